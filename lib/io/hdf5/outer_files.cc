#include "io/hdf5/internal.h"

#include <cstdlib>
#include <filesystem>

namespace mesoslip::hdf5
{
namespace
{
namespace fs = std::filesystem;

/** Gets a name by two calls of @p get(text, length): for the length, then for the text,
 * as in HDF5. */
template <typename Get>
std::string name_from(const Get &get)
{
  const auto length = get(nullptr, 0);
  std::string name(length > 0 ? static_cast<std::size_t>(length) + 1 : 0, '\0');
  if (length <= 0 || get(name.data(), name.size()) < 0)
    return "";
  name.resize(name.size() - 1);
  return name;
}

/** The file in which HDF5 finds the source @p name of a virtual dataset of @p path;
 * empty: none. */
std::string place_of_source(const std::string &name, const std::string &path)
{
  if (name == ".")
    return path;
  const fs::path folder = fs::path(path).parent_path(), given(name);
  std::error_code ignored;
  for (const fs::path &place : {folder / given, given, folder / given.filename()})
    if (fs::is_regular_file(place, ignored))
      return place.string();
  return "";
}

std::string
unreadable_source(const std::string &path, const hid_t dataset, const int depth);

/** Describes an unreadable source @p k of a virtual dataset; empty: it is readable. */
std::string unreadable_mapping(const std::string &path,
                               const hid_t properties,
                               const std::size_t k,
                               const int depth)
{
  const std::string name    = name_from([&](char *text, const std::size_t n) {
    return H5Pget_virtual_filename(properties, k, text, n);
  });
  const std::string dataset = name_from([&](char *text, const std::size_t n) {
    return H5Pget_virtual_dsetname(properties, k, text, n);
  });
  // A pattern of names matches any number of files; HDF5_VDS_PREFIX may lead anywhere.
  if ((name + dataset).find('%') != std::string::npos ||
      std::getenv("HDF5_VDS_PREFIX") != nullptr)
    return "";
  const std::string place = place_of_source(name, path);
  if (place.empty())
    return "has a part of its numbers in the file " + name +
           ", which is not there; put it beside this one";
  const Hdf5Handle file(H5Fopen(place.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)),
    source(file.valid() ? H5Dopen2(file, dataset.c_str(), H5P_DEFAULT) : -1);
  if (!source.valid())
    return "has a part of its numbers in the dataset " + dataset + " of " + place +
           ", which cannot be opened; copy that file again";
  return unreadable_source(place, source, depth + 1);
}

/** Describes missing or short plain files that hold the numbers of @p dataset; empty:
 * none. */
std::string short_external_file(const hid_t properties, const hid_t dataset)
{
  const Hdf5Handle type(H5Dget_type(dataset)), space(H5Dget_space(dataset));
  auto left = static_cast<hsize_t>(H5Sget_simple_extent_npoints(space)) *
              static_cast<hsize_t>(H5Tget_size(type));
  const int n = H5Pget_external_count(properties);
  for (unsigned int k = 0; k < static_cast<unsigned int>(std::max(n, 0)); ++k)
    {
      char name[4096] = "";
      off_t offset    = 0;
      hsize_t size    = 0;
      if (H5Pget_external(properties, k, sizeof name - 1, name, &offset, &size) < 0)
        continue;
      const hsize_t needs = static_cast<hsize_t>(offset) + std::min(size, left);
      left -= std::min(size, left);
      std::error_code code;
      const auto has = fs::file_size(name, code);
      if (std::getenv("HDF5_EXTFILE_PREFIX") == nullptr && (code || has < needs))
        return std::string("has its numbers in the file ") + name +
               (code
                  ? ", which is not in the folder where the program was started; put it "
                    "there"
                  : ", which has " + std::to_string(has) + " of the " +
                      std::to_string(needs) + " bytes needed; copy it again");
    }
  return "";
}

std::string
unreadable_source(const std::string &path, const hid_t dataset, const int depth)
{
  constexpr int deepest = 8; // limit for sources that refer to themselves
  const Hdf5Handle properties(H5Dget_create_plist(dataset));
  std::size_t n = 0;
  if (H5Pget_layout(properties) != H5D_VIRTUAL)
    return short_external_file(properties, dataset);
  if (H5Pget_virtual_count(properties, &n) < 0 || depth > deepest)
    return "has sources that cannot be found; save it without sources";
  for (std::size_t k = 0; k < n; ++k)
    if (const std::string what = unreadable_mapping(path, properties, k, depth);
        !what.empty())
      return what;
  return "";
}
} // namespace

std::string missing_numbers(const std::string &path, const hid_t dataset)
{
  return unreadable_source(path, dataset, 0);
}
} // namespace mesoslip::hdf5
