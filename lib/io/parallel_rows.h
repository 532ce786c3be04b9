#ifndef mesoslip_io_parallel_rows_h
#define mesoslip_io_parallel_rows_h

#include "io/hdf5_file.h"

#include <mpi.h>

namespace mesoslip
{
/**
 * Collective writer for a dataset of Hdf5File::reserve() or reserve_rows(): each rank
 * writes a piece of a row or some rows through MPI-IO (a single rank through the file as
 * it is). Before, rank 0 calls Hdf5File::leave(); after destruction it calls
 * Hdf5File::resume(), which accepts the file since only rows change. All members are
 * collective.
 */
class ParallelRows
{
public:
  /** Opens dataset @p name of `<path>.part`. @throws UserError on all ranks */
  ParallelRows(const std::string &path,
               const std::string &name,
               const MPI_Comm communicator);

  /**
   * Writes the @p values of this rank into row @p row from index @p first on along the
   * second axis; pieces of different ranks do not overlap.
   * @throws NumericalFailure for numbers that are not finite, UserError if the file
   * cannot be written, on all ranks
   */
  void write(const std::size_t row,
             const std::size_t first,
             const std::vector<double> &values);

  /** Writes the @p values of this rank, whole rows from row @p first on; rows of
   * different ranks do not overlap.
   * @throws as write() */
  void write_rows(const std::size_t first, const std::vector<double> &values);

  /** Waits until written data are on the disk. */
  void sync();

private:
  Shape extent() const;
  void
  write_block(const Shape &offset, const Shape &count, const std::vector<double> &values);
  void require(const bool fine, const std::string &what) const;

  const std::string path, name;
  const MPI_Comm communicator;
  bool parallel = false;    ///< whether there are several ranks
  Hdf5Handle file, dataset; ///< file is closed last
};
} // namespace mesoslip

#endif
