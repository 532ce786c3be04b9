#include "base/collective.h"

#include "base/errors.h"

#include <algorithm>
#include <deal.II/base/mpi.h>

namespace mesoslip
{
namespace
{
// Messages have fewer than 2^31 bytes.
constexpr std::size_t longest_message = 1 << 30;

void send(const MPI_Comm communicator, const int rank, const std::string &text)
{
  unsigned long long length = text.size();
  MPI_Send(&length, 1, MPI_UNSIGNED_LONG_LONG, rank, 0, communicator);
  for (std::size_t at = 0; at < text.size(); at += longest_message)
    MPI_Send(text.data() + at,
             static_cast<int>(std::min(longest_message, text.size() - at)), MPI_CHAR,
             rank, 0, communicator);
}

std::string receive(const MPI_Comm communicator, const int rank)
{
  unsigned long long length = 0;
  MPI_Recv(&length, 1, MPI_UNSIGNED_LONG_LONG, rank, 0, communicator, MPI_STATUS_IGNORE);
  std::string text(length, '\0');
  for (std::size_t at = 0; at < text.size(); at += longest_message)
    MPI_Recv(text.data() + at,
             static_cast<int>(std::min(longest_message, text.size() - at)), MPI_CHAR,
             rank, 0, communicator, MPI_STATUS_IGNORE);
  return text;
}
} // namespace

void broadcast(const MPI_Comm communicator, std::string &text, const int owner)
{
  text = dealii::Utilities::MPI::broadcast(communicator, text, owner);
}

void bring_to_root(const MPI_Comm communicator, std::string &text, const int owner)
{
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  if (owner == 0)
    return;
  if (rank == owner)
    send(communicator, 0, text);
  else if (rank == 0)
    text = receive(communicator, owner);
}

std::vector<std::string> gather(const MPI_Comm communicator, const std::string &text)
{
  int n_ranks = 1, rank = 0;
  MPI_Comm_size(communicator, &n_ranks);
  MPI_Comm_rank(communicator, &rank);
  std::vector<std::string> texts;
  if (rank > 0)
    send(communicator, 0, text);
  else
    {
      texts.push_back(text);
      for (int r = 1; r < n_ranks; ++r)
        texts.push_back(receive(communicator, r));
    }
  return texts;
}

std::string scatter(const MPI_Comm communicator, const std::vector<std::string> &texts)
{
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  if (rank > 0)
    return receive(communicator, 0);
  for (std::size_t r = 1; r < texts.size(); ++r)
    send(communicator, static_cast<int>(r), texts[r]);
  return texts.front();
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
