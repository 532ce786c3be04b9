#include "sliding/given_grid.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "base/object_exchange.h"
#include "body/grid_body.h"
#include "dynamics/critical_time_step.h"
#include "eigenvalues/free_dofs.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"
#include "grid/row_partition.h"
#include "material/plausibility.h"
#include "observation/grid_probes.h"
#include "program/machine.h"
#include "program/run_context.h"
#include "sliding/run_plan.h"
#include "sliding/supports/side_platen.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Whether each rank does the whole analysis. */
bool is_repeated(const ContactParameters &parameters)
{
  return parameters.analysis != ContactAnalysis::transient &&
         parameters.static_solver != StaticSolverKind::ml;
}

BodyDescription make_body_on_root(const ContactParameters &parameters)
{
  BodyDescription body;
  const unsigned int n_copies = is_repeated(parameters) ? ranks_of_this_machine() : 1;
  on_root(MPI_COMM_WORLD, [&]() {
    body = make_body(parameters, n_copies);
    if (parameters.is_turned_over())
      turn_over(body);
  });
  broadcast_object(MPI_COMM_WORLD, body);
  return body;
}

void check_reference(const double x, const UniformGrid<2> &grid)
{
  if (!std::isnan(x) && !(x >= 0. && x <= grid.extent(0)))
    throw UserError("Observation/Reference x: " + to_text(x) +
                    " m lies outside the body, 0 to " + to_text(grid.extent(0)) + " m");
}

/** Checks that the rows of nodes can be divided among the ranks.
 * @throws UserError for too many ranks */
void check_ranks(const UniformGrid<2> &grid)
{
  const unsigned int n_rows  = grid.cells[1] + 1,
                     n_ranks = mpi::n_mpi_processes(MPI_COMM_WORLD),
                     most    = largest_number_of_ranks(n_rows);
  if (n_ranks > most)
    throw UserError(
      "the body has " + std::to_string(n_rows) +
      " rows of nodes (Body/Cells), which are divided among the processes, "
      "two at least each; start " +
      (most == 1 ? "it without mpirun" : "at most " + std::to_string(most) + " of them") +
      " instead of " + std::to_string(n_ranks));
}

/** The reference node, in the column nearest to Reference x or to the middle. */
ReferenceNode reference_node(const ContactParameters &parameters,
                             const BodyDescription &body)
{
  const UniformGrid<2> &grid = body.grid;
  const double wanted        = parameters.observation.reference_x;
  const double x             = std::isnan(wanted) ? 0.5 * grid.extent(0) : wanted;
  ReferenceNode node;
  node.number = std::lround(std::clamp(x, 0., grid.extent(0)) / grid.spacing[0]);
  if (parameters.periodic) // the last node is a copy
    node.number %= grid.cells[0];
  node.position = {{node.number * grid.spacing[0], 0., 0.}};
  // Phase as for a probe there: a point between two cells belongs to the upper one.
  node.phase =
    static_cast<unsigned int>(body.phase_of(std::min(node.number, grid.cells[0] - 1)));
  node.area = tributary_width(grid, node.number, parameters.periodic);
  return node;
}
} // namespace

GivenGrid::GivenGrid(const ContactParameters &given)
  : GivenGrid(given, make_body_on_root(given))
{
}

GivenGrid::GivenGrid(const ContactParameters &given, const BodyDescription &described)
  : GivenBody<2>(given)
  , body(described)
  , material(make_material(body, given.body.mean_dilatation, given.periodic))
{
  check_probes(parameters.observation.probes, body.grid, parameters.is_turned_over());
  check_reference(parameters.observation.reference_x, body.grid);
  require_frequency(material);
  if (parameters.analysis == ContactAnalysis::transient && !parameters.is_turned_over())
    check_ranks(body.grid);
  const double bytes = field_memory(parameters, body.grid);
  (is_repeated(parameters) ? known.memory.on_each : known.memory.divided) = bytes;
  // Rank 0 computes the largest frequency of the whole body.
  if (parameters.analysis == ContactAnalysis::transient)
    known.memory.on_rank_0 =
      bytes - known.memory.on_other_rank(mpi::n_mpi_processes(MPI_COMM_WORLD));
  known.n_points      = body.grid.n_nodes();
  known.heterogeneous = parameters.body.heterogeneous;
  known.phases        = body.phases;
  check_damping();
  known.volume_fractions = body.fractions(body.grid.n_cells());
  known.scales           = scales();
  known.lines            = lines();
  this->add_lines_on_cells();
  known.warnings   = warnings();
  known.rve_digest = body.rve_digest;
  known.place      = cell_text(body.grid);
  known.size       = size();
  for (unsigned int i = 0; i < material.n_columns(); ++i)
    known.contact_place[0].push_back(body.grid.origin[0] + i * body.grid.spacing[0]);
  if (parameters.is_counter || parameters.counter)
    known.contact_facets = facets();
  known.shortest_side = std::min(body.grid.extent(0), body.grid.extent(1));
  known.contents      = "Content of Body/RVE file = " + body.rve_content + "\n";
  known.probes        = parameters.observation.probes;
  for (ProbePoint &probe : known.probes)
    probe.position = place_of_probe(probe, body.grid);
  known.long_run   = 6e8;
  known.most_ranks = std::max(1U, body.grid.cells[1] / 40); // hides communication
}

/** Facets of the contact; on a periodic grid the last node is a copy of the first. */
std::vector<SurfaceFacet> GivenGrid::facets() const
{
  const unsigned int n         = body.grid.cells[0];
  const std::vector<double> &x = known.contact_place[0];
  std::vector<SurfaceFacet> facets;
  for (unsigned int i = 0; i < n; ++i)
    {
      const unsigned int next = parameters.periodic && i + 1 == n ? 0 : i + 1;
      facets.push_back({2, {{i, next}}, {{{{x[i], 0.}}, {{x[i + 1], 0.}}}}});
    }
  return facets;
}

std::vector<std::string> GivenGrid::lines() const
{
  const std::string &file = parameters.body.rve_file;
  std::string coefficients, names;
  for (const Phase<2> &phase : body.phases)
    {
      const std::string comma = names.empty() ? "" : ", ";
      names += comma + phase.name;
      coefficients += comma + phase.name + " " + to_text(phase.friction_coefficient);
    }
  const VoigtMatrix<2> &D       = body.phases[0].stiffness;
  std::vector<std::string> text = {
    "Body: " + size_text(body.grid),
    "Material: " +
      (parameters.body.heterogeneous
         ? "heterogeneous, the phases " + names
         : brief_text(4, "homogeneous, D11, D12, D22, D33 = ", 1e-9 * D(0, 0), ", ",
                      1e-9 * D(0, 1), ", ", 1e-9 * D(1, 1), ", ", 1e-9 * D(2, 2),
                      " GPa, ", body.phases[0].density, " kg/m^3")) +
      (file.empty() ? ", from Body/Stiffness and Density (no RVE file)" : " of " + file)};
  if (mpi::n_mpi_processes(MPI_COMM_WORLD) > 1 && is_repeated(parameters))
    text.emplace_back(
      "This analysis runs on one process, all others repeat it; start it without mpirun "
      "or set Performance/Static solver = ml");
  if (parameters.friction.coefficient_by_phase)
    text.push_back("Friction coefficients of the phases: " + coefficients);
  return text;
}

std::vector<std::string> GivenGrid::warnings() const
{
  const std::string &file = parameters.body.rve_file, &section = parameters.body.section;
  const std::string size             = file.empty() || parameters.body.size[0] > 0.
                                         ? section + "/Size"
                                         : "the size in " + file;
  const FrictionParameters &friction = parameters.friction;
  std::vector<PlausibleRange> ranges = {
    plausible_length(size + " along x", body.grid.extent(0)),
    plausible_length(size + " along y", body.grid.extent(1))};
  for (const Phase<2> &phase : body.phases)
    {
      const std::string of_phase = " of phase '" + phase.name + "'";
      ranges.push_back(plausible_density(
        file.empty() ? section + "/Density" : "the density" + of_phase, phase.density));
      if (friction.coefficient_by_phase)
        ranges.push_back(plausible_friction("the friction coefficient" + of_phase,
                                            phase.friction_coefficient));
    }
  std::vector<std::string> found = body.warnings;
  add_implausible(found, ranges, known.scales);
  return found;
}

/** Least mass per area of a side (kg/m^2) that a platen moves, for nodes of this
 * density. */
double GivenGrid::mass_for_area(const SideSupport &platen, const double density) const
{
  const auto &h         = body.grid.spacing;
  const double of_nodes = 0.5 * density * h[0] * h[1] * (body.grid.cells[1] - 1);
  return (of_nodes + platen.platen_mass) / body.grid.extent(1);
}

BodyScales GivenGrid::scales() const
{
  BodyScales found(material);
  if (parameters.analysis != ContactAnalysis::transient)
    return found;
  // Computed on rank 0, so that the other ranks do not need its fields.
  double frequency = 0.;
  on_root(MPI_COMM_WORLD, [&]() { frequency = largest_frequency(material).upper; });
  broadcast_object(MPI_COMM_WORLD, frequency);
  const double lightest =
    std::min_element(material.phases().begin(), material.phases().end(),
                     [](const ElasticPhase<2> &a, const ElasticPhase<2> &b) {
                       return a.density < b.density;
                     })
      ->density;
  const auto of_springs = [&](const Suspension &suspension, const unsigned int axis) {
    return suspension.squared_frequency(0.5 * lightest * body.grid.spacing[axis]);
  };
  double of_sides = 0.;
  for (const SideSupport &side : parameters.loaded_sides())
    of_sides = std::max(of_sides, side.is_platen ? side.suspension.squared_frequency(
                                                     mass_for_area(side, lightest))
                                                 : of_springs(side.suspension, 0));
  // The largest frequency of a sum is at most the sum; a corner has the springs of top
  // and side.
  found.highest_frequency =
    std::hypot(frequency, std::sqrt(of_springs(parameters.top.suspension, 1) + of_sides));
  return found;
}

BodySize GivenGrid::size() const
{
  const UniformGrid<2> &grid = body.grid;
  BodySize size;
  size.top_area = grid.extent(0);
  for (const SideSupport &side : parameters.loaded_sides())
    {
      const SideNodes column = column_of(side);
      size.side_area.push_back(column.whole_area());
      size.side_push.push_back(column.whole_push());
      size.side_moves.push_back(side.is_platen ? moves_of_platen(side, 0, 2)
                                               : std::array<bool, 3>{});
    }
  size.n_cells  = grid.n_cells();
  size.crossing = known.scales.crossing();
  size.mass     = known.scales.mass;
  size.friction = body.node_friction;
  for (unsigned int i = 0; i <= grid.cells[0]; ++i)
    size.area.push_back(tributary_width(grid, i, parameters.periodic));
  size.n_contact_nodes = grid.cells[0] + (parameters.periodic ? 0 : 1);
  size.reference       = reference_node(parameters, body);
  return size;
}

/** Adds the nodes of the supports of this body. */
SlidingSetup GivenGrid::with_sides(SlidingSetup setup) const
{
  setup.top.nodes = top_nodes().carried;
  for (const SideSupport &side : parameters.loaded_sides())
    setup.loaded.push_back(
      {side, column_of(side), {}, {}, known.size.side_moves[setup.loaded.size()]});
  return setup;
}

BodyInMotion<2> GivenGrid::start(const SlidingSetup &given,
                                 RunContext &context,
                                 CounterMotion<2> *counter) const
{
  const std::vector<ProbePoint> &probes = parameters.observation.probes;
  const SlidingSetup setup              = with_sides(given);
  auto sliding                          = std::make_unique<SlidingGrid>(
    material, setup, context.communicator(), nullptr,
    context.options().profile ? &context.timer() : nullptr, counter);
  sliding->set_initial_velocity(parameters.body.initial_velocity);
  BodyInMotion<2> motion;
  if (!probes.empty())
    motion.probes = std::make_unique<GridProbes>(
      probes, material, sliding->stepper, &sliding->contact, false, setup.probe_interval);
  motion.displacement = [&moving = *sliding]() {
    const NodeRows &rows = moving.rows;
    return FieldRows{rows.begin,
                     interleaved(moving.u, rows.local(rows.begin), rows.local(rows.end))};
  };
  motion.body = std::move(sliding);
  return motion;
}

void GivenGrid::write_contact(Hdf5File &file) const
{
  const std::vector<double> x = contact_places()[0];
  std::vector<double> area    = known.size.area;
  // A periodic node is written twice, with half of its area each.
  if (parameters.periodic)
    for (double *end : {&area.front(), &area.back()})
      *end *= 0.5;
  write_series(file, "/contact", {{"x", "m", &x}, {"area", "m", &area}});
}

Hdf5File GivenGrid::create_file(const std::string &path, const std::string &format) const
{
  return create_grid_file(path, described(), format);
}

Shape GivenGrid::vectors_shape() const
{
  return nodes_shape(body.grid);
}

void GivenGrid::write_fields(std::optional<Hdf5File> &file,
                             const std::string & /*path*/,
                             const std::string &name,
                             const std::vector<const NodalField<double> *> &fields) const
{
  if (!file)
    return;
  std::vector<double> values;
  for (const NodalField<double> *field : fields)
    {
      const std::vector<double> one = interleaved(*field);
      values.insert(values.end(), one.begin(), one.end());
    }
  Shape shape = vectors_shape();
  shape.insert(shape.begin(), fields.size());
  write_dataset(*file, name, shape, values);
}

void GivenGrid::show(const std::string &path,
                     const std::vector<XdmfField> &fields,
                     const std::vector<double> &times) const
{
  show_grid(path, described().grid, !body.phase_id.empty(), fields, times);
}
} // namespace mesoslip
