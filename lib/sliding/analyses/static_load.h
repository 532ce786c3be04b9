#ifndef mesoslip_sliding_analyses_static_load_h
#define mesoslip_sliding_analyses_static_load_h

#include "contact/static_contact_solver.h"
#include "sliding/analyses/static_springs.h"
#include "sliding/given_body.h"

#include <Eigen/Core>

#include <array>
#include <exception>
#include <optional>
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

/** Normal force of the flat on the body (N, in 2D N/m), which has @p n_nodes distinct contact nodes. */
double total_normal_force(const StaticContactSolution &solution,
                          const std::size_t n_nodes);

/** Its force along axis @p c of the dim - 1 along the flat. */
double total_tangential_force(const StaticContactSolution &solution,
                              const std::size_t n_nodes,
                              const unsigned int c,
                              const unsigned int n_tangents);

/** The top in the static state: the body beyond one that absorbs carries the friction, so that nothing
 * moves along the flat there. */
TopSetup top_at_rest(const ContactParameters &parameters);

/** @throws UserError if supports and loads of @p p allow no equilibrium */
template <int dim>
void check_static_load(const ContactParameters &p, const BodyFacts<dim> &body);

/** A body under a load that grows in increments. */
template <int dim>
class StaticLoad
{
public:
  /**
   * Of a @p body whose elastic() is made, with the loads of @p parameters and the coefficients @p friction of its
   * contact nodes; all must outlive it.
   */
  StaticLoad(const GivenBody<dim> &body,
             const ContactParameters &parameters,
             const std::vector<double> &friction);

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

  /** Component @p c of what stretches the spring along the flat at contact node @p i (m). */
  double stretch_of(std::size_t i, unsigned int c) const;

  /** Gaps to the profile where the nodes are now; whether they hardly change. */
  bool follow_profile();

  /** Takes the depths of springs that are not linear; whether their forces are those of the solution. */
  bool settle_springs();

  /** Solves with springs that may not be linear, over a profile. @throws NotConverged */
  void solve();

  /** Solves once and adds up iterations. */
  void solve_linear();

  /** Moves the platens until body and springs carry @p share of their pressures. @throws NotConverged */
  void press(const double share);
  void start_platens(const double share);
  void move_platens();
  std::exception_ptr failure_of_solve();

  /** The same where everything is proportional to how far the top is lowered. */
  void press_in_proportion();

  double normal_force() const;
  Eigen::VectorXd platen_force() const;
  void pull(const SupportNodes &support, const Suspension &suspension);

  /** Adds to steps(). */
  void record(const double share, const double share_of_flat);

  const ContactParameters &parameters;
  const BodyFacts<dim> &facts;
  const ContactPlaces nodes; ///< where the nodes of the contact are
  std::vector<double> gaps;  ///< of these nodes (m); empty: all touch the flat
  std::array<double, 2> way =
    {}; ///< of the flat along x and y from where the body was put on it (m)
  std::optional<StaticSprings> springs; ///< between them and the flat, along its normal
  const ElasticBody<dim> &elastic;
  const SupportNodes top;
  const double strain; ///< of the body under its pressure, about
  StaticContactOptions options;
  StaticContactProblem problem;
  NodalField<double> whole_load; ///< N, in 2D N/m
  bool sides_push = false;       ///< whether sides load the body, and not only the platen
  StaticContactSolution solution;

  /** A component in which a platen moves. */
  struct PlatenMove
  {
    std::size_t platen     = 0; ///< which one, of platens
    unsigned int component = 0; ///< 0: x
    double pressed = 0.; ///< force of its pressure against the component (N, in 2D N/m)
    double pulled =
      0.; ///< size of the force of its springs before it moves (N, in 2D N/m)
    double stiffness = 0.; ///< of the body and of them, about (N/m, in 2D Pa)
  };
  void add_platens(const GivenBody<dim> &body);

  std::vector<Platen> platens;          ///< of sides, then the top
  std::vector<PlatenMove> platen_moves; ///< that of the top along its normal is the last
  Eigen::VectorXd shift;                ///< in these (m)
  Eigen::MatrixXd mobility; ///< about how it changes with platen_force() (m/N)
  std::vector<StaticLoadStep> done;
};
} // namespace mesoslip

#endif
