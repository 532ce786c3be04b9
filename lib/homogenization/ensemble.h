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

/** Statistics of one entry of the stiffness over the members. */
struct EntryStatistics
{
  double mean               = 0.; ///< Pa
  double standard_deviation = 0.; ///< Pa, of a member; 0 for a single one
  double half_width = 0.; ///< Pa, of the confidence interval of the mean (Student)

  /** 2 s / (sqrt(n) mean), Kanit et al. (2003); 0 for a single member. */
  double relative_error = 0.;
};

/** EntryStatistics of all entries of the stiffness, as matrices. */
struct StiffnessStatistics
{
  VoigtMatrix<2> mean;               ///< Pa
  VoigtMatrix<2> standard_deviation; ///< Pa
  VoigtMatrix<2> half_width;         ///< Pa
  VoigtMatrix<2> relative_error;     ///< as in EntryStatistics
};

/** Statistics of a sample of numbers. */
EntryStatistics entry_statistics(const std::vector<double> &values,
                                 const double confidence);

/** Statistics of all entries for the boundary condition number @p condition. */
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
} // namespace mesoslip

#endif
