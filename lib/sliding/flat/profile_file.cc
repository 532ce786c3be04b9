#include "base/digest.h"
#include "base/errors.h"
#include "base/text.h"
#include "io/grid_table.h"
#include "io/image.h"
#include "sliding/flat/profile_parameters.h"

#include <cmath>

namespace mesoslip
{
namespace
{
/** Identifies a source by its content, independent of its path. */
std::string
source_text(const std::string &kind, const std::string &path, const std::string &more)
{
  return kind + " " + Digest().add_file(path).hex() + more;
}

/** Checks that the first and the last height of each row and column agree, for a
 * repeating profile. */
void require_seamless(const ProfileTable::Points &points, const std::string &path)
{
  const std::size_t n = points.x.at.size(), m = points.y.at.size();
  const auto require = [&](const std::size_t first, const std::size_t last,
                           const char *axis) {
    const double a = points.height[first], b = points.height[last];
    if (a != b)
      throw UserError(
        "Flat/Profile repeats: the height in " + path + " is " + to_text(a) +
        " m where it begins along " + axis + " and " + to_text(b) +
        " m where it ends, so that copies have a step between them; give the first "
        "height again at the end");
  };
  for (std::size_t j = 0; j < m; ++j)
    require(j * n, j * n + n - 1, "x");
  for (std::size_t i = 0; i < n; ++i)
    require(i, (m - 1) * n + i, "y");
}
} // namespace

ProfileTable::Points
read_profile_table(const std::string &path, const unsigned int dim, const bool repeats)
{
  const char *const x = "x [m]", *const y = "y [m]";
  const CsvTable table = CsvTable::read(path);
  if (dim == 2 && table.has_column(y))
    throw UserError(path + " has a column '" + y +
                    "', but Dimension is 2; give the heights over x alone");
  if (!table.has_column(x))
    table.numbers(x); // throws with the reason
  const GridTable grid = table.has_column(y) ? grid_table(table, y, x, "height [m]")
                                             : grid_table(table, x, y, "height [m]");
  ProfileTable::Points points;
  points.x.at    = table.has_column(y) ? grid.second : grid.first;
  points.y.at    = table.has_column(y) ? grid.first : grid.second;
  points.height  = grid.values;
  points.repeats = repeats;
  points.source  = source_text("table", path, repeats ? ", repeated" : "");
  if (points.x.at.size() < 2)
    throw UserError(path + " has one value of x; a profile has two or more");
  if (repeats)
    require_seamless(points, path);
  return points;
}

ProfileTable::Points read_profile_picture(const ProfileParameters &given,
                                          const unsigned int dim)
{
  const Image image = read_image(given.file);
  if (image.coloured)
    throw UserError("Flat/Profile file: " + given.file +
                    " has colours; a profile is a picture of grey levels");
  const double white = image.deep ? 65535. : 255.;
  ProfileTable::Points points;
  // Heights belong to pixel centres; if the picture repeats, its first pixel follows the
  // last.
  const auto places = [&](const unsigned int n, const double size, ProfileAxis &axis) {
    for (unsigned int i = 0; i < n + (given.repeats ? 1 : 0); ++i)
      axis.at.push_back((i + 0.5) * size / n);
  };
  places(image.width, given.picture_size[0], points.x);
  if (dim == 3)
    places(image.height, given.picture_size[1], points.y);
  else
    points.y.at = {0.};
  for (std::size_t j = 0; j < points.y.at.size(); ++j)
    for (std::size_t i = 0; i < points.x.at.size(); ++i)
      points.height.push_back(
        given.picture_height / white *
        image.values[j % image.height * image.width + i % image.width]);
  points.repeats = given.repeats;
  points.source  = source_text("picture", given.file,
                               " of " + to_text(given.picture_size) + " m, " +
                                 to_text(given.picture_height) + " m high" +
                                 (given.repeats ? ", repeated" : ""));
  if (points.x.at.size() < 2)
    throw UserError("Flat/Profile file: " + given.file +
                    " is one pixel wide; a profile has two or more");
  return points;
}
} // namespace mesoslip
