#include "base/errors.h"
#include "base/files.h"
#include "parameters/keys.h"
#include "sliding/mesh/mesh_body.h"

namespace mesoslip
{
void MeshBodyParameters::bind(Keys &keys)
{
  mesh.has_grids_in_3d = true;
  mesh.bind(keys);
  {
    const auto in_mesh = keys.section("Mesh");
    keys.bind(
      "Contact boundary", contact_boundary,
      "Physical group of the curves (2D) or surfaces (3D) that lie on the flat or "
      "above it: the gap of a node is Flat/Gap and its height above the lowest "
      "one [-]");
    keys.bind("Top boundary", top_boundary,
              "Physical group of the curves or surfaces that section Supports/Top loads "
              "[-]");
    for (const std::string axis : {"x", "y", "z"})
      keys.renamed("Held in " + axis, "Supports/<group>/Held = u_" + axis);
    bind_periodicity(keys);
    keys.only_if(is_given(),
                 {"Contact boundary", "Top boundary", "Periodic in x", "Periodic in y"},
                 "there is no mesh", "set Mesh/File");
    require_one_mesh(keys);
  }
  const bool from_file = keys.has_text("Body/RVE file");
  if (from_file && keys.has_text("Phases/Names"))
    throw UserError("section Phases has no effect, as Body/RVE file is set and says what "
                    "the body is of; remove it, or Body/RVE file");
  if (keys.has_text("Mesh/File") && !from_file)
    bind_phases(keys, phases, false);
}

void MeshBodyParameters::bind_periodicity(Keys &keys)
{
  for (unsigned int c = 0; c < 2; ++c)
    {
      const std::string key = std::string("Periodic in ") + "xy"[c];
      keys.bind_list(
        key, periodic[c], {},
        "Two physical groups, the second of which is the first one shifted along " +
          std::string(1, "xy"[c]) +
          ": opposite points move together; empty: not periodic [-]");
      keys.require(periodic[c].empty() || periodic[c].size() == 2, key,
                   "it names " + std::to_string(periodic[c].size()) +
                     " groups; name two, that at the lower and that at the upper end");
    }
  keys.only_if(mesh.dim == 3, {"Periodic in y"}, "Dimension is 2", "set Dimension = 3");
}

void MeshBodyParameters::require_one_mesh(const Keys &keys) const
{
  keys.require(mesh.files.size() < 2, "File",
               "it names " + std::to_string(mesh.files.size()) +
                 " meshes; name one, which is the body");
}

void MeshBodyParameters::bind_below(Keys &keys)
{
  mesh.bind_file(keys);
  const auto in_mesh = keys.section("Mesh");
  keys.bind("Contact boundary", contact_boundary,
            "Physical group of the curves (2D) or surfaces (3D) on which the body lies, "
            "even; in complex modes with nodes where those of its "
            "contact are [-]");
  bind_periodicity(keys);
  keys.only_if(is_given(), {"Contact boundary", "Periodic in x", "Periodic in y"},
               "there is no mesh", "set File");
  require_one_mesh(keys);
}

void MeshBodyParameters::check() const
{
  for (const std::string &file : mesh.files)
    require_readable_file(section + "Mesh/File: ", file, "it has to name a mesh of Gmsh");
  for (const PhaseParameters &phase : phases)
    mesh.dim == 2 ? phase.check<2>() : phase.check<3>();
}
} // namespace mesoslip
