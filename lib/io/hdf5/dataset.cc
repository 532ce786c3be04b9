#include "io/hdf5/internal.h"
#include "io/hdf5_file.h"
#include "io/text.h"

#include <algorithm>

namespace mesoslip
{
using hdf5::Handle;

namespace
{
/** Chunks of long rows, in bytes; what is read or compressed at a time. */
constexpr std::size_t large_chunk = 1 << 20;
/** Chunks of many short rows; also the least a dataset takes on the disk. */
constexpr std::size_t small_chunk = 1 << 15;

/** Splits an array into chunks along its leading axes until they are small enough; equal
 *  ones, as the last one takes as much space as the others. */
Shape chunk_shape(const Shape &shape, const std::size_t number_bytes)
{
  Shape chunk = shape;
  for (std::size_t axis = 0; axis < chunk.size(); ++axis)
    {
      std::size_t rest = number_bytes;
      for (std::size_t other = axis + 1; other < chunk.size(); ++other)
        rest *= chunk[other];
      chunk[axis] = std::clamp<std::size_t>(large_chunk / std::max<std::size_t>(rest, 1),
                                            1, std::max<std::size_t>(chunk[axis], 1));
      const std::size_t n_chunks =
        (shape[axis] + chunk[axis] - 1) / std::max<std::size_t>(chunk[axis], 1);
      if (n_chunks > 0)
        chunk[axis] = (shape[axis] + n_chunks - 1) / n_chunks;
      if (chunk[axis] > 1)
        break;
    }
  return chunk;
}

std::string dataset_text(const std::string &name)
{
  return "the dataset " + name;
}

bool same_shape(const Shape &shape, const Shape &expected)
{
  return shape.size() == expected.size() &&
         std::equal(shape.begin(), shape.end(), expected.begin(),
                    [](const std::size_t a, const std::size_t b) {
                      return a == b || b == any_extent;
                    });
}

Handle creation_properties(const Shape &chunk, const unsigned int compression)
{
  Handle properties(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(properties, false); // equal results are equal files
  if (!chunk.empty())
    {
      H5Pset_chunk(properties, static_cast<int>(chunk.size()), hdf5::dims(chunk).data());
      if (compression > 0)
        {
          H5Pset_shuffle(properties);
          H5Pset_deflate(properties, std::min(compression, 9u));
        }
    }
  return properties;
}

Handle link_properties()
{
  Handle links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links, 1);
  return links;
}
} // namespace

Hdf5File::Id Hdf5File::open_dataset(const std::string &name,
                                    const std::string &hint) const
{
  if (!exists(name))
    fail(dataset_text(name) + " is missing", hint);
  Handle object(open_object(name, hint));
  if (H5Iget_type(object) != H5I_DATASET)
    fail(name + " is not a dataset", hint);
  check_storage(name, object);
  return object.release();
}

void Hdf5File::check_storage(const std::string &name, const Id dataset) const
{
  const Handle properties(H5Dget_create_plist(dataset));
  const H5D_layout_t layout = H5Pget_layout(properties);
  // Nothing of ours lies in the header of its dataset, where the library (1.10) would
  // read beyond what a damaged file has.
  if (layout == H5D_COMPACT)
    fail(dataset_text(name) + " is stored in its header, as no program here does");
  if (layout == H5D_VIRTUAL || H5Pget_external_count(properties) != 0)
    fail(dataset_text(name) +
         " has its values outside this file, where they are not read; copy them into it");
  if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED)
    fail(dataset_text(name) + " cannot be opened: the file is damaged");
}

Shape Hdf5File::shape_of(const std::string &name, const Id dataset) const
{
  const Handle space(H5Dget_space(dataset));
  std::vector<hsize_t> extents;
  if (!hdf5::read_extents(space, extents))
    fail(dataset_text(name) + " holds nothing or is damaged");
  return Shape(extents.begin(), extents.end());
}

Shape Hdf5File::shape(const std::string &name, const std::string &hint) const
{
  const hdf5::CrashGuard guard(file_path);
  const Handle dataset(open_dataset(name, hint));
  Shape extents   = shape_of(name, dataset);
  const auto open = extendables.find(name);
  if (open != extendables.end())
    extents[0] += open->second.buffered_rows();
  return extents;
}

void Hdf5File::write_raw(const std::string &name,
                         const Shape &shape,
                         const Id type,
                         const void *data,
                         const unsigned int compression)
{
  require_writable();
  remove(name);
  const std::size_t n     = hdf5::product(shape);
  const bool chunk        = compression > 0 && !shape.empty() && n > 0;
  const Handle space      = hdf5::make_space(shape);
  const Handle properties = creation_properties(
    chunk ? chunk_shape(shape, H5Tget_size(type)) : Shape(), compression);
  const Handle links = link_properties();
  const Handle dataset(
    H5Dcreate2(file, name.c_str(), type, space, links, properties, H5P_DEFAULT));
  if (!dataset.valid())
    fail_writing(dataset_text(name) + " cannot be created");
  if (n > 0 && H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    fail_writing(dataset_text(name) + " cannot be written");
}

template <typename T>
void Hdf5File::write(const std::string &name,
                     const Shape &shape,
                     const T *data,
                     const unsigned int compression)
{
  hdf5::require_finite(file_path, dataset_text(name), data, hdf5::product(shape));
  write_raw(name, shape, hdf5::native_type<T>(), data, compression);
}

template <typename T>
void Hdf5File::write(const std::string &name,
                     const Shape &shape,
                     const std::vector<T> &data,
                     const unsigned int compression)
{
  if (data.size() != hdf5::product(shape))
    throw std::logic_error(file_path + ": " + dataset_text(name) + " of shape " +
                           to_text(shape) + " is given " + std::to_string(data.size()) +
                           " numbers");
  write(name, shape, data.data(), compression);
}

void Hdf5File::write_strings(const std::string &name,
                             const std::vector<std::string> &strings)
{
  const hdf5::FixedStrings texts(strings);
  write_raw(name, {strings.size()}, texts.type, texts.characters.data(), 0);
}

std::vector<std::string> Hdf5File::read_strings(const std::string &name,
                                                const std::string &hint) const
{
  const hdf5::CrashGuard guard(file_path);
  const Handle dataset(open_dataset(name, hint));
  std::vector<std::string> strings;
  if (!hdf5::read_all_strings(dataset, false, strings))
    fail(dataset_text(name) + " is not a list of texts of fixed length", hint);
  if (!std::all_of(strings.begin(), strings.end(), is_utf8))
    fail(dataset_text(name) + " holds a text that is not UTF-8", hint);
  return strings;
}

void Hdf5File::check_type(const std::string &name, const Id dataset, const Id type) const
{
  const Handle stored(H5Dget_type(dataset));
  const auto found = H5Tget_class(stored), wanted = H5Tget_class(type);
  if (found != H5T_INTEGER && found != H5T_FLOAT)
    fail(dataset_text(name) + " does not hold numbers");
  if (found == H5T_FLOAT && wanted == H5T_INTEGER)
    fail(dataset_text(name) + " does not hold whole numbers");
}

void Hdf5File::check_size(const std::string &name,
                          const Id dataset,
                          const Shape &extents) const
{
  const Handle type(H5Dget_type(dataset)), properties(H5Dget_create_plist(dataset));
  const std::size_t bytes    = H5Tget_size(type);
  std::vector<hsize_t> chunk = {};
  if (H5Pget_layout(properties) == H5D_CHUNKED)
    {
      chunk.resize(H5S_MAX_RANK);
      const int rank = H5Pget_chunk(properties, H5S_MAX_RANK, chunk.data());
      chunk.resize(static_cast<std::size_t>(std::max(rank, 0)));
    }
  std::size_t n = 0;
  if (!hdf5::count_values(dataset, hdf5::dims(extents), bytes, n) ||
      !hdf5::count_values(dataset, chunk, bytes, n))
    fail(dataset_text(name) + " of shape " + to_text(extents) +
         " is larger than the file can hold: the file is truncated or damaged");
}

template <typename T>
void Hdf5File::check_finite(const std::string &name, const std::vector<T> &data) const
{
  const std::size_t position = hdf5::find_not_finite(data.data(), data.size());
  if (position < data.size())
    fail(dataset_text(name) + " holds a value that is not finite, at position " +
         std::to_string(position) + " of " + std::to_string(data.size()));
}

template <typename T>
std::vector<T> Hdf5File::read(const std::string &name,
                              const Shape &expected,
                              const std::string &hint) const
{
  const hdf5::CrashGuard guard(file_path);
  const Handle dataset(open_dataset(name, hint));
  check_type(name, dataset, hdf5::native_type<T>());
  const Shape extents = shape_of(name, dataset);
  if (!expected.empty() && !same_shape(extents, expected))
    fail(dataset_text(name) + " has the shape " + to_text(extents) + " instead of " +
           to_text(expected),
         hint);
  check_size(name, dataset, extents);
  std::vector<T> data(hdf5::product(extents));
  if (!data.empty() && H5Dread(dataset, hdf5::native_type<T>(), H5S_ALL, H5S_ALL,
                               H5P_DEFAULT, data.data()) < 0)
    fail(dataset_text(name) + " cannot be read: the file is truncated or damaged");
  check_finite(name, data);
  return data;
}

template <typename T>
std::vector<T> Hdf5File::read_block(const std::string &name,
                                    const Shape &offset,
                                    const Shape &count,
                                    const std::string &hint) const
{
  const hdf5::CrashGuard guard(file_path);
  const Handle dataset(open_dataset(name, hint));
  check_type(name, dataset, hdf5::native_type<T>());
  const Shape extents = shape_of(name, dataset);
  bool inside         = offset.size() == extents.size() && count.size() == extents.size();
  for (std::size_t axis = 0; inside && axis < extents.size(); ++axis)
    inside = offset[axis] <= extents[axis] && count[axis] <= extents[axis] - offset[axis];
  if (!inside)
    fail(dataset_text(name) + " has the shape " + to_text(extents) +
           ", which does not hold " + to_text(count) + " values from position " +
           to_text(offset),
         hint);

  check_size(name, dataset, count);
  std::vector<T> data(hdf5::product(count));
  if (data.empty())
    return data;
  const Handle space(H5Dget_space(dataset));
  // Of the same rank as the selection: otherwise HDF5 maps every number by itself.
  const Handle memory = hdf5::make_space(count);
  if (H5Sselect_hyperslab(space, H5S_SELECT_SET, hdf5::dims(offset).data(), nullptr,
                          hdf5::dims(count).data(), nullptr) < 0 ||
      H5Dread(dataset, hdf5::native_type<T>(), memory, space, H5P_DEFAULT, data.data()) <
        0)
    fail(dataset_text(name) + " cannot be read: the file is truncated or damaged");
  check_finite(name, data);
  return data;
}

template <typename T>
void Hdf5File::create_extendable(const std::string &name,
                                 const Shape &row_shape,
                                 const unsigned int compression)
{
  require_writable();
  const Id type = hdf5::native_type<T>();
  if (exists(name))
    {
      if (open_extendable(name, type).row_shape != row_shape)
        fail(dataset_text(name) + " exists with rows of another shape than " +
             to_text(row_shape));
      return;
    }
  const std::size_t row_bytes = hdf5::product(row_shape) * sizeof(T);
  if (row_bytes == 0)
    throw std::logic_error(file_path + ": " + dataset_text(name) + " has empty rows");
  Shape extents = {0};
  extents.insert(extents.end(), row_shape.begin(), row_shape.end());
  Shape chunk = extents;
  chunk[0]    = std::max<std::size_t>(small_chunk / row_bytes, 1);
  chunk       = chunk_shape(chunk, sizeof(T));

  std::vector<hsize_t> limits = hdf5::dims(extents);
  limits[0]                   = H5S_UNLIMITED;
  const Handle space(H5Screate_simple(static_cast<int>(extents.size()),
                                      hdf5::dims(extents).data(), limits.data()));
  const Handle properties = creation_properties(chunk, compression);
  const Handle links      = link_properties();
  const Handle dataset(
    H5Dcreate2(file, name.c_str(), type, space, links, properties, H5P_DEFAULT));
  if (!dataset.valid())
    fail_writing(dataset_text(name) + " cannot be created");
  open_extendable(name, type);
}
#define MESOSLIP_INSTANTIATE(T)                                                    \
  template void Hdf5File::write<T>(const std::string &, const Shape &,             \
                                   const std::vector<T> &, const unsigned int);    \
  template void Hdf5File::write<T>(const std::string &, const Shape &, const T *,  \
                                   const unsigned int);                            \
  template std::vector<T> Hdf5File::read<T>(const std::string &, const Shape &,    \
                                            const std::string &) const;            \
  template std::vector<T> Hdf5File::read_block<T>(                                 \
    const std::string &, const Shape &, const Shape &, const std::string &) const; \
  template void Hdf5File::create_extendable<T>(const std::string &, const Shape &, \
                                               const unsigned int);
MESOSLIP_INSTANTIATE(double)
MESOSLIP_INSTANTIATE(float)
MESOSLIP_INSTANTIATE(int)
MESOSLIP_INSTANTIATE(unsigned int)
MESOSLIP_INSTANTIATE(std::int64_t)
MESOSLIP_INSTANTIATE(std::uint64_t)
MESOSLIP_INSTANTIATE(std::uint8_t)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
