#ifndef mesoslip_homogenization_ensemble_h
#define mesoslip_homogenization_ensemble_h

#include "base/serialize_members.h"
#include "homogenization/load_cases.h"
#include "material/voigt.h"
#include "morphology/microstructure_parameters.h"
#include "statics/static_solver.h"

#include <map>
#include <optional>
#include <string>
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

/** One morphology and what was computed for it. */
struct EnsembleMember
{
  std::uint64_t seed = 0;                     ///< of the random numbers of its morphology
  std::vector<std::string> warnings;          ///< about its morphology
  std::vector<double> fractions;              ///< area fractions of the phases
  std::vector<HomogenizedResponse> responses; ///< in the order of the conditions

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<4>(archive, *this);
  }
};

/** Statistics of the entries of the stiffness over the members. */
struct StiffnessStatistics
{
  VoigtMatrix<2> mean               = VoigtMatrix<2>::Zero(); ///< Pa
  VoigtMatrix<2> standard_deviation = VoigtMatrix<2>::Zero(); ///< Pa, of a member

  /** Pa, of the confidence interval of the mean (Student). */
  VoigtMatrix<2> half_width = VoigtMatrix<2>::Zero();

  /** 2 s / (sqrt(n) mean), Kanit et al. (2003) [-]. */
  VoigtMatrix<2> relative_error = VoigtMatrix<2>::Zero();
};

/** Statistics for the boundary condition number @p condition; of a single member the mean
 * alone, all others are zero. */
StiffnessStatistics stiffness_statistics(const std::vector<EnsembleMember> &members,
                                         const std::size_t condition,
                                         const double confidence);

/**
 * What there is to warn of in the morphologies: each sentence once, with the seeds of
 * those that it is about unless it is about all.
 */
std::vector<std::string> morphology_warnings(const std::vector<EnsembleMember> &members);

/** The material of a morphology on its grid. */
UniformMaterial make_material(const Microstructure &microstructure);

/** Mean stiffness (Pa) over all members and those of their responses whose condition is
 * one of @p conditions; zero if there are none. */
VoigtMatrix<2> mean_stiffness(const std::vector<EnsembleMember> &members,
                              const std::vector<BoundaryCondition> &conditions);

/** Over which conditions the effective stiffness is the mean: the chosen one, or KUBC and
 * SUBC, or all if those two are not both there. */
std::vector<BoundaryCondition> effective_conditions(const RveParameters &parameters);

/**
 * What the residuals say of a result: a sentence when fewer than five digits of the mean
 * stress (SUBC: strain) and of the concentration tensors hold, else nothing.
 * @throws NumericalFailure when not even two hold, or when the stiffness is not positive
 * definite: this is no result.
 */
std::string check_response(const HomogenizedResponse &response, const double tolerance);

/**
 * check_response() of all members, with their seeds if there are several, and what the
 * effective stiffness hides: entries D13 and D23 that orthotropy drops, KUBC and SUBC of
 * which the mean is taken although they are far apart.
 */
std::vector<std::string> result_warnings(const std::vector<EnsembleMember> &members,
                                         const RveParameters &parameters);
} // namespace mesoslip

#endif
