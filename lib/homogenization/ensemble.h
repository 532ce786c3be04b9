#ifndef mesoslip_homogenization_ensemble_h
#define mesoslip_homogenization_ensemble_h

#include "homogenization/conduction/conduction_response.h"
#include "homogenization/derivatives/complex_stiffness.h"
#include "homogenization/loads/load_evaluation.h"
#include "homogenization/loads/load_parameters.h"
#include "homogenization/response.h"
#include "material/voigt.h"
#include "morphology/mesh_morphology.h"
#include "morphology/microstructure_parameters.h"
#include "statics/static_solver.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** All of rve_homogenization's parameters. */
struct RveParameters
{
  MeshParameters mesh;                       ///< Dimension and section Mesh
  MicrostructureParameters microstructure;   ///< sections Grid, Phases, Microstructure
  std::vector<BoundaryCondition> conditions; ///< in the order of the .prm
  MeanDilatation mean_dilatation = MeanDilatation::automatic; ///< phases that have it
  StaticSolverKind solver =
    StaticSolverKind::multigrid; ///< which solver solves the load cases
  double tolerance = 1e-8;       ///< relative residual of a solve

  /** mean (of KUBC and SUBC), KUBC, SUBC, PBC or MUBC: what /stiffness/effective is. */
  std::string effective = "mean";

  /** Whether the effective stiffness keeps the entries that couple shear to anything else,
   * in 2D D13 and D23, which are 0 otherwise. */
  bool effective_full = false;

  bool complex_loss =
    false;                  ///< loss factors from complex stiffnesses, not to first order
  bool derivatives = false; ///< those with respect to constants of phases are written
  bool write_concentration = true; ///< tensors of all cells into rve.h5
  bool reuse               = true; ///< an rve.h5 of the same digest is not computed anew

  /** Number of morphologies: of the seeds seed, seed + 1, ..., or of the meshes. */
  unsigned int n_members = 1;
  double confidence      = 0.95; ///< of the ensemble's intervals, 0 to 1

  /** Stiffness that the results are compared with (Pa), see
   * stiffness_from_coefficients(); empty: none. */
  std::vector<double> reference;

  LoadParameters loads; ///< section Loads

  /** Binds the keys of all sections. @throws UserError naming the key. */
  void bind(Keys &keys);

  /** @throws UserError naming the key. */
  void check() const;
};

/** One morphology and what was computed for it. */
template <int dim>
struct EnsembleMember
{
  /** Where its morphology comes from: "seed 7" of the random numbers, or "mesh b.msh". */
  std::string origin;
  std::vector<std::string> warnings; ///< about its morphology
  std::vector<double> fractions;     ///< volume fractions of the phases
  /** In the order of the conditions. */
  std::vector<HomogenizedResponse<dim>> responses;

  /** For each condition whose cases are superposed, in their order, each load. */
  std::vector<LoadResult<dim>> loads;

  /** Conductivities, in the order of the conditions; empty: not asked for. */
  std::vector<ConductionResponse<dim>> conduction;

  /** Complex stiffnesses, in the order of the conditions; empty: not asked for. */
  std::vector<ComplexStiffness<dim>> complex;

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<7>(archive, *this);
  }
};

/** The largest loss factor of the phases. */
double largest_loss_factor(const RveParameters &parameters);

/** Statistics of the entries of the stiffness over the members. */
template <int dim>
struct StiffnessStatistics
{
  VoigtMatrix<dim> mean               = VoigtMatrix<dim>::Zero(); ///< Pa
  VoigtMatrix<dim> standard_deviation = VoigtMatrix<dim>::Zero(); ///< Pa, of a member

  /** Pa, of the confidence interval of the mean (Student). */
  VoigtMatrix<dim> half_width = VoigtMatrix<dim>::Zero();

  /** 2 s / (sqrt(n) mean), Kanit et al. (2003) [-]. */
  VoigtMatrix<dim> relative_error = VoigtMatrix<dim>::Zero();
};

/** Statistics for the boundary condition number @p condition; of a single member the mean
 * alone, all others are zero. */
template <int dim>
StiffnessStatistics<dim>
stiffness_statistics(const std::vector<EnsembleMember<dim>> &members,
                     const std::size_t condition,
                     const double confidence);

/**
 * What there is to warn of in the morphologies: each sentence once, with the origins of
 * those that it is about unless it is about all.
 */
template <int dim>
std::vector<std::string>
morphology_warnings(const std::vector<EnsembleMember<dim>> &members);

/** The material of a morphology on its grid. */
UniformMaterial make_material(const PhaseMap<2> &map,
                              std::vector<ElasticPhase<2>> phases);

/** Mean stiffness (Pa) over all members and those of their responses whose condition is
 * one of @p conditions; zero if there are none. */
template <int dim>
VoigtMatrix<dim> mean_stiffness(const std::vector<EnsembleMember<dim>> &members,
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
template <int dim>
std::string check_response(const HomogenizedResponse<dim> &response,
                           const double tolerance);

/**
 * check_response() of all members, with their origins if there are several, and what the
 * effective stiffness hides: entries that orthotropy drops, KUBC and SUBC of
 * which the mean is taken although they are far apart.
 */
template <int dim>
std::vector<std::string> result_warnings(const std::vector<EnsembleMember<dim>> &members,
                                         const RveParameters &parameters);
} // namespace mesoslip

#endif
