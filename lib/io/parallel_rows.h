#ifndef mesoslip_io_parallel_rows_h
#define mesoslip_io_parallel_rows_h

#include "io/hdf5_file.h"

#include <mpi.h>

namespace mesoslip
{
/**
 * A dataset of Hdf5File::reserve() or reserve_rows() into which all ranks write together, each a piece
 * of a row or some rows, through MPI-IO (on one rank through the file as it is). Rank 0 has left the
 * file with Hdf5File::leave() and takes it back with Hdf5File::resume() when this object is
 * gone. Nothing but the rows changes in the file, so it stays one that resume() takes.
 * All members are collective.
 */
class ParallelRows
{
public:
  /** Opens dataset @p name of `<path>.part`. @throws UserError on all ranks */
  ParallelRows(const std::string &path,
               const std::string &name,
               const MPI_Comm communicator);

  /**
   * Writes the @p values of this rank into row @p row from place @p first on along the
   * second axis; the pieces of the ranks do not overlap. @throws NumericalFailure for
   * numbers that are not finite, UserError if the file cannot be written, on all ranks
   */
  void write(const std::size_t row,
             const std::size_t first,
             const std::vector<double> &values);

  /** Writes the @p values of this rank, whole rows from row @p first on; those of the ranks do
   * not overlap. @throws as write() */
  void write_rows(const std::size_t first, const std::vector<double> &values);

  /** Waits until what was written is on the disk. */
  void sync();

private:
  Shape extent() const;
  void
  write_block(const Shape &offset, const Shape &count, const std::vector<double> &values);
  void require(const bool fine, const std::string &what) const;

  const std::string path, name;
  const MPI_Comm communicator;
  bool parallel = false;    ///< whether there are several ranks
  Hdf5Handle file, dataset; ///< the first is closed last
};
} // namespace mesoslip

#endif
