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
  MeanDilatation mean_dilatation = MeanDilatation::automatic; ///< which phases have it
  StaticSolverKind solver =
    StaticSolverKind::multigrid; ///< static solver used for all load cases
  double tolerance = 1e-8;       ///< relative residual of a solve

  /** Definition of /stiffness/effective: mean (KUBC and SUBC), KUBC, SUBC, PBC or
   * MUBC. */
  std::string effective = "mean";

  /** Whether the effective stiffness keeps the entries that couple shear to anything else,
   * in 2D D13 and D23, which are 0 otherwise. */
  bool effective_full = false;

  bool complex_loss =
    false;                  ///< loss factors from complex stiffnesses, not to first order
  bool derivatives = false; ///< whether derivatives by phase constants are written
  bool write_concentration = true; ///< whether tensors of all cells are written to rve.h5
  bool reuse               = true; ///< whether an rve.h5 of the same digest is reused

  /** Number of morphologies: with the seeds seed, seed + 1, ..., or one per mesh. */
  unsigned int n_members = 1;
  double confidence      = 0.95; ///< confidence level of the ensemble's intervals, 0 to 1

  /** Reference stiffness (Pa) for comparison, see stiffness_from_coefficients(); empty:
   * none. */
  std::vector<double> reference;

  LoadParameters loads; ///< section Loads

  /** Binds the keys of all sections. @throws UserError naming the key. */
  void bind(Keys &keys);

  /** @throws UserError naming the key. */
  void check() const;
};

/** A morphology and its results. */
template <int dim>
struct EnsembleMember
{
  /** Origin of the morphology: "seed 7" of the random numbers, or "mesh b.msh". */
  std::string origin;
  std::vector<std::string> warnings; ///< warnings about its morphology
  std::vector<double> fractions;     ///< volume fractions of the phases
  /** Per boundary condition, in the order of the .prm. */
  std::vector<HomogenizedResponse<dim>> responses;

  /** Results of all loads for each condition whose unit cases are superposed, in
   * order. */
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
  VoigtMatrix<dim> standard_deviation = VoigtMatrix<dim>::Zero(); ///< Pa, of members

  /** Pa, half width of the confidence interval of the mean (Student). */
  VoigtMatrix<dim> half_width = VoigtMatrix<dim>::Zero();

  /** 2 s / (sqrt(n) mean), Kanit et al. (2003) [-]. */
  VoigtMatrix<dim> relative_error = VoigtMatrix<dim>::Zero();
};

/** Statistics for the boundary condition number @p condition. With a single member only
 * the mean is set, the rest is zero. */
template <int dim>
StiffnessStatistics<dim>
stiffness_statistics(const std::vector<EnsembleMember<dim>> &members,
                     const std::size_t condition,
                     const double confidence);

/**
 * Warnings on the morphologies: each sentence once, with the origins of the members
 * concerned unless all are.
 */
template <int dim>
std::vector<std::string>
morphology_warnings(const std::vector<EnsembleMember<dim>> &members);

/** Material of the cells of a morphology on its grid. */
UniformMaterial make_material(const PhaseMap<2> &map,
                              std::vector<ElasticPhase<2>> phases);

/** Mean stiffness (Pa) over the responses of all members under @p conditions; zero if
 * there are none. */
template <int dim>
VoigtMatrix<dim> mean_stiffness(const std::vector<EnsembleMember<dim>> &members,
                                const std::vector<BoundaryCondition> &conditions);

/** Conditions over which the effective stiffness is averaged: the chosen one; for "mean",
 * KUBC and SUBC, or all conditions if either is missing. */
std::vector<BoundaryCondition> effective_conditions(const RveParameters &parameters);

/**
 * Judges a result by its residuals: a sentence if fewer than five digits of the mean
 * stress (SUBC: strain) and of the concentration tensors hold, else empty.
 * @throws NumericalFailure if fewer than two digits hold or the stiffness is not
 * positive definite
 */
template <int dim>
std::string check_response(const HomogenizedResponse<dim> &response,
                           const double tolerance);

/**
 * Warnings of check_response() for all members (with their origins if there are
 * several), and on the effective stiffness: entries dropped by orthotropy, and KUBC and
 * SUBC too far apart for their mean.
 */
template <int dim>
std::vector<std::string> result_warnings(const std::vector<EnsembleMember<dim>> &members,
                                         const RveParameters &parameters);
} // namespace mesoslip

#endif
