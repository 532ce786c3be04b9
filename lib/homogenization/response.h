#ifndef mesoslip_homogenization_response_h
#define mesoslip_homogenization_response_h

#include "base/serialize_members.h"
#include "homogenization/load_cases.h"
#include "material/voigt.h"

#include <optional>
#include <vector>

namespace mesoslip
{
/** What the three load cases of one boundary condition say about the volume. */
struct HomogenizedResponse
{
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< on the boundary

  /**
   * Effective stiffness (Pa) from the energy that the boundary condition makes extremal:
   * of second order in the error of the displacements. KUBC, PBC: the elastic energy,
   * mean of L^T C L with the hourglass part. SUBC: inverse of the compliance from the
   * complementary energy, twice the work of the tractions less the elastic energy.
   */
  VoigtMatrix<2> stiffness = VoigtMatrix<2>::Zero();

  /** The same from the means, of first order: mean of C:L, or inverse of the mean of S:B
   * (SUBC). */
  VoigtMatrix<2> stiffness_from_mean = VoigtMatrix<2>::Zero();

  /** Largest difference of the two, zero by Hill and Mandel, see scaled_difference(). */
  double hill_mandel_residual = 0.;

  /** Largest entry of D - D^T for stiffness_from_mean, in the same scale, before
   * symmetrization. */
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

  std::array<SolverReport, 3> reports; ///< iterations and residuals of the three solves

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<10>(archive, *this);
  }
};

/** Largest |a_ij - b_ij| / sqrt(b_ii b_jj): the same in any units, and where one modulus
 * is far below the others. */
double scaled_difference(const VoigtMatrix<2> &a, const VoigtMatrix<2> &b);

/**
 * Evaluates the solutions on the rank that holds them; collective on a distributed body.
 * Fields are kept only if @p keep_concentration.
 */
HomogenizedResponse homogenize(const ElasticBody<2> &body,
                               const LoadCaseSolutions &solutions,
                               const bool keep_concentration);
} // namespace mesoslip

#endif
