#ifndef mesoslip_homogenization_rve_parameters_h
#define mesoslip_homogenization_rve_parameters_h

#include "homogenization/load_cases.h"
#include "material/voigt.h"
#include "morphology/microstructure_parameters.h"
#include "statics/static_solver.h"

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** All of rve_homogenization's parameters. */
struct RveParameters
{
  MicrostructureParameters microstructure;   ///< sections Grid, Phases, Microstructure
  std::vector<BoundaryCondition> conditions; ///< in the order of the .prm
  StaticSolverKind solver =
    StaticSolverKind::multigrid; ///< which solver solves the load cases
  double tolerance = 1e-8;       ///< relative residual of a solve

  /** mean (of KUBC and SUBC), KUBC, SUBC or PBC: what /stiffness/effective is. */
  std::string effective = "mean";

  /** Whether the effective stiffness keeps D13 and D23, which are 0 otherwise. */
  bool effective_full = false;

  bool write_concentration = true; ///< tensors of all cells into rve.h5
  bool reuse               = true; ///< an rve.h5 of the same digest is not computed anew

  /** Number of morphologies, of the seeds seed, seed + 1, ... */
  unsigned int n_members = 1;
  double confidence      = 0.95; ///< of the ensemble's intervals, 0 to 1

  /** Stiffness that the results are compared with (Pa). */
  std::optional<VoigtMatrix<2>> reference;

  /** Binds the keys of all sections. @throws UserError naming the key. */
  void bind(Keys &keys);

  /** @throws UserError naming the key. */
  void check() const;
};
} // namespace mesoslip

#endif
