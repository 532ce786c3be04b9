// What every program does with its command line, seen from the shell.
#include "io_testing.h"

#include "base/files.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <thread>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
struct Result
{
  int status = -1;
  std::string out;
  std::string err;
};

/** Runs io_program in @p folder, optionally behind @p launcher. */
Result run(const TemporaryFolder &folder,
           const std::string &words,
           const std::string &launcher = "")
{
  const std::string command = "cd " + folder.path + " && " + launcher +
                              " '" IO_PROGRAM "' " + words + " >out.txt 2>err.txt";
  const int status = std::system(command.c_str());
  Result result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.out    = read_file(folder / "out.txt");
  result.err    = read_file(folder / "err.txt");
  return result;
}

/** Expects status 2, nothing on stdout, one line on stderr with @p part. */
void expect_user_error(const Result &result, const std::string &part)
{
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err.rfind("io_program: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  expect_contains(result.err, part);
}

const std::string mpirun =
  "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 '" MPIEXEC
  "' --oversubscribe "
  "-np 2";
} // namespace

TEST(CommandLineTest, BadInputIsOneSentence)
{
  const TemporaryFolder folder;
  write_file(folder / "a.prm", "set Dimension = 2\nsubsection Tme step\nend\n");
  write_file(folder / "empty.prm", " \n");
  expect_user_error(run(folder, ""), "a parameter file (.prm) is needed; see --help");
  expect_user_error(run(folder, "no.prm"), "there is no file no.prm");
  expect_user_error(run(folder, "."), ". is a folder");
  expect_user_error(run(folder, "empty.prm"), "empty.prm is empty");
  expect_user_error(run(folder, "--bogus a.prm"), "'--bogus'");
  expect_user_error(run(folder, "a.prm b.prm"), "'a.prm' and 'b.prm' are given");
  expect_user_error(run(folder, "a.prm"), "a.prm:2: there is no subsection 'Tme step'");
  EXPECT_FALSE(std::filesystem::exists(folder / "output")) << "bad input creates nothing";
}

TEST(CommandLineTest, PrintedParametersAreAParameterFile)
{
  const TemporaryFolder folder;
  const Result first = run(folder, "--print-parameters");
  EXPECT_EQ(first.status, 0);
  expect_contains(first.out, "  # Of the limit [-]; a number in (0, 1]\n"
                             "  set Fraction = 0.3333333333333333\n");
  write_file(folder / "all.prm", first.out);
  EXPECT_EQ(run(folder, "--print-parameters all.prm").out, first.out);
  const Result more =
    run(folder, "--print-parameters all.prm --set 'Phases/Names=matrix, b'");
  expect_contains(more.out, "  subsection b\n");
}

TEST(CommandLineTest, ARunLeavesItsPapers)
{
  const TemporaryFolder folder;
  const std::string prm = "set Dimension = 3 # odd   spacing \r\n";
  std::filesystem::create_directory(folder / "in");
  write_file(folder / "in/a.prm", prm);
  write_file(folder / "in/x.png", "x");
  const std::string set =
    " --set 'Phases/Names = matrix,fibre' --set 'Phases/fibre/Density=7' ";
  const Result result = run(folder, "in/a.prm -o res --profile" + set);
  EXPECT_EQ(result.status, 0) << result.err;
  expect_contains(result.out, "\n  Work ");
  EXPECT_EQ(read_file(folder / "res/original.prm"), prm);
  const auto summary = nlohmann::json::parse(read_file(folder / "res/summary.json"));
  EXPECT_EQ(summary["program"], "io_program");
  EXPECT_EQ(summary["dim"], 3);
  EXPECT_TRUE(summary["cells"].is_null());
  EXPECT_EQ(summary["ranks"], 1);
  EXPECT_GT(summary["peak_memory_bytes"].get<double>(), 1e6);
  EXPECT_GT(summary["seconds"]["total"].get<double>(), 0.);
  expect_contains(read_file(folder / "res/log.txt"), "io_program 0.1.0, 1 process");

  // The effective parameters say the same without any --set.
  const Result again = run(folder, "res/parameters.prm -q -o res2");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out, "");
  const auto without_defaults = [](std::string text) {
    return text.substr(text.find("set "));
  };
  expect_contains(read_file(folder / "res/parameters.prm"), "set Density = 7");
  EXPECT_EQ(without_defaults(read_file(folder / "res/parameters.prm")),
            without_defaults(read_file(folder / "res2/parameters.prm")));

  // Paths in a .prm start at its folder, those of --set at the current one.
  write_file(folder / "in/b.prm", "subsection Input\nset Image file = x.png\nend\n");
  EXPECT_EQ(run(folder, "in/b.prm").status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "output/b/summary.json"));
  expect_user_error(run(folder, "in/b.prm --set 'Input/Image file=x.png'"),
                    "Input/Image file: there is no file " + folder.path +
                      "/x.png; draw one first");
  std::ofstream(folder / "file") << "x";
  expect_user_error(run(folder, "in/b.prm --output file"),
                    "is not a folder; give another one");
  expect_user_error(run(folder, "in/b.prm --output none --resume"), "nothing to resume");
}

TEST(CommandLineTest, ValidateCreatesNothing)
{
  const TemporaryFolder folder;
  write_file(folder / "a.prm", "set Dimension = 2\n");
  const Result result = run(folder, "a.prm --validate");
  EXPECT_EQ(result.status, 0);
  expect_contains(result.out, "memory 1 MB");
  EXPECT_FALSE(std::filesystem::exists(folder / "output"));
}

TEST(CommandLineTest, FailuresHaveTheirStatus)
{
  const TemporaryFolder folder;
  write_file(folder / "a.prm", "set Output folder = out\n");
  Result result = run(folder, "a.prm --set Behaviour=succeed");
  EXPECT_EQ(result.status, 0);
  result = run(folder, "a.prm --quiet --set Behaviour=nan");
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(result.err,
            "io_program: summary.json: 'speed/mean' is not a finite number\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "out/summary.json"))
    << "not even the old one";
  result = run(folder, "a.prm --quiet --set Behaviour=fail");
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(
    result.err,
    "io_program: the velocity is not finite in step 12 at t = 1.5e-06 s, node (3, 4)\n");
  expect_contains(read_file(folder / "out/log.txt"),
                  "stopped: the velocity is not finite");
  result = run(folder, "a.prm --quiet --set Behaviour=logic");
  EXPECT_EQ(result.status, 1);
  expect_contains(result.err, "asks for the parameter 'Undeclared' without declaring it");
  result = run(folder, "a.prm --quiet --set Behaviour=solver");
  EXPECT_EQ(result.status, 3);
  expect_contains(result.err,
                  "a linear solver did not converge: residual 0.5 after 7 iter");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
}

TEST(CommandLineTest, StopsOnRequestAndLocksItsFolder)
{
  const TemporaryFolder folder;
  write_file(folder / "a.prm", "set Output folder = out\nset Behaviour = wait\n");
  for (const bool by_signal : {true, false})
    {
      const int started = std::system(
        ("cd " + folder.path +
         " && { '" IO_PROGRAM
         "' a.prm -q 2>wait.txt & echo $! >pid.txt; wait $!; echo $? >status.txt; } &")
          .c_str());
      ASSERT_EQ(started, 0);
      for (int i = 0; i < 500 && !std::filesystem::exists(folder / "out/log.txt"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      expect_user_error(run(folder, "a.prm"),
                        "is in use by a run that has not ended (process ");
      if (by_signal)
        kill(std::stoi(read_file(folder / "pid.txt")), SIGTERM);
      else
        write_file(folder / "out/terminate", "");
      for (int i = 0; i < 500 && !std::filesystem::exists(folder / "status.txt"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      EXPECT_EQ(read_file(folder / "status.txt"), "130\n");
      expect_contains(read_file(folder / "wait.txt"), "io_program: stopped after step ");
      std::filesystem::remove(folder / "status.txt");
      std::filesystem::remove(folder / "out/log.txt");
    }
}

TEST(CommandLineTest, SeveralRanksSpeakWithOneVoice)
{
  const TemporaryFolder folder;
  write_file(folder / "a.prm", "set Output folder = out\n");
  Result result = run(folder, "a.prm", mpirun);
  EXPECT_EQ(result.status, 0) << result.err;
  expect_contains(read_file(folder / "out/summary.json"), "\"ranks\": 2");
  const auto times = [&](const std::string &part) {
    int n = 0;
    for (auto at = result.err.find(part); at != std::string::npos;
         at      = result.err.find(part, at + 1))
      ++n;
    return n;
  };
  result = run(folder, "a.prm --set Behaviour=fail", mpirun);
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(times("the velocity is not finite"), 1) << result.err;
  result = run(folder, "no.prm", mpirun);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(times("there is no file"), 1) << result.err;
  // One rank fails, the other waits for it in vain.
  result = run(folder, "a.prm --set 'Behaviour=one rank'", mpirun);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(times("io_program (process 1): only this rank is in trouble"), 1)
    << result.err;
}
