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
/** Reaction of the flat after a load increment. */
struct StaticLoadStep
{
  double share                           = 0.; ///< fraction of the full normal load
  std::array<double, 2> displacement     = {}; ///< flat along x and y (m)
  double normal_force                    = 0.; ///< on the body (N, in 2D N/m)
  std::array<double, 2> tangential_force = {}; ///< along x and y, same units
  double contact_area     = 0.; ///< tributary area of the nodes in contact (m^2, in 2D m)
  double stick_area       = 0.; ///< tributary area of the nodes that stick, same units
  unsigned int iterations = 0;  ///< over contact states and friction
};

/** Normal force of the flat on the body (N, in 2D N/m) over @p n_nodes contact nodes
 * without periodic copies. */
double total_normal_force(const StaticContactSolution &solution,
                          const std::size_t n_nodes);

/** Tangential force of the flat along axis @p c of the dim - 1 axes along the flat. */
double total_tangential_force(const StaticContactSolution &solution,
                              const std::size_t n_nodes,
                              const unsigned int c,
                              const unsigned int n_tangents);

/** The top support in the static state. An absorbing top is held along the flat: the body
 * beyond it carries the friction. */
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
   * Loads come from @p parameters, friction coefficients of the contact nodes from
   * @p friction. make_elastic() was called on @p body; all arguments must outlive this
   * object.
   */
  StaticLoad(const GivenBody<dim> &body,
             const ContactParameters &parameters,
             const std::vector<double> &friction);

  /**
   * Presses the body on the flat, then displaces the flat; reports the iterations of all
   * increments. Collective.
   * @throws NotConverged
   */
  StaticContactSolution follow(const StaticContactOptions &given);

  /** Results per load increment. */
  const std::vector<StaticLoadStep> &steps() const
  {
    return done;
  }

private:
  /** Sets stick conditions at the current positions, on a flat that has moved by @p share
   * of its way. */
  void stick_where_it_is(const double share);

  /** Component @p c of the elongation of the tangential spring at contact node
   * @p i (m). */
  double stretch_of(std::size_t i, unsigned int c) const;

  /** Updates the gaps over the profile for the current positions; returns whether they
   * hardly changed. */
  bool follow_profile();

  /** Updates the indentation of nonlinear springs; returns whether their forces agree
   * with the solution. */
  bool settle_springs();

  /** Solves with nonlinear springs over a profile.
   * @throws NotConverged */
  void solve();

  /** Solves once and adds up iterations. */
  void solve_linear();

  /** Moves the platens until body and springs balance @p share of the platen pressures.
   * @throws NotConverged */
  void press(const double share);
  void start_platens(const double share);
  void move_platens();
  std::exception_ptr failure_of_solve();

  /** press() for the linear case, where everything is proportional to the lowering of the
   * top. */
  void press_in_proportion();

  double normal_force() const;
  Eigen::VectorXd platen_force() const;
  void pull(const SupportNodes &support, const Suspension &suspension);

  /** Appends a result to steps(). */
  void record(const double share, const double share_of_flat);

  const ContactParameters &parameters;
  const BodyFacts<dim> &facts;
  const ContactPlaces nodes; ///< positions of the contact nodes
  std::vector<double> gaps;  ///< gaps of the contact nodes (m); empty: all touch the flat
  std::array<double, 2> way =
    {}; ///< displacement of the flat along x and y since the body was put on it (m)
  std::optional<StaticSprings> springs; ///< contact springs, along the normal
  const ElasticBody<dim> &elastic;
  const SupportNodes top;
  const double strain; ///< rough normal strain of the body under its pressure
  StaticContactOptions options;
  StaticContactProblem problem;
  NodalField<double> whole_load; ///< N, in 2D N/m
  bool sides_push = false;       ///< whether sides other than the platen load the body
  StaticContactSolution solution;

  /** A component in which a platen moves. */
  struct PlatenMove
  {
    std::size_t platen     = 0;  ///< index into platens
    unsigned int component = 0;  ///< 0: x
    double pressed         = 0.; ///< force of its pressure against it (N, in 2D N/m)
    double pulled =
      0.; ///< magnitude of the spring force before the platen moves (N, in 2D N/m)
    double stiffness = 0.; ///< rough stiffness of body and springs (N/m, in 2D Pa)
  };
  void add_platens(const GivenBody<dim> &body);

  std::vector<Platen> platens;          ///< platens of the sides, then of the top
  std::vector<PlatenMove> platen_moves; ///< the normal motion of the top is last
  Eigen::VectorXd shift;                ///< displacement per entry of platen_moves (m)
  Eigen::MatrixXd mobility; ///< approximate derivative of shift by platen_force() (m/N)
  std::vector<StaticLoadStep> done;
};
} // namespace mesoslip

#endif
