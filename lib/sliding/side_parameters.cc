#include "parameters/keys.h"
#include "sliding/contact_parameters.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** The components that are held on a side of the body, x to z. */
std::array<bool, 3> bind_side(Keys &keys, const std::string &key, const std::string &side)
{
  unsigned int value = 0;
  keys.bind(key, value,
            {"free", "u_x", "u_y", "both", "u_z", "u_x u_z", "u_y u_z", "all"},
            "Displacement components that are zero on the " + side +
              " side; both: u_x and u_y; those with u_z, and all three, in 3D");
  return {{(value & 1) != 0, (value & 2) != 0, (value & 4) != 0}};
}

/** The sides of a grid are groups as those of a mesh. */
void use_sides_of_grid(MeshBodyParameters &mesh,
                       const std::array<std::array<bool, 3>, 4> &held,
                       const std::array<bool, 2> &periodic)
{
  const std::string names[] = {"Left", "Right", "Front", "Back"};
  for (unsigned int side = 0; side < 4; ++side)
    for (unsigned int c = 0; c < 3; ++c)
      if (held[side][c])
        mesh.held[c].push_back(names[side]);
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (periodic[axis])
      mesh.periodic[axis] = {names[2 * axis], names[2 * axis + 1]};
}

} // namespace

void ContactParameters::bind_sides(Keys &keys)
{
  const auto section                            = keys.section("Sides");
  const std::array<std::array<bool, 3>, 4> held = {
    {bind_side(keys, "Left", "left"), bind_side(keys, "Right", "right"),
     bind_side(keys, "Front", "front (lower y)"),
     bind_side(keys, "Back", "back (upper y)")}};
  std::copy_n(held[0].begin(), 2, sides.left_held.begin());
  std::copy_n(held[1].begin(), 2, sides.right_held.begin());
  bool periodic_in_y = false;
  keys.bind("Periodic", periodic,
            "Periodic in x: the nodes of the left and the right side are the same");
  keys.bind("Periodic in y", periodic_in_y,
            "The same for the front and the back side, in 3D");
  keys.only_if(mesh.mesh.dim == 3, {"Front", "Back", "Periodic in y"},
               "the body is plane", "set Dimension = 3");
  const std::string names[] = {"Left", "Right", "Front", "Back"};
  const unsigned int normal = mesh.mesh.dim - 1;
  for (unsigned int side = 0; side < 4; ++side)
    {
      const auto &h     = held[side];
      const bool is_one = side < 2 ? periodic : periodic_in_y;
      keys.require(mesh.mesh.dim == 3 || !h[2], names[side],
                   "u_z is held, but Dimension is 2");
      keys.require(!is_one || !(h[0] || h[1] || h[2]),
                   side < 2 ? "Periodic" : "Periodic in y",
                   side < 2 ? "it is true, so Left and Right have to be free"
                            : "it is true, so Front and Back have to be free");
      keys.require(
        top.kind != TopSetup::Kind::platen || !h[normal], names[side],
        std::string("u_") + "xyz"[normal] +
          " is held, but the platen of Top/Kind moves the corner; hold u_x only, "
          "or set Top/Kind = pressure or held");
    }
  if (!mesh.is_given())
    use_sides_of_grid(mesh, held, {{periodic, periodic_in_y}});
}
} // namespace mesoslip
