#include "base/errors.h"
#include "base/version.h"
#include "io/drafts.h"
#include "io/hdf5/internal.h"

#include <deal.II/base/exceptions.h>

namespace mesoslip
{
using hdf5::attribute_text, hdf5::dataset_text;

namespace
{
/**
 * Values in the form of the library; texts become UTF-8 padded with zeros to the
 * longest.
 * @throws NumericalFailure for a number that is not finite.
 */
struct Encoded
{
  template <typename T>
  Encoded(const std::string &text, const T *values, const std::size_t n)
    : data(values)
  {
    if constexpr (std::is_same_v<T, std::string>)
      {
        std::size_t longest = 1;
        for (std::size_t i = 0; i < n; ++i)
          longest = std::max(longest, values[i].size());
        type = Hdf5Handle(H5Tcopy(H5T_C_S1));
        H5Tset_size(type, longest);
        H5Tset_cset(type, H5T_CSET_UTF8);
        H5Tset_strpad(type, H5T_STR_NULLPAD);
        for (std::size_t i = 0; i < n; ++i)
          characters += values[i] + std::string(longest - values[i].size(), '\0');
        data = characters.data();
      }
    else
      {
        type = Hdf5Handle(H5Tcopy(hdf5::native_type<T>()));
        if (const std::string found = hdf5::not_finite(values, n); !found.empty())
          throw NumericalFailure(
            text + " would hold " + found +
            "; look for an input that is far too large, and at its unit");
      }
  }

  Hdf5Handle type;
  const void *data;
  std::string characters;
};

/** Link properties that create intermediate groups. */
Hdf5Handle link_properties()
{
  Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links, 1);
  return links;
}

/** Dataset properties without times, so that equal results are equal files. */
Hdf5Handle creation_properties()
{
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(properties, false);
  return properties;
}
} // namespace

void Hdf5File::create_group(const std::string &name)
{
  if (exists(name))
    return;
  const Hdf5Handle links = link_properties();
  const Hdf5Handle group(H5Gcreate2(file, name.c_str(), links, H5P_DEFAULT, H5P_DEFAULT));
  if (!group.valid())
    fail_writing("the group " + name + " cannot be created");
}

void Hdf5File::remove(const std::string &name)
{
  if (exists(name) && H5Ldelete(file, name.c_str(), H5P_DEFAULT) < 0)
    fail_writing(name + " cannot be replaced");
}

template <typename T>
void Hdf5File::write(const std::string &name,
                     const Shape &shape,
                     const std::vector<T> &data)
{
  Assert(writable && file.valid(), dealii::ExcMessage("the file is not being written"));
  const std::size_t n = hdf5::product(shape);
  AssertThrow(data.size() == n, dealii::ExcDimensionMismatch(data.size(), n));
  const Encoded values(file_path + ": " + dataset_text(name), data.data(), n);
  remove(name);
  const Hdf5Handle space = hdf5::make_space(shape), links = link_properties(),
                   properties = creation_properties();
  Hdf5Handle dataset(
    H5Dcreate2(file, name.c_str(), values.type, space, links, properties, H5P_DEFAULT));
  if (!dataset.valid() ||
      (n > 0 &&
       H5Dwrite(dataset, values.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data) < 0) ||
      !dataset.close())
    fail_writing(dataset_text(name) + " cannot be written");
}

template <typename T>
void Hdf5File::write_attribute(const std::string &object,
                               const std::string &name,
                               const T &value)
{
  const std::string text = attribute_text(object, name);
  const auto write_them  = [&](const Shape &shape, const auto *values) {
    const std::size_t n = hdf5::product(shape);
    const Encoded encoded(file_path + ": " + text, values, n);
    create_group(object);
    const Hdf5Handle owner = open_object(object, ""), space = hdf5::make_space(shape);
    if (H5Aexists(owner, name.c_str()) > 0)
      H5Adelete(owner, name.c_str());
    Hdf5Handle attribute(
       H5Acreate2(owner, name.c_str(), encoded.type, space, H5P_DEFAULT, H5P_DEFAULT));
    if (!attribute.valid() ||
        (n > 0 && H5Awrite(attribute, encoded.type, encoded.data) < 0) ||
        !attribute.close())
      fail_writing(text + " cannot be written");
  };
  Assert(writable && file.valid(), dealii::ExcMessage("the file is not being written"));
  if constexpr (hdf5::is_vector<T> || hdf5::array_size < T >> 0)
    write_them({value.size()}, value.data());
  else
    write_them({}, &value);
}

template <typename T>
void Hdf5File::reserve(const std::string &name, const Shape &shape)
{
  remove(name);
  const Hdf5Handle space = hdf5::make_space(shape), links = link_properties(),
                   properties = creation_properties();
  H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER);
  Hdf5Handle dataset(H5Dcreate2(file, name.c_str(), hdf5::native_type<T>(), space, links,
                                properties, H5P_DEFAULT));
  if (!dataset.valid() || !dataset.close())
    fail_writing(dataset_text(name) + " cannot be created");
}

void Hdf5File::reserve_rows(const std::string &name,
                            const Shape &shape,
                            const std::size_t n_together,
                            const StoredNumber stored)
{
  if (exists(name))
    {
      if (H5Dset_extent(open_dataset(name, ""), hdf5::dims(shape).data()) < 0)
        fail_writing(dataset_text(name) + " cannot be lengthened or shortened");
      return;
    }
  Shape chunk = shape;
  chunk[0]    = std::max<std::size_t>(1, std::min(n_together, shape[0]));
  // The library's limit for chunks is 4 GB.
  while (hdf5::product(chunk) > (std::size_t(1) << 28))
    chunk[1] = (chunk[1] + 1) / 2;
  std::vector<hsize_t> limits = hdf5::dims(shape);
  limits[0]                   = H5S_UNLIMITED;
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()),
                                          hdf5::dims(shape).data(), limits.data()));
  const Hdf5Handle links = link_properties(), properties = creation_properties();
  H5Pset_chunk(properties, static_cast<int>(chunk.size()), hdf5::dims(chunk).data());
  const bool empty = DraftMark::leaves_empty();
  H5Pset_alloc_time(properties, empty ? H5D_ALLOC_TIME_INCR : H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(properties, empty ? H5D_FILL_TIME_IFSET : H5D_FILL_TIME_NEVER);
  Hdf5Handle dataset(
    H5Dcreate2(file, name.c_str(),
               stored == StoredNumber::byte ? H5T_NATIVE_UINT8 : H5T_NATIVE_DOUBLE, space,
               links, properties, H5P_DEFAULT));
  if (!dataset.valid() || !dataset.close())
    fail_writing(dataset_text(name) + " cannot be created");
}

template <typename T>
void Hdf5File::write_row(const std::string &name,
                         const std::size_t row,
                         const std::vector<T> &values)
{
  const Encoded encoded(file_path + ": " + dataset_text(name), values.data(),
                        values.size());
  // Writes bypass the chunk cache.
  const Hdf5Handle access(H5Pcreate(H5P_DATASET_ACCESS));
  H5Pset_chunk_cache(access, 0, 0, 0.);
  Hdf5Handle dataset(H5Dopen2(file, name.c_str(), access));
  Shape count = shape_of(dataset, dataset_text(name)), offset(count.size(), 0);
  const std::size_t n_rows = count[0];
  count[0]  = values.size() / hdf5::product({count.begin() + 1, count.end()});
  offset[0] = row;
  AssertThrow(row + count[0] <= n_rows, dealii::ExcIndexRange(row, 0, n_rows));
  AssertThrow(values.size() == hdf5::product(count),
              dealii::ExcDimensionMismatch(values.size(), hdf5::product(count)));
  const Hdf5Handle memory = hdf5::make_space(count),
                   space  = hdf5::select_block(dataset, offset, count);
  if (H5Dwrite(dataset, encoded.type, memory, space, H5P_DEFAULT, encoded.data) < 0 ||
      !dataset.close())
    fail_writing(dataset_text(name) + " cannot be written");
}

void Hdf5File::write_header(const std::string &format,
                            const int format_version,
                            const int dim,
                            const std::string &digest)
{
  write_attribute("/", "format", format);
  write_attribute("/", "format_version", format_version);
  write_attribute("/", "dim", dim);
  write_attribute("/", "program_version", std::string(version));
  write_attribute("/", "digest", DraftMark::is_set() ? draft_digest : digest);
}

#define MESOSLIP_INSTANTIATE(T)                                                        \
  template void Hdf5File::write<T>(const std::string &, const Shape &,                 \
                                   const std::vector<T> &);                            \
  template void Hdf5File::write_attribute<T>(const std::string &, const std::string &, \
                                             const T &);                               \
  template void Hdf5File::write_attribute<std::array<T, 2>>(                           \
    const std::string &, const std::string &, const std::array<T, 2> &);               \
  template void Hdf5File::write_attribute<std::array<T, 3>>(                           \
    const std::string &, const std::string &, const std::array<T, 3> &);               \
  template void Hdf5File::write_attribute<std::vector<T>>(                             \
    const std::string &, const std::string &, const std::vector<T> &);
MESOSLIP_HDF5_TYPES(MESOSLIP_INSTANTIATE)
#undef MESOSLIP_INSTANTIATE
#define MESOSLIP_INSTANTIATE(T)                                                \
  template void Hdf5File::reserve<T>(const std::string &, const Shape &);      \
  template void Hdf5File::write_row<T>(const std::string &, const std::size_t, \
                                       const std::vector<T> &);
MESOSLIP_INSTANTIATE(double)
MESOSLIP_INSTANTIATE(std::uint8_t)
MESOSLIP_INSTANTIATE(std::uint16_t)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
