#ifndef mesoslip_contact_incremental_friction_h
#define mesoslip_contact_incremental_friction_h

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace mesoslip
{
/**
 * Coulomb friction of contact nodes on a flat at rest, for one load increment: it opposes
 * the tangential displacement from the sticking position.
 */
template <int dim>
class IncrementalFriction
{
public:
  static constexpr unsigned int n_tangents = dim - 1; ///< number of tangential components
  using Direction = std::array<double, n_tangents>;   ///< vector along the flat

  /**
   * Friction of @p n_nodes nodes. @p reference: displacement (m) at which each node
   * sticks, components together; empty: zero. @p stiffness: tangential springs (N/m, in
   * 2D Pa); empty: none. @p scale relates displacements to forces, see stiffness_scale().
   * @p initial: initial direction of all nodes.
   */
  IncrementalFriction(const std::vector<double> &reference,
                      const std::vector<double> &stiffness,
                      const std::size_t n_nodes,
                      const double scale,
                      const Direction &initial)
    : force(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n_nodes) * n_tangents))
    , direction(n_nodes, initial)
    , reference(reference)
    , stiffness(stiffness)
    , scale(scale)
  {
  }

  /** Index of component @p c of node @p i. */
  static Eigen::Index index(const unsigned int i, const unsigned int c)
  {
    return static_cast<Eigen::Index>(i) * n_tangents + c;
  }

  /** Component @p c of the displacement (m) at which node @p i sticks. */
  double sticks_at(const unsigned int i, const unsigned int c) const
  {
    return reference.empty() ? 0. : reference[index(i, c)];
  }

  /** Tangential compliance of node @p i before it slips (m/N, in 2D m^2/N). */
  double softness(const unsigned int i) const
  {
    return stiffness.empty() ? 0. : 1. / stiffness[i];
  }

  /**
   * Component @p c of the slip of node @p i (m), without the stretch of its spring; @p u:
   * dim displacement components of each contact node.
   */
  double
  slip(const std::vector<double> &u, const unsigned int i, const unsigned int c) const
  {
    return u[dim * i + c] - sticks_at(i, c) + softness(i) * force[index(i, c)];
  }

  /** Whether @p now is opposed to @p before. */
  static bool reversed(const Direction &before, const Direction &now)
  {
    return now != before &&
           !(std::inner_product(now.begin(), now.end(), before.begin(), 0.) > 0.);
  }

  /** Norm of the trial friction force of node @p i (N). @p u: see slip(). */
  double size_of_trial(const std::vector<double> &u, const unsigned int i) const
  {
    double squares = 0.;
    for (unsigned int c = 0; c < n_tangents; ++c)
      squares += trial(u, i, c) * trial(u, i, c);
    return std::sqrt(squares);
  }

  /** Squared norm of the slip() of node @p i (m^2). */
  double squared_slip(const std::vector<double> &u, const unsigned int i) const
  {
    double squares = 0.;
    for (unsigned int c = 0; c < n_tangents; ++c)
      squares += std::pow(slip(u, i, c), 2);
    return squares;
  }

  /** Turns the friction of node @p i against its displacement; see slip(). */
  void turn(const std::vector<double> &u, const unsigned int i)
  {
    const double size = size_of_trial(u, i);
    for (unsigned int c = 0; c < n_tangents && size > 0.; ++c)
      direction[i][c] = trial(u, i, c) / size;
  }

  /**
   * Whether node @p i moves in the direction of its friction, which is at most @p limit
   * (N).
   */
  bool
  is_pushed(const std::vector<double> &u, const unsigned int i, const double limit) const
  {
    double friction_squares = 0., along = 0.;
    for (unsigned int c = 0; c < n_tangents; ++c)
      {
        const double f = force[index(i, c)];
        friction_squares += f * f;
        along += f * slip(u, i, c);
      }
    // With little friction, as just after landing, motion is dominated by round-off.
    const double friction = std::sqrt(friction_squares);
    return along > 0. && friction > 1e-3 * limit && friction <= (1. + 1e-6) * limit;
  }

  Eigen::VectorXd force;            ///< friction on the body (N, in 2D N/m), see index()
  std::vector<Direction> direction; ///< direction of friction at slipping nodes

private:
  double
  trial(const std::vector<double> &u, const unsigned int i, const unsigned int c) const
  {
    return force[index(i, c)] - scale * slip(u, i, c);
  }

  const std::vector<double> &reference, &stiffness;
  const double scale;
};
} // namespace mesoslip

#endif
