#ifndef mesoslip_contact_laws_friction_expression_h
#define mesoslip_contact_laws_friction_expression_h

#include "contact/laws/healing.h"
#include "contact/laws/nodewise_law.h"
#include "parameters/expression.h"

#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * mu as an expression in the slip rate V (m/s), the accumulated slip D (m), the pressure
 * p (Pa), the time t (s) and the position x and, in 3D, y (m). Negative values count as
 * undefined.
 */
class FrictionExpression final : public NodewiseLaw<FrictionExpression>
{
public:
  /** Parses @p text. @throws std::invalid_argument for an invalid expression */
  FrictionExpression(const std::string &text,
                     const unsigned int dim,
                     const Healing &healing);

  double coefficient(const SlipPoint &at) const override;

  /** Central difference; one-sided at V = 0. */
  double slope(const SlipPoint &at) const override;

  std::optional<StateVariable> state() const override;
  double next_state(const double state, const SlipStep &step) const override;

  /**
   * Maximum over 101 slip rates up to @p fastest; infinite if mu depends on another
   * variable.
   */
  double largest(const double fastest) const override;

  bool knows_falls() const override
  {
    return false;
  }

  bool looks_around() const override;

  /** Whether mu depends on the accumulated slip. */
  bool has_slip() const;

private:
  const std::unique_ptr<const Expression> expression;
  const Healing healing;
  mutable std::vector<double> values; ///< values of the variables in an evaluation
};
} // namespace mesoslip

#endif
