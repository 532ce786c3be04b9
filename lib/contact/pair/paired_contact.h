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
/** The contact of a second body, whose nodes PairedContact moves. */
template <int dim>
struct PartnerSurface : SurfaceCondition<dim>
{
  NodesOfContact nodes; ///< with their numbers in the contact of this body

  /** 1, or -1 for a body that is computed upside down: its own normal points away from the first one. */
  double normal = 1.;

  /** What moves the nodes. */
  std::function<void(const SurfaceView<dim> &)> meet;

  /** One step, within one of the first body. */
  void advance(const SurfaceView<dim> &surface) override
  {
    meet(surface);
  }
};

/** What the nodes of a contact meet of a second body. */
struct SurfaceMeeting
{
  SurfaceWeights weights; ///< at the start

  /** What makes the weights as the second body slides on; null: displacements are small, and weights stay. */
  std::shared_ptr<const MovingWeights> sliding;

  /** Whether forces on a node reach others, or the surface below rises and falls under it. */
  bool couples() const
  {
    return sliding || !weights.are_partners();
  }
};

/** How forces of neighbours were found together. */
struct PairSettling
{
  std::uint64_t trials    = 0;  ///< of all steps
  std::uint64_t unsettled = 0;  ///< steps in which friction went on changing
  double change           = 0.; ///< in these, of the largest force, at most
};

/** How the nodes of a contact that a rank has start along the normal. */
struct NormalStart
{
  std::vector<double> inverse_inertia; ///< 1/kg, in 2D m/kg; 0: held
  std::vector<double> acceleration;    ///< without contact (m/s^2)
  double velocity = 0.;                ///< of the whole body along the normal (m/s)
};

/**
 * Two bodies that meet: the contact sees the motion of the nodes of the first one relative to what is below them of the second one,
 * W u_2 with SurfaceWeights W, whose nodes yield as well. Contact forces f accelerate them against each other by
 *
 *     G f,   G = M_1^-1 + W M_2^-1 W^T,
 *
 * so that the forward-increment Lagrange multipliers of the rigid flat are those of the pair with this compliance. Where each node has
 * one partner, G is diagonal. Else forces of neighbours are found together: each node answers the forces of the others as if its own
 * compliance were
 *
 *     d_i = 1/m_i + r_i / 2,   r_i = sum over j of |W_ij| (sum over k of |W_kj|) / m_j,
 *
 * again and again until nothing changes. As 1/m_i and 1/m_i + r_i enclose all of G, what is left shrinks on nodes that touch and slide,
 * or stick, at least by r_i / (2 d_i) each time, with Chebyshev's acceleration faster (Golub and Varga 1961).
 *
 * The velocity of the flat is that of the second body along the first one. While that body slides on by more than its cells, weights
 * follow its way; its surface then rises and falls under the nodes, and what drives it does the work of that.
 *
 * Nodes may be on different ranks, which tell each other those of both contacts in each step.
 */
template <int dim>
class PairedContact : public SurfaceCondition<dim>
{
public:
  /** @p contact is of the @p nodes of the first body, which have the meeting @p given with those of @p partner, of whose body @p advance_partner
   * makes one step. Both must outlive this. Collective over the @p communicator of ranks that have them. */
  PairedContact(ContactSurface<dim> &contact,
                const NodesOfContact &nodes,
                PartnerSurface<dim> &partner,
                const SurfaceMeeting &given,
                const std::function<void()> &advance_partner,
                const StepParameters &step,
                const MPI_Comm communicator);

  PairedContact(const PairedContact &)            = delete; ///< the partner refers to it
  PairedContact &operator=(const PairedContact &) = delete; ///< see the constructor

  /** One step of the nodes and of the second body. Collective. */
  void advance(const SurfaceView<dim> &surface) override;

  /** Nodes that press on the second body from the start get one acceleration with what is below them. Collective. */
  void start_as_one(NormalStart &own, NormalStart &other);

  /** Since the start. */
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
  /** What the second body tells of a component. */
  enum Row : unsigned int
  {
    displacement,  ///< m
    velocity,      ///< of the scheme (m/s)
    braking,       ///< minus the acceleration without contact (m/s^2)
    one_over_mass, ///< 1/kg, in 2D m/kg
    increment,     ///< in the step before (m)
    n_rows
  };
  using Forces =
    std::vector<double>; ///< on all nodes of the contact, components together

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
  const SurfaceView<dim> *above = nullptr; ///< in the step under way
  SurfaceValues
    of_partner; ///< u, w, acceleration without contact, inverse mass and, of a body that slides on, its last increment
  SurfaceValues
    forces; ///< on the first body (N, in 2D N/m), by component; behind them how far they are from settled

  std::vector<double>
    share;      ///< of each node below: half of the sum of |W_kj| over k, of partners one
  Forces taken; ///< from the nodes below, W^T f (N, in 2D N/m)
  Forces last;  ///< of the last step (N, in 2D N/m)
  std::array<double, 2> way = {}; ///< of the second body since the start (m)
  std::vector<double>
    moved_before; ///< increments of the nodes of the second body of this rank in the last step (m)
  PairSettling settled;
  std::vector<double> acceleration; ///< in the work of a step

  /** Of the relative motion: displacement (m), velocity of the scheme (m/s), force without contact (N, in 2D N/m), one over
   * the inertia (1/kg, in 2D m/kg), the inertia (0: held) and minus the acceleration without contact (m/s^2), a column for each node; and
   * forces that are tried with what settle() asks of them. */
  NodalField<double> u, w, force, inverse_mass, mass, apart, trial;
};
} // namespace mesoslip

#endif
