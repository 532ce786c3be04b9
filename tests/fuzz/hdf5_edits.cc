#include "hdf5_edits.h"

#include "byte_edits.h"
#include "hdf5_contents.h"

#include "io/checksum.h"

#include <hdf5.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace mesoslip_tests
{
namespace
{
struct Names
{
  std::vector<std::string> objects = {"/"};
  std::vector<std::pair<std::string, std::string>> attributes;
};

/** All objects and attributes of the file. */
Names names_of(const hid_t file)
{
  Names names;
  const auto add_object = [](hid_t, const char *name, const H5O_info_t *,
                             void *list) -> herr_t {
    if (std::strcmp(name, ".") != 0)
      static_cast<Names *>(list)->objects.push_back(std::string("/") + name);
    return 0;
  };
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, add_object, &names, H5O_INFO_BASIC);
  for (const std::string &object : names.objects)
    {
      std::vector<std::string> attributes;
      const auto add_attribute = [](hid_t, const char *name, const H5A_info_t *,
                                    void *list) -> herr_t {
        static_cast<std::vector<std::string> *>(list)->push_back(name);
        return 0;
      };
      hsize_t begin = 0;
      H5Aiterate_by_name(file, object.c_str(), H5_INDEX_NAME, H5_ITER_INC, &begin,
                         add_attribute, &attributes, H5P_DEFAULT);
      for (const std::string &attribute : attributes)
        names.attributes.emplace_back(object, attribute);
    }
  return names;
}

void replace_dataset(const hid_t file, const std::string &name, Choices &choices)
{
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  const hid_t type = some_type(choices), properties = H5Pcreate(H5P_DATASET_CREATE);
  const Space space = some_space(choices);
  if (choices.below(2) == 1 && !space.extents.empty())
    {
      std::vector<hsize_t> chunk(space.extents.size(), 2);
      H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
      if (choices.below(2) == 1)
        H5Pset_deflate(properties, 1);
    }
  const hid_t set =
    H5Dcreate2(file, name.c_str(), type, space.id, H5P_DEFAULT, properties, H5P_DEFAULT);
  if (set >= 0 && space.values > 0 && !holds_addresses(type))
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT,
             some_values(choices, type, space.values).data());
  H5Dclose(set);
  H5Pclose(properties);
  H5Sclose(space.id);
  H5Tclose(type);
}

void replace_attribute(const hid_t file,
                       const std::pair<std::string, std::string> &name,
                       Choices &choices)
{
  const hid_t object = H5Oopen(file, name.first.c_str(), H5P_DEFAULT);
  H5Adelete(object, name.second.c_str());
  if (choices.below(4) > 0)
    {
      const hid_t type  = some_type(choices);
      const Space space = some_space(choices);
      const hid_t attribute =
        H5Acreate2(object, name.second.c_str(), type, space.id, H5P_DEFAULT, H5P_DEFAULT);
      if (attribute >= 0 && space.values > 0 && !holds_addresses(type))
        H5Awrite(attribute, type, some_values(choices, type, space.values).data());
      H5Aclose(attribute);
      H5Sclose(space.id);
      H5Tclose(type);
    }
  H5Oclose(object);
}

/** New values in place, for what only differs in its numbers. */
void rewrite(const hid_t file, const std::string &name, Choices &choices)
{
  const hid_t set   = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  const hid_t type  = H5Dget_type(set);
  const hid_t space = H5Dget_space(set);
  const hssize_t n  = H5Sget_simple_extent_npoints(space);
  if (set >= 0 && n > 0 && n < 100000 && !holds_addresses(type))
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT,
             some_values(choices, type, static_cast<std::size_t>(n)).data());
  H5Sclose(space);
  H5Tclose(type);
  H5Dclose(set);
}

/** Exchanges two objects, links one twice, in a circle, to itself or to nowhere. */
void edit_links(const hid_t file,
                const std::string &object,
                const std::string &other,
                Choices &choices)
{
  const hid_t usual         = H5P_DEFAULT;
  const std::string parking = "/parked";
  const auto move           = [&](const std::string &from, const std::string &to) {
    H5Lmove(file, from.c_str(), file, to.c_str(), usual, usual);
  };
  switch (choices.below(4))
    {
    case 0:
      move(object, parking);
      move(other, object);
      move(parking, other);
      break;
    case 1:
      H5Ldelete(file, other.c_str(), usual);
      H5Lcreate_hard(file, object.c_str(), file, other.c_str(), usual, usual);
      break;
    case 2:
      H5Ldelete(file, object.c_str(), usual);
      H5Lcreate_soft(choices.below(2) == 0 ? object.c_str() : "/nowhere", file,
                     object.c_str(), usual, usual);
      break;
    default:
      H5Ldelete(file, object.c_str(), usual);
      H5Lcreate_external("/nowhere.h5", "/", file, object.c_str(), usual, usual);
    }
}

template <typename T>
const T &one_of(const std::vector<T> &list, Choices &choices)
{
  return list[choices.below(static_cast<unsigned int>(list.size()))];
}

void edit_objects(const hid_t file, const Names &names, Choices &choices)
{
  const std::string object = one_of(names.objects, choices);
  switch (choices.below(8))
    {
    case 0:
      H5Ldelete(file, object.c_str(), H5P_DEFAULT);
      break;
    case 1:
    case 2:
      replace_dataset(file, object, choices);
      break;
    case 3:
    case 4:
      if (!names.attributes.empty())
        replace_attribute(file, one_of(names.attributes, choices), choices);
      break;
    case 5:
      edit_links(file, object, one_of(names.objects, choices), choices);
      break;
    default:
      rewrite(file, object, choices);
    }
}

/**
 * The library keeps its structures for the next file, of which one, of 0.5 MB, took half
 * of an execution, but no buffers, so that AddressSanitizer sees what goes beyond their
 * ends.
 */
void keep_structures_only()
{
  constexpr int all = -1;
  H5set_free_list_limits(all, all, 4 << 20, 256 << 10, 16 << 20, 1 << 20);
}

/** Opens the bytes of a file, in memory. */
hid_t open_image(const std::string &bytes)
{
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1 << 16, false);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_file_image(access, const_cast<char *>(bytes.data()), bytes.size()); // is copied
  const hid_t file = H5Fopen("in memory", H5F_ACC_RDWR, access);
  H5Pclose(access);
  if (file < 0)
    std::abort();
  return file;
}

std::string close_image(const hid_t file)
{
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  const ssize_t length = H5Fget_file_image(file, nullptr, 0);
  std::string bytes(static_cast<std::size_t>(std::max<ssize_t>(length, 0)), '\0');
  if (!bytes.empty())
    H5Fget_file_image(file, bytes.data(), bytes.size());
  H5Fclose(file);
  return bytes;
}
} // namespace

std::string
edited(const std::string &valid, const std::uint8_t *data, const std::size_t size)
{
  if (size == 0)
    return valid;
  static const bool once = (keep_structures_only(), true);
  static_cast<void>(once);
  Choices choices(data, size);
  const unsigned int mode = choices.byte() % 4;
  if (mode == 0)
    return std::string(data + 1, data + size);
  if (mode == 1)
    return edit_bytes(valid, choices);

  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t file  = open_image(valid);
  const Names names = names_of(file);
  for (unsigned int n = 0; n < 8 && !choices.empty(); ++n)
    edit_objects(file, names, choices);
  // The image begins behind the user block.
  return valid.substr(0, mesoslip::signature_bytes) + close_image(file);
}
} // namespace mesoslip_tests
