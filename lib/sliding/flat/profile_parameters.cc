#include "sliding/flat/profile_parameters.h"

#include "base/object_exchange.h"
#include "parameters/keys.h"

#include <stdexcept>

namespace mesoslip
{
namespace
{
bool ends_in(const std::string &path, const std::string &end)
{
  return path.size() >= end.size() &&
         path.compare(path.size() - end.size(), end.size(), end) == 0;
}
} // namespace

void ProfileParameters::bind(Keys &keys, const unsigned int dim)
{
  keys.bind(
    "Profile", expression,
    "Height of the flat over its plane, an expression in x and, in 3D, y [m] such as "
    "1e-6*sin(2*pi*x/1e-3); it moves with the flat, and x and y are those of the body "
    "at the start. Empty: the flat is even [m]");
  keys.bind_input(
    "Profile file", file,
    "The height as a table, a CSV file with the columns 'x [m]', 'height [m]' and, in "
    "3D where it varies along y, 'y [m]', linear in between; or as a picture of grey "
    "levels, a PNG, of which a body in 2D has the lowest row");
  keys.bind_list("Profile size", picture_size, Range::length(),
                 "Extents of a picture along x and, in 3D, y from x = y = 0 on [m]", 0,
                 2);
  keys.bind("Profile height", picture_height, Range::any(),
            "Height of white over black in a picture [m]");
  keys.bind(
    "Profile repeats", repeats,
    "Whether copies of a table or picture follow beyond its ends, where otherwise "
    "the height of the ends goes on");
  keys.require(expression.empty() || file.empty(), "Profile",
               "there is a Profile file as well; leave one of them empty");
  const bool picture = ends_in(file, ".png");
  keys.require(file.empty() || picture || ends_in(file, ".csv"), "Profile file",
               file +
                 " is neither a table, whose name ends in .csv, nor a picture, in .png");
  keys.only_if(!file.empty(), {"Profile repeats"}, "Flat/Profile file is empty",
               "name a table or picture there");
  keys.only_if(picture, {"Profile size", "Profile height"},
               "Flat/Profile file is no picture", "name one there");
  keys.require(!picture || picture_size.size() == dim - 1, "Profile size",
               "give the extent of the picture along x" +
                 std::string(dim == 3 ? " and that along y" : "") +
                 " in m, such as 1e-3" + (dim == 3 ? ", 1e-3" : ""));
  keys.require(
    !picture || picture_height != 0., "Profile height",
    "it is 0, so that the picture is even; give the height of white over black in m");
  if (!expression.empty())
    try
      {
        make(dim);
      }
    catch (const std::invalid_argument &error)
      {
        keys.require(false, "Profile", error.what());
      }
}

std::shared_ptr<const FlatProfile> ProfileParameters::make(const unsigned int dim) const
{
  if (!expression.empty())
    return std::make_shared<ProfileExpression>(expression, dim);
  if (file.empty())
    return nullptr;
  ProfileTable::Points points;
  on_root(MPI_COMM_WORLD, [&]() {
    points = ends_in(file, ".csv") ? read_profile_table(file, dim, repeats)
                                   : read_profile_picture(*this, dim);
  });
  for (auto *values : {&points.x.at, &points.y.at, &points.height})
    broadcast_object(MPI_COMM_WORLD, *values);
  broadcast_object(MPI_COMM_WORLD, points.repeats);
  broadcast_object(MPI_COMM_WORLD, points.source);
  return std::make_shared<ProfileTable>(points);
}
} // namespace mesoslip
