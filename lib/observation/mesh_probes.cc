#include "observation/mesh_probes.h"

#include "base/errors.h"
#include "base/text.h"
#include "mesh/cell_locator.h"
#include "mesh/cell_shapes.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <numeric>

namespace mesoslip
{
namespace
{
/** Tolerance of the shape functions for a probe outside its cell [-]. */
constexpr double outside_cell = 1e-6;

template <int dim>
std::string coordinates_text(const dealii::Point<dim> &point)
{
  std::string text;
  for (unsigned int d = 0; d < dim; ++d)
    text += (d > 0 ? ", " : "(") + to_text(point[d]);
  return text + ")";
}

template <int dim>
dealii::Point<dim> nearest_point(const Mesh<dim> &mesh, const dealii::Point<dim> &to)
{
  return *std::min_element(mesh.points.begin(), mesh.points.end(),
                           [&](const auto &a, const auto &b) {
                             return (a - to).norm_square() < (b - to).norm_square();
                           });
}

/** Location of a point in @p cell; outside the cell shape functions are negative. */
template <int dim>
MeshPlace place_in(const Mesh<dim> &mesh,
                   const unsigned int cell,
                   const dealii::Point<dim> &at,
                   const ProbePoint &point)
{
  const unsigned int material = mesh.cells[cell].material_id;
  MeshPlace place{point, cell, material, material, mesh.cells[cell].vertices, {}, {}, {}};
  const auto integrated = integrated_gradients(mesh, place.corners);
  const double volume   = cell_measure(mesh, place.corners).volume;
  for (const auto &gradient : integrated)
    for (unsigned int d = 0; d < dim; ++d)
      place.mean_gradient.push_back(gradient[d] / volume);
  for (unsigned int d = 0; d < dim; ++d)
    place.point.position[d] = at[d];
  const CellShapes<dim> shapes = shapes_at(mesh, place.corners, at);
  place.shape                  = shapes.values;
  for (unsigned int &corner : place.corners)
    corner = mesh.master(corner);
  for (const auto &gradient : shapes.gradients)
    for (unsigned int d = 0; d < dim; ++d)
      place.gradient.push_back(gradient[d]);
  return place;
}

/** Nearest of the @p contact points if @p place is on the contact; with two equally near
 * points the first. */
std::optional<unsigned int> nearest_contact(const MeshPlace &place,
                                            const std::vector<unsigned int> &contact)
{
  std::optional<unsigned int> nearest;
  double inside = 0., largest = 0.;
  for (unsigned int i = 0; i < contact.size(); ++i)
    for (std::size_t v = 0; v < place.corners.size(); ++v)
      if (place.corners[v] == contact[i])
        {
          inside += place.shape[v];
          if (place.shape[v] > largest + 1e-9)
            {
              largest = place.shape[v];
              nearest = i;
            }
        }
  return 1. - inside < outside_cell ? nearest : std::nullopt;
}
} // namespace

template <int dim>
std::vector<MeshPlace> locate_probes(const Mesh<dim> &mesh,
                                     const std::vector<ProbePoint> &points)
{
  std::vector<unsigned int> all(points.empty() ? 0 : mesh.cells.size());
  std::iota(all.begin(), all.end(), 0U);
  return locate_probes(mesh, points, all);
}

template <int dim>
std::vector<MeshPlace> locate_probes(const Mesh<dim> &mesh,
                                     const std::vector<ProbePoint> &points,
                                     const std::vector<unsigned int> &cells)
{
  std::vector<MeshPlace> places;
  if (points.empty())
    return places;
  const CellLocator<dim> locator(mesh, cells);
  for (const ProbePoint &point : points)
    {
      dealii::Point<dim> at;
      for (unsigned int d = 0; d < dim; ++d)
        at[d] = point.position[d];
      auto cell = locator.find(at);
      if (cell && point.nearest_node)
        {
          at   = nearest_point(mesh, at);
          cell = locator.find(at);
        }
      if (cell)
        places.push_back(place_in(mesh, *cell, at, point));
      const bool inside =
        cell && std::all_of(places.back().shape.begin(), places.back().shape.end(),
                            [](const double s) { return s >= -outside_cell; });
      if (!inside)
        {
          const auto box = dealii::BoundingBox<dim>(mesh.points).get_boundary_points();
          throw UserError(
            point.section + "/" + point.name + "/Position: " + coordinates_text(at) +
            " m lies outside the body, whose bounding box is from " +
            coordinates_text(box.first) + " to " + coordinates_text(box.second) +
            (cell ? " m; Nearest node = true moves it to a node of the mesh" : " m"));
        }
    }
  return places;
}

template <int dim>
MeshProbes<dim>::MeshProbes(const std::vector<MeshPlace> &places,
                            const MeshPart<dim> &part,
                            const std::vector<ElasticPhase<dim>> &phases,
                            const Stepper &stepper,
                            const std::optional<Contact> &contact,
                            const std::uint64_t interval)
  : ProbeRecorder(stepper, dim, interval)
  , places(places)
  , phases(phases)
  , contact(contact)
{
  for (const MeshPlace &place : places)
    {
      const auto found =
        std::find(part.cell_in_mesh.begin(), part.cell_in_mesh.end(), place.cell);
      const bool owned = found != part.cell_in_mesh.end();
      corners.emplace_back();
      for (std::size_t v = 0; v < place.corners.size() && owned; ++v)
        {
          const auto &of_cell = part.cells[found - part.cell_in_mesh.begin()].vertices;
          corners.back().push_back(
            *std::find_if(of_cell.begin(), of_cell.end(), [&](const unsigned int point) {
              return part.master_in_mesh[point] == place.corners[v];
            }));
        }
      contact_node.push_back(contact ? nearest_contact(place, contact->points)
                                     : std::nullopt);
      add({place.point.name, place.point.position, place.phase}, owned);
    }
}

template <int dim>
ProbeRecorder::Vector MeshProbes<dim>::interpolate(const NodalField<double> &field,
                                                   const std::size_t k) const
{
  Vector value = {};
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t v = 0; v < corners[k].size(); ++v)
      value[c] += places[k].shape[v] * field.row(c, 0)[corners[k][v]];
  return value;
}

template <int dim>
void MeshProbes<dim>::sample_strain(const std::size_t k, ProbeHistory &history) const
{
  const MeshPlace &place         = places[k];
  const ElasticPhase<dim> &phase = phases[place.material];
  VoigtVector<dim> strain        = VoigtVector<dim>::Zero();
  double more_dilatation         = 0.; // cell mean minus value at the point
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t v = 0; v < corners[k].size(); ++v)
      {
        const double u = stepper.u.row(c, 0)[corners[k][v]];
        for (unsigned int d = 0; d < dim; ++d)
          strain[voigt_index<dim>(c, d)] += place.gradient[v * dim + d] * u;
        more_dilatation +=
          (place.mean_gradient[v * dim + c] - place.gradient[v * dim + c]) * u;
      }
  if (phase.mean_dilatation)
    strain.template head<dim>().array() += more_dilatation / dim;
  const VoigtVector<dim> stress = phase.stiffness * strain;
  history.strain.insert(history.strain.end(), strain.data(),
                        strain.data() + n_voigt<dim>);
  history.stress.insert(history.stress.end(), stress.data(),
                        stress.data() + n_voigt<dim>);
}

template <int dim>
void MeshProbes<dim>::sample_contact(const std::size_t k, ProbeHistory &history) const
{
  if (!contact_node[k])
    return;
  const double area    = -contact->area[*contact_node[k]];
  const unsigned int i = *contact->nodes.find(*contact_node[k]);
  history.traction.push_back(contact->surface.tangential_force()[i] / area);
  if (dim == 3)
    history.traction.push_back(contact->surface.lateral_force()[i] / area);
  history.traction.push_back(contact->surface.normal_force()[i] / area);
}

#define MESOSLIP_INSTANTIATE(dim)                                                 \
  template std::vector<MeshPlace> locate_probes(const Mesh<dim> &,                \
                                                const std::vector<ProbePoint> &); \
  template std::vector<MeshPlace> locate_probes(const Mesh<dim> &,                \
                                                const std::vector<ProbePoint> &,  \
                                                const std::vector<unsigned int> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
template class MeshProbes<2>;
template class MeshProbes<3>;
} // namespace mesoslip
