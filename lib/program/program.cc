#include "program/program.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "base/files.h"
#include "base/text.h"
#include "base/version.h"
#include "io/drafts.h"
#include "io/hdf5_file.h"
#include "parameters/keys.h"
#include "program/command_line.h"
#include "program/other_program.h"
#include "program/outcome.h"
#include "program/output_folder.h"
#include "program/parameter_file.h"
#include "program/run_context.h"
#include "program/serve.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

namespace mesoslip
{
namespace
{
constexpr char output_key[] = "Output folder";

/** Resolves "nope/../r" to r even if nope does not exist, so that it is not created. */
std::string without_detours(const std::string &folder)
{
  namespace fs = std::filesystem;
  const fs::path path(folder);
  if (std::find(path.begin(), path.end(), "..") == path.end())
    return folder;
  return fs::proximate(fs::weakly_canonical(path)).string();
}

std::string choose_output_folder(const CommandLine &line, const Keys &keys)
{
  if (!line.output.empty())
    return without_detours(line.output);
  const std::string &folder = keys.value(output_key);
  if (!folder.empty())
    return without_detours(folder);
  return "output/" + std::filesystem::path(line.prm_file).stem().string();
}

/** Checks that requested output was printed. */
void require_printed()
{
  if (!std::cout.flush())
    throw UserError("the standard output cannot be written; is the disk full?");
}

void validate(const Analysis &analysis,
              const CommandLine &line,
              const std::string &folder)
{
  std::ostringstream report;
  analysis.describe(report);
  try
    {
      if (!line.draft.empty())
        analysis.write_draft(without_detours(line.draft));
    }
  catch (const std::exception &)
    {
      discard_draft();
      throw;
    }
  if (mpi::this_mpi_process(MPI_COMM_WORLD) > 0 || line.quiet)
    return;
  std::cout << line.prm_file << ": the parameters are valid; the results would go to "
            << folder << '\n'
            << report.str();
  if (const unsigned int n = analysis.useful_ranks(); n > 1)
    std::cout << "up to " << n << " ranks on idle cores make it faster\n";
  require_printed();
}

void run(Analysis &analysis,
         const Application &program,
         const Keys &keys,
         const CommandLine &line,
         const std::string &original,
         const MPI_Comm communicator,
         Timer &timer)
{
  CommandLine options = line;
  options.output      = choose_output_folder(line, keys);
  options.resume      = line.resume && analysis.resumable();

  std::ostringstream effective;
  effective << "# " << program.name << ' ' << version
            << (line.nested ? ": what differs from the defaults in this run\n"
                            : ": all parameters of this run\n");
  if (line.nested) // the folder of one out of many runs stays small
    print_given(keys, effective);
  else
    print_parameters(keys, effective);

  RunContext context(program.name, options, communicator, original, effective.str(),
                     timer);
  if (line.trial)
    {
      context.summary()["draft"] = true;
      context.warn("--try: what this run reads may be drafts, what it writes are drafts");
    }
  if (line.resume && !options.resume)
    context.log("--resume: a run of this kind keeps no checkpoints, it starts from the "
                "beginning");
  try
    {
      analysis.run(context);
      if (!context.has_begun())
        return;
      context.progress().finish();
      context.write_summary();
      context.log("done in " + duration_text(context.timer().total()));
    }
  catch (const std::exception &)
    {
      context.progress().finish();
      if (!analysis.resumable())
        context.remove_begun_results();
      Outcome outcome = describe_current_exception();
      std::error_code ignored;
      if (outcome.status == ExitStatus::user_error && analysis.resumable() &&
          context.has_begun() &&
          outcome.message.find("without --resume") == std::string::npos &&
          std::filesystem::exists(context.file(program.name + ".checkpoint"), ignored))
        outcome.message += "; the same command with --resume goes on from the last "
                           "checkpoint once this is mended";
      context.log_to_file("stopped: " + outcome.message);
      if (outcome.status == ExitStatus::user_error)
        throw UserError(outcome.message);
      throw;
    }
  if (options.profile && context.root())
    context.timer().print(std::cout);
}

void do_what_is_asked(const CommandLine &line,
                      const Application &program,
                      const MPI_Comm communicator,
                      Timer &timer)
{
  const bool root = mpi::this_mpi_process(communicator) == 0;
  std::string text, output;
  const RawParameters raw = read_parameter_file(line, communicator, text);
  refuse_file_of_other_program(raw, program.name);
  Keys keys(raw);
  keys.bind(output_key, output,
            "Folder for the results, relative to the current folder; empty: "
            "output/<name of the .prm>");
  program.declare(keys);
  keys.apply();
  program.declare(keys);
  if (line.print_parameters)
    {
      if (root)
        {
          std::cout << "# " << program.name << ' ' << version << '\n';
          print_parameters(keys, std::cout);
        }
      return require_printed();
    }
  const std::string folder = choose_output_folder(line, keys);
  on_root(communicator, [&]() {
    check_output_folder(folder, program.name, keys);
    if (line.trial && std::filesystem::exists(folder))
      throw UserError("--try: there is a folder " + folder +
                      " already; name a new one with --output");
  });
  if (line.validate || line.trial)
    accept_drafts();
  std::optional<DraftMark> mark;
  if (line.trial)
    mark.emplace(true);
  const std::unique_ptr<Analysis> analysis = [&]() {
    const auto scope = timer.scope("Reading and checking");
    return program.build(keys);
  }();
  if (!line.resume) // a resumed run already has its disk space
    on_root(communicator, [&]() { require_disk(folder, analysis->need()); });
  if (line.validate)
    validate(*analysis, line, folder);
  else
    run(*analysis, program, keys, line, text, communicator, timer);
}
} // namespace

void Analysis::write_draft(const std::string & /*folder*/) const
{
  throw UserError(
    "--draft: no later run checks itself with what this one computes; leave "
    "--draft out");
}

namespace
{
/** Outcome of @p action, which all ranks of @p communicator call, on the first rank where
 * it fails; the same on all ranks. */
template <typename Action>
Outcome
outcome_of(const Action &action, const Application &program, const MPI_Comm communicator)
{
  // A communicator of its own, so that these messages do not mix with messages of ranks
  // still at work.
  MPI_Comm concluding = dealii::Utilities::MPI::duplicate_communicator(communicator);
  Outcome outcome;
  try
    {
      action();
    }
  catch (...)
    {
      outcome = describe_current_exception();
    }
  outcome = shared_outcome(concluding, program.name, outcome);
  dealii::Utilities::MPI::free_communicator(concluding);
  return outcome;
}
} // namespace

Outcome carry_out(const std::vector<std::string> &words,
                  const Application &program,
                  const MPI_Comm communicator)
{
  std::vector<const char *> all = {program.name.c_str()};
  for (const std::string &word : words)
    all.push_back(word.c_str());
  const auto run = [&]() {
    CommandLine line =
      CommandLine::parse(static_cast<int>(all.size()), all.data(), program.draft);
    line.nested = true;
    Timer timer;
    do_what_is_asked(line, program, communicator, timer);
  };
  return outcome_of(run, program, communicator);
}

namespace
{
/** Answers --help and --version without MPI, which takes longer to start; false for other
 * command lines. */
bool tells_of_itself(int argc, char **argv, const Application &program)
{
  CommandLine line;
  try
    {
      line = CommandLine::parse(argc, argv, program.draft);
    }
  catch (const UserError &)
    {
      return false; // reported later, by one rank
    }
  if (!line.help && !line.version)
    return false;
  if (is_first_process())
    std::cout << (line.help ? CommandLine::help_text(program.name, program.description,
                                                     program.draft)
                            : program.name + " (mesoslip) " + version + "\n");
  require_printed();
  return true;
}

void require_current_folder()
{
  std::error_code code;
  if (std::filesystem::current_path(code).empty())
    throw UserError("the current folder is not there any more; change to another one");
}
} // namespace

int run_program(int argc, char **argv, const Application &program)
{
  // Makes the file size limit ("ulimit -f") an ordinary write error.
  std::signal(SIGXFSZ, SIG_IGN);
  try
    {
      if (tells_of_itself(argc, argv, program))
        return 0;
      Timer timer;
      std::optional<Timer::Scope> starting = timer.scope("Start of MPI");
      prepare_mpi_of_one_process();
      require_current_folder();
      // Hides the command line from PETSc, which would report unknown options, and
      // disables its option files and variables. Its destructor aborts while an exception
      // is active: no exception passes this line.
      unsetenv("PETSC_OPTIONS");
      std::string no_file         = "-skip_petscrc";
      std::array<char *, 3> words = {{argv[0], no_file.data(), nullptr}};
      int n_words                 = 2;
      char **of_petsc             = words.data();
      dealii::Utilities::MPI::MPI_InitFinalize mpi(n_words, of_petsc, 1);
      dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
      starting.reset();
      const auto do_it = [&]() {
        const CommandLine line = CommandLine::parse(argc, argv, program.draft);
        if (line.serve)
          serve_runs(program);
        else
          do_what_is_asked(line, program, MPI_COMM_WORLD, timer);
      };
      const Outcome outcome = outcome_of(do_it, program, MPI_COMM_WORLD);
      const int status      = static_cast<int>(outcome.status);
      if (outcome.status != ExitStatus::done && is_first_process())
        say(program.name, outcome.message);
      if (Hdf5File::writing_has_failed())
        {
          std::cout << std::flush;
          std::_Exit(status);
        }
      return status;
    }
  catch (...)
    {
      const Outcome outcome = describe_current_exception();
      say(program.name, outcome.message);
      return static_cast<int>(outcome.status);
    }
}
} // namespace mesoslip
