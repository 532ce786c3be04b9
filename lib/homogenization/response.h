#ifndef mesoslip_homogenization_response_h
#define mesoslip_homogenization_response_h

#include "homogenization/load_cases.h"
#include "io/serialize_members.h"
#include "material/voigt.h"

#include <optional>
#include <vector>

namespace mesoslip
{
/** What the three load cases of one boundary condition say about the volume. */
struct HomogenizedResponse
{
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< on the boundary

  /** Effective stiffness (Pa): mean of C:L, or inverse of the mean of S:B (SUBC). */
  VoigtMatrix<2> stiffness = VoigtMatrix<2>::Zero();

  /** The same from the elastic energy, mean of L^T C L with the hourglass part. */
  VoigtMatrix<2> stiffness_from_energy = VoigtMatrix<2>::Zero();

  /** |difference of the two| / |stiffness|, Frobenius: zero by Hill and Mandel. */
  double hill_mandel_residual = 0.;

  /** |D - D^T| / |D| before symmetrization. */
  double symmetry_residual = 0.;

  /** Norm of (mean of L) - I (KUBC, PBC) or (mean of B) - I (SUBC). */
  double mean_residual = 0.;

  /**
   * With two phases their mean tensors follow from the stiffness alone: (C_i - C_m)^-1
   * (D - C_m) / f, and the like with compliances for B. Relative distance of the stiffer
   * one from that; empty for other numbers of phases or phases that do not differ enough.
   */
  std::optional<double> two_phase_residual;

  /**
   * Cell means of the concentration tensor [ny][nx][3][3], row local, column macroscopic
   * component: strain L (KUBC, PBC) or stress B (SUBC). Empty if not asked for.
   */
  std::vector<double> concentration;

  /** Volume mean of the concentration tensor over each phase; Zero for absent phases. */
  std::vector<VoigtMatrix<2>> phase_means;

  std::array<SolverReport, 3> reports; ///< of the three solves

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<10>(archive, *this);
  }
};

/**
 * Evaluates the solutions on the rank that holds them. Fields are kept only if
 * @p keep_concentration.
 */
HomogenizedResponse homogenize(const UniformMaterial &material,
                               const LoadCaseSolutions &solutions,
                               const bool keep_concentration);
} // namespace mesoslip

#endif
