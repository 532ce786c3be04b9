#ifndef mesoslip_homogenization_volume_analysis_h
#define mesoslip_homogenization_volume_analysis_h

#include "homogenization/rve_program.h"

#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/** What rve_homogenization does whatever the volume lies on; grid and mesh differ in how
 * they make and solve their volumes. */
template <int dim>
class VolumeAnalysis : public Analysis
{
public:
  ResourceNeed need() const override;
  void run(RunContext &context) override;
  void write_draft(const std::string &folder) const override;

protected:
  /** @p digest identifies parameters and input files. */
  VolumeAnalysis(const RveParameters &parameters, const std::string &digest)
    : parameters(parameters)
    , digest(digest)
  {
  }

  /** Number of cells of the first member. */
  virtual double n_cells() const = 0;

  /** Writes what the cells are made of into rve.h5, of which @p path is the name, where morphology()
   * leaves it out. Collective. */
  virtual void write_cells_of_draft(const std::string & /*path*/) const
  {
  }

  /** Grid or mesh of the first member, its phases, where they are and their fractions; on
   * rank 0. */
  virtual RveContent<dim> morphology() const = 0;

  /** Sentences on what looks like another unit. */
  virtual std::vector<std::string> slips() const = 0;

  /** Solves all load cases of all members. Collective; results are those of rank 0.
   * @throws NotConverged */
  virtual RveResults<dim> compute(RunContext &context) = 0;

  /** What explains a solve that failed, or helps; empty: nothing is known. */
  virtual std::string advice(const NotConverged &failure) const = 0;

  /** What is hard about phases and cells @p aspect times as long as wide, and the
   * tolerance that the solve would have met. */
  std::string causes(const NotConverged &failure, const double aspect) const;

  const RveParameters parameters; ///< checked
  const std::string digest;       ///< of all inputs
};

/** The analysis of volumes on a grid. @throws UserError */
std::unique_ptr<Analysis> make_grid_analysis(const RveParameters &parameters,
                                             const std::string &digest);

/** Collective. @throws UserError, with the number of cells that would fit, unless the machine
 * has the memory for these voxels; before anything is read but what a file says of itself */
void require_voxel_memory(const RveParameters &parameters);

/** The analysis of volumes of voxels. Collective. @throws UserError */
std::unique_ptr<Analysis> make_voxel_analysis(const RveParameters &parameters,
                                              const std::string &digest);

/** The analysis of volumes on meshes. Collective. @throws UserError */
template <int dim>
std::unique_ptr<Analysis> make_mesh_analysis(const RveParameters &parameters,
                                             const std::string &digest);
} // namespace mesoslip

#endif
