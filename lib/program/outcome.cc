#include "program/outcome.h"

#include "base/object_exchange.h"
#include "base/text.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/solver_control.h>

#include <chrono>
#include <iostream>
#include <new>
#include <sstream>
#include <thread>

namespace mesoslip
{
namespace
{
/** deal.II's multi-line message as one sentence. */
std::string one_line(const dealii::ExceptionBase &error)
{
  std::ostringstream info;
  error.print_info(info);
  std::istringstream words(info.str());
  std::string text, word;
  while (words >> word)
    text += (text.empty() ? "" : " ") + word;
  const std::string location = error.what();
  const auto begin           = location.find("An error occurred in line");
  if (begin == std::string::npos)
    return text;
  return text + " (" + location.substr(begin, location.find('\n', begin) - begin) + ")";
}

/** Whether @p request completes in time. */
bool completes(MPI_Request &request, const std::chrono::seconds limit)
{
  const auto deadline = std::chrono::steady_clock::now() + limit;
  int done            = 0;
  while (true)
    {
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      if (done != 0 || std::chrono::steady_clock::now() > deadline)
        return done != 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}
} // namespace

void say(const std::string &speaker, const std::string &sentence)
{
  std::cerr << speaker + ": " + sentence + "\n" << std::flush;
}

Outcome describe_current_exception()
{
  try
    {
      throw;
    }
  catch (const UserError &error)
    {
      return {ExitStatus::user_error, error.what()};
    }
  catch (const NumericalFailure &error)
    {
      return {ExitStatus::numerical_failure, error.what()};
    }
  catch (const Interrupted &error)
    {
      return {ExitStatus::interrupted, error.what()};
    }
  catch (const dealii::SolverControl::NoConvergence &error)
    {
      return {ExitStatus::numerical_failure,
              "a linear solver did not converge: residual " +
                to_text(error.last_residual) + " after " +
                std::to_string(error.last_step) + " iterations"};
    }
  catch (const dealii::ExceptionBase &error)
    {
      return {ExitStatus::unexpected, "internal error: " + one_line(error)};
    }
  catch (const std::bad_alloc &)
    {
      return {ExitStatus::unexpected,
              "there is not enough memory; --validate estimates what a run needs"};
    }
  catch (const std::exception &error)
    {
      return {ExitStatus::unexpected, std::string("internal error: ") + error.what()};
    }
  catch (...)
    {
      return {ExitStatus::unexpected, "internal error of unknown kind"};
    }
}

Outcome shared_outcome(const MPI_Comm communicator,
                       const std::string &program,
                       const Outcome &outcome)
{
  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &n_ranks);
  if (n_ranks == 1)
    return outcome;
  const bool failed = outcome.status != ExitStatus::done;

  // The first failing rank reports for all.
  int mine = failed ? rank : n_ranks, speaker = n_ranks;
  MPI_Request request;
  MPI_Iallreduce(&mine, &speaker, 1, MPI_INT, MPI_MIN, communicator, &request);
  if (failed && !completes(request, std::chrono::seconds(10)))
    {
      say(program + " (process " + std::to_string(rank) + ")", outcome.message);
      MPI_Abort(communicator, static_cast<int>(outcome.status));
    }
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  Outcome shared = outcome;
  if (speaker < n_ranks)
    {
      broadcast_object(communicator, shared.status, speaker);
      broadcast_object(communicator, shared.message, speaker);
    }
  return shared;
}
} // namespace mesoslip
