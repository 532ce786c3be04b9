#ifndef mesoslip_sliding_friction_coefficient_law_parameters_h
#define mesoslip_sliding_friction_coefficient_law_parameters_h

#include "contact/laws/friction_table.h"
#include "contact/laws/healing.h"
#include "contact/laws/rate_and_state.h"
#include "contact/laws/slip_weakening.h"
#include "contact/laws/stribeck.h"

#include <memory>
#include <string>

namespace mesoslip
{
class Keys;

/** The law of the coefficient of friction in section Friction. */
struct CoefficientLawParameters
{
  /** Law of the coefficient. */
  enum class Kind
  {
    constant,
    static_and_kinetic,
    stribeck,
    linear_slip_weakening,
    exponential_slip_weakening,
    rate_and_state,
    table,
    expression
  };

  /** Whether the coefficient varies. */
  bool is_given() const
  {
    return kind != Kind::constant;
  }

  /** Whether Friction/Coefficient is a constant of the law. */
  bool has_reference() const
  {
    return kind != Kind::table && kind != Kind::expression;
  }

  /** Whether the coefficient depends on the accumulated slip of a node. */
  bool is_slip_weakening() const
  {
    return kind == Kind::linear_slip_weakening ||
           kind == Kind::exponential_slip_weakening;
  }

  /** Binds the keys of the current section. @throws UserError */
  void bind(Keys &keys);

  /**
   * The law with mu_s or f_0 = @p reference; null when it is constant. Reads a table on rank
   * 0. Collective. @throws UserError
   */
  std::shared_ptr<const CoefficientLaw> make(const double reference,
                                             const unsigned int dim);

  /** Name and all constants except mu_s or f_0, for comparisons: "Stribeck: mu_k = 0.2,
   * ..."; call it after make(). */
  std::string text() const;

  Kind kind = Kind::constant; ///< law in use; selects the constants below

  /** Also for static and kinetic. By default like dry steel, whose friction halves within
   * some cm/s. */
  Stribeck::Constants stribeck = {0., 0.2, 0.1, 2., 0.};

  SlipWeakening::Constants weakening = {0., 0.2, 1e-5, false, {}}; ///< for both laws
  RateAndState::Constants state;                       ///< constants of rate and state
  Healing healing = {Healing::Kind::separation, 1e-3}; ///< healing of slip weakening
  std::string table_file;         ///< file of the table, see read_friction_table()
  std::string expression = "0.3"; ///< mu, see FrictionExpression

private:
  std::string table_digest; ///< digest of the table's numbers
};

/**
 * Points of a table of friction: columns "slip rate [m/s]", "coefficient [-]" and, if
 * wanted, "pressure [Pa]", a row for each pair of slip rate and pressure in any order.
 * @throws UserError for missing, repeated or negative values
 */
FrictionTable::Points read_friction_table(const std::string &path);
} // namespace mesoslip

#endif
