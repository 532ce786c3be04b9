#ifndef mesoslip_contact_laws_slip_law_h
#define mesoslip_contact_laws_slip_law_h

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace mesoslip
{
/** What a coefficient of friction may depend on. */
struct SlipPoint
{
  double slip_rate               = 0.; ///< V (m/s), at least 0
  double state                   = 0.; ///< of the law, in its unit
  double pressure                = 0.; ///< Pa
  double time                    = 0.; ///< s
  std::array<double, 2> position = {}; ///< x and, in 3D, y (m)
};

/** What a law remembers of each node. */
struct StateVariable
{
  std::string name;    ///< "slip"
  std::string unit;    ///< "m"
  double initial = 0.; ///< before the first contact
};

/** How a node got through the step that ends now. */
struct SlipStep
{
  double dt        = 0.;    ///< its length (s)
  double slip_rate = 0.;    ///< (m/s)
  bool touches     = false; ///< in contact
  bool sticks      = false; ///< in contact without slip
};

/**
 * Nodes of a contact in one step. A node would slide with free_rate if its coefficient were
 * zero; a coefficient mu takes softness * mu of that away.
 */
struct SlipNodes
{
  std::size_t n                          = 0;       ///< number of nodes
  const SlipStep *before                 = nullptr; ///< the step that ends now
  const double *free_rate                = nullptr; ///< m/s
  const double *softness                 = nullptr; ///< m/s; negative: does not touch
  const double *pressure                 = nullptr; ///< Pa, or null
  std::array<const double *, 2> position = {};      ///< m, or null
  double time                            = 0.;      ///< s
  double *state       = nullptr; ///< in the law's unit, or null; updated
  double *coefficient = nullptr; ///< result where a node touches
};

/**
 * A coefficient of friction mu(V, state, p, t, x), V being the slip rate, with the evolution
 * of its state. One small class a law: derive from NodewiseLaw<Law>, which makes the loop
 * over the nodes of the functions here.
 */
class SlipLaw
{
public:
  virtual ~SlipLaw() = default;

  /** mu; NaN where it is not defined, which stops a run. */
  virtual double coefficient(const SlipPoint &at) const = 0;

  /** d mu / d V with the state as it is (s/m). */
  virtual double slope(const SlipPoint &at) const = 0;

  /** Name, unit and first value of the state, if there is one. */
  virtual std::optional<StateVariable> state() const
  {
    return std::nullopt;
  }

  /** The state at the end of a step that began with @p state. */
  virtual double next_state(const double state, const SlipStep &) const
  {
    return state;
  }

  /** The state after long sliding with @p slip_rate (m/s); at 0 that of a start. */
  virtual double steady_state(const double) const
  {
    return 0.;
  }

  /** An upper bound of mu for slip rates up to @p fastest (m/s); infinite: not known. */
  virtual double largest(const double fastest) const = 0;

  /** An upper bound of -d mu / d V (s/m); 0: mu never falls with the slip rate. */
  virtual double steepest_fall() const
  {
    return 0.;
  }

  /** An upper bound of -d mu / d slip by what the state does (1/m). */
  virtual double steepest_fall_in_slip() const
  {
    return 0.;
  }

  /** Whether steepest_fall() and steepest_fall_in_slip() are such bounds. */
  virtual bool knows_falls() const
  {
    return true;
  }

  /** Whether pressure, or place and time, take part. */
  virtual bool looks_around() const
  {
    return false;
  }

  /** Updates the states and finds the coefficients of @p nodes: the slip rate V and mu(V)
   * of one instant belong together, V + softness mu(V) = free_rate. */
  virtual void update(const SlipNodes &nodes) const = 0;
};
} // namespace mesoslip

#endif
