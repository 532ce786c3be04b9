#ifndef mesoslip_sliding_friction_friction_parameters_h
#define mesoslip_sliding_friction_friction_parameters_h

#include "contact/friction_law.h"
#include "sliding/friction/slip_law_parameters.h"

#include <memory>
#include <string>

namespace mesoslip
{
class Keys;

/** Section Friction, besides the FrictionLaw. */
struct FrictionParameters
{
  std::string law_name      = "constant time"; ///< coulomb, constant time or slip rate
  double slip_length        = 3e-6;            ///< L of the slip-rate law (m)
  double reference_velocity = 1e-3;            ///< V_ref of the slip-rate law (m/s)
  bool coefficient_by_phase = false;           ///< those of the phases in rve.h5
  double coefficient        = 0.25;            ///< of all nodes, unless by phase; at rest
  std::string node_rule =
    "stiffness";              ///< stiffness, mean, largest or smallest; see make_body()
  SlipLawParameters slip_law; ///< how the coefficient varies
  std::string normal_stress = "instant"; ///< or constant time, slip rate

  /** Whether all nodes have a coefficient of which Friction/Coefficient is the constant. */
  bool has_constant_coefficient() const
  {
    return !coefficient_by_phase && slip_law.has_reference();
  }

  /** Binds the keys of section Friction; puts the regularizations into @p law. */
  void bind(Keys &keys, FrictionLaw &law);

  /** Where and how a law of the coefficient is used. */
  struct Use
  {
    unsigned int dim    = 2;     ///< of the body
    double pressure     = 0.;    ///< of the top (Pa)
    double speed        = 0.;    ///< of the flat (m/s), at least 0
    bool in_time        = true;  ///< in a transient run; else in statics
    bool flat_displaced = false; ///< in statics, in increments
  };

  /**
   * Makes the law of the coefficient, once all other keys are bound: in transient runs
   * @p law has it, in statics coefficient becomes that of the law at the speed of the flat.
   * Collective. @throws UserError for a law that has no meaning there
   */
  void make_slip_law(const Keys &keys, const Use &use, FrictionLaw &law);

  /** The constants of the memory of the normal stress, for comparisons; empty: none. */
  static std::string memory_text(const NormalStressMemory &memory);
};
} // namespace mesoslip

#endif
