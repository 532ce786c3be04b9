#ifndef mesoslip_sliding_mesh_statics_mesh_static_load_h
#define mesoslip_sliding_mesh_statics_mesh_static_load_h

#include "body/mesh/mesh_body.h"
#include "contact/static_contact_solver.h"
#include "sliding/contact_parameters.h"

#include <array>
#include <vector>

namespace mesoslip
{
/** What the flat carries after an increment of the load. */
struct StaticLoadStep
{
  double share                           = 0.; ///< of the normal load
  std::array<double, 2> displacement     = {}; ///< of the flat along x and y (m)
  double normal_force                    = 0.; ///< of the flat on the body (N, in 2D N/m)
  std::array<double, 2> tangential_force = {}; ///< likewise, along x and y
  double contact_area     = 0.; ///< of the nodes that touch the flat (m^2, in 2D m)
  double stick_area       = 0.; ///< of those that stick
  unsigned int iterations = 0;  ///< over contact states and friction
};

/** Normal force of the flat on the body (N, in 2D N/m). */
double total_normal_force(const StaticContactSolution &solution);

/** Its force along axis @p c of the dim - 1 along the flat. */
double total_tangential_force(const StaticContactSolution &solution,
                              const unsigned int c,
                              const unsigned int n_tangents);

/** @throws UserError if supports and loads allow no equilibrium; @p mu are the coefficients of the
 * contact nodes. */
template <int dim>
void check_mesh_static(const ContactParameters &p, const std::vector<double> &mu);

/** A body on a mesh under a load that grows in increments. */
template <int dim>
class MeshStaticLoad
{
public:
  /**
   * @p body lists contact nodes in the order of @p elastic, @p held is what groups and top
   * hold, @p stiffness (Pa) says how far a platen is lowered first. All must outlive it.
   */
  MeshStaticLoad(const ContactParameters &parameters,
                 const MeshBodyDescription &body,
                 const MeshBody<dim> &elastic,
                 const DofMask &held,
                 const double stiffness);

  /**
   * Presses the body on the flat, then displaces the flat. Iterations are those of all
   * increments. Collective. @throws NotConverged
   */
  StaticContactSolution follow(const StaticContactOptions &given);

  /** One for each increment. */
  const std::vector<StaticLoadStep> &steps() const
  {
    return done;
  }

private:
  /** Nodes stick where they are now, on a flat that moves by @p share of its way. */
  void stick_where_it_is(const double share);

  /** Solves and adds up iterations. */
  void solve();

  /** Lowers the platen until the flat carries @p share of its pressure. */
  void press(const double share);

  /** Adds to steps(). */
  void record(const double share, const double share_of_flat);

  const ContactParameters &parameters;
  const MeshBodyDescription &body;
  const MeshBody<dim> &elastic;
  const double stiffness;
  StaticContactOptions options;
  StaticContactProblem problem;
  NodalField<double> whole_load; ///< N, in 2D N/m
  StaticContactSolution solution;
  double lowered = 0., lowered_before = 0.; ///< the platen (m)
  double force_before = 0.;                 ///< of the flat then (N)
  std::vector<StaticLoadStep> done;
};
} // namespace mesoslip

#endif
