#include "sliding/pair/given_pair.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "body/rigid_motions.h"
#include "eigenvalues/complex/sliding_pencil.h"
#include "program/run_context.h"
#include "sliding/complex/complex_cases.h"
#include "sliding/counter/counter_text.h"
#include "sliding/counter/partners.h"
#include "sliding/mesh/box_body.h"
#include "sliding/pair/grid_mesh.h"
#include "sliding/pair/pair_modes.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace mesoslip
{
namespace
{
/** In pairs, grids are treated as meshes. */
template <int dim>
std::unique_ptr<GivenMesh<dim>> mesh_of(const ContactParameters &parameters)
{
  std::unique_ptr<BodyMesh<dim>> mesh;
  if (parameters.mesh.is_given())
    mesh = std::make_unique<BodyMesh<dim>>();
  else if constexpr (dim == 2)
    mesh = std::make_unique<GridMesh>();
  else
    mesh = std::make_unique<BoxBody>();
  return std::make_unique<GivenMesh<dim>>(parameters, std::move(mesh));
}

/** Appends the nodes of a mask. */
void append(DofMask &all, const DofMask &part, const unsigned int first)
{
  for (unsigned int i = 0; i < part.n_columns(); ++i)
    for (unsigned int c = 0; c < 3; ++c)
      if (part.is_constrained(c, {i, 0}))
        all.constrain(c, {first + i, 0});
}

/** Damping constants of the phases of both bodies, unless all are equal. */
template <int dim>
ContactParameters with_damping_of(ContactParameters parameters,
                                  const GivenBody<dim> &above,
                                  const GivenBody<dim> &below)
{
  const StepParameters &own = above.parameters.step, &other = below.parameters.step;
  StepParameters &both = parameters.step;
  if (!own.damps_by_phase() && !other.damps_by_phase() && own.beta == other.beta &&
      own.alpha == other.alpha)
    return parameters;
  const auto append = [](std::vector<double> &all, const std::vector<double> &of_phases,
                         const double common, const std::size_t n_phases) {
    if (of_phases.empty())
      all.insert(all.end(), n_phases, common);
    else
      all.insert(all.end(), of_phases.begin(), of_phases.end());
  };
  both.beta_of_phases.clear();
  both.alpha_of_phases.clear();
  for (const GivenBody<dim> *body : {&above, &below})
    {
      const StepParameters &step = body->parameters.step;
      const std::size_t n        = body->facts().phases.size();
      append(both.beta_of_phases, step.beta_of_phases, step.beta, n);
      append(both.alpha_of_phases, step.alpha_of_phases, step.alpha, n);
    }
  both.beta  = std::max(own.beta, other.beta);
  both.alpha = std::max(own.alpha, other.alpha);
  return parameters;
}

/** Bytes of sparse factors; static contact needs about half as many as complex modes. */
template <int dim>
double bytes_of_factors(const ContactAnalysis analysis, const std::uint64_t n_points)
{
  return (analysis == ContactAnalysis::static_contact ? 0.5 : 1.) *
         complex_modes_memory(static_cast<double>(dim * n_points), dim);
}

void take_larger(CellExtreme &extreme, const CellExtreme &other)
{
  if (!(extreme.value >= other.value))
    extreme = other;
}
} // namespace

template <int dim>
GivenPair<dim>::GivenPair(const ContactParameters &given)
  : GivenPair(given, mesh_of<dim>(given), mesh_of<dim>(*given.counter))
{
}

template <int dim>
GivenPair<dim>::GivenPair(const ContactParameters &given,
                          std::unique_ptr<GivenMesh<dim>> upper,
                          std::unique_ptr<GivenMesh<dim>> lower)
  : GivenBody<dim>(with_damping_of<dim>(given, *upper, *lower))
  , above(std::move(upper))
  , below(std::move(lower))
{
  known = above->facts();
  for (const std::string &line : below->told())
    known.lines.push_back(text_of_counter(line));
  for (const std::string &warning : below->facts().warnings)
    known.warnings.push_back(text_of_counter(warning));
  if (mpi::n_mpi_processes(MPI_COMM_WORLD) > 1 &&
      parameters.analysis == ContactAnalysis::static_contact)
    known.lines.emplace_back(
      "Static contact with a counter body runs on one process, all "
      "others repeat it; start it without mpirun");
  known.n_points += below->facts().n_points;
  known.memory.on_rank_0 += below->facts().memory.on_rank_0;
  known.memory.on_each = bytes_of_factors<dim>(parameters.analysis, known.n_points);
  add_size_below();
  known.lines.push_back(text_of(meeting_of<dim>(*above, *below)));
}

/** Adds cells and loaded sides of the lower body. */
template <int dim>
void GivenPair<dim>::add_size_below()
{
  const BodySize &other = below->facts().size;
  known.size.n_cells += other.n_cells;
  const auto append = [](auto &all, const auto &values) {
    all.insert(all.end(), values.begin(), values.end());
  };
  append(known.size.side_area, other.side_area);
  append(known.size.side_push, other.side_push);
  append(known.size.side_moves, other.side_moves);
}

/** Whether supports of the lower body leave a rigid motion free; platens hold their nodes
 * together, and along their motion by springs only. */
template <int dim>
bool GivenPair<dim>::floats_below() const
{
  DofMask held = below->held({}, false);
  std::vector<NodesAsOne> as_one;
  for (const Platen &platen : below->platens(below->parameters.top))
    for (unsigned int c = 0; c < dim; ++c)
      if (platen.moves[c])
        {
          as_one.push_back({c, platen.nodes});
          for (const NodeIndex &node : platen.nodes)
            held.release(c, node);
        }
  return can_move(below->elastic(), held, below->elastic().foundation().springs, as_one);
}

template <int dim>
BodyInMotion<dim>
GivenPair<dim>::start(const SlidingSetup &, RunContext &, CounterMotion<dim> *) const
{
  throw std::logic_error("bodies of a pair move one by one");
}

template <int dim>
CounterMotion<dim> GivenPair<dim>::start_below(const SlidingSetup &, RunContext &) const
{
  throw std::logic_error("bodies of a pair move one by one");
}

template <int dim>
void GivenPair<dim>::write_contact(Hdf5File &file) const
{
  above->write_contact(file);
}

template <int dim>
MeetingNodes GivenPair<dim>::meeting() const
{
  return {below->contact_of_elastic(), meeting_of<dim>(*above, *below).weights};
}

template <int dim>
void GivenPair<dim>::make_elastic(const MPI_Comm communicator, const bool /*whole*/)
{
  above->make_elastic(communicator, true);
  below->make_elastic(communicator, true);
  known.size = above->facts().size;
  add_size_below();
  known.contact_height = above->facts().contact_height;
  known.contact_place  = above->facts().contact_place;
  known.contact_points = above->facts().contact_points;
  if (floats_below())
    throw UserError("Counter body/Supports: nothing holds the counter body against all "
                    "forces, so that it would move as a whole; set Counter "
                    "body/Supports/Bottom/Kind = held or springs");
  using Motion                              = typename PairBody<dim>::Motion;
  const std::array<RealMatrix, 2> stiffness = {
    {whole_stiffness<dim>(above->points(), communicator),
     whole_stiffness<dim>(below->points(), communicator)}};
  const auto pair = [&](const Motion motion) {
    return std::make_unique<PairBody<dim>>(above->points(), below->points(), meeting(),
                                           stiffness, motion);
  };
  at_rest = pair(Motion::relative);
  if (parameters.analysis != ContactAnalysis::static_contact)
    moving = pair(Motion::absolute);
}

template <int dim>
const ElasticBody<dim> &GivenPair<dim>::elastic() const
{
  return *at_rest;
}

template <int dim>
const ElasticBody<dim> &GivenPair<dim>::vibrating() const
{
  return *moving;
}

template <int dim>
VibrationModes<dim> GivenPair<dim>::modes(const TopSetup &top,
                                          const bool contact_held,
                                          const VibrationModesOptions &options) const
{
  return pair_modes<dim>(*moving, held(top, false), contact_held, known.scales.wave_speed,
                         options);
}

namespace
{
/** A common alpha also acts on masses of supports. */
template <int dim>
DampingByPhase damping_of(const GivenMesh<dim> &body,
                          const StepParameters &step,
                          const MPI_Comm communicator)
{
  DampingByPhase damping    = body.make_damping(step, communicator);
  const StepParameters &own = body.parameters.step;
  if (!own.alpha_of_phases.empty())
    return damping;
  damping.drags = body.points().lumped_mass();
  for (double &drag : damping.drags)
    drag *= own.alpha;
  return damping;
}
} // namespace

template <int dim>
DampingByPhase GivenPair<dim>::make_damping(const StepParameters &step,
                                            const MPI_Comm communicator) const
{
  const auto n = static_cast<std::ptrdiff_t>(above->facts().phases.size());
  std::array<StepParameters, 2> of_bodies = {{step, step}};
  for (auto values : {&StepParameters::beta_of_phases, &StepParameters::alpha_of_phases})
    {
      const std::vector<double> &all = step.*values;
      (of_bodies[0].*values).assign(all.begin(), all.begin() + n);
      (of_bodies[1].*values).assign(all.begin() + n, all.end());
    }
  const DampingByPhase own   = damping_of(*above, of_bodies[0], communicator),
                       other = damping_of(*below, of_bodies[1], communicator);
  DampingByPhase both{blocks_of({{own.stiffness, other.stiffness}}), own.drags};
  both.drags.insert(both.drags.end(), other.drags.begin(), other.drags.end());
  return both;
}

template <int dim>
DofMask GivenPair<dim>::held(const TopSetup &top, const bool contact_held) const
{
  const DofMask own = above->held(top, contact_held), other = below->held({}, false);
  DofMask both(own.n_columns() + other.n_columns(), 1);
  append(both, own, 0);
  append(both, other, own.n_columns());
  return both;
}

template <int dim>
std::size_t GivenPair<dim>::n_free(const TopSetup &top, const bool contact_held) const
{
  return above->n_free(top, contact_held) + below->n_free({}, false);
}

template <int dim>
SupportNodes GivenPair<dim>::top_nodes() const
{
  return above->top_nodes();
}

template <int dim>
std::vector<SideSupport> GivenPair<dim>::loaded_sides() const
{
  std::vector<SideSupport> all = above->parameters.loaded_sides();
  for (const SideSupport &side : below->parameters.loaded_sides())
    all.push_back(side);
  return all;
}

template <int dim>
std::vector<SupportNodes> GivenPair<dim>::side_nodes() const
{
  std::vector<SupportNodes> all = above->side_nodes();
  for (SupportNodes side : below->side_nodes())
    {
      for (NodeIndex &node : side.nodes)
        node = at_rest->below_node(node);
      all.push_back(side);
    }
  return all;
}

template <int dim>
NodalField<double> GivenPair<dim>::compressed(const double) const
{
  return at_rest->zero_field();
}

template <int dim>
std::vector<ContactCell> GivenPair<dim>::contact_cells(const NodalField<double> &u) const
{
  return above->contact_cells(at_rest->parts(u)[0]);
}

template <int dim>
std::vector<std::vector<double>> GivenPair<dim>::contact_places() const
{
  return above->contact_places();
}

template <int dim>
ContactParts GivenPair<dim>::contact_parts() const
{
  return above->contact_parts();
}

template <int dim>
Deformation GivenPair<dim>::deformation(const NodalField<double> &u) const
{
  const auto parts        = at_rest->parts(u);
  Deformation all         = above->deformation(parts[0]);
  const Deformation other = below->deformation(parts[1]);
  take_larger(all.strain, other.strain);
  take_larger(all.rotation, other.rotation);
  if (!(all.jacobian.value <= other.jacobian.value))
    all.jacobian = other.jacobian;
  return all;
}

template class GivenPair<2>;
template class GivenPair<3>;
} // namespace mesoslip
