#ifndef mesoslip_sliding_friction_friction_parameters_h
#define mesoslip_sliding_friction_friction_parameters_h

#include "contact/friction_law.h"
#include "sliding/friction/coefficient_law_parameters.h"

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
  bool coefficient_by_phase = false;           ///< whether taken from phases of rve.h5
  double coefficient        = 0.25;            ///< constant of all nodes; at rest
  std::string node_rule =
    "stiffness"; ///< stiffness, mean, largest or smallest; see make_body()
  CoefficientLawParameters coefficient_law; ///< law of the coefficient
  std::string normal_stress = "instant";    ///< or constant time, slip rate

  /** Whether all nodes have a coefficient of which Friction/Coefficient is the
   * constant. */
  bool has_constant_coefficient() const
  {
    return !coefficient_by_phase && coefficient_law.has_reference();
  }

  /** Binds the keys of section Friction; puts the regularizations into @p law. */
  void bind(Keys &keys, FrictionLaw &law);

  /** Conditions under which a law of the coefficient is used. */
  struct Use
  {
    unsigned int dim    = 2;     ///< dimension of the body
    double pressure     = 0.;    ///< pressure on the top (Pa)
    double speed        = 0.;    ///< speed of the flat (m/s), at least 0
    bool in_time        = true;  ///< transient run; else statics
    bool flat_displaced = false; ///< statics with a displaced flat, in increments
  };

  /**
   * Makes the law of the coefficient, after all other keys are bound. In transient runs
   * @p law gets it, in statics the coefficient becomes its value at the speed of the
   * flat. Collective.
   * @throws UserError for a law that has no meaning there
   */
  void make_coefficient_law(const Keys &keys, const Use &use, FrictionLaw &law);

  /** The constants of the memory of the normal stress, for comparisons; empty: none. */
  static std::string memory_text(const NormalStressMemory &memory);
};
} // namespace mesoslip

#endif
