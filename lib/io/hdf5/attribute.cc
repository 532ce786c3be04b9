#include "io/hdf5/internal.h"
#include "io/hdf5_file.h"
#include "io/text.h"

#include <algorithm>

namespace mesoslip
{
using hdf5::Handle;

namespace hdf5
{
Handle make_space(const Shape &shape)
{
  if (shape.empty())
    return Handle(H5Screate(H5S_SCALAR));
  return Handle(
    H5Screate_simple(static_cast<int>(shape.size()), dims(shape).data(), nullptr));
}

bool read_extents(const hid_t space, std::vector<hsize_t> &extents)
{
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || H5Sget_simple_extent_type(space) == H5S_NULL)
    return false;
  extents.resize(static_cast<std::size_t>(rank));
  return H5Sget_simple_extent_dims(space, extents.data(), nullptr) >= 0;
}

bool count_values(const hid_t object,
                  const std::vector<hsize_t> &extents,
                  const std::size_t value_bytes,
                  std::size_t &n)
{
  constexpr double best_compression = 1032., always_allowed = 1 << 24;
  const Handle file(H5Iget_file_id(object));
  hsize_t file_bytes = 0;
  if (H5Fget_filesize(file, &file_bytes) < 0)
    return false;
  double bytes = static_cast<double>(value_bytes);
  n            = 1;
  for (const hsize_t extent : extents)
    {
      bytes *= static_cast<double>(extent);
      n *= static_cast<std::size_t>(extent);
    }
  return bytes <=
         std::max(best_compression * static_cast<double>(file_bytes), always_allowed);
}

FixedStrings::FixedStrings(const std::vector<std::string> &strings)
  : type(H5Tcopy(H5T_C_S1))
{
  std::size_t longest = 1;
  for (const std::string &text : strings)
    longest = std::max(longest, text.size());
  H5Tset_size(type, longest);
  H5Tset_cset(type, H5T_CSET_UTF8);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  for (const std::string &text : strings)
    characters += text + std::string(longest - text.size(), '\0');
}

namespace
{
herr_t read_any(const hid_t object, const bool attribute, const hid_t type, void *target)
{
  return attribute ? H5Aread(object, type, target)
                   : H5Dread(object, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, target);
}
} // namespace

bool read_all_strings(const hid_t object,
                      const bool attribute,
                      std::vector<std::string> &strings)
{
  const Handle type(attribute ? H5Aget_type(object) : H5Dget_type(object));
  const Handle space(attribute ? H5Aget_space(object) : H5Dget_space(object));
  if (!type.valid() || !space.valid() || H5Tget_class(type) != H5T_STRING ||
      H5Tis_variable_str(type) > 0)
    return false;
  const std::size_t length = H5Tget_size(type);
  std::vector<hsize_t> extents;
  std::size_t n = 0;
  if (!read_extents(space, extents) || !count_values(object, extents, length, n))
    return false;
  strings.assign(n, "");
  if (strings.empty())
    return true;

  std::string all(length * strings.size(), '\0');
  if (read_any(object, attribute, type, all.data()) < 0)
    return false;
  for (std::size_t i = 0; i < strings.size(); ++i)
    {
      const std::string one = all.substr(i * length, length);
      strings[i]            = one.substr(0, one.find('\0'));
    }
  return true;
}
} // namespace hdf5

bool Hdf5File::has_attribute(const std::string &object, const std::string &name) const
{
  const hdf5::CrashGuard guard(file_path);
  return exists(object) &&
         H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

Hdf5File::Id Hdf5File::open_attribute(const std::string &object,
                                      const std::string &name,
                                      const std::string &hint) const
{
  const Handle owner(open_object(object, hint));
  if (H5Aexists(owner, name.c_str()) <= 0)
    fail("the attribute '" + name + "' of " + object + " is missing", hint);
  Handle attribute(H5Aopen(owner, name.c_str(), H5P_DEFAULT));
  if (!attribute.valid())
    fail("the attribute '" + name + "' of " + object + " cannot be opened", hint);
  return attribute.release();
}

void Hdf5File::write_string_attribute(const std::string &object,
                                      const std::string &name,
                                      const std::vector<std::string> &values,
                                      const bool scalar)
{
  const hdf5::FixedStrings texts(values);
  write_raw_attribute(object, name, texts.type, texts.characters.data(), values.size(),
                      scalar);
}

void Hdf5File::write_raw_attribute(const std::string &object,
                                   const std::string &name,
                                   const Id type,
                                   const void *values,
                                   const std::size_t n,
                                   const bool scalar)
{
  require_writable();
  if (!exists(object))
    create_group(object);
  const Handle owner(open_object(object, ""));
  if (H5Aexists(owner, name.c_str()) > 0)
    H5Adelete(owner, name.c_str());
  const Handle space = hdf5::make_space(scalar ? Shape() : Shape{n});
  const Handle attribute(
    H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
  if (!attribute.valid() || (n > 0 && H5Awrite(attribute, type, values) < 0))
    fail_writing("the attribute '" + name + "' of " + object + " cannot be written");
}

namespace
{
template <typename T>
struct IsVector : std::false_type
{
};
template <typename T>
struct IsVector<std::vector<T>> : std::true_type
{
};

/** Reads numbers, or says why not. */
template <typename T>
std::string read_numbers(const hid_t attribute, std::vector<T> &values)
{
  const Handle type(H5Aget_type(attribute));
  const Handle space(H5Aget_space(attribute));
  const auto kind = H5Tget_class(type);
  if (kind != H5T_INTEGER && (kind != H5T_FLOAT || std::is_integral<T>::value))
    return std::is_integral<T>::value ? "is not a whole number" : "is not a number";
  std::vector<hsize_t> extents;
  std::size_t n = 0;
  if (!hdf5::read_extents(space, extents))
    return "has no value";
  if (!hdf5::count_values(attribute, extents, H5Tget_size(type), n))
    return "is larger than the file";
  values.resize(n);
  if (!values.empty() && H5Aread(attribute, hdf5::native_type<T>(), values.data()) < 0)
    return "cannot be read";
  for (const T value : values)
    if (!std::isfinite(static_cast<double>(value)))
      return "is not finite";
  return "";
}

std::string read_numbers(const hid_t attribute, std::vector<std::string> &values)
{
  if (!hdf5::read_all_strings(attribute, true, values))
    return "is not a text of fixed length";
  return std::all_of(values.begin(), values.end(), is_utf8) ? "" : "is not UTF-8";
}
} // namespace

template <typename T>
void Hdf5File::write_attribute(const std::string &object,
                               const std::string &name,
                               const T &value)
{
  const auto check = [&](const auto *values, const std::size_t n) {
    hdf5::require_finite(file_path, "the attribute '" + name + "' of " + object, values,
                         n);
  };
  if constexpr (std::is_same<T, std::string>::value)
    write_string_attribute(object, name, {value}, true);
  else if constexpr (std::is_same<T, std::vector<std::string>>::value)
    write_string_attribute(object, name, value, false);
  else if constexpr (IsVector<T>::value)
    {
      check(value.data(), value.size());
      write_raw_attribute(object, name, hdf5::native_type<typename T::value_type>(),
                          value.data(), value.size(), false);
    }
  else
    {
      check(&value, 1);
      write_raw_attribute(object, name, hdf5::native_type<T>(), &value, 1, true);
    }
}

template <typename T>
T Hdf5File::read_attribute(const std::string &object,
                           const std::string &name,
                           const std::string &hint) const
{
  const hdf5::CrashGuard guard(file_path);
  const Handle attribute(open_attribute(object, name, hint));
  const auto check = [&](const std::string &problem) {
    if (!problem.empty())
      fail("the attribute '" + name + "' of " + object + " " + problem, hint);
  };
  if constexpr (IsVector<T>::value)
    {
      T values;
      check(read_numbers(attribute, values));
      return values;
    }
  else
    {
      std::vector<T> values;
      check(read_numbers(attribute, values));
      if (values.size() != 1)
        check("has " + std::to_string(values.size()) + " values instead of one");
      return values.front();
    }
}

#define MESOSLIP_INSTANTIATE(T)                                                        \
  template void Hdf5File::write_attribute<T>(const std::string &, const std::string &, \
                                             const T &);                               \
  template T Hdf5File::read_attribute<T>(const std::string &, const std::string &,     \
                                         const std::string &) const;
MESOSLIP_INSTANTIATE(std::string)
MESOSLIP_INSTANTIATE(double)
MESOSLIP_INSTANTIATE(int)
MESOSLIP_INSTANTIATE(unsigned int)
MESOSLIP_INSTANTIATE(std::int64_t)
MESOSLIP_INSTANTIATE(std::uint64_t)
MESOSLIP_INSTANTIATE(std::vector<std::string>)
MESOSLIP_INSTANTIATE(std::vector<double>)
MESOSLIP_INSTANTIATE(std::vector<int>)
MESOSLIP_INSTANTIATE(std::vector<unsigned int>)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
