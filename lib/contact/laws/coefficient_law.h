#ifndef mesoslip_contact_laws_coefficient_law_h
#define mesoslip_contact_laws_coefficient_law_h

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace mesoslip
{
/** Arguments of a coefficient of friction. */
struct SlipPoint
{
  double slip_rate               = 0.; ///< V (m/s), at least 0
  double state                   = 0.; ///< state of the law, in its unit
  double pressure                = 0.; ///< Pa
  double time                    = 0.; ///< s
  std::array<double, 2> position = {}; ///< x and, in 3D, y (m)
};

/** State variable of a law, stored for each node. */
struct StateVariable
{
  std::string name;    ///< name, such as "slip"
  std::string unit;    ///< unit, such as "m"
  double initial = 0.; ///< value before the first contact
};

/** Motion of a node in the step that ends now. */
struct SlipStep
{
  double dt        = 0.;    ///< length of the step (s)
  double slip_rate = 0.;    ///< slip rate (m/s)
  bool touches     = false; ///< in contact
  bool sticks      = false; ///< in contact without slip
};

/**
 * Contact nodes in one step. A node would slide with free_rate if its coefficient were
 * zero; a coefficient mu reduces the rate by softness * mu.
 */
struct SlipNodes
{
  std::size_t n                          = 0;       ///< number of nodes
  const SlipStep *before                 = nullptr; ///< the step that ends now
  const double *free_rate                = nullptr; ///< m/s
  const double *softness                 = nullptr; ///< m/s; negative: no contact
  const double *pressure                 = nullptr; ///< Pa, or null
  std::array<const double *, 2> position = {};      ///< m, or null
  double time                            = 0.;      ///< s
  double *state       = nullptr; ///< in the unit of the law, or null; updated
  double *coefficient = nullptr; ///< result for touching nodes
};

/**
 * A coefficient of friction mu(V, state, p, t, x), with slip rate V, and the evolution of
 * its state. Write one small class per law: derive it from NodewiseLaw<Law>, which adds
 * the loop over the nodes.
 */
class CoefficientLaw
{
public:
  virtual ~CoefficientLaw() = default;

  /** mu; NaN where it is undefined, which stops a run. */
  virtual double coefficient(const SlipPoint &at) const = 0;

  /** d mu / d V at constant state (s/m). */
  virtual double slope(const SlipPoint &at) const = 0;

  /** Name, unit and initial value of the state, if there is one. */
  virtual std::optional<StateVariable> state() const
  {
    return std::nullopt;
  }

  /** The state at the end of a step that began with @p state. */
  virtual double next_state(const double state, const SlipStep &) const
  {
    return state;
  }

  /** The steady state of sliding with @p slip_rate (m/s); at 0 the initial state. */
  virtual double steady_state(const double) const
  {
    return 0.;
  }

  /** An upper bound of mu for slip rates up to @p fastest (m/s); infinite if unknown. */
  virtual double largest(const double fastest) const = 0;

  /** An upper bound of -d mu / d V (s/m); 0 if mu never falls with the slip rate. */
  virtual double steepest_fall() const
  {
    return 0.;
  }

  /** An upper bound of -d mu / d slip through the evolution of the state (1/m). */
  virtual double steepest_fall_in_slip() const
  {
    return 0.;
  }

  /** Whether steepest_fall() and steepest_fall_in_slip() are valid bounds. */
  virtual bool knows_falls() const
  {
    return true;
  }

  /** Whether mu depends on pressure, position or time. */
  virtual bool looks_around() const
  {
    return false;
  }

  /**
   * Updates the states and computes the coefficients of @p nodes. Slip rate V and mu(V)
   * belong to the same instant: V + softness mu(V) = free_rate.
   */
  virtual void update(const SlipNodes &nodes) const = 0;
};
} // namespace mesoslip

#endif
