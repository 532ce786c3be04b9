#include "base/text.h"
#include "io/drafts.h"
#include "io/hdf5/internal.h"

#include <cstring>

namespace mesoslip
{
using hdf5::attribute_text, hdf5::dataset_text;

namespace
{
bool same_shape(const Shape &shape, const Shape &expected)
{
  return std::equal(
    shape.begin(), shape.end(), expected.begin(), expected.end(),
    [](const std::size_t a, const std::size_t b) { return a == b || b == any_extent; });
}

/** Reason why a dataset cannot be read: a missing filter, or damage. */
std::string reading_failure(const hid_t object)
{
  const bool is_dataset = H5Iget_type(object) == H5I_DATASET;
  const Hdf5Handle properties(is_dataset ? H5Dget_create_plist(object) : -1);
  for (int k = 0; is_dataset && k < H5Pget_nfilters(properties); ++k)
    {
      char name[64]      = "";
      std::size_t n      = 0;
      unsigned int flags = 0;
      const auto filter = H5Pget_filter2(properties, static_cast<unsigned int>(k), &flags,
                                         &n, nullptr, sizeof name, name, nullptr);
      if (filter >= 0 && H5Zfilter_avail(filter) <= 0)
        return "cannot be read: it is compressed by the filter '" + std::string(name) +
               "' (number " + std::to_string(filter) +
               "), which the HDF5 library here does not have; save it with gzip or "
               "uncompressed";
    }
  return "cannot be read: the file is truncated or damaged";
}
/** Stops conversion of a number out of range of the memory type; HDF5 would clamp it. */
H5T_conv_ret_t refuse(const H5T_conv_except_t what,
                      const hid_t /*from*/,
                      const hid_t /*to*/,
                      void * /*source*/,
                      void * /*destination*/,
                      void *refused)
{
  if (what != H5T_CONV_EXCEPT_RANGE_HI && what != H5T_CONV_EXCEPT_RANGE_LOW)
    return H5T_CONV_UNHANDLED;
  *static_cast<bool *>(refused) = true;
  return H5T_CONV_ABORT;
}
} // namespace

Hdf5Handle Hdf5File::open_dataset(const std::string &name, const std::string &hint) const
{
  Hdf5Handle object = open_object(name, hint);
  if (H5Iget_type(object) != H5I_DATASET)
    fail(name + " is not a dataset", hint);
  return object;
}

Shape Hdf5File::shape_of(const Hdf5Handle &object, const std::string &text) const
{
  const Hdf5Handle space(H5Iget_type(object) == H5I_ATTR ? H5Aget_space(object)
                                                         : H5Dget_space(object));
  std::vector<hsize_t> extents(H5S_MAX_RANK);
  const int rank = H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  if (rank < 0 || H5Sget_simple_extent_type(space) == H5S_NULL)
    fail(text + " holds nothing or is damaged");
  return Shape(extents.begin(), extents.begin() + rank);
}

Shape Hdf5File::shape(const std::string &name, const std::string &hint) const
{
  const Hdf5Handle dataset = open_dataset(name, hint);
  require_numbers(dataset, name);
  return shape_of(dataset, dataset_text(name));
}

void Hdf5File::require_numbers(const Hdf5Handle &dataset, const std::string &name) const
{
  if (const std::string what = hdf5::missing_numbers(file_path, dataset); !what.empty())
    fail(dataset_text(name) + " " + what);
}

bool Hdf5File::is_floating(const std::string &name) const
{
  const Hdf5Handle type(H5Dget_type(open_dataset(name, "")));
  return H5Tget_class(type) == H5T_FLOAT;
}

template <typename T>
std::vector<T> Hdf5File::read_values(const Hdf5Handle &object,
                                     const std::string &text,
                                     const Shape &shape,
                                     const Hdf5Handle *selection) const
{
  constexpr bool texts    = std::is_same_v<T, std::string>;
  const bool is_attribute = H5Iget_type(object) == H5I_ATTR;
  const Hdf5Handle type(is_attribute ? H5Aget_type(object) : H5Dget_type(object));
  const auto kind = H5Tget_class(type);
  if (texts && kind != H5T_STRING)
    fail(text + " is not a text or a list of texts");
  // h5py saves truth values as an enumeration.
  if (!texts && kind != H5T_INTEGER && kind != H5T_FLOAT && kind != H5T_ENUM)
    fail(text + " does not hold numbers");
  if (std::is_integral_v<T> && kind == H5T_FLOAT)
    fail(text + " does not hold whole numbers");

  const std::size_t n = hdf5::product(shape);
  // The memory space has the rank of the selection: otherwise HDF5 maps each number
  // separately.
  const Hdf5Handle memory = hdf5::make_space(shape);
  bool beyond             = false;
  const Hdf5Handle transfer(H5Pcreate(H5P_DATASET_XFER));
  H5Pset_type_conv_cb(transfer, refuse, &beyond);
  const auto read_as = [&](const hid_t memory_type, void *values) {
    const hid_t space = selection == nullptr ? H5S_ALL : static_cast<hid_t>(*selection);
    const bool failed = n > 0 && (is_attribute ? H5Aread(object, memory_type, values)
                                               : H5Dread(object, memory_type, memory,
                                                         space, transfer, values)) < 0;
    if (beyond)
      fail(text +
           " holds a number that it cannot, negative or too large: another program "
           "wrote it, or it is damaged");
    if (failed)
      fail(text + " " + reading_failure(object));
  };
  std::vector<T> values(n);
  if constexpr (!texts)
    {
      read_as(hdf5::native_type<T>(), values.data());
      if (const std::string found = hdf5::not_finite(values.data(), n); !found.empty())
        fail(text + " holds " + found);
    }
  else if (H5Tis_variable_str(type) > 0)
    {
      std::vector<char *> found(n, nullptr);
      read_as(type, found.data());
      for (std::size_t i = 0; i < n; ++i)
        values[i] = found[i] == nullptr ? "" : found[i];
      H5Dvlen_reclaim(type, memory, H5P_DEFAULT, found.data());
    }
  else
    {
      const std::size_t length = H5Tget_size(type);
      std::string all(length * n, '\0');
      read_as(type, all.data());
      for (std::size_t i = 0; i < n; ++i)
        values[i].assign(&all[i * length], strnlen(&all[i * length], length));
    }
  if constexpr (texts)
    if (!std::all_of(values.begin(), values.end(), is_utf8))
      fail(text + " holds a text that is not UTF-8");
  return values;
}

template <typename T>
std::vector<T> Hdf5File::read(const std::string &name,
                              const Shape &expected,
                              const std::string &hint) const
{
  const Hdf5Handle dataset = open_dataset(name, hint);
  require_numbers(dataset, name);
  const Shape extents = shape_of(dataset, dataset_text(name));
  if (!expected.empty() && !same_shape(extents, expected))
    fail(dataset_text(name) + " has the shape " + to_text(extents) + " instead of " +
           to_text(expected),
         hint);
  return read_values<T>(dataset, dataset_text(name), extents);
}

template <typename T>
std::vector<T> Hdf5File::read_block(const std::string &name,
                                    const Shape &offset,
                                    const Shape &count,
                                    const std::string &hint) const
{
  const Hdf5Handle dataset = open_dataset(name, hint);
  const Shape extents      = shape_of(dataset, dataset_text(name));
  bool inside = offset.size() == extents.size() && count.size() == extents.size();
  for (std::size_t axis = 0; inside && axis < extents.size(); ++axis)
    inside = offset[axis] <= extents[axis] && count[axis] <= extents[axis] - offset[axis];
  if (!inside)
    fail(dataset_text(name) + " has the shape " + to_text(extents) +
           ", which does not hold " + to_text(count) + " values from position " +
           to_text(offset),
         hint);
  const Hdf5Handle selection = hdf5::select_block(dataset, offset, count);
  return read_values<T>(dataset, dataset_text(name), count, &selection);
}

bool Hdf5File::has_attribute(const std::string &object, const std::string &name) const
{
  return exists(object) &&
         H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

template <typename T>
T Hdf5File::read_attribute(const std::string &object,
                           const std::string &name,
                           const std::string &hint) const
{
  const std::string text = attribute_text(object, name);
  const Hdf5Handle owner = open_object(object, hint);
  if (H5Aexists(owner, name.c_str()) <= 0)
    fail(text + " is missing", hint);
  const Hdf5Handle attribute(H5Aopen(owner, name.c_str(), H5P_DEFAULT));
  if (!attribute.valid())
    fail(text + " cannot be opened: the file is damaged", hint);
  const Shape extents = shape_of(attribute, text);
  if constexpr (hdf5::is_vector<T>)
    return read_values<typename T::value_type>(attribute, text, extents);
  else if constexpr (hdf5::array_size<T> > 0)
    {
      const auto values = read_values<typename T::value_type>(attribute, text, extents);
      T result          = {};
      if (values.size() != result.size())
        fail(text + " has " + std::to_string(values.size()) + " values instead of " +
             std::to_string(result.size()));
      std::copy_n(values.data(), values.size(), result.data());
      return result;
    }
  else
    {
      const auto values = read_values<T>(attribute, text, extents);
      if (values.size() != 1)
        fail(text + " has " + std::to_string(values.size()) + " values instead of one");
      return values.front();
    }
}

std::string Hdf5File::check_header(const std::string &format,
                                   const int max_version,
                                   const int dim,
                                   const std::string &hint) const
{
  if (!has_attribute("/", "format"))
    fail("is not a file of format " + format + ": it has no attribute 'format'", hint);
  const auto found = read_attribute<std::string>("/", "format");
  if (found != format)
    fail("has the format " + found + " instead of " + format, hint);
  const int file_version = read_attribute<int>("/", "format_version");
  if (file_version < 1 || file_version > max_version)
    fail("has version " + std::to_string(file_version) + " of the format " + format +
         ", but this program knows versions 1 to " + std::to_string(max_version));
  const int file_dim = read_attribute<int>("/", "dim");
  if (dim != 0 && file_dim != dim)
    fail("is " + std::to_string(file_dim) + "D, but the run is " + std::to_string(dim) +
           "D",
         hint);
  const auto digest = read_attribute<std::string>("/", "digest");
  if (digest == draft_digest && !drafts_are_accepted())
    fail("is a draft for --validate, in which nothing was computed; do the run that "
         "makes the result, or name its file");
  return digest;
}

bool Hdf5File::is_draft() const
{
  return has_attribute("/", "digest") &&
         read_attribute<std::string>("/", "digest") == draft_digest;
}

std::string Hdf5File::change_note(const std::string &program) const
{
  if (is_draft())
    return file_path + " is a draft for --validate, in which nothing was computed";
  if (signature == Signature::valid)
    return "";
  if (signature == Signature::broken)
    return file_path + " has changed since " + program +
           " wrote it, by an edit or by damage; its numbers are used as they are";
  return file_path +
         " has no checksum, as an earlier version or another program wrote it: "
         "whether it is as " +
         program + " wrote it is not known; its numbers are used as they are";
}

void Hdf5File::require_unit(const std::string &dataset, const std::string &unit) const
{
  if (!has_attribute(dataset, "unit"))
    return;
  const auto found = read_attribute<std::string>(dataset, "unit");
  if (found != unit)
    fail("the dataset " + dataset + " has the unit '" + found + "' instead of '" + unit +
         "'; convert its numbers, or correct the attribute");
}

#define MESOSLIP_INSTANTIATE(T)                                                    \
  template std::vector<T> Hdf5File::read<T>(const std::string &, const Shape &,    \
                                            const std::string &) const;            \
  template std::vector<T> Hdf5File::read_block<T>(                                 \
    const std::string &, const Shape &, const Shape &, const std::string &) const; \
  template T Hdf5File::read_attribute<T>(const std::string &, const std::string &, \
                                         const std::string &) const;               \
  template std::array<T, 2> Hdf5File::read_attribute<std::array<T, 2>>(            \
    const std::string &, const std::string &, const std::string &) const;          \
  template std::array<T, 3> Hdf5File::read_attribute<std::array<T, 3>>(            \
    const std::string &, const std::string &, const std::string &) const;          \
  template std::vector<T> Hdf5File::read_attribute<std::vector<T>>(                \
    const std::string &, const std::string &, const std::string &) const;
MESOSLIP_HDF5_TYPES(MESOSLIP_INSTANTIATE)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
