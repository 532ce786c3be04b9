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
 * mu as an expression in the slip rate V (m/s), the accumulated slip D (m), the pressure p
 * (Pa), the time t (s) and the place x and, in 3D, y (m). Where it is negative it is not
 * defined.
 */
class FrictionExpression final : public NodewiseLaw<FrictionExpression>
{
public:
  /** @throws std::invalid_argument for a text that is no such expression */
  FrictionExpression(const std::string &text,
                     const unsigned int dim,
                     const Healing &healing);

  double coefficient(const SlipPoint &at) const override;

  /** By a central difference, next to V = 0 by one to the right. */
  double slope(const SlipPoint &at) const override;

  std::optional<StateVariable> state() const override;
  double next_state(const double state, const SlipStep &step) const override;

  /** The largest of 101 slip rates up to @p fastest; infinite where anything else takes part. */
  double largest(const double fastest) const override;

  bool knows_falls() const override
  {
    return false;
  }

  bool looks_around() const override;

  /** Whether the accumulated slip takes part. */
  bool has_slip() const;

private:
  const std::unique_ptr<const Expression> expression;
  const Healing healing;
  mutable std::vector<double> values; ///< of the variables, for one evaluation
};
} // namespace mesoslip

#endif
