#include "sliding/mesh/mesh_body.h"

#include "base/digest.h"
#include "base/errors.h"
#include "base/exchange.h"
#include "base/text.h"
#include "exchange/rve_file.h"
#include "material/shear_impedance.h"
#include "sliding/body_grid.h"
#include "sliding/contact_parameters.h"
#include "sliding/mesh/body_mesh.h"
#include "sliding/mesh/mesh_sides.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

namespace mesoslip
{
namespace
{
double sum_of(const std::vector<double> &values)
{
  return std::accumulate(values.begin(), values.end(), 0.);
}

template <int dim>
std::vector<double> friction_of_points(const BodyMesh<dim> &morphology,
                                       const std::vector<BoundaryFace<dim>> &faces,
                                       const MeshBoundary &contact,
                                       const FrictionParameters &friction)
{
  if (!friction.coefficient_by_phase)
    return std::vector<double>(contact.points.size(), friction.coefficient);
  std::vector<double> coefficient, weight;
  for (const Phase<dim> &phase : morphology.materials())
    {
      coefficient.push_back(phase.friction_coefficient);
      weight.push_back(
        friction.node_rule == "stiffness" ? phase.stiffness(dim - 1, dim - 1) : 1.);
    }
  const bool largest = friction.node_rule == "largest";
  if (largest || friction.node_rule == "smallest")
    return extreme_of_phases(morphology.mesh, faces, contact, coefficient, largest);
  return mean_of_phases(morphology.mesh, faces, contact, coefficient, weight);
}

/** For each phase its share in the area of the faces around each point of @p contact. */
template <int dim>
std::vector<std::vector<double>>
shares_of_phases(const BodyMesh<dim> &morphology,
                 const std::vector<BoundaryFace<dim>> &faces,
                 const MeshBoundary &contact)
{
  const std::size_t n = morphology.materials().size();
  std::vector<std::vector<double>> shares;
  for (std::size_t p = 0; p < morphology.phases.size(); ++p)
    {
      std::vector<double> is_phase(n);
      for (unsigned int m = 0; m < n; ++m)
        is_phase[m] = morphology.phase_of(m) == p ? 1. : 0.;
      shares.push_back(mean_of_phases(morphology.mesh, faces, contact, is_phase,
                                      std::vector<double>(n, 1.)));
    }
  return shares;
}

/** Whether the analysis needs the contact: modes with a free bottom do not. */
bool needs_contact(const ContactParameters &parameters)
{
  return parameters.analysis != ContactAnalysis::modal ||
         parameters.modal_bottom != "free";
}

/** Whether the analysis needs the top: modes with a free top and counter bodies do
 * not. */
bool needs_top(const ContactParameters &parameters)
{
  if (parameters.is_counter) // its bottom is an ordinary side
    return false;
  const TopSetup &top = parameters.top;
  return parameters.analysis != ContactAnalysis::modal || top.holds(0) ||
         (parameters.mesh.mesh.dim == 3 && top.holds(1)) || top.suspension.is_there() ||
         !(top.hold_from > 0.);
}

/** Checks the compatibility of platen, contact and constrained boundaries. */
void check_supports(const MeshBodyDescription &body,
                    const unsigned int normal,
                    const ContactParameters &given)
{
  const MeshBodyParameters &parameters = given.mesh;
  const TopSetup &top                  = given.top;
  std::set<unsigned int> held;
  for (const HeldComponent &h : body.held)
    if (h.component == normal)
      held.insert(h.point);
  const bool is_static = given.analysis == ContactAnalysis::static_contact ||
                         given.analysis == ContactAnalysis::complex_modes;
  if (is_static &&
      std::all_of(body.contact.points.begin(), body.contact.points.end(),
                  [&](const unsigned int point) { return held.count(point) > 0; }))
    throw UserError("Supports: " + to_text(parameters.held[normal]) + " with Held = u_" +
                    "xyz"[normal] + " holds all of '" + parameters.contact_boundary +
                    "', the Contact boundary, along the normal of the flat, which then "
                    "carries nothing; leave it out");
  const std::set<unsigned int> top_points(body.top.points.begin(), body.top.points.end());
  for (const unsigned int point : body.contact.points)
    if (top_points.count(point) > 0)
      throw UserError("Mesh/Top boundary: '" + parameters.top_boundary + "' and '" +
                      parameters.contact_boundary +
                      "', the Contact boundary, share points; each point may be in one");
  for (const HeldComponent &h : body.held)
    if (top.is_platen && top_points.count(h.point) > 0 &&
        (h.component == normal || !top.holds(h.component)))
      throw UserError("Supports: " + to_text(parameters.held[h.component]) +
                      " with Held = u_" + "xyz"[h.component] +
                      " has points that the platen of Supports/Top/Kind moves; leave the "
                      "component out, or set Supports/Top/Kind = " +
                      (top.suspension.is_there() ? "springs" : "pressure or held"));
}

/** The contact node nearest to Reference x, or to the middle of the contact, in 3D
 * halfway along y; with two equally near nodes the last, as on grids. Periodic points
 * are one node in several places. */
template <int dim>
ReferenceNode reference_node(const BodyMesh<dim> &morphology,
                             const MeshBoundary &contact,
                             const double wanted_x)
{
  const Mesh<dim> &mesh = morphology.mesh;
  std::unordered_map<unsigned int, unsigned int> number;
  for (const unsigned int point : contact.points)
    number.emplace(point, static_cast<unsigned int>(number.size()));
  std::vector<unsigned int> all = contact.points;
  for (unsigned int point = 0; point < mesh.masters.size(); ++point)
    if (mesh.masters[point] != point && number.count(mesh.masters[point]) > 0)
      all.push_back(point);
  std::sort(all.begin(), all.end(), [&](const unsigned int a, const unsigned int b) {
    return std::lexicographical_compare(&mesh.points[a][0], &mesh.points[a][0] + dim,
                                        &mesh.points[b][0], &mesh.points[b][0] + dim);
  });
  std::vector<dealii::Point<dim>> points;
  for (const unsigned int point : all)
    points.push_back(mesh.points[point]);
  const auto [lower, upper] = dealii::BoundingBox<dim>(points).get_boundary_points();
  dealii::Point<dim> middle = lower + 0.5 * (upper - lower);
  if (!std::isnan(wanted_x))
    middle[0] = wanted_x;
  if (!(lower[0] <= middle[0] && middle[0] <= upper[0]))
    throw UserError("Observation/Reference x: " + to_text(wanted_x) +
                    " m lies outside the contact, " + to_text(lower[0]) + " to " +
                    to_text(upper[0]) + " m");
  ReferenceNode node;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    {
      dealii::Tensor<1, dim> away = points[i] - middle;
      away[dim - 1]               = 0.;
      if (!(away.norm() <= nearest + 1e-9 * (upper - lower).norm()))
        continue;
      nearest     = away.norm();
      node.number = number.at(mesh.master(all[i]));
    }
  std::copy_n(&mesh.points[contact.points[node.number]][0], dim, node.position.begin());
  node.area        = -contact.area[node.number];
  const auto place = morphology.places_of({{"", "the reference node", node.position}});
  node.phase       = morphology.phase_of(place[0].material);
  return node;
}

/** Stiffness, impedance, size and mass; the area is taken from @p top or, without a top,
 * from the bounding box. */
template <int dim>
BodyScales scales_of(const BodyMesh<dim> &morphology,
                     const dealii::Tensor<1, dim> &sides,
                     const MeshBoundary &top,
                     const std::array<double, 2> &flat_direction)
{
  BodyScales scales;
  scales.dim             = dim;
  scales.shear_impedance = std::numeric_limits<double>::infinity();
  for (const Phase<dim> &phase : morphology.materials())
    {
      const double stiffness = phase.stiffness(dim - 1, dim - 1);
      scales.stiffness       = std::max(scales.stiffness, stiffness);
      scales.wave_speed =
        std::max(scales.wave_speed, std::sqrt(stiffness / phase.density));
      scales.shear_impedance =
        std::min(scales.shear_impedance,
                 shear_impedance<dim>(phase.stiffness, phase.density, flat_direction));
    }
  double box = 1., mean_density = 0.;
  for (unsigned int d = 0; d + 1 < dim; ++d)
    {
      scales.extent[d] = sides[d];
      box *= sides[d];
    }
  for (std::size_t k = 0; k < morphology.phases.size(); ++k)
    mean_density += morphology.fractions[k] * morphology.phases[k].density;
  scales.height  = sides[dim - 1];
  scales.area    = top.points.empty() ? box : sum_of(top.area);
  scales.density = mean_density;
  scales.mass    = morphology.mass(mean_density * box * sides[dim - 1]);
  return scales;
}

/** Renumbers points and cells of the partial mesh to numbers in the whole body. */
template <int dim>
void number_in_whole_body(MeshBodyDescription &body, const BodyMesh<dim> &morphology)
{
  const auto renumber = [&](std::vector<unsigned int> &points) {
    for (unsigned int &point : points)
      point = morphology.whole_point(point);
  };
  for (MeshSide &side : body.sides)
    renumber(side.points);
  renumber(body.contact.points);
  renumber(body.top.points);
  for (HeldComponent &h : body.held)
    h.point = morphology.whole_point(h.point);
  for (MeshPlace &place : body.probes)
    {
      place.cell  = morphology.whole_cell(place.cell);
      place.phase = morphology.phase_of(place.material);
      renumber(place.corners);
    }
}
} // namespace

template <int dim>
MeshBodyDescription describe_body(const BodyMesh<dim> &morphology,
                                  const ContactParameters &given)
{
  const MeshBodyParameters &parameters = given.mesh;
  const Mesh<dim> &mesh                = morphology.mesh;
  for (const Phase<dim> &phase : morphology.phases)
    if (!(phase.density > 0.))
      throw UserError("Phases/" + phase.name +
                      "/Density is not given; dynamics needs it, in kg/m^3");
  const auto faces      = morphology.boundary();
  const auto faces_with = [&](const std::string &key, const std::string &name) {
    return group_faces(morphology, faces, key, name);
  };
  const char normal = "xyz"[dim - 1];
  MeshBodyDescription body;
  if (needs_contact(given))
    {
      const std::string key = parameters.section + "Mesh/Contact boundary";
      const auto bottom     = faces_with(key, parameters.contact_boundary);
      body.contact          = mesh_boundary(mesh, bottom);
      if (given.is_counter)
        for (double &area : body.contact.area)
          area *= -1.;
      if (!(sum_of(body.contact.area) < 0.))
        throw UserError(
          key + ": '" + parameters.contact_boundary +
          (given.is_counter
             ? "' does not face up; a counter body is below the other one"
             : std::string(
                 "' does not face down; the flat is below the body, its normal is ") +
                 normal));
      body.friction =
        friction_of_points(morphology, bottom, body.contact, given.friction);
      if (given.is_counter || given.counter)
        body.contact.facets = facets_of(mesh, bottom, body.contact);
      body.shares = shares_of_phases(morphology, bottom, body.contact);
      body.reference =
        reference_node(morphology, body.contact, given.observation.reference_x);
    }
  if (needs_top(given))
    {
      const auto top = faces_with("Mesh/Top boundary", parameters.top_boundary);
      body.top       = mesh_boundary(mesh, top);
      if (given.top.suspension.absorbing)
        body.top_nodes.impedance = impedance_of_points(morphology, top, body.top);
      body.top_nodes.area = body.top.area;
      for (const unsigned int point : body.top.points)
        for (unsigned int c = 0; c < dim; ++c)
          body.top_nodes.position[c].push_back(mesh.points[point][c]);
      if (!(sum_of(body.top.area) > 0.))
        throw UserError("Mesh/Top boundary: '" + parameters.top_boundary +
                        "' does not face up, along " + normal);
    }
  for (unsigned int c = 0; c < dim; ++c)
    for (const std::string &name : parameters.held[c])
      for (const unsigned int point :
           boundary_points(mesh,
                           faces_with(parameters.section + "Supports/" + name, name))
             .points)
        body.held.push_back({mesh.master(point), c});
  describe_sides(body, morphology, faces, given);
  check_supports(body, dim - 1, given);
  body.n_points = morphology.n_points();
  body.n_cells  = morphology.n_cells();
  Digest digest;
  if (!morphology.file.empty())
    digest.add_file(morphology.file);
  body.digest               = digest.add(parameters.rve_digest).hex();
  const auto [lower, upper] = dealii::BoundingBox<dim>(mesh.points).get_boundary_points();
  const dealii::Tensor<1, dim> sides = upper - lower;
  body.scales = scales_of(morphology, sides, body.top, given.contact.flat_direction);
  body.shortest_side = std::min({sides[0], sides[1], sides[dim - 1]});
  body.probes        = morphology.places_of(given.observation.probes);
  number_in_whole_body(body, morphology);
  return body;
}

template MeshBodyDescription describe_body(const BodyMesh<2> &,
                                           const ContactParameters &);
template MeshBodyDescription describe_body(const BodyMesh<3> &,
                                           const ContactParameters &);
} // namespace mesoslip
