#include "program/serve.h"

#include "base/errors.h"
#include "base/exchange.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#ifdef __linux__
#  include <csignal>
#  include <sys/prctl.h>
#endif

namespace mesoslip
{
namespace
{
/** Parses a list of words.
 * @throws UserError */
std::vector<std::string> words_of(const std::string &line)
{
  const auto words = nlohmann::json::parse(line, nullptr, false);
  const bool valid =
    words.is_array() && std::all_of(words.begin(), words.end(),
                                    [](const auto &word) { return word.is_string(); });
  if (!valid)
    throw UserError("--serve expects a JSON list of words on each line, not: " + line);
  return words.template get<std::vector<std::string>>();
}

} // namespace

void serve_runs(const Application &program)
{
  if (mpi::n_mpi_processes(MPI_COMM_WORLD) > 1)
    throw UserError("--serve is for one process, which others start; leave out mpirun");
#ifdef __linux__
  // If the process that started this one is killed, the current run stops and leaves its
  // checkpoint.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
  for (std::string line; std::getline(std::cin, line);)
    {
      const Outcome outcome = carry_out(words_of(line), program, MPI_COMM_WORLD);
      std::cout << nlohmann::json({{"status", static_cast<int>(outcome.status)},
                                   {"message", outcome.message}})
                     .dump(-1, ' ', true)
                << std::endl;
      if (!std::cout)
        throw UserError("--serve: the answer cannot be written");
      if (outcome.status == ExitStatus::interrupted)
        return;
    }
}
} // namespace mesoslip
