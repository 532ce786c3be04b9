#ifndef mesoslip_contact_pair_paired_contact_h
#define mesoslip_contact_pair_paired_contact_h

#include "contact/contact_surface.h"
#include "contact/pair/moving_weights.h"
#include "contact/pair/surface_values.h"
#include "contact/pair/surface_weights.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace mesoslip
{
/** Contact side of a second body, advanced by PairedContact. */
template <int dim>
struct PartnerSurface : SurfaceCondition<dim>
{
  NodesOfContact nodes; ///< nodes numbered in the contact of this body

  /**
   * 1, or -1 for a body computed upside down: its own normal points away from the first
   * body.
   */
  double normal = 1.;

  /** Called to advance the nodes. */
  std::function<void(const SurfaceView<dim> &)> meet;

  /** Advances the nodes by one step, within a step of the first body. */
  void advance(const SurfaceView<dim> &surface) override
  {
    meet(surface);
  }
};

/** Coupling of the nodes of a contact to a second body. */
struct SurfaceMeeting
{
  SurfaceWeights weights; ///< weights at the start

  /**
   * Computes the weights while the second body slides; null: small displacements,
   * constant weights.
   */
  std::shared_ptr<const MovingWeights> sliding;

  /**
   * Whether forces affect neighbouring nodes, or the surface below rises and falls under
   * the nodes.
   */
  bool couples() const
  {
    return sliding || !weights.are_partners();
  }
};

/** Statistics of the iteration for coupled forces. */
struct PairSettling
{
  std::uint64_t trials    = 0;  ///< trials in all steps
  std::uint64_t unsettled = 0;  ///< steps in which friction did not converge
  double change           = 0.; ///< largest relative change in these steps
};

/** Initial motion along the normal of the contact nodes of a rank. */
struct NormalStart
{
  std::vector<double> inverse_inertia; ///< 1/kg, in 2D m/kg; 0: constrained
  std::vector<double> acceleration;    ///< acceleration without contact (m/s^2)
  double velocity = 0.;                ///< normal velocity of the whole body (m/s)
};

/**
 * Contact of two bodies. The contact law sees the motion of the nodes of the first body
 * relative to the second body below them, W u_2 with SurfaceWeights W. Both bodies yield:
 * contact forces f accelerate the nodes against each other by
 *
 *     G f,   G = M_1^-1 + W M_2^-1 W^T,
 *
 * so that the forward-increment Lagrange multipliers of the rigid flat apply to the pair
 * with this compliance. If each node has one partner, G is diagonal. Otherwise the forces
 * of neighbours are found by iteration: each node responds to the forces of the other
 * nodes as if its own compliance were
 *
 *     d_i = 1/m_i + r_i / 2,   r_i = sum over j of |W_ij| (sum over k of |W_kj|) / m_j,
 *
 * until nothing changes. As 1/m_i and 1/m_i + r_i enclose all of G, the error on nodes
 * that touch and slide, or stick, shrinks at least by r_i / (2 d_i) per iteration, and
 * faster with Chebyshev acceleration (Golub and Varga 1961).
 *
 * The velocity of the flat is the velocity of the second body along the first one. If the
 * second body slides by more than its cells, the weights follow its displacement; its
 * surface then rises and falls under the nodes, and its drive does the corresponding
 * work.
 *
 * Nodes may be on different ranks, which exchange the values of both contacts in each
 * step.
 */
template <int dim>
class PairedContact : public SurfaceCondition<dim>
{
public:
  /**
   * @p contact has the @p nodes of the first body, coupled by @p given to the nodes of
   * @p partner. @p advance_partner makes one step of the second body. Contact and partner
   * must outlive this object. Collective over the @p communicator of the ranks that have
   * contact nodes.
   */
  PairedContact(ContactSurface<dim> &contact,
                const NodesOfContact &nodes,
                PartnerSurface<dim> &partner,
                const SurfaceMeeting &given,
                const std::function<void()> &advance_partner,
                const StepParameters &step,
                const MPI_Comm communicator);

  PairedContact(const PairedContact &)            = delete; ///< partner refers to it
  PairedContact &operator=(const PairedContact &) = delete; ///< see the constructor

  /** Advances the nodes and the second body by one step. Collective. */
  void advance(const SurfaceView<dim> &surface) override;

  /**
   * Gives nodes that press on the second body initially the same acceleration as the
   * surface below. Collective.
   */
  void start_as_one(NormalStart &own, NormalStart &other);

  /** Statistics since the start. */
  const PairSettling &settling() const
  {
    return settled;
  }

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &way[0] & way[1] & moved_before &last;
    archive &settled.trials &settled.unsettled &settled.change;
    if (meeting.sliding)
      set_weights(meeting.sliding->at(way));
  }

private:
  /** Values per component that the second body provides. */
  enum Row : unsigned int
  {
    displacement,  ///< m
    velocity,      ///< velocity of the scheme (m/s)
    braking,       ///< minus acceleration without contact (m/s^2)
    one_over_mass, ///< 1/kg, in 2D m/kg
    increment,     ///< increment of the previous step (m)
    n_rows
  };
  using Forces = std::vector<double>; ///< forces on all contact nodes, node after node

  void meet(const SurfaceView<dim> &below);
  void set_weights(SurfaceWeights weights);
  double yielding(const double *inverse_below, const std::size_t k) const;
  void share_partner(const SurfaceView<dim> &below);
  void slide();
  void take_relative();
  void settle(const SurfaceView<dim> &relative);
  void press_with(const Forces &guess);
  void
  share_trial(const SurfaceView<dim> &relative, const Forces &guess, const bool first);
  double largest_of(const unsigned int row) const;
  void share_forces();
  void take_shared_forces();
  void move(const SurfaceView<dim> &surface,
            const NodesOfContact &of_surface,
            const unsigned int c,
            const Forces &f,
            const double sign) const;
  double sign(const unsigned int c) const;
  std::vector<double> common_forces(const SurfaceValues &own,
                                    const double *inverse_below) const;

  ContactSurface<dim> &contact;
  const NodesOfContact nodes;
  PartnerSurface<dim> &partner;
  SurfaceMeeting meeting;
  const std::function<void()> advance_partner;
  const StepParameters step;
  const SurfaceView<dim> *above = nullptr; ///< surface in the current step
  SurfaceValues of_partner;                ///< values of the second body, see Row
  SurfaceValues forces; ///< on the first body (N, in 2D N/m), then rows of the trial

  std::vector<double>
    share;      ///< for each node below, half of the sum of |W_kj| over k; 1 for partners
  Forces taken; ///< forces on the nodes below, W^T f (N, in 2D N/m)
  Forces last;  ///< forces of the last step (N, in 2D N/m)
  std::array<double, 2> way = {}; ///< displacement of the second body since the start (m)
  std::vector<double>
    moved_before; ///< last increments of the nodes of the second body on this rank (m)
  PairSettling settled;
  std::vector<double> acceleration; ///< work array of a step

  /**
   * Relative motion, one column per node: displacement (m), velocity of the scheme (m/s),
   * force without contact (N, in 2D N/m), inverse inertia (1/kg, in 2D m/kg), inertia (0:
   * constrained) and minus the acceleration without contact (m/s^2); and trial forces
   * with work arrays of settle().
   */
  NodalField<double> u, w, force, inverse_mass, mass, apart, trial;
};
} // namespace mesoslip

#endif
