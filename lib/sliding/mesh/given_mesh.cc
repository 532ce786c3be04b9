#include "sliding/mesh/given_mesh.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "base/object_exchange.h"
#include "eigenvalues/complex/sliding_pencil.h"
#include "exchange/datasets.h"
#include "material/plausibility.h"
#include "program/machine.h"
#include "program/run_context.h"
#include "sliding/mesh/contact_area.h"
#include "sliding/mesh/elastic_mesh.h"
#include "sliding/mesh/mesh_file.h"
#include "sliding/run_plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mesoslip
{
template <int dim>
GivenMesh<dim>::GivenMesh(const ContactParameters &given,
                          std::unique_ptr<BodyMesh<dim>> unread)
  : GivenBody<dim>(with_phases<dim>(given))
  , mesh(std::move(unread))
{
  parameters.mesh.check();
  known.phases = make_phases<dim>(parameters.mesh.phases);
  this->check_damping();
  const unsigned int n_here  = ranks_of_this_machine(),
                     n_ranks = mpi::n_mpi_processes(MPI_COMM_WORLD);
  on_root(MPI_COMM_WORLD, [&]() {
    known.memory = mesh->read(parameters, n_here, n_ranks);
    body         = describe_body(*mesh, parameters);
    if (const std::string sentence =
          standing_faces_warning(body.contact, parameters.mesh);
        !sentence.empty())
      mesh->warnings.push_back(sentence);
    if (!parameters.mesh.rve_note.empty())
      mesh->warnings.push_back(parameters.mesh.rve_note);
    known.has_simplices = has_simplices(mesh->mesh);
    this->add_implausible(mesh->warnings, plausible_phases<dim>(mesh->phases),
                          body.scales);
  });
  broadcast_object(MPI_COMM_WORLD, body);
  broadcast_object(MPI_COMM_WORLD, known.memory);
  broadcast_object(MPI_COMM_WORLD, mesh->oriented);
  mesh->share(parameters.body);
  phases = elastic_phases<dim>(oriented_phases(known.phases, mesh->oriented),
                               parameters.body.mean_dilatation);
  if (n_ranks > body.n_cells)
    throw UserError("the mesh has " + std::to_string(body.n_cells) +
                    " cells, which are divided among the processes; start at most " +
                    std::to_string(body.n_cells));
  if (parameters.analysis == ContactAnalysis::transient)
    {
      distributed = mesh->distribute(body.contact.points, body.probes, phases,
                                     parameters.sweep.isa, MPI_COMM_WORLD);
      body.scales.highest_frequency =
        std::hypot(distributed->largest_frequency().upper,
                   frequency_of_springs(*distributed, body, parameters));
      if (parameters.map.interval > 0. || parameters.wants_node_loads())
        require_contact_area(body);
    }
  known.lines = lines();
  this->add_lines_on_cells();
  known.warnings         = mesh->warnings;
  known.n_points         = body.n_points;
  known.heterogeneous    = phases.size() > 1;
  known.rve_digest       = parameters.mesh.rve_digest;
  known.volume_fractions = mesh->fractions;
  known.place            = cell_text(dim);
  known.scales           = body.scales;
  describe_contact();
  known.shortest_side = body.shortest_side;
  known.contents      = "Content of Mesh/File = " + body.digest +
                   "\nContent of Body/RVE file = " + parameters.mesh.rve_content + "\n";
  known.probes     = probe_places();
  known.long_run   = 2e8;
  known.most_ranks = most_ranks();
}

template <int dim>
void GivenMesh<dim>::describe_contact()
{
  known.size           = size();
  known.contact_height = body.contact.height;
  known.contact_place  = body.contact.position;
  known.contact_points = body.contact.points;
  known.contact_facets = body.contact.facets;
}

template <int dim>
std::vector<std::string> GivenMesh<dim>::lines() const
{
  std::vector<std::string> text = mesh->description;
  const auto add                = [&](const std::string &what, const std::string &name,
                       const MeshBoundary &boundary) {
    const double sum = std::accumulate(boundary.area.begin(), boundary.area.end(), 0.);
    if (!boundary.points.empty())
      text.push_back(brief_text(6, what, " '", name, "': ", boundary.points.size(),
                                               " nodes, ", std::fabs(sum), dim == 2 ? " m" : " m^2",
                                               " seen along the normal of the flat"));
  };
  add("Contact", parameters.mesh.contact_boundary, body.contact);
  add("Top", parameters.mesh.top_boundary, body.top);
  return text;
}

template <int dim>
BodySize GivenMesh<dim>::size() const
{
  BodySize size;
  size.dim      = dim;
  size.top_area = std::accumulate(body.top.area.begin(), body.top.area.end(), 0.);
  for (const MeshSide &side : body.sides)
    {
      size.side_area.push_back(side.nodes.whole_area());
      size.side_push.push_back(side.nodes.whole_push());
      size.side_moves.push_back(side.moves);
    }
  size.n_cells         = body.n_cells;
  size.crossing        = body.scales.crossing();
  size.mass            = body.scales.mass;
  size.friction        = body.friction;
  size.n_contact_nodes = body.contact.points.size();
  for (const double area : body.contact.area)
    size.area.push_back(-area);
  size.reference = body.reference;
  return size;
}

template <int dim>
unsigned int GivenMesh<dim>::most_ranks() const
{
  constexpr unsigned int of_a_rank = 2000; // cells per rank that hide communication
  unsigned int most                = static_cast<unsigned int>(body.n_cells / of_a_rank);
  return std::max(1U, std::min(most, mesh->most_ranks()));
}

template <int dim>
void GivenMesh<dim>::write_contact(Hdf5File &file) const
{
  std::vector<double> position;
  for (const unsigned int point : body.contact.points)
    for (unsigned int d = 0; d < dim; ++d)
      position.push_back(mesh->point(point)[d]);
  write_dataset(file, "/contact/point", {body.contact.points.size()},
                body.contact.points);
  write_series(file, "/contact",
               {{"position", "m", &position, dim},
                {"area", dim == 2 ? "m" : "m^2", &known.size.area},
                {"height", "m", &body.contact.height}});
}

template <int dim>
std::vector<ProbePoint> GivenMesh<dim>::probe_places() const
{
  std::vector<ProbePoint> places;
  for (const MeshPlace &place : body.probes)
    {
      ProbePoint &point = places.emplace_back();
      point.name        = place.point.name;
      std::copy_n(place.point.position.begin(), dim, point.position.begin());
    }
  return places;
}

template <int dim>
void GivenMesh<dim>::make_elastic(const MPI_Comm communicator, const bool whole)
{
  // Contact and top are empty if the analysis does not need them.
  const bool has_contact = !body.contact.points.empty(),
             has_top     = !body.top.points.empty();
  of_statics             = mesh->make_elastic(
                parameters.mesh, has_contact ? parameters.mesh.contact_boundary : "",
    has_top ? parameters.mesh.top_boundary : "", phases, communicator, whole);
  of_statics->stand_on(this->foundation());
  if (body.contact.points.empty() || parameters.is_counter)
    return;
  order_contact(body, *of_statics);
  describe_contact();
}

template <int dim>
const ElasticBody<dim> &GivenMesh<dim>::elastic() const
{
  return *of_statics;
}

template <int dim>
DampingByPhase GivenMesh<dim>::make_damping(const StepParameters &step,
                                            const MPI_Comm communicator) const
{
  const auto damped = mesh->make_elastic(
    parameters.mesh, parameters.mesh.contact_boundary, parameters.mesh.top_boundary,
    phases_of_damping(phases, mesh->of_materials(step)), communicator, true);
  return {whole_stiffness(*damped, communicator), damped->lumped_mass()};
}

template <int dim>
DofMask GivenMesh<dim>::held(const TopSetup &top, const bool contact_held) const
{
  return held_by_mesh(body, top, contact_held, *of_statics);
}

template <int dim>
std::size_t GivenMesh<dim>::n_free(const TopSetup &top, const bool contact_held) const
{
  return n_free_on_mesh(mesh->mesh, body, top, contact_held);
}

template <int dim>
SupportNodes GivenMesh<dim>::top_nodes() const
{
  return nodes_of<dim>({body.top.points, body.top_nodes}, *of_statics);
}

template <int dim>
std::vector<SupportNodes> GivenMesh<dim>::side_nodes() const
{
  std::vector<SupportNodes> sides;
  for (const MeshSide &side : body.sides)
    sides.push_back(nodes_of(side, *of_statics));
  return sides;
}

template <int dim>
std::vector<NodeIndex> GivenMesh<dim>::contact_of_elastic() const
{
  std::vector<NodeIndex> nodes;
  for (const unsigned int point : body.contact.points)
    if (const auto node = of_statics->find(point))
      nodes.push_back(*node);
  return nodes;
}

template <int dim>
NodalField<double> GivenMesh<dim>::compressed(const double) const
{
  return of_statics->zero_field();
}

template <int dim>
std::vector<ContactCell> GivenMesh<dim>::contact_cells(const NodalField<double> &u) const
{
  return cells_at_contact(*mesh, parameters.mesh, *of_statics, u);
}

template <int dim>
std::vector<std::vector<double>> GivenMesh<dim>::contact_places() const
{
  std::vector<std::vector<double>> places(dim);
  for (const unsigned int point : body.contact.points)
    for (unsigned int c = 0; c < dim; ++c)
      places[c].push_back(mesh->point(point)[c]);
  return places;
}

template <int dim>
ContactParts GivenMesh<dim>::contact_parts() const
{
  ContactParts parts;
  for (const Phase<dim> &phase : known.phases)
    parts.names.push_back(phase.name);
  parts.shares = body.shares;
  return parts;
}

template <int dim>
Deformation GivenMesh<dim>::deformation(const NodalField<double> &u) const
{
  return mesh->deformation(*of_statics, u);
}

template <int dim>
Hdf5File GivenMesh<dim>::create_file(const std::string &path,
                                     const std::string &format) const
{
  return create_mesh_file(path, format, *mesh, body.digest, parameters.mesh.rve_digest);
}

template <int dim>
Shape GivenMesh<dim>::vectors_shape() const
{
  return mesh->vectors_shape();
}

template <int dim>
void GivenMesh<dim>::write_fields(
  std::optional<Hdf5File> &file,
  const std::string &path,
  const std::string &name,
  const std::vector<const NodalField<double> *> &fields) const
{
  // Replicated fields are written by rank 0.
  if (file || of_statics->communicator() != MPI_COMM_SELF)
    write_divided_fields(file, path, name, fields, *mesh, *of_statics);
}

template <int dim>
void GivenMesh<dim>::show(const std::string &path,
                          const std::vector<XdmfField> &fields,
                          const std::vector<double> &times) const
{
  mesh->show(path, fields, times);
}

template class GivenMesh<2>;
template class GivenMesh<3>;
} // namespace mesoslip
