#ifndef mesoslip_homogenization_loads_load_evaluation_h
#define mesoslip_homogenization_loads_load_evaluation_h

#include "base/serialize_members.h"
#include "homogenization/loads/load_parameters.h"
#include "homogenization/loads/load_statistics.h"
#include "homogenization/loads/local_fields.h"
#include "homogenization/loads/mixed_load.h"
#include "homogenization/response.h"
#include "morphology/microstructure_parameters.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Statistics of the cells of a phase under a load. */
struct PhaseUnderLoad
{
  std::vector<Moments> quantities; ///< statistics, in the order of LocalFields

  /** Histogram of each quantity: volume share of the phase in each of the Bins. */
  std::vector<std::vector<double>> histogram;

  /** Share of the phase's volume beyond the limits of the von Mises stress and of the
   * largest principal stress; 0 without a limit. */
  std::array<double, 2> beyond = {};

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/** Response of a volume to a load, by superposition of the unit cases of a boundary
 * condition. */
template <int dim>
struct LoadResult
{
  std::string name;                                      ///< name of the load
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< for the unit cases

  VoigtVector<dim> strain = VoigtVector<dim>::Zero(); ///< macroscopic, engineering shear
  VoigtVector<dim> stress = VoigtVector<dim>::Zero(); ///< macroscopic (Pa)

  /** Largest difference between mean local and macroscopic strain, over the largest
   * macroscopic strain. */
  double strain_residual = 0.;
  double stress_residual = 0.; ///< the same for the stress

  /** Hill-Mandel residual: mean of (stress : strain) minus mean stress : mean strain,
   * over the latter. */
  double hill_mandel_residual = 0.;

  double energy = 0.; ///< elastic energy over the volume (J/m^3)

  std::vector<PhaseUnderLoad> phases; ///< in phase order; absent phases have no volume

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<9>(archive, *this);
  }

  /** Statistics of quantity @p q over the whole volume. */
  Moments whole(const std::size_t q) const;
};

/** Phases in the form that LocalFields needs. */
template <int dim>
std::vector<LoadedPhase<dim>>
loaded_phases(const std::vector<PhaseParameters> &parameters);

/** Group of the fields of @p load under @p condition in loads.h5. */
std::string load_group(const std::string &load, const BoundaryCondition condition);

/**
 * Superposes the unit load cases of @p cells, whose response is @p response, to all
 * @p loads. Writes the fields into @p file unless the name is empty. Collective;
 * statistics are valid on rank 0.
 */
template <int dim>
std::vector<LoadResult<dim>> evaluate_loads(const LoadParameters &loads,
                                            const HomogenizedResponse<dim> &response,
                                            const std::vector<LoadedPhase<dim>> &phases,
                                            const VolumeElement<dim> &cells,
                                            const std::string &file);
} // namespace mesoslip

#endif
