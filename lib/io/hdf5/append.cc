#include "io/hdf5/internal.h"
#include "io/hdf5_file.h"

#include <algorithm>

namespace mesoslip
{
using hdf5::Handle;

Hdf5File::Extendable &Hdf5File::open_extendable(const std::string &name, const Id type)
{
  const auto known = extendables.find(name);
  if (known != extendables.end())
    return known->second;

  Handle dataset(open_dataset(name, ""));
  const Shape extents = shape_of(name, dataset);
  check_type(name, dataset, type);
  const Handle properties(H5Dget_create_plist(dataset));
  std::vector<hsize_t> chunk(std::max<std::size_t>(extents.size(), 1), 1);
  if (extents.empty() || H5Pget_layout(properties) != H5D_CHUNKED ||
      H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data()) < 0)
    fail("the dataset " + name + " cannot be extended");

  Extendable target;
  target.type        = type;
  target.rows        = extents.front();
  target.row_shape   = Shape(extents.begin() + 1, extents.end());
  target.row_bytes   = hdf5::product(target.row_shape) * H5Tget_size(type);
  target.buffer_rows = chunk.front();
  target.dataset     = dataset.release();
  return extendables.emplace(name, std::move(target)).first->second;
}

Hdf5File::Extendable &Hdf5File::extendable(const std::string &name, const Id type)
{
  require_writable();
  Extendable &target = open_extendable(name, type);
  if (H5Tequal(target.type, type) <= 0)
    throw std::logic_error(file_path + ": the dataset " + name +
                           " is given rows of another type than it was created with");
  return target;
}

void Hdf5File::append_raw(const std::string &name,
                          const Id type,
                          const void *data,
                          const std::size_t n_rows)
{
  Extendable &target = extendable(name, type);
  const char *bytes  = static_cast<const char *>(data);
  if (target.buffer_rows <= 1)
    return write_rows(name, target, bytes, n_rows);
  target.buffer.insert(target.buffer.end(), bytes, bytes + n_rows * target.row_bytes);
  if (target.buffered_rows() >= target.buffer_rows)
    write_buffer(name, target);
}

void Hdf5File::write_rows(const std::string &name,
                          Extendable &target,
                          const void *data,
                          const std::size_t n_rows)
{
  if (n_rows == 0)
    return;
  Shape extents = {target.rows + n_rows}, offset = {target.rows}, count = {n_rows};
  for (const std::size_t extent : target.row_shape)
    {
      extents.push_back(extent);
      offset.push_back(0);
      count.push_back(extent);
    }
  const bool extended = H5Dset_extent(target.dataset, hdf5::dims(extents).data()) >= 0;
  const Handle space(H5Dget_space(target.dataset));
  const Handle memory = hdf5::make_space(count);
  if (!extended ||
      H5Sselect_hyperslab(space, H5S_SELECT_SET, hdf5::dims(offset).data(), nullptr,
                          hdf5::dims(count).data(), nullptr) < 0 ||
      H5Dwrite(target.dataset, target.type, memory, space, H5P_DEFAULT, data) < 0)
    fail_writing("the dataset " + name + " cannot be written");
  target.rows += n_rows;
}

void Hdf5File::write_buffer(const std::string &name, Extendable &target)
{
  write_rows(name, target, target.buffer.data(), target.buffered_rows());
  target.buffer.clear();
}

void Hdf5File::truncate_rows(const std::string &name, const std::size_t n_rows)
{
  require_writable();
  const auto known = extendables.find(name);
  if (known != extendables.end())
    write_buffer(name, known->second);
  const Handle dataset(open_dataset(name, ""));
  Shape extents = shape_of(name, dataset);
  if (extents.empty() || n_rows > extents.front())
    fail("the dataset " + name + " has the shape " + to_text(extents) + ", but " +
         std::to_string(n_rows) + " rows are needed");
  extents.front() = n_rows;
  if (H5Dset_extent(dataset, hdf5::dims(extents).data()) < 0)
    fail("the dataset " + name + " cannot be shortened");
  if (known != extendables.end())
    known->second.rows = n_rows;
}

template <typename T>
void Hdf5File::append(const std::string &name, const T *data, const std::size_t n_rows)
{
  const Id type                = hdf5::native_type<T>();
  const std::size_t row_values = extendable(name, type).row_bytes / sizeof(T);
  hdf5::require_finite(file_path, "the dataset " + name, data, n_rows * row_values);
  append_raw(name, type, data, n_rows);
}

#define MESOSLIP_INSTANTIATE(T) \
  template void Hdf5File::append<T>(const std::string &, const T *, const std::size_t);
MESOSLIP_INSTANTIATE(double)
MESOSLIP_INSTANTIATE(float)
MESOSLIP_INSTANTIATE(int)
MESOSLIP_INSTANTIATE(unsigned int)
MESOSLIP_INSTANTIATE(std::int64_t)
MESOSLIP_INSTANTIATE(std::uint64_t)
MESOSLIP_INSTANTIATE(std::uint8_t)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
