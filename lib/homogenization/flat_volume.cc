#include "homogenization/flat_volume.h"

namespace mesoslip
{
namespace
{
/** Place of component @p m (xx, yy, xy) in the Voigt order of space, where y is called z. */
constexpr unsigned int place(const unsigned int m)
{
  return 2 * m;
}

/** The same matrix in space; what is not in the plane is zero. */
VoigtMatrix<3> in_space(const VoigtMatrix<2> &plane)
{
  VoigtMatrix<3> result = VoigtMatrix<3>::Zero();
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      result(place(i), place(j)) = plane(i, j);
  return result;
}

/** The part of a matrix that is in the plane. */
VoigtMatrix<2> in_plane(const VoigtMatrix<3> &space)
{
  VoigtMatrix<2> result;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      result(i, j) = space(place(i), place(j));
  return result;
}

std::vector<ElasticPhase<3>> in_space(const std::vector<ElasticPhase<2>> &phases)
{
  std::vector<ElasticPhase<3>> result;
  for (const ElasticPhase<2> &phase : phases)
    result.push_back({in_space(phase.stiffness), phase.density});
  return result;
}

/** One cell thick; how thick it is does not matter. */
UniformGrid<3> in_space(const UniformGrid<2> &grid)
{
  return {{{grid.cells[0], 1, grid.cells[1]}},
          {{grid.spacing[0], grid.spacing[0], grid.spacing[1]}},
          {{grid.origin[0], 0., grid.origin[1]}}};
}
} // namespace

FlatVolume::FlatVolume(const UniformGrid<2> &grid,
                       const CellView &phase_id,
                       const std::vector<ElasticPhase<2>> &the_phases,
                       const MPI_Comm communicator)
  : phases(the_phases)
  , rows(scatter_planes(in_space(grid), phase_id, the_phases.size(), communicator))
  , volume(
      CellPlanes(in_space(grid), rows.view(), communicator), in_space(the_phases), true)
{
}

VolumeSums<2> FlatVolume::solve(const BoundaryCondition wanted,
                                const double tolerance,
                                const std::function<void()> &case_done)
{
  condition                 = wanted;
  const VolumeSums<3> space = volume.solve(wanted, tolerance, case_done);
  VolumeSums<2> sums;
  sums.condition = wanted;
  for (const PhaseSums<3> &phase : space.phases)
    sums.phases.push_back({in_plane(phase.strain), phase.volume});
  sums.volume = space.volume;
  sums.energy = in_plane(space.energy);
  for (unsigned int m = 0; m < 3; ++m)
    sums.reports[m] = space.reports[place(m)];
  return sums;
}

void FlatVolume::for_each_cell(
  const unsigned int k,
  const std::function<void(const unsigned int, const VoigtMatrix<2> &)> &action) const
{
  volume.for_each_cell(k, [&](const unsigned int phase, const VoigtMatrix<3> &strain) {
    action(phase, in_plane(strain));
  });
}

std::vector<double> FlatVolume::concentration(const unsigned int k) const
{
  std::vector<double> tensors;
  for_each_cell(k, [&](const unsigned int phase, const VoigtMatrix<2> &strain) {
    const VoigtMatrix<2> tensor = condition == BoundaryCondition::SUBC
                                    ? VoigtMatrix<2>(phases[phase].stiffness * strain)
                                    : strain;
    tensors.insert(tensors.end(), tensor.data(), tensor.data() + tensor.size());
  });
  return tensors;
}
} // namespace mesoslip
