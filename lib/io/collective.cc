#include "io/collective.h"

#include "io/errors.h"

namespace mesoslip
{
void broadcast(const MPI_Comm communicator, std::string &text)
{
  int n_ranks = 1;
  MPI_Comm_size(communicator, &n_ranks);
  if (n_ranks == 1)
    return;
  unsigned long long length = text.size();
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, 0, communicator);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, 0, communicator);
}

namespace
{
/** A letter for the class of the exception, then its message; "" for success. */
std::string outcome_of(const std::function<void()> &work)
{
  try
    {
      work();
      return "";
    }
  catch (const UserError &error)
    {
      return std::string("U") + error.what();
    }
  catch (const NumericalFailure &error)
    {
      return std::string("N") + error.what();
    }
  catch (const Interrupted &error)
    {
      return std::string("I") + error.what();
    }
  catch (const std::exception &error)
    {
      return std::string("X") + error.what();
    }
}
} // namespace

void on_root(const MPI_Comm communicator, const std::function<void()> &work)
{
  int n_ranks = 1, rank = 0;
  MPI_Comm_size(communicator, &n_ranks);
  MPI_Comm_rank(communicator, &rank);
  if (n_ranks == 1)
    return work();

  std::string outcome = rank == 0 ? outcome_of(work) : "";
  broadcast(communicator, outcome);
  if (outcome.empty())
    return;
  const std::string message = outcome.substr(1);
  switch (outcome.front())
    {
    case 'U':
      throw UserError(message);
    case 'N':
      throw NumericalFailure(message);
    case 'I':
      throw Interrupted(message);
    default:
      throw std::runtime_error(message);
    }
}
} // namespace mesoslip
