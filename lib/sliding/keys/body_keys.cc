#include "sliding/keys/body_keys.h"

#include "base/files.h"
#include "morphology/microstructure_parameters.h"
#include "parameters/keys.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Upper end of the range of numbers of cells. */
constexpr long most_cells = 1000000000;
} // namespace

void bind_vector(Keys &keys,
                 const std::string &key,
                 std::array<double, 3> &vector,
                 const unsigned int dim,
                 const std::string &meaning)
{
  std::vector<double> list = {vector[0], vector[1]};
  keys.bind_list(key, list, Range::any(), meaning, 2, 3);
  keys.require(list.size() == 2 || dim == 3, key,
               "it has three components, but Dimension is 2");
  vector = {};
  std::copy(list.begin(), list.end(), vector.begin());
}

std::size_t bind_damping(Keys &keys,
                         const std::string &key,
                         double &largest,
                         std::vector<double> &of_phases,
                         const std::string &meaning)
{
  constexpr std::size_t most_phases = 256;
  of_phases                         = {largest};
  keys.bind_list(key, of_phases, Range::non_negative(), meaning, 1, most_phases);
  const auto [least, most] = std::minmax_element(of_phases.begin(), of_phases.end());
  const std::size_t given  = of_phases.size();
  largest                  = *most;
  if (*least == *most)
    of_phases.clear();
  return given;
}

void bind_material(Keys &keys,
                   BodyParameters &body,
                   MeshBodyParameters &mesh,
                   const bool may_be_absent)
{
  std::vector<double> size;
  std::vector<long> cells;
  keys.bind("Material", body.heterogeneous, {"homogeneous", "heterogeneous"},
            "One effective material, or every cell with the phase that it has in the RVE "
            "file; cells of a mesh have the one with the name of their group");
  keys.bind_input("RVE file", body.rve_file,
                  "Path of the rve.h5 of rve_homogenization, or of its folder, from "
                  "which the body takes its "
                  "materials, and its size and cells where these are empty; empty: the "
                  "material is that of Stiffness and Density");
  keys.bind("Stiffness from", body.stiffness_name,
            {"effective", "KUBC", "SUBC", "PBC", "MUBC"},
            "Boundary conditions of the homogenization whose stiffness in the RVE file a "
            "homogeneous body takes");
  keys.bind_list(
    "Stiffness", body.stiffness, Range::stiffness(),
    "Stiffness of a homogeneous body without RVE file in plane strain, Voigt "
    "order xx, yy, xy: D11, D12, D22, D33 or all six D11, D12, D13, D22, D23, "
    "D33; by default that of eq. (10). In 3D, order xx, yy, zz, yz, xz, xy: D11, D12, "
    "D13, D22, D23, D33, D44, D55, D66 or all 21 of the upper triangle [Pa]",
    4, 21);
  bind_mean_dilatation(keys, body.mean_dilatation);
  keys.bind("Density", body.density, Range::density(),
            "Density of a homogeneous body without RVE file [kg/m^3]");
  keys.bind_list(
    "Size", size, Range::length(),
    "Width and height of the body, in 3D its extents along x, y, z; empty: "
    "those of the RVE file, or, in 2D, the paper's 56 x 16 mm without one. A "
    "homogeneous body may be larger than the volume of the RVE file, with "
    "Cells given [m]",
    0, 3);
  keys.bind_list(
    "Cells", cells, 1, most_cells,
    "Numbers of cells along x and y, in 3D along x, y, z; empty: those of the RVE file, "
    "or, in 2D, 560, 160 without one. A heterogeneous body takes whole multiples of "
    "those of the RVE file [-]",
    0, 3);
  const unsigned int dim  = mesh.mesh.dim;
  const auto require_axes = [&](const std::string &key, const std::size_t n) {
    keys.require(mesh.is_given() || n == 0 || n == dim, key,
                 std::to_string(n) + (n == 1 ? " number" : " numbers") + " found, " +
                   (dim == 2 ? "two (x, y)" : "three (x, y, z)") + " are needed");
  };
  require_axes("Size", size.size());
  require_axes("Cells", cells.size());
  std::copy(size.begin(), size.end(), body.size.begin());
  std::copy(cells.begin(), cells.end(), body.cells.begin());
  const std::size_t n  = body.stiffness.size();
  const bool is_number = dim == 2 ? n == 4 || n == 6 : n == 9 || n == 21;
  keys.require(is_number || !keys.is_typed(keys.path("Stiffness")), "Stiffness",
               std::to_string(n) + " numbers found; give " +
                 (dim == 2 ? "D11, D12, D22, D33 or all six"
                           : "9 of an orthotropic material or all 21"));
  body.rve_file        = file_or_in_folder(body.rve_file, "rve.h5");
  const bool from_file = !body.rve_file.empty();
  mesh.mesh.one_phase  = from_file && !body.heterogeneous;
  keys.require(dim == 2 || mesh.is_given() || from_file || may_be_absent ||
                 keys.is_typed(keys.path("Stiffness")),
               "Stiffness",
               "it is not given; in 3D a body takes its materials from Body/RVE file or "
               "Mesh/File, or is homogeneous with 9 or 21 numbers here");
  keys.require(from_file || !body.heterogeneous, "RVE file",
               "it is empty, but a heterogeneous body takes its phases and morphology "
               "from there; run rve_homogenization and name its rve.h5");
  keys.only_if(!from_file, {"Stiffness", "Density"},
               "the materials are those of " + keys.path("RVE file"),
               "leave " + keys.path("RVE file") + " empty");
  keys.only_if(from_file, {"Stiffness from"}, keys.path("RVE file") + " is empty",
               "name an rve.h5 there");
  keys.only_with("Material", {"homogeneous"}, {"Stiffness from"});
}
std::vector<ProbePoint>
bind_probes(Keys &keys, const std::string &section_of_probes, const unsigned int dim)
{
  std::vector<std::string> names;
  keys.bind_names(
    "Probes", names, "probe",
    "Names of points that are observed, each with a subsection of that name");
  std::vector<ProbePoint> probes;
  for (const std::string &name : names)
    {
      const auto section = keys.section(name);
      ProbePoint probe;
      std::vector<double> position;
      probe.section = section_of_probes;
      probe.name    = name;
      keys.bind_list(
        "Position", position, Range::any(),
        "x and y from the lower left corner of the body, also those of a probe of a "
        "counter "
        "body, which is below y = 0; in 3D with z; on a mesh its coordinates; has to be "
        "given [m]",
        0, 3);
      keys.bind("Nearest node", probe.nearest_node, "Move the probe to the nearest node");
      keys.require(position.size() == dim, "Position",
                   std::string(position.size() < dim ? "a number is missing; give "
                                                     : "too many numbers; give ") +
                     (dim == 2 ? "x and y" : "x, y and z") +
                     " of the probe from the lower left corner, or on a mesh its "
                     "coordinates, in m, in a subsection " +
                     name);
      std::copy(position.begin(), position.end(), probe.position.begin());
      probes.push_back(probe);
    }
  return probes;
}
} // namespace mesoslip
