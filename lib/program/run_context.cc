#include "program/run_context.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "base/files.h"
#include "base/version.h"
#include "program/outcome.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

volatile std::sig_atomic_t signal_received = 0;
timespec first_signal                      = {};

// Terminals, timeout and mpirun may deliver a request twice.
extern "C" void mesoslip_on_signal(int)
{
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (signal_received == 0)
    first_signal = now;
  else if (now.tv_sec - first_signal.tv_sec > 1)
    _exit(130);
  signal_received = 1;
}

void install_signal_handlers()
{
  struct sigaction action = {};
  action.sa_handler       = mesoslip_on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

std::string date_and_time()
{
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M:%S", std::localtime(&now));
  return text;
}

/** Throws for the first number that is not finite; JSON would turn it into null. */
void require_finite(const nlohmann::json &node, const std::string &path)
{
  if (node.is_number_float() && !std::isfinite(node.get<double>()))
    throw NumericalFailure("summary.json: '" + path + "' is not a finite number");
  if (node.is_object())
    for (const auto &[key, child] : node.items())
      require_finite(child, path.empty() ? key : path + "/" + key);
  if (node.is_array())
    for (std::size_t i = 0; i < node.size(); ++i)
      require_finite(node[i], path + "[" + std::to_string(i) + "]");
}
} // namespace

RunContext::RunContext(const std::string &program,
                       const CommandLine &line,
                       const MPI_Comm communicator,
                       const std::string &original,
                       const std::string &effective,
                       Timer &timer)
  : program(program)
  , run_options(line)
  , comm(communicator)
  , run_timer(timer)
  , run_summary(std::make_unique<nlohmann::json>())
  , original_parameters(original)
  , effective_parameters(effective)
  , next_look(std::chrono::steady_clock::now())
{
  MPI_Comm_rank(comm, &my_rank);
  MPI_Comm_size(comm, &size);
  const bool quiet = run_options.quiet || !root();
  progress_display = std::make_unique<Progress>(std::cout, Progress::choose_mode(quiet));
  on_root(comm, [&]() {
    if (run_options.resume && !fs::is_directory(output_folder()))
      throw UserError("there is nothing to resume: the output folder " + output_folder() +
                      " does not exist");
    std::error_code code;
    fs::create_directories(output_folder(), code);
    if (code)
      throw UserError("the output folder " + output_folder() + " cannot be created (" +
                      (fs::is_symlink(output_folder())
                         ? "it is a link to what is not there"
                         : code.message()) +
                      "); give another one with --output");
    lock = std::make_unique<FolderLock>(output_folder());
    std::error_code ignored;
    fs::remove(file("terminate"), ignored);
  });
  // The parameters come first: a folder with a log but without them is refused, also when
  // a run was killed in between.
  if (!run_options.resume)
    begin();
  on_root(comm, [&]() {
    log_file.open(file("log.txt"), run_options.resume ? std::ios::app : std::ios::trunc);
    if (!log_file)
      throw UserError(file("log.txt") + ": cannot be written (" + system_message() + ")");
  });

  *run_summary = {{"program", program},
                  {"version", version},
                  {"dim", nullptr},
                  {"cells", nullptr},
                  {"dofs", nullptr},
                  {"ranks", size},
                  {"warnings", nlohmann::json::array()}};
  log(program + " " + version + ", " + std::to_string(size) +
      (size == 1 ? " process, " : " processes, ") + date_and_time() + ", " +
      run_options.prm_file + " -> " + output_folder());
  install_signal_handlers();
}

RunContext::~RunContext() = default;

void RunContext::begin()
{
  begun = true;
  on_root(comm, [&]() {
    std::error_code ignored;
    fs::remove(file("summary.json"), ignored);
    write_file(file("parameters.prm"), effective_parameters);
    write_file(file("original.prm"), original_parameters);
  });
}

void RunContext::remove_results(const std::vector<std::string> &names)
{
  std::error_code ignored;
  results = names;
  for (const std::string &name : names)
    for (const std::string &path : {file(name), file(name + ".part")})
      if (root() && fs::is_regular_file(path, ignored))
        fs::remove(path, ignored);
}

void RunContext::remove_begun_results() const
{
  std::error_code ignored;
  for (const std::string &name : results)
    if (root())
      fs::remove(file(name + ".part"), ignored);
}

std::string RunContext::file(const std::string &name) const
{
  return output_folder() + "/" + name;
}

void RunContext::log(const std::string &line)
{
  if (!root())
    return;
  log_file << line << std::endl;
  if (run_options.quiet)
    return;
  progress_display->clear();
  std::cout << line << std::endl;
}

void RunContext::log_to_file(const std::string &line)
{
  if (root())
    log_file << line << std::endl;
}

void RunContext::warn(const std::string &line)
{
  if (!root())
    return;
  nlohmann::json &warnings = (*run_summary)["warnings"];
  if (std::find(warnings.begin(), warnings.end(), line) == warnings.end())
    warnings.push_back(line);
  log_file << "warning: " << line << std::endl;
  if (run_options.nested) // already in its log
    return;
  progress_display->clear();
  say(program, "warning: " + line);
}

bool RunContext::stop_requested_here()
{
  if (signal_received != 0)
    return true;
  const auto now = std::chrono::steady_clock::now();
  if (!root() || now < next_look)
    return false;
  next_look = now + std::chrono::milliseconds(250);
  std::error_code ignored;
  return fs::exists(file("terminate"), ignored);
}

bool RunContext::stop_requested()
{
  int stop = stop_requested_here() ? 1 : 0;
  if (size > 1)
    MPI_Allreduce(MPI_IN_PLACE, &stop, 1, MPI_INT, MPI_MAX, comm);
  return stop != 0;
}

void RunContext::write_summary()
{
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  unsigned long long memory = 1024ull * static_cast<unsigned long long>(usage.ru_maxrss);
  if (size > 1)
    MPI_Allreduce(MPI_IN_PLACE, &memory, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, comm);
  (*run_summary)["seconds"]           = run_timer.json();
  (*run_summary)["peak_memory_bytes"] = memory;
  on_root(comm, [&]() {
    require_finite(*run_summary, "");
    write_file(file("summary.json"), run_summary->dump(2) + "\n");
  });
  on_root(comm, [&]() {
    if (!log_file)
      throw UserError(file("log.txt") + ": cannot be written (is the disk full?), so the "
                                        "log is not complete; the results are");
  });
}
} // namespace mesoslip
