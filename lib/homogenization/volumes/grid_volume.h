#ifndef mesoslip_homogenization_grid_volume_h
#define mesoslip_homogenization_grid_volume_h

#include "elasticity/uniform_material.h"
#include "homogenization/load_cases.h"
#include "homogenization/volumes/volume_element.h"

#include <memory>
#include <vector>

namespace mesoslip
{
/** Volume sums of the @p solutions on @p body, on the rank that holds them; collective on
 * a distributed body. The unit of volume is a mean cell. */
VolumeSums<2> sum_up(const ElasticBody<2> &body, const LoadCaseSolutions &solutions);

/**
 * A volume element on a plane grid, replicated on all ranks. The ranks share the load
 * cases (with ml they solve each case together); rank 0 has all results.
 */
class GridVolume : public VolumeElement<2>
{
public:
  /** Solves the load cases of all @p conditions by @p solver on @p the_grid with
   * @p the_material. @p timer gets a section for each condition. Collective.
   * @throws NotConverged */
  GridVolume(const UniformGrid<2> &the_grid,
             const UniformMaterial &the_material,
             const StaticSolverKind solver,
             const std::vector<BoundaryCondition> &conditions,
             const double tolerance,
             const MPI_Comm communicator,
             const std::function<void()> &case_done,
             Timer *timer);

  /** Sums of the load cases of @p condition; frees the solutions of the condition
   * before. */
  VolumeSums<2> solve(const BoundaryCondition condition,
                      const double tolerance,
                      const std::function<void()> &case_done = {}) override;

  bool is_here() const override
  {
    return is_root;
  }
  MPI_Comm communicator() const override
  {
    return MPI_COMM_SELF;
  }
  void for_each(const Action &action) const override;
  void for_each_sample(const Sample &visit) const override;
  void write(const std::string &path,
             const std::vector<CellDataset> &datasets,
             const std::size_t n,
             const Values &values) const override;

private:
  const UniformGrid<2> grid;
  const UniformMaterial material;
  const bool is_root;
  std::unique_ptr<ElasticBody<2>> body;
  std::vector<LoadCaseSolutions> solutions;
  std::size_t current = 0; ///< index in `solutions` of the current condition
};
} // namespace mesoslip

#endif
