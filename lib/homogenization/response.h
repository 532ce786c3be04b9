#ifndef mesoslip_homogenization_response_h
#define mesoslip_homogenization_response_h

#include "base/serialize_members.h"
#include "homogenization/load_cases.h"
#include "material/voigt.h"
#include "statics/static_solver.h"

#include <array>
#include <optional>
#include <vector>

namespace mesoslip
{
/** Sums over the cells of one phase under the unit load cases (a column each) and under
 * one kelvin. */
template <int dim>
struct PhaseSums
{
  UnitStrains<dim> strain = UnitStrains<dim>::Zero(); ///< integral (VolumeSums' unit)
  double volume           = 0.;                       ///< in any unit, see VolumeSums
};

/** Volume sums of the load cases of one boundary condition. */
template <int dim>
struct VolumeSums
{
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< for the load cases
  std::vector<PhaseSums<dim>> phases;                    ///< per phase
  double volume = 0.; ///< total volume, in the unit of PhaseSums::volume

  /** Volume mean of strain_k . C strain_l (Pa, for SUBC 1/Pa). */
  VoigtMatrix<dim> energy = VoigtMatrix<dim>::Zero();

  std::vector<SolverReport> reports; ///< solver reports per load case, heat last
};

/** Response to one kelvin under a boundary condition that keeps the mean strain (SUBC:
 * stress) zero. */
template <int dim>
struct ThermalResponse
{
  bool exists = false; ///< whether a phase expands

  /** Effective thermal stress beta (Pa/K): S = D E - beta T. By reciprocity it is the
   * mean of A^T beta with the strains A of the unit load cases and the thermal stress
   * beta of the phases (SUBC: this mean is the expansion). MUBC: without shears. */
  VoigtVector<dim> stress = VoigtVector<dim>::Zero();

  VoigtVector<dim> expansion =
    VoigtVector<dim>::Zero(); ///< D^-1 stress (1/K, engineering shear)

  /** Largest difference between stress and the mean stress (SUBC: between expansion and
   * mean strain) of the solved case, over the mean of the phases. */
  double residual = 0.;

  /** Mean of a_k . beta with the strains a_k of the unit cases (Pa/K, SUBC: 1/K) and,
   * last, of a_T . beta with the strains a_T of one kelvin (Pa/K^2). */
  Eigen::Matrix<double, n_voigt<dim> + 1, 1> work =
    Eigen::Matrix<double, n_voigt<dim> + 1, 1>::Zero();

  double held =
    0.; ///< mean of alpha . C alpha in space (Pa/K^2); set where the phases are known

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<6>(archive, *this);
  }
};

/** Effective properties from the load cases of one boundary condition. */
template <int dim>
struct HomogenizedResponse
{
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< for the load cases

  /**
   * Effective stiffness (Pa) from the energy that the boundary condition makes extremal:
   * of second order in the error of the displacements. KUBC, PBC: the elastic energy,
   * mean of L^T C L with the hourglass part. SUBC: inverse of the compliance from the
   * complementary energy, twice the work of the tractions less the elastic energy. MUBC:
   * as KUBC, without the entries that couple a shear to anything else, see coupling.
   */
  VoigtMatrix<dim> stiffness = VoigtMatrix<dim>::Zero();

  /** Effective stiffness from means, of first order: mean of C:L, or inverse of the mean
   * of S:B (SUBC). */
  VoigtMatrix<dim> stiffness_from_mean = VoigtMatrix<dim>::Zero();

  /** Largest difference between stiffness and stiffness_from_mean, zero by Hill and
   * Mandel, see scaled_difference(). */
  double hill_mandel_residual = 0.;

  /** Largest entry of D - D^T for stiffness_from_mean before symmetrization, see
   * scaled_difference(). */
  double symmetry_residual = 0.;

  /** Norm of (mean of L) - I (KUBC, PBC; MUBC: of its orthotropic part) or (mean of B) - I
   * (SUBC). */
  double mean_residual = 0.;

  /** MUBC: largest entry of the mean stresses that couples a shear to anything else, in the
   * scale of scaled_difference(): zero when x, y (and z) are axes of orthotropy. */
  double coupling = 0.;

  /** Volume mean of strain_k . C strain_l of unit loads (Pa, for SUBC 1/Pa). */
  VoigtMatrix<dim> energy = VoigtMatrix<dim>::Zero();

  /**
   * Two phases: relative distance of the stiffer phase's mean tensor from the exact (C_i
   * - C_m)^-1 (D - C_m) / f (for B the same with compliances), which the stiffness alone
   * determines. Empty for other numbers of phases or phases that do not differ enough.
   */
  std::optional<double> two_phase_residual;

  /**
   * Volume mean of the concentration tensor over each phase (row: local, column:
   * macroscopic Voigt component): strain L (KUBC, PBC, MUBC) or stress B (SUBC); zero
   * for absent phases.
   */
  std::vector<VoigtMatrix<dim>> phase_means;

  /** Derivatives of the stiffness (Pa over the unit of the constant), see variations_of(). */
  std::vector<VoigtMatrix<dim>> derivatives;

  ThermalResponse<dim> heat; ///< response to one kelvin
  double volume = 0.;        ///< total volume, in the unit of VolumeSums

  std::vector<SolverReport>
    reports; ///< iterations and residuals, by load case, heat last

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<14>(archive, *this);
  }
};

/** Largest |a_ij - b_ij| / sqrt(b_ii b_jj): independent of units, and meaningful where
 * one modulus is far below the rest. */
template <int dim>
double scaled_difference(const VoigtMatrix<dim> &a, const VoigtMatrix<dim> &b);

/** Effective properties from @p sums. @p phases are the phases of the sums (stiffness in
 * Pa). */
template <int dim>
HomogenizedResponse<dim> homogenize(const VolumeSums<dim> &sums,
                                    const std::vector<ElasticPhase<dim>> &phases);

/** Replaces means over materials by means over the @p n_parts phases, where the cells of
 * a phase are several materials (orientations of the phase). Material m belongs to phase
 * @p part [m]. @p sums are the sums from which @p response follows. */
template <int dim>
void gather_parts(HomogenizedResponse<dim> &response,
                  const VolumeSums<dim> &sums,
                  const std::vector<unsigned int> &part,
                  const std::size_t n_parts);
} // namespace mesoslip

#endif
