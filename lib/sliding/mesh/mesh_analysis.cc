#include "sliding/mesh/mesh_analysis.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "material/plausibility.h"
#include "mesh/mesh.h"
#include "program/machine.h"
#include "program/run_context.h"
#include "sliding/mesh/box_body.h"
#include "sliding/run_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <ostream>

namespace mesoslip
{
namespace
{
/** Sentences on materials, friction and a static load that look like another unit. */
template <int dim>
std::vector<std::string> implausible_body(const std::vector<Phase<dim>> &phases,
                                          const ContactParameters &parameters,
                                          const double stiffness)
{
  std::vector<PlausibleRange> ranges = plausible_phases<dim>(phases);
  if (parameters.friction.has_constant_coefficient())
    ranges.push_back(
      plausible_friction("Friction/Coefficient", parameters.friction.coefficient));
  if (parameters.analysis == ContactAnalysis::static_contact)
    ranges.push_back(plausible_pressure(
      "Top/Pressure", std::fabs(parameters.top.pressure.amplitude()), stiffness));
  std::vector<std::string> sentences = implausible(ranges);
  for (const std::string &one : stiffness_warnings<dim>(phases))
    sentences.push_back(one);
  return sentences;
}

/** The mesh, or the box, for which the memory of a machine with @p n_here of all @p n_ranks is
 * enough; @p memory becomes what it takes. */
template <int dim>
MeshMorphology<dim> read_body(const ContactParameters &parameters,
                              const unsigned int n_here,
                              const unsigned int n_ranks,
                              BodyMemory &memory)
{
  const MeshBodyParameters &mesh = parameters.mesh;
  if constexpr (dim == 3)
    if (mesh.is_box())
      {
        auto box = make_box(parameters, n_here, n_ranks);
        memory   = memory_of_box(parameters, box.box->grid);
        return box;
      }
  auto body = read_mesh<dim>(mesh.mesh, mesh.mesh.files[0], mesh.phases);
  memory    = memory_on_mesh(parameters, body.mesh);
  require_memory({memory.on_machine(n_here, n_ranks),
                  "take a coarser mesh, or divide it among more machines"});
  return body;
}

/** Empty if all contact nodes have an area seen along the normal of the flat. */
std::string standing_faces_warning(const MeshBoundary &contact,
                                   const MeshBodyParameters &mesh)
{
  double mean = 0.;
  for (const double area : contact.area)
    mean += std::fabs(area) / static_cast<double>(contact.area.size());
  const auto n = std::count_if(contact.area.begin(), contact.area.end(),
                               [&](const double a) { return !(-a > 1e-9 * mean); });
  if (n == 0)
    return "";
  return "Mesh/Contact boundary: " + std::to_string(n) + " of " +
         std::to_string(contact.area.size()) + " nodes of '" + mesh.contact_boundary +
         "' have no area seen along the normal of the flat, as faces of the group stand "
         "on "
         "it or look up; they have no pressure, but count in the shares of sticking, "
         "slipping and separated nodes like all others: leave these faces out of the "
         "group";
}
} // namespace

template <int dim>
MeshAnalysis<dim>::MeshAnalysis(const ContactParameters &given)
  : parameters(with_phases<dim>(given))
{
  parameters.mesh.check();
  const unsigned int n_here  = ranks_of_this_machine(),
                     n_ranks = mpi::n_mpi_processes(MPI_COMM_WORLD);
  on_root(MPI_COMM_WORLD, [&]() {
    morphology = read_body<dim>(parameters, n_here, n_ranks, memory);
    join_periodic_sides(morphology, parameters.mesh);
    body = describe_body(morphology, parameters);
    if (const std::string sentence =
          standing_faces_warning(body.contact, parameters.mesh);
        !sentence.empty())
      morphology.warnings.push_back(sentence);
    if (!parameters.mesh.rve_note.empty())
      morphology.warnings.push_back(parameters.mesh.rve_note);
    for (const std::string &sentence :
         implausible_body<dim>(morphology.phases, parameters, body.scales.stiffness))
      morphology.warnings.push_back(sentence);
  });
  broadcast_object(MPI_COMM_WORLD, body);
  broadcast_object(MPI_COMM_WORLD, memory);
  broadcast_object(MPI_COMM_WORLD, morphology.oriented);
  // Only steps are divided before all else is made on rank 0.
  if constexpr (dim == 3)
    if (parameters.mesh.is_box() && parameters.analysis == ContactAnalysis::transient)
      share_box(parameters.body, morphology);
  for (const Phase<dim> &phase :
       oriented_phases(make_phases<dim>(parameters.mesh.phases), morphology.oriented))
    phases.push_back({phase.stiffness, phase.density});
  if (n_ranks > body.n_cells)
    throw UserError("the mesh has " + std::to_string(body.n_cells) +
                    " cells, which are divided among the processes; start fewer than " +
                    std::to_string(n_ranks));
}

template <int dim>
std::vector<std::string> MeshAnalysis<dim>::lines() const
{
  std::vector<std::string> text = morphology.description;
  const auto add                = [&](const std::string &what, const std::string &name,
                       const MeshBoundary &boundary) {
    const double area =
      std::fabs(std::accumulate(boundary.area.begin(), boundary.area.end(), 0.));
    if (!boundary.points.empty())
      text.push_back(brief_text(6, what, " '", name, "': ", boundary.points.size(),
                                               " nodes, ", area, dim == 2 ? " m" : " m^2",
                                               " seen along the normal of the flat"));
  };
  add("Contact", parameters.mesh.contact_boundary, body.contact);
  add("Top", parameters.mesh.top_boundary, body.top);
  return text;
}

template <int dim>
void MeshAnalysis<dim>::describe(std::ostream &out) const
{
  for (const std::string &line : lines())
    out << line << '\n';
  out << dim * body.n_points << " degrees of freedom\n"
      << memory.text(mpi::n_mpi_processes(MPI_COMM_WORLD)) << '\n';
  for (const std::string &warning : morphology.warnings)
    out << "warning: " << warning << '\n';
}

template <int dim>
void MeshAnalysis<dim>::log_body(RunContext &context) const
{
  for (const std::string &line : lines())
    context.log(line);
  for (const std::string &warning : morphology.warnings)
    context.warn(warning);
}

template <int dim>
void MeshAnalysis<dim>::summarize_body(const std::string &analysis,
                                       RunContext &context) const
{
  nlohmann::json &json = context.summary();
  json["dim"]          = dim;
  json["cells"]        = body.n_cells;
  json["dofs"]         = dim * body.n_points;
  json["analysis"]     = analysis;
  json["material"]     = phases.size() > 1 ? "heterogeneous" : "homogeneous";
}

template <int dim>
MeshBodyInput<dim> MeshAnalysis<dim>::input_without_mesh() const
{
  MeshBodyInput<dim> input;
  input.phases      = phases;
  input.periodicity = {!parameters.mesh.periodic[0].empty(),
                       !parameters.mesh.periodic[1].empty()};
  // What the analysis does not need may not be there.
  if (!body.contact.points.empty())
    input.contact_boundary = parameters.mesh.contact_boundary;
  if (!body.top.points.empty())
    input.top_boundary = parameters.mesh.top_boundary;
  return input;
}

template <int dim>
std::unique_ptr<MeshBody<dim>> MeshAnalysis<dim>::divide_body() const
{
  return MeshBody<dim>::divide(morphology.mesh, input_without_mesh(), MPI_COMM_WORLD);
}

template <int dim>
std::unique_ptr<MeshBody<dim>> MeshAnalysis<dim>::make_whole_body() const
{
  MeshBodyInput<dim> input = input_without_mesh();
  input.mesh               = morphology.mesh;
  broadcast_object(MPI_COMM_WORLD, input.mesh);
  return std::make_unique<MeshBody<dim>>(input, MPI_COMM_WORLD);
}

template <int dim>
DofMask MeshAnalysis<dim>::held_by_mesh(const TopSetup &top,
                                        const MeshBody<dim> &elastic) const
{
  DofMask held(elastic.n_columns(), 1);
  const auto hold = [&](const unsigned int c, const unsigned int point) {
    if (const auto node = elastic.find(point))
      held.constrain(c, *node);
  };
  for (const HeldComponent &h : body.held)
    hold(h.component, h.point);
  for (unsigned int c = 0; c < dim; ++c)
    if (top.is_fixed(c, dim))
      for (const unsigned int point : body.top.points)
        hold(c, point);
  return held;
}

template <int dim>
void MeshAnalysis<dim>::order_contact(const MeshBody<dim> &elastic)
{
  const MeshBoundary contact         = this->body.contact;
  const std::vector<double> friction = this->body.friction;
  std::map<unsigned int, std::size_t> place;
  for (std::size_t k = 0; k < contact.points.size(); ++k)
    place[contact.points[k]] = k;
  const std::vector<unsigned int> &points = elastic.contact_points();
  for (std::size_t k = 0; k < points.size(); ++k)
    {
      const std::size_t old        = place.at(points[k]);
      this->body.contact.points[k] = contact.points[old];
      this->body.contact.area[k]   = contact.area[old];
      this->body.contact.height[k] = contact.height[old];
      this->body.friction[k]       = friction[old];
    }
}

template <int dim>
std::string MeshAnalysis<dim>::place_of_cell(const CellExtreme &cell)
{
  std::string text = "cell " + std::to_string(cell.cell) + " around ";
  for (unsigned int d = 0; d < dim; ++d)
    text += std::string(d > 0 ? ", " : "") + "xyz"[d] + " = " +
            quantity_text(1e3 * cell.middle[d], "mm");
  return text;
}

template class MeshAnalysis<2>;
template class MeshAnalysis<3>;
} // namespace mesoslip
