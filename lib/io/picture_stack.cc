#include "base/errors.h"
#include "io/image.h"
#include "io/slice_names.h"
#include "io/tiff_image.h"
#include "io/voxel_file.h"

#include <algorithm>
#include <filesystem>
#include <glob.h>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

bool is_tiff_name(const std::string &path)
{
  return has_ending(path, ".tif") || has_ending(path, ".tiff");
}

std::vector<std::string> matching(const std::string &pattern)
{
  glob_t found = {};
  std::vector<std::string> files;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return files;
}

std::vector<std::string> pictures_in(const std::string &folder)
{
  std::vector<std::string> files;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder))
    if (const std::string path = entry.path().string();
        entry.path().filename().string()[0] != '.' && // macOS keeps notes in ._NAME
        (has_ending(path, ".png") || is_tiff_name(path)))
      files.push_back(path);
  return files;
}

/** Throws unless a file in a stack of files has a single picture. */
void require_one_page(const std::string &path)
{
  if (const std::size_t n = tiff_pages(path, false); n != 1)
    throw UserError(
      path + " has " + std::to_string(n) +
      " pages, but a stack of files has one picture in each; save each page "
      "as a file, or name a file that has all pages");
}

/** A stack of pictures of equal size, one per plane. */
class PictureStack : public VoxelFile
{
public:
  explicit PictureStack(const std::vector<std::string> &the_files)
    : files(the_files)
  {
    const bool pages = files.size() == 1 && is_tiff_name(files[0]);
    const auto n     = pages ? tiff_pages(files[0]) : files.size();
    picture(0); // sets width, height and depth
    extents         = {n, height, width};
    first_depth     = depth;
    const bool tiff = is_tiff_name(files[0]);
    for (const std::string &file : files)
      if (is_tiff_name(file) != tiff)
        throw UserError(file + " is of another kind than " + files[0] +
                        "; a stack is all PNG or all TIFF");
  }

  std::vector<double> plane(const std::size_t z) override
  {
    std::vector<double> values = picture(z);
    if (width != extents[2] || height != extents[1])
      throw UserError(file_of(z) + " has " + std::to_string(width) + " x " +
                      std::to_string(height) + " pixels, and " + file_of(0) + " has " +
                      std::to_string(extents[2]) + " x " + std::to_string(extents[1]) +
                      "; pictures of a stack have one size");
    if (depth != first_depth)
      throw UserError(name_of(z) + "has " + depth + ", and " + name_of(0) + "has " +
                      first_depth +
                      ", in which the same grey is another number; save all pictures of "
                      "a stack alike");
    return values;
  }

private:
  const std::string &file_of(const std::size_t z) const
  {
    return files[files.size() == 1 ? 0 : z];
  }

  /** Text for messages: a file, or a page of the only file, and a blank. */
  std::string name_of(const std::size_t z) const
  {
    return file_of(z) +
           (files.size() == 1 ? ", page " + std::to_string(z + 1) + ", " : " ");
  }

  /** The values of picture @p z, from the top row; sets width and height, and depth to a
   * description of its numbers. */
  std::vector<double> picture(const std::size_t z)
  {
    if (is_tiff_name(file_of(z)))
      {
        const bool one_file = files.size() == 1;
        if (!one_file)
          require_one_page(file_of(z));
        TiffImage image = read_tiff(file_of(z), one_file ? z : 0);
        width           = image.width;
        height          = image.height;
        whole           = whole && image.type.is_whole();
        type_name       = "'" + image.type.text() + "'";
        depth           = std::to_string(image.bits) + " bits a pixel, " +
                (image.type.kind == 'f'   ? "floating point"
                 : image.type.kind == 'i' ? "signed"
                                          : "unsigned");
        return std::move(image.values);
      }
    const Image image = read_image(file_of(z));
    width             = image.width;
    height            = image.height;
    type_name         = "of a PNG";
    depth             = image.deep ? "grey levels of 16 bits" : "8 bits or fewer";
    std::vector<double> values;
    values.reserve(image.values.size());
    for (std::size_t y = height; y-- > 0;) // a picture begins at the bottom
      values.insert(values.end(), image.values.begin() + static_cast<long>(y * width),
                    image.values.begin() + static_cast<long>((y + 1) * width));
    return values;
  }

  const std::vector<std::string> files;
  std::size_t width = 0, height = 0; ///< size of the last picture
  std::string depth, first_depth;    ///< description of the last and the first picture
};
} // namespace

std::vector<std::string> VoxelSource::files() const
{
  std::error_code ignored;
  const bool folder = fs::is_directory(path, ignored);
  if (!folder && path.find_first_of("*?") == std::string::npos)
    return {path};
  std::vector<std::string> found = folder ? pictures_in(path) : matching(path);
  if (found.empty())
    throw UserError(path + (folder
                              ? " holds no pictures; it has to hold a stack of .png or "
                                ".tif files"
                              : " matches no file; check the pattern"));
  std::sort(found.begin(), found.end());
  std::vector<std::string> names;
  names.reserve(found.size());
  for (const std::string &file : found)
    names.push_back(fs::path(file).filename().string());
  require_slices_in_order(path, names);
  return found;
}

std::unique_ptr<VoxelFile> open_picture_stack(const std::vector<std::string> &files)
{
  return std::make_unique<PictureStack>(files);
}
} // namespace mesoslip
