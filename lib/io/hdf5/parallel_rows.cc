#include "io/parallel_rows.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "io/hdf5/internal.h"

#include <deal.II/base/exceptions.h>

#include <unistd.h>

namespace mesoslip
{
namespace
{
/** Whether @p fine is true on all ranks. */
bool on_all(const bool fine, const MPI_Comm communicator)
{
  return mpi::min(fine ? 1U : 0U, communicator) > 0;
}
} // namespace

ParallelRows::ParallelRows(const std::string &path,
                           const std::string &name,
                           const MPI_Comm communicator)
  : path(path)
  , name(name)
  , communicator(communicator)
  , parallel(mpi::n_mpi_processes(communicator) > 1)
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Hdf5Handle of_file(H5Pcreate(H5P_FILE_ACCESS)),
    of_dataset(H5Pcreate(H5P_DATASET_ACCESS));
  const bool fine =
    !parallel || H5Pset_fapl_mpio(of_file, communicator, MPI_INFO_NULL) >= 0;
  file = Hdf5Handle(H5Fopen((path + ".part").c_str(), H5F_ACC_RDWR, of_file));
  require(fine && file.valid(), "cannot be opened by all processes");
  // Writes bypass the chunk cache.
  H5Pset_chunk_cache(of_dataset, 0, 0, 0.);
  dataset = Hdf5Handle(H5Dopen2(file, name.c_str(), of_dataset));
  require(dataset.valid(), hdf5::dataset_text(name) + " cannot be opened");
}

void ParallelRows::write(const std::size_t row,
                         const std::size_t first,
                         const std::vector<double> &values)
{
  const Shape all = extent();
  Shape count     = all, offset(all.size(), 0);
  AssertThrow(row < all[0], dealii::ExcIndexRange(row, 0, all[0]));
  count[0]  = 1;
  count[1]  = values.size() / hdf5::product({all.begin() + 2, all.end()});
  offset[0] = row;
  offset[1] = first;
  write_block(offset, count, values);
}

void ParallelRows::write_rows(const std::size_t first, const std::vector<double> &values)
{
  const Shape all = extent();
  Shape count     = all, offset(all.size(), 0);
  count[0]        = values.size() / hdf5::product({all.begin() + 1, all.end()});
  offset[0]       = first;
  write_block(offset, count, values);
}

Shape ParallelRows::extent() const
{
  const Hdf5Handle extents(H5Dget_space(dataset));
  std::vector<hsize_t> all(static_cast<std::size_t>(H5Sget_simple_extent_ndims(extents)));
  H5Sget_simple_extent_dims(extents, all.data(), nullptr);
  return {all.begin(), all.end()};
}

void ParallelRows::write_block(const Shape &offset,
                               const Shape &count,
                               const std::vector<double> &values)
{
  if (!on_all(hdf5::not_finite(values.data(), values.size()).empty(), communicator))
    throw NumericalFailure(path + ": " + hdf5::dataset_text(name) +
                           " would hold a value that is not finite; look for an input "
                           "that is far too large, and at its unit");
  const Shape all = extent();
  bool inside     = values.size() == hdf5::product(count);
  for (std::size_t axis = 0; axis < all.size() && !values.empty(); ++axis)
    inside = inside && offset[axis] + count[axis] <= all[axis];
  AssertThrow(inside, dealii::ExcMessage("a piece has to lie in the dataset"));
  const Hdf5Handle memory = hdf5::make_space(count),
                   space  = hdf5::select_block(dataset, offset, count);
  require(values.empty() || H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space,
                                     H5P_DEFAULT, values.data()) >= 0,
          hdf5::dataset_text(name) + " cannot be written");
}

void ParallelRows::sync()
{
  void *descriptor = nullptr;
  bool fine        = H5Fget_vfd_handle(file, H5P_DEFAULT, &descriptor) >= 0;
  if (fine)
    fine = parallel ? MPI_File_sync(*static_cast<MPI_File *>(descriptor)) == MPI_SUCCESS
                    : fsync(*static_cast<const int *>(descriptor)) == 0;
  require(fine, "cannot be written");
}

void ParallelRows::require(const bool fine, const std::string &what) const
{
  if (on_all(fine, communicator))
    return;
  hdf5::note_failed_writing();
  throw UserError(path + ".part: " + what + " (is the disk full?)");
}
} // namespace mesoslip
