#ifndef mesoslip_homogenization_ensemble_h
#define mesoslip_homogenization_ensemble_h

#include "homogenization/response.h"
#include "homogenization/rve_parameters.h"
#include "morphology/microstructure_parameters.h"

#include <map>
#include <string>
#include <vector>

namespace mesoslip
{
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
