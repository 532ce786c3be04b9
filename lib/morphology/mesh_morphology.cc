#include "morphology/mesh_morphology.h"

#include "base/errors.h"
#include "base/text.h"
#include "material/plausibility.h"
#include "mesh/boundary.h"
#include "mesh/boundary/open_seams.h"
#include "mesh/cell_quality.h"
#include "mesh/read_gmsh.h"
#include "parameters/keys.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace mesoslip
{
namespace
{
/** Below this scaled Jacobian a cell is so flat that its strains are unreliable. */
constexpr double poor_jacobian = 0.05;

std::string count_text(const std::size_t n, const std::string &of)
{
  return std::to_string(n) + " " + of;
}

/** Numbers the phases as in Phases/Names, or all as one phase. */
template <int dim>
void number_phases(Mesh<dim> &mesh,
                   const std::string &file,
                   const std::vector<PhaseParameters> &phases,
                   const bool one_phase)
{
  if (one_phase)
    {
      for (auto &cell : mesh.cells)
        cell.material_id = 0;
      mesh.phases = {phases[0].name};
      return;
    }
  std::vector<dealii::types::material_id> number;
  std::vector<std::string> names;
  for (const PhaseParameters &phase : phases)
    names.push_back(phase.name);
  for (const std::string &group : mesh.phases)
    {
      const auto found = std::find(names.begin(), names.end(), group);
      if (found == names.end())
        throw UserError("Mesh/File = " + file + " has cells of the group '" + group +
                        "', which is no phase: there are " + to_text(names) +
                        "; name groups and phases alike");
      number.push_back(found - names.begin());
    }
  for (auto &cell : mesh.cells)
    cell.material_id = number[cell.material_id];
  mesh.phases = names;
}

template <int dim>
std::string kinds_text(const Mesh<dim> &mesh)
{
  std::size_t simplices = 0;
  for (const auto &cell : mesh.cells)
    simplices += cell.vertices.size() == dim + 1;
  const std::size_t others = mesh.cells.size() - simplices;
  std::string text         = "Mesh: " + count_text(mesh.points.size(), "points");
  if (simplices > 0)
    text += ", " + count_text(simplices, dim == 2 ? "triangles" : "tetrahedra");
  if (others > 0)
    text += ", " + count_text(others, dim == 2 ? "quadrilaterals" : "hexahedra");
  return text;
}

/** Extents of the bounding box. */
template <int dim>
std::string box_line(const Mesh<dim> &mesh)
{
  const dealii::BoundingBox<dim> box(mesh.points);
  std::string text;
  for (unsigned int d = 0; d < dim; ++d)
    {
      // Round-off relative to the size of the body is shown as zero.
      const auto shown = [&](const double x) {
        return std::fabs(x) > 1e-9 * box.side_length(d) ? x : 0.;
      };
      text +=
        brief_text(6, d == 0 ? "Bounding box: " : ", ", "xyz"[d], " from ",
                   shown(box.lower_bound(d)), " to ", shown(box.upper_bound(d)), " m");
    }
  return text;
}

/** Warns of a body that looks like another unit, or refuses it if Mesh/Scale is not
 * typed. */
template <int dim>
void check_size(MeshMorphology<dim> &body, const bool scale_typed)
{
  const dealii::BoundingBox<dim> box(body.mesh.points);
  std::vector<PlausibleRange> lengths;
  for (unsigned int d = 0; d < dim; ++d)
    lengths.push_back(
      plausible_length(std::string("the body along ") + "xyz"[d], box.side_length(d)));
  const std::vector<std::string> slips = implausible(lengths);
  if (slips.empty())
    return;
  if (!scale_typed)
    throw UserError("Mesh/Scale: " + slips.front() +
                    "; set Mesh/Scale to the metres per unit of the file, 0.001 for mm, "
                    "or to 1 if it is in m");
  body.warnings.push_back("Mesh/Scale: " + slips.front());
}

template <int dim>
std::string point_text(const dealii::Point<dim> &point)
{
  std::string text;
  for (unsigned int d = 0; d < dim; ++d)
    text += brief_text(4, d == 0 ? "" : ", ", point[d]);
  return text;
}

template <int dim>
std::string quality_line(const MeshQuality<dim> &quality)
{
  return brief_text(4, "Edges from ", quality.smallest_edge, " to ", quality.largest_edge,
                    " m; worst cell at (", point_text(quality.worst_place),
                    ") m, scaled Jacobian ", quality.worst_jacobian);
}

/** Faces and area of each group on the boundary. */
template <int dim>
std::vector<std::string> boundary_lines(const Mesh<dim> &mesh,
                                        const std::vector<BoundaryFace<dim>> &faces)
{
  std::vector<std::string> lines;
  for (unsigned int b = 0; b < mesh.boundaries.size(); ++b)
    {
      const auto group = faces_of_group(mesh, faces, b);
      double area      = 0.;
      for (const BoundaryFace<dim> &face : group)
        {
          dealii::Tensor<1, dim> normal;
          for (const auto &part : boundary_points<dim>(mesh, {face}).normal_area)
            normal += part;
          area += normal.norm();
        }
      const std::string name   = "Boundary '" + mesh.boundaries[b] + "': ";
      const std::size_t others = n_faces_in_file(mesh, b) - group.size();
      lines.push_back(
        group.empty()
          ? name + "inside the body, without effect"
          : brief_text(6, name, group.size(), dim == 2 ? " edges, " : " faces, ", area,
                       dim == 2 ? " m" : " m^2") +
              (others > 0
                 ? "; " + std::to_string(others) + " more not on the boundary of the body"
                 : ""));
    }
  return lines;
}

/** Opposite points of the two sides of an axis, or the reason why there are none. */
template <int dim>
struct OppositeSides
{
  OppositePoints<dim> points;
  double largest_offset = 0.; ///< points to side planes (m)
  std::string error;
};

/** Opposite sides for each axis. */
template <int dim>
std::array<OppositeSides<dim>, dim> opposite_sides(const Mesh<dim> &mesh)
{
  const auto faces          = faces_of_box(mesh, boundary_faces(mesh));
  const double edge         = cell_quality(mesh).smallest_edge;
  const auto [lower, upper] = dealii::BoundingBox<dim>(mesh.points).get_boundary_points();
  std::array<OppositeSides<dim>, dim> result;
  for (unsigned int side = 0; side < 2 * dim; ++side)
    for (const unsigned int p : boundary_points(mesh, faces[side]).points)
      result[side / 2].largest_offset = std::max(
        result[side / 2].largest_offset,
        std::fabs(mesh.points[p][side / 2] - (side % 2 == 0 ? lower : upper)[side / 2]));
  for (unsigned int axis = 0; axis < dim; ++axis)
    try
      {
        result[axis].points =
          opposite_points(mesh, faces[2 * axis], faces[2 * axis + 1], axis, edge);
      }
    catch (const UserError &e)
      {
        result[axis].error = e.what();
      }
  return result;
}

std::string file_name_of(const std::string &path)
{
  return std::filesystem::path(path).filename().string();
}
} // namespace

void MeshParameters::bind(Keys &keys)
{
  keys.bind("Dimension", dim, 2, 3,
            has_grids_in_3d
              ? "Dimension of the body: 2, plane strain, or 3 [-]"
              : "Dimension of the body: 2, plane strain, or 3, which needs a mesh [-]");
  bind_file(keys);
  keys.require(dim == 2 || has_grids_in_3d || !files.empty(), "Dimension",
               "3 needs a mesh; set Mesh/File to one that Gmsh wrote");
}

void MeshParameters::bind_file(Keys &keys)
{
  {
    const auto section = keys.section("Mesh");
    keys.bind_inputs("File", files,
                     "Mesh of the body that Gmsh wrote (.msh, format 4.1 or 2.2), with "
                     "triangles and quadrilaterals (2D), tetrahedra or hexahedra (3D). "
                     "Its physical groups of cells are named as the phases. Several "
                     "meshes, separated by commas, make an ensemble. Empty: the body is "
                     "a grid [-]");
    keys.bind("Scale", scale, Range::positive(),
              "Metres per unit of the mesh file: 0.001 for one in mm [m]");
    keys.bind("Tolerance", tolerance, Range::closed(1e-9, 0.1),
              "How far points may be off the sides of a volume and off the points "
              "opposite, in edges [-]");
    std::vector<std::string> of_mesh = {"Scale", "Tolerance"};
    if (has_degrees)
      {
        keys.bind(
          "Degree", degree, 1, 2,
          "Degree of the displacements in triangles, tetrahedra and, along each axis, "
          "quadrilaterals and hexahedra. 2: several times the unknowns and, where the "
          "solution is smooth, far smaller errors; triangles and tetrahedra do not lock "
          "in nearly incompressible phases [-]");
        of_mesh.emplace_back("Degree");
      }
    keys.only_if(!files.empty(), of_mesh, "there is no mesh", "set Mesh/File");
  }
  scale_typed = keys.is_typed(keys.path("Mesh/Scale"));
}

template <int dim>
MeshMorphology<dim> read_mesh(const MeshParameters &parameters,
                              const std::string &file,
                              const std::vector<PhaseParameters> &phases)
{
  MeshMorphology<dim> result;
  Mesh<dim> &mesh = result.mesh;
  result.file     = file;
  mesh            = read_gmsh<dim>(file, parameters.scale, parameters.degree);
  mesh.tolerance  = parameters.tolerance;
  number_phases(mesh, file, phases, parameters.one_phase);
  result.description = {kinds_text(mesh) + " of " + file_name_of(file), box_line(mesh)};
  check_size(result, parameters.scale_typed);
  if (mesh.n_turned > 0)
    result.description.push_back(
      count_text(mesh.n_turned, mesh.n_turned == 1 ? "cell" : "cells") +
      " had the corners in the reverse order, which is turned");
  if (!mesh.bulges.empty())
    result.description.push_back(
      count_text(mesh.bulges.size(), "edges, faces and cells are curved"));
  const MeshQuality<dim> quality = cell_quality(mesh);
  result.description.push_back(quality_line(quality));
  if (quality.worst_jacobian < poor_jacobian)
    result.warnings.push_back("the mesh has cells that are nearly flat: " +
                              result.description.back() + "; strains there say little");
  const double volume = std::accumulate(quality.volume.begin(), quality.volume.end(), 0.);
  result.phases       = make_phases<dim>(phases);
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      result.fractions.push_back(quality.volume[p] / volume);
      result.description.push_back(
        brief_text(6, "Phase ", p, ", ", phases[p].name, ": ", quality.n_cells[p],
                   " cells, ", quality.volume[p], dim == 2 ? " m^2, " : " m^3, ",
                   100. * result.fractions[p], " %; ", phases[p].text<dim>()));
      if (quality.n_cells[p] == 0)
        result.warnings.push_back("phase '" + phases[p].name +
                                  "' of Phases/Names has no cell in " +
                                  file_name_of(file));
    }
  const auto faces = boundary_faces(mesh);
  for (const std::string &line : boundary_lines(mesh, faces))
    result.description.push_back(line);
  if (const auto open = open_seams(mesh, faces); !open.empty())
    result.warnings.push_back(
      file_name_of(file) +
      " is open where parts touch: " + count_text(open.size(), "points of the boundary") +
      " coincide with others or lie on edges or faces of other cells, first at (" +
      point_text(mesh.points[open.front()]) +
      ") m; if that is no crack, let the parts share their points (in Gmsh: "
      "BooleanFragments or Coherence)");
  return result;
}

template <int dim>
std::string opposite_text(const OppositePoints<dim> &sides)
{
  return brief_text(3, sides.pairs.size(), " points each, opposite within ",
                    sides.largest_mismatch, " m");
}

template <int dim>
std::vector<std::string> periodicity_lines(const Mesh<dim> &mesh)
{
  std::vector<std::string> lines;
  const auto pairs = opposite_sides(mesh);
  const dealii::BoundingBox<dim> box(mesh.points);
  for (unsigned int axis = 0; axis < dim; ++axis)
    if (pairs[axis].largest_offset > 1e-9 * box.side_length(axis))
      lines.push_back(brief_text(3, "Sides at both ends of ", "xyz"[axis],
                                 ": plane within ", pairs[axis].largest_offset, " m"));
  for (unsigned int axis = 0; axis < dim; ++axis)
    lines.push_back(pairs[axis].error.empty()
                      ? std::string("Sides at both ends of ") + "xyz"[axis] + ": " +
                          opposite_text(pairs[axis].points) + ": periodic"
                      : "Not for PBC: " + pairs[axis].error);
  return lines;
}

template <int dim>
void require_volume(const Mesh<dim> &mesh, const bool periodic)
{
  for (const auto &sides : opposite_sides(mesh))
    if (periodic && !sides.error.empty())
      throw UserError(sides.error);
}

template MeshMorphology<2> read_mesh<2>(const MeshParameters &,
                                        const std::string &,
                                        const std::vector<PhaseParameters> &);
template MeshMorphology<3> read_mesh<3>(const MeshParameters &,
                                        const std::string &,
                                        const std::vector<PhaseParameters> &);
template void require_volume(const Mesh<2> &, const bool);
template void require_volume(const Mesh<3> &, const bool);
template std::string opposite_text(const OppositePoints<2> &);
template std::string opposite_text(const OppositePoints<3> &);
template std::vector<std::string> periodicity_lines(const Mesh<2> &);
template std::vector<std::string> periodicity_lines(const Mesh<3> &);
} // namespace mesoslip
