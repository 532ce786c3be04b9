#include "base/errors.h"
#include "io/image.h"
#include "io/tiff_image.h"
#include "io/voxel_file.h"

#include <algorithm>
#include <cctype>
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
        has_ending(path, ".png") || is_tiff_name(path))
      files.push_back(path);
  return files;
}

/** The digits of @p text from @p at on, which it leaves behind them, without zeros in
 *  front. */
std::string number_from(const std::string &text, std::size_t &at)
{
  const std::size_t end = std::min(text.find_first_not_of("0123456789", at), text.size());
  std::string digits    = text.substr(at, end - at);
  at                    = end;
  return digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
}

/** Whether @p a comes before @p b when numbers in names count as numbers: 9 before 10. */
bool number_before(const std::string &a, const std::string &b)
{
  const auto digit = [](const char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size())
    if (digit(a[i]) && digit(b[j]))
      {
        const std::string x = number_from(a, i), y = number_from(b, j);
        if (x != y)
          return x.size() != y.size() ? x.size() < y.size() : x < y;
      }
    else if (a[i++] != b[j++])
      return a[i - 1] < b[j - 1];
  const bool a_ended = i == a.size(), b_ended = j == b.size();
  return a_ended && !b_ended;
}

/** Throws unless a file of a stack of files has one picture. */
void require_one_page(const std::string &path)
{
  if (const std::size_t n = tiff_pages(path, false); n != 1)
    throw UserError(
      path + " has " + std::to_string(n) +
      " pages, but a stack of files has one picture in each; save each page "
      "as a file, or name a file that has all pages");
}

/** Pictures of one size, one a plane. */
class PictureStack : public VoxelFile
{
public:
  explicit PictureStack(const std::vector<std::string> &the_files)
    : files(the_files)
  {
    const bool pages = files.size() == 1 && is_tiff_name(files[0]);
    const auto n     = pages ? tiff_pages(files[0]) : files.size();
    picture(0); // sets width and height
    extents         = {n, height, width};
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
    return values;
  }

private:
  const std::string &file_of(const std::size_t z) const
  {
    return files[files.size() == 1 ? 0 : z];
  }

  /** The values of picture @p z, from the top row, whose size goes to width and height. */
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
        return std::move(image.values);
      }
    const Image image = read_image(file_of(z));
    width             = image.width;
    height            = image.height;
    type_name         = "of a PNG";
    std::vector<double> values;
    values.reserve(image.values.size());
    for (std::size_t y = height; y-- > 0;) // a picture begins at the bottom
      values.insert(values.end(), image.values.begin() + static_cast<long>(y * width),
                    image.values.begin() + static_cast<long>((y + 1) * width));
    return values;
  }

  const std::vector<std::string> files;
  std::size_t width = 0, height = 0; ///< of the picture read last
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
  const auto wrong = std::is_sorted_until(found.begin(), found.end(), number_before);
  if (wrong != found.end())
    throw UserError(path + ": by name, " + fs::path(*(wrong - 1)).filename().string() +
                    " comes before " + fs::path(*wrong).filename().string() +
                    ", against their numbers; write numbers with leading zeros");
  return found;
}

std::unique_ptr<VoxelFile> open_picture_stack(const std::vector<std::string> &files)
{
  return std::make_unique<PictureStack>(files);
}
} // namespace mesoslip
