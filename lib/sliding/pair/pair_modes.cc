#include "sliding/pair/pair_modes.h"

#include "eigenvalues/complex/contact_motion.h"
#include "eigenvalues/complex/still_vibrations.h"

#include <cmath>

namespace mesoslip
{
namespace
{
/** The contact nodes that no support holds along the normal. */
template <int dim>
SlidingNodesAtRest touching_nodes(const PairBody<dim> &pair, const DofMask &held)
{
  SlidingNodesAtRest contact;
  const std::vector<NodeIndex> &nodes = pair.surface(ElasticBody<dim>::bottom).nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (!held.is_constrained(dim - 1, nodes[k]))
      {
        contact.nodes.push_back(nodes[k]);
        contact.meets.push_back(pair.meets(k));
      }
  return contact;
}
} // namespace

template <int dim>
VibrationModes<dim> pair_modes(const PairBody<dim> &pair,
                               const DofMask &held,
                               const bool touching,
                               const double wave_speed,
                               const VibrationModesOptions &options)
{
  const FreeDofs<dim> dofs(pair, held, options.platens);
  const ContactMotion<dim> motion = make_contact_motion<dim>(
    pair, dofs, touching ? touching_nodes(pair, held) : SlidingNodesAtRest());
  const RealMatrix mass_of_free(masses_of(dofs).asDiagonal());
  SlidingPencil still;
  still.mass = motion.of_free(mass_of_free);
  still.stiffness =
    motion.among_unknowns(whole_stiffness<dim>(pair, MPI_COMM_SELF) +
                          whole_matrix<dim>(pair, pair.foundation().springs));
  check_number_of_modes(static_cast<std::size_t>(still.size()), options);

  const LowestVibrations lowest =
    lowest_vibrations(still, static_cast<int>(options.n_modes),
                      std::pow(wave_speed / pair.extent(dim - 1), 2), options.tolerance,
                      options.before_solve);
  VibrationModes<dim> result;
  result.n_rigid_motions = lowest.n_rigid;
  result.n_solves        = lowest.n_solves;
  for (std::size_t k = 0; k < lowest.squares.size(); ++k)
    {
      const Eigen::VectorXd &x  = lowest.shapes[k];
      const Eigen::VectorXd all = motion.free * x, momentum = mass_of_free * all,
                            elastic        = still.stiffness * x;
      typename FreeDofs<dim>::Vector shape = dofs.zero(), moved = dofs.zero();
      std::copy(all.begin(), all.end(), shape.begin());
      std::copy(momentum.begin(), momentum.end(), moved.begin());
      VibrationMode<dim> &mode =
        result.modes.emplace_back(make_mode(shape, moved, dofs, pair));
      mode.frequency = std::sqrt(lowest.squares[k]) / (2. * M_PI);
      mode.residual =
        (elastic - lowest.squares[k] * (still.mass * x)).norm() / elastic.norm();
    }
  return result;
}

template VibrationModes<2> pair_modes(const PairBody<2> &,
                                      const DofMask &,
                                      const bool,
                                      const double,
                                      const VibrationModesOptions &);
template VibrationModes<3> pair_modes(const PairBody<3> &,
                                      const DofMask &,
                                      const bool,
                                      const double,
                                      const VibrationModesOptions &);
} // namespace mesoslip
