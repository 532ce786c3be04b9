#ifndef mesoslip_homogenization_rve_parameters_h
#define mesoslip_homogenization_rve_parameters_h

#include "elasticity/static_solver.h"
#include "homogenization/load_cases.h"
#include "material/voigt.h"
#include "microstructure/microstructure_parameters.h"

#include <optional>
#include <string>
#include <vector>

namespace dealii
{
class ParameterHandler;
}

namespace mesoslip
{
/** All of rve_homogenization's parameters. */
struct RveParameters
{
  MicrostructureParameters microstructure;   ///< sections Grid, Phases, Microstructure
  std::vector<BoundaryCondition> conditions; ///< in the order of the .prm
  StaticSolverKind solver = StaticSolverKind::multigrid; ///< multigrid or assembled
  double tolerance        = 0.;                          ///< relative residual of a solve

  /** mean (of KUBC and SUBC), KUBC, SUBC or PBC: what /stiffness/effective is. */
  std::string effective;

  /** D13 = D23 = 0 in the effective stiffness. */
  bool effective_orthotropic = true;

  bool write_concentration = true; ///< tensors of all cells into rve.h5
  bool reuse               = true; ///< an rve.h5 of the same digest is not computed anew

  /** Seeds seed, seed + 1, ... */
  unsigned int n_members = 1;
  double confidence      = 0.95; ///< of the ensemble's intervals, 0 to 1

  /** Pa; compared with the results. */
  std::optional<VoigtMatrix<2>> reference;

  /** All sections; @p raw names the phases, which have subsections. */
  static void declare(dealii::ParameterHandler &prm, const RawParameters &raw);

  /** @throws UserError for keys that others leave without effect. */
  static void check_keys(const KeyUse &use);

  /** Parsed and checked. @throws UserError naming the key. */
  static RveParameters parse(dealii::ParameterHandler &prm);
};
} // namespace mesoslip

#endif
