#include "sliding/sweep/run_end.h"

#include "base/errors.h"
#include "base/files.h"
#include "base/object_exchange.h"
#include "io/checkpoint.h"

namespace mesoslip
{
namespace
{
const char kind[] = "end of contact_dynamics, layout 1";

/** Content of the file. */
struct EndRecord
{
  LoadsAtEnd loads;
  std::vector<std::string> states; ///< by rank

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &loads.flat_velocity &loads.pressure &states;
  }
};

EndRecord read_record(const std::string &folder)
{
  const std::string file = run_end_file(folder);
  require_readable_file("Time/Continue from: ", file,
                        "run it with Checkpoints/Write end = true");
  EndRecord record;
  load_state(read_checkpoint(file, kind), record, file);
  return record;
}

/** Final state of a run from which another run may start. */
template <int dim>
struct RunEnd
{
  SlidingBody<dim> &body;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    body.serialize_end(archive);
  }
};
} // namespace

std::string run_end_file(const std::string &folder)
{
  return file_or_in_folder(folder, "contact_dynamics.end");
}

template <int dim>
void write_run_end(SlidingBody<dim> &body,
                   const double time,
                   const std::string &folder,
                   const MPI_Comm communicator)
{
  EndRecord record = {
    {body.setup.contact.flat_velocity(time), body.setup.top.pressure(time)},
    gather(communicator, save_state(RunEnd<dim>{body}))};
  on_root(communicator, [&]() {
    write_checkpoint(folder + "/contact_dynamics.end", kind, save_state(record));
  });
}

LoadsAtEnd loads_at_end(const std::string &folder, const MPI_Comm communicator)
{
  LoadsAtEnd loads;
  on_root(communicator, [&]() { loads = read_record(folder).loads; });
  return mpi::broadcast(loads, 0, communicator);
}

namespace
{
/** Reads the part of this rank. */
std::string read_run_end(const std::string &folder, const MPI_Comm communicator)
{
  std::vector<std::string> of_ranks;
  on_root(communicator, [&]() {
    of_ranks = read_record(folder).states;
    if (const auto n = static_cast<std::size_t>(mpi::n_mpi_processes(communicator));
        of_ranks.size() != n)
      throw UserError("Time/Continue from: " + run_end_file(folder) + " is of " +
                      std::to_string(of_ranks.size()) + " ranks, and this run has " +
                      std::to_string(n) + "; start as many");
  });
  return scatter(communicator, of_ranks);
}
} // namespace

template <int dim>
void start_from_end(SlidingBody<dim> &body,
                    const std::string &folder,
                    const MPI_Comm communicator)
{
  const std::string own = read_run_end(folder, communicator);
  RunEnd<dim> end{body};
  try
    {
      load_state(own, end, run_end_file(folder));
    }
  catch (const UserError &error)
    {
      throw UserError(
        "Time/Continue from is for runs of the same body with the same kinds "
        "of laws: " +
        std::string(error.what()));
    }
}

template void
write_run_end(SlidingBody<2> &, const double, const std::string &, const MPI_Comm);
template void
write_run_end(SlidingBody<3> &, const double, const std::string &, const MPI_Comm);
template void start_from_end(SlidingBody<2> &, const std::string &, const MPI_Comm);
template void start_from_end(SlidingBody<3> &, const std::string &, const MPI_Comm);
} // namespace mesoslip
