#include "base/exchange.h"
#include "body/mesh/cell_values.h"
#include "body/mesh/condensed_cells.h"
#include "homogenization/volumes/mesh_volume.h"
#include "io/parallel_rows.h"
#include "mesh/point_blocks.h"

#include <cmath>

namespace mesoslip
{
// The unknown of KUBC and PBC is the fluctuation. The tolerance refers to its forces,
// which the heterogeneity causes.
template <int dim>
void MeshVolume<dim>::assemble()
{
  using namespace dealii;
  const IndexSet &owned = mesh.dofs().locally_owned_dofs();
  CondensedCells cells(constraints);
  // MUBC constrain some components of a point and leave the rest free: ML needs all
  // components of a point in the columns of other ranks.
  cells.reinit(matrix, mesh, condition == BoundaryCondition::MUBC);
  if (is_apart)
    cells.reinit(gentle, mesh, condition == BoundaryCondition::MUBC);
  loads = std::vector<Vector>(n_loads);
  for (Vector &load : loads)
    load.reinit(owned, constraints.get_local_lines(), mesh.communicator());
  gross_loads.assign(n_loads, 0.);

  mesoslip::for_each_cell(mesh, [&](const auto &cell, const auto &values,
                                    const auto &indices) {
    const ElasticPhase<dim> &phase = phases[cell.material_id()];
    const VoigtMatrix<dim> &C      = phase.stiffness;
    const auto B                   = cell_strains(values, phase);
    Eigen::MatrixXd f              = Eigen::MatrixXd::Zero(indices.size(), n_loads);
    for (const unsigned int q : values.quadrature_point_indices())
      {
        auto of_unit_loads = f.leftCols(heat);
        if (condition == BoundaryCondition::SUBC)
          of_unit_loads.noalias() += values.JxW(q) * B[q].transpose(); // uniform stress
        else
          of_unit_loads.noalias() -= values.JxW(q) * B[q].transpose() * C;
        f.col(heat).noalias() += values.JxW(q) * B[q].transpose() * phase.thermal_stress;
      }
    cells.add(cell_matrix(values, B, phase), indices, matrix);
    if (is_apart)
      cells.add(cell_matrix(values, B, phase_in_cell(values, phase)), indices, gentle);
    for (unsigned int k = 0; k < n_loads; ++k)
      {
        gross_loads[k] += f.col(k).squaredNorm();
        cells.add(Eigen::VectorXd(f.col(k)), indices, loads[k]);
      }
  });
  matrix.compress();
  if (is_apart)
    gentle.compress();
  for (unsigned int k = 0; k < n_loads; ++k)
    loads[k].compress(VectorOperation::add);
  for (double &gross : gross_loads)
    gross = std::sqrt(mpi::sum(gross, mesh.communicator()));
}

template <int dim>
template <typename Visit>
void MeshVolume<dim>::for_each_point(const Visit &visit) const
{
  UnitStrains<dim> applied = UnitStrains<dim>::Zero();
  if (condition != BoundaryCondition::SUBC)
    applied.setIdentity(); // 0 for heat
  Eigen::MatrixXd u;
  mesoslip::for_each_cell(
    mesh, [&](const auto &cell, const auto &values, const auto &indices) {
      u.setZero(indices.size(), n_loads);
      for (unsigned int i = 0; i < indices.size(); ++i)
        for (unsigned int k = 0; k < n_loads; ++k)
          if (solutions[k].size() > 0)
            u(i, k) = solutions[k](indices[i]);
      const auto B = cell_strains(values, phases[cell.material_id()]);
      for (const unsigned int q : values.quadrature_point_indices())
        visit(cell, UnitStrains<dim>(applied + B[q] * u), values.JxW(q));
    });
}

template <int dim>
VolumeSums<dim> MeshVolume<dim>::integrate() const
{
  VolumeSums<dim> sums;
  sums.condition = condition;
  sums.phases.resize(phases.size());
  for_each_point([&](const auto &cell, const UnitStrains<dim> &strain, const double JxW) {
    PhaseSums<dim> &phase = sums.phases[cell.material_id()];
    phase.strain += JxW * strain;
    phase.volume += JxW;
    const VoigtMatrix<dim> of_unit_loads = strain.template leftCols<heat>();
    sums.energy += JxW * of_unit_loads.transpose() *
                   phases[cell.material_id()].stiffness * of_unit_loads;
  });
  const auto add_up = [this](auto &values) {
    sum_over_ranks(values.data(), static_cast<std::size_t>(values.size()),
                   mesh.communicator());
  };
  add_up(sums.energy);
  for (PhaseSums<dim> &phase : sums.phases)
    {
      add_up(phase.strain);
      phase.volume = mpi::sum(phase.volume, mesh.communicator());
      sums.volume += phase.volume;
    }
  sums.energy /= sums.volume;
  return sums;
}

template <int dim>
void MeshVolume<dim>::for_each_cell(
  const std::function<void(const std::uint64_t, const LocalCell<dim> &)> &action) const
{
  LocalCell<dim> mean;
  std::uint64_t number = 0;
  const auto finish    = [&]() {
    if (!(mean.volume > 0.))
      return;
    mean.strain /= mean.volume;
    action(number, mean);
    mean = LocalCell<dim>();
  };
  for_each_point([&](const auto &cell, const UnitStrains<dim> &strain, const double JxW) {
    const std::uint64_t now = cell.id().get_coarse_cell_id();
    if (now != number)
      finish();
    number            = now;
    mean.phase        = cell.material_id();
    const auto centre = cell.center();
    for (unsigned int d = 0; d < dim; ++d)
      mean.centre[d] = centre[d];
    mean.strain += JxW * strain;
    mean.volume += JxW;
  });
  finish();
}

template <int dim>
void MeshVolume<dim>::for_each(const Action &action) const
{
  for_each_cell(
    [&action](const std::uint64_t, const LocalCell<dim> &cell) { action(cell); });
}

template <int dim>
void MeshVolume<dim>::for_each_sample(const Sample &visit) const
{
  for_each_point([&](const auto &cell, const UnitStrains<dim> &strain, const double JxW) {
    visit(cell.material_id(), JxW, strain);
  });
}

// Each rank writes a contiguous block of cells, in the order of the mesh.
template <int dim>
void MeshVolume<dim>::write(const std::string &path,
                            const std::vector<CellDataset> &datasets,
                            const std::size_t n,
                            const Values &values) const
{
  std::vector<std::uint64_t> numbers;
  std::vector<double> own;
  for_each_cell([&](const std::uint64_t number, const LocalCell<dim> &cell) {
    numbers.push_back(number);
    own.resize(own.size() + n);
    values(cell, &own[own.size() - n]);
  });
  const NumberedBlocks blocks(
    numbers, mpi::sum<std::uint64_t>(numbers.size(), communicator()), communicator());
  for (const CellDataset &dataset : datasets)
    ParallelRows(path, dataset.name, communicator())
      .write_rows(blocks.first(),
                  blocks.gather(own, n, dataset.first, dataset.components));
}

template void MeshVolume<2>::assemble();
template void MeshVolume<3>::assemble();
template VolumeSums<2> MeshVolume<2>::integrate() const;
template VolumeSums<3> MeshVolume<3>::integrate() const;
#define MESOSLIP_INSTANTIATE(dim)                                        \
  template void MeshVolume<dim>::for_each(const Action &) const;         \
  template void MeshVolume<dim>::for_each_sample(const Sample &) const;  \
  template void MeshVolume<dim>::write(const std::string &,              \
                                       const std::vector<CellDataset> &, \
                                       const std::size_t, const Values &) const;
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
