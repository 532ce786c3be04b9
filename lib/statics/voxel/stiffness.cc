#include "statics/voxel/stiffness.h"

#include "base/exchange.h"
#include "elasticity/brick/brick_matrices.h"
#include "material/stiffness.h"

#include <algorithm>

namespace mesoslip::voxel
{
namespace
{
/** Largest number of phases, including the number after them for the outside of
 * the body. */
constexpr std::size_t most_phases = 65536;
/** Ratio of stiffness from which smoothing is increased. It saves iterations, but time
 * only for nearly incompressible phases and if few steps hardly converge. */
constexpr double strong_ratio = 400.;

/** Largest over smallest diagonal entry of the occurring phases: large for high contrast
 * and for nearly incompressible phases. */
double stiffness_ratio(const std::vector<double> &n_cells,
                       const std::vector<ElasticPhase<3>> &phases,
                       const VoxelGrid &grid)
{
  double smallest = 1e300, largest = 0.;
  for (std::size_t phase = 0; phase < phases.size(); ++phase)
    if (n_cells[phase] > 0.)
      for (unsigned int n = 0; n < grid.n_load_cases(); ++n)
        {
          const unsigned int m = grid.load_case(n);
          smallest             = std::min(smallest, phases[phase].stiffness(m, m));
          largest              = std::max(largest, phases[phase].stiffness(m, m));
        }
  return largest / smallest;
}

/** Numbers of cells of @p n_phases phases on all ranks. */
std::vector<double> count_cells(const CellPlanes &cells, const std::size_t n_phases)
{
  std::vector<double> n(n_phases, 0.);
  on_all_ranks(cells.communicator, [&]() {
    for (std::size_t k = 0; k < cells.own.size(); ++k)
      {
        if (cells.own[k] >= n_phases || n_phases >= most_phases)
          throw std::invalid_argument("A cell has a phase without a stiffness.");
        n[cells.own[k]] += 1.;
      }
  });
  mesoslip::sum_over_ranks(n, cells.communicator);
  return n;
}

/** Phases of the cells in a rank's fields, [z][y][stride]; @p outside marks no cell. */
CellIndices
padded_phases(const CellPlanes &cells, const VoxelGrid &grid, const std::size_t outside)
{
  const std::size_t stride             = grid.stride();
  const std::array<unsigned int, 3> &n = grid.cells;
  // Maps a cell number in a field, ghosts included, to the number in the box.
  const auto cell = [&](const std::size_t number, const unsigned int axis) {
    return grid.is_periodic(axis) ? (number + n[axis] - 1) % n[axis]
                                  : number - grid.first();
  };
  std::vector<unsigned int> planes;    // number in the box
  std::vector<std::size_t> first_rows; // first rows of these planes in the field
  for (std::size_t k = 0; k <= grid.n_nodes(2); ++k)
    if (const std::size_t plane = cell(k + grid.below(), 2); plane < n[2])
      {
        planes.push_back(static_cast<unsigned int>(plane));
        first_rows.push_back(k * grid.cell_rows_in_plane());
      }
  const CellIndices brought = cells.bring(planes, outside);
  CellIndices phases(grid.n_cell_rows() * stride, outside);
  for (std::size_t k = 0; k < planes.size(); ++k)
    for (std::size_t j = 0; j < grid.cell_rows_in_plane(); ++j)
      for (std::size_t i = 0; i <= grid.n_nodes(0); ++i)
        {
          const std::array<std::size_t, 2> at = {
            {cell(i, 0), grid.flat ? 0 : cell(j, 1)}};
          if (at[0] < n[0] && at[1] < n[1])
            phases.set((first_rows[k] + j) * stride + i,
                       brought[(k * n[1] + at[1]) * n[0] + at[0]]);
        }
  return phases;
}

/** In-plane part of a phase on a flat grid. */
ElasticPhase<2> in_plane(const VoxelGrid &grid, const ElasticPhase<3> &phase)
{
  ElasticPhase<2> plane{VoigtMatrix<2>::Zero(), 0., phase.mean_dilatation};
  for (unsigned int i = 0; i < n_voigt<2>; ++i)
    for (unsigned int j = 0; j < n_voigt<2>; ++j)
      plane.stiffness(i, j) = phase.stiffness(grid.load_case(i), grid.load_case(j));
  return plane;
}

/** Phases for the preconditioner, which a multigrid can smooth. */
std::vector<ElasticPhase<3>> to_precondition(const VoxelGrid &grid,
                                             const std::vector<ElasticPhase<3>> &phases)
{
  std::vector<ElasticPhase<3>> result = phases;
  for (ElasticPhase<3> &phase : result)
    if (!grid.flat)
      phase = phase_to_precondition(phase);
    else
      {
        const auto plane = phase_to_precondition(in_plane(grid, phase));
        for (unsigned int i = 0; i < n_voigt<2>; ++i)
          for (unsigned int j = 0; j < n_voigt<2>; ++j)
            phase.stiffness(grid.load_case(i), grid.load_case(j)) = plane.stiffness(i, j);
      }
  return result;
}

/** The kernels' coefficients of a phase. */
std::vector<double> coefficients_in(const VoxelGrid &grid,
                                    const ElasticPhase<3> &phase,
                                    const unsigned int n_coefficients)
{
  if (!grid.flat)
    return coefficients_of(phase, n_coefficients);
  const ElasticPhase<2> plane = in_plane(grid, phase);
  std::vector<double> result;
  for (const VoigtMatrix<2> &D : {plane.stiffness, plane.stiffness_about_mean()})
    for (const StiffnessEntry &entry : stiffness_entries<2>())
      result.push_back(D(entry.row, entry.column));
  result.resize(n_coefficients);
  return result;
}

/** Number of coefficients that describe all occurring phases. */
unsigned int n_coefficients_for(const std::vector<ElasticPhase<3>> &phases,
                                const std::vector<double> &n_cells,
                                const bool flat)
{
  bool general = CellIndices::is_wide(phases.size()), apart = false;
  for (std::size_t phase = 0; phase < phases.size(); ++phase)
    if (n_cells[phase] > 0.)
      {
        general |= !is_isotropic(phases[phase].stiffness);
        apart |= phases[phase].mean_dilatation;
      }
  if (flat)
    return apart ? n_plane_apart : n_plane;
  if (general)
    return apart ? n_general_apart : n_general;
  return apart ? n_isotropic_apart : n_isotropic;
}

Multigrid::Options options_for(const double ratio)
{
  if (ratio < strong_ratio)
    return {{2, 1. / 10.}, 2, 8};
  return {{4, 1. / 20.}, 4, 32};
}

/** The box in edges along y, divided among the ranks. */
VoxelGrid divided_grid(VoxelGrid grid, const CellPlanes &cells)
{
  grid.cells = cells.grid.cells;
  for (unsigned int d = 0; d < 3; ++d)
    grid.spacing[d] = cells.grid.spacing[d] / cells.grid.spacing[1];
  divide(grid, cells.communicator);
  return grid;
}

double largest_modulus(const std::vector<double> &n_cells,
                       const std::vector<ElasticPhase<3>> &phases)
{
  double largest = 0.;
  for (std::size_t phase = 0; phase < phases.size(); ++phase)
    if (n_cells[phase] > 0.)
      largest = std::max(largest, phases[phase].stiffness.cwiseAbs().maxCoeff());
  return largest;
}
} // namespace

Stiffness::Stiffness(const CellPlanes &cells,
                     const std::vector<ElasticPhase<3>> &of_phases,
                     const VoxelGrid &kind)
  : of_phases(of_phases)
  , length(cells.grid.spacing[1])
  , grid(divided_grid(kind, cells))
  , n_cells(count_cells(cells, of_phases.size()))
  , phases(padded_phases(cells, grid, of_phases.size()))
  , modulus(largest_modulus(n_cells, of_phases))
{
  n_coefficients = n_coefficients_for(of_phases, n_cells, grid.flat);
  source =
    of_phases.size() + 1 <= kernels().few_phases ? Source::few_phases : Source::phases;
  if (CellIndices::is_wide(of_phases.size()))
    {
      if (grid.flat)
        throw std::invalid_argument("A flat box has more than 255 phases.");
      source = Source::materials;
    }
  const auto gentle = to_precondition(grid, of_phases);
  table             = make_table(of_phases);
  preconditioner    = make_table(gentle);
  ratio             = stiffness_ratio(n_cells, gentle, grid);
}

/** Index of a coefficient of a phase in the table, see SweepArguments. */
std::size_t Stiffness::in_table(const unsigned int coefficient,
                                const std::size_t phase) const
{
  if (source == Source::materials)
    return phase * n_of_material(n_coefficients) + coefficient;
  return std::size_t{256} * coefficient + phase;
}

/** Table of the coefficients of the phases, in units. */
LineVector<double> Stiffness::make_table(const std::vector<ElasticPhase<3>> &of) const
{
  const unsigned int n = n_in_table(cells_of(grid, n_coefficients));
  LineVector<double> result(source == Source::materials
                              ? (of.size() + 1) * n_of_material(n)
                              : std::size_t{256} * (n + 1),
                            0.);
  for (std::size_t phase = 0; phase < of.size(); ++phase)
    if (n_cells[phase] > 0.)
      {
        const std::vector<double> c = coefficients_in(grid, of[phase], n);
        for (unsigned int m = 0; m < n; ++m)
          result[in_table(m, phase)] = c[m] / modulus * grid.factor();
        result[in_table(n, phase)] = 1.;
      }
  return result;
}

std::unique_ptr<Multigrid> Stiffness::make_multigrid(HeldComponents held) const
{
  const std::size_t stride = grid.stride();
  CellStiffness cells;
  cells.n_coefficients = n_coefficients;
  cells.numbers.resize(grid.n_cell_rows() * n_coefficients * stride);
  for (std::size_t row = 0; row < grid.n_cell_rows(); ++row)
    for (unsigned int m = 0; m < n_coefficients; ++m)
      for (std::size_t i = 0; i < stride; ++i)
        cells.numbers[(row * n_coefficients + m) * stride + i] =
          static_cast<float>(preconditioner[in_table(m, phases[row * stride + i])]);
  auto multigrid = std::make_unique<Multigrid>(grid, std::move(cells), options_for(ratio),
                                               std::move(held));
  multigrid->finest().take_phases(phases, source,
                                  {preconditioner.begin(), preconditioner.end()},
                                  {table.begin(), table.end()});
  return multigrid;
}

double Stiffness::forces(const CellLoad &load,
                         VoxelField<double> &v,
                         VoxelField<float> &out,
                         double *exact) const
{
  SweepArguments<double> a = sweep_arguments(grid, work);
  a.x                      = v.data();
  a.out                    = out.data();
  a.exact                  = exact;
  a.phase                  = phases.bytes();
  a.material               = phases.words();
  a.table                  = table.data();
  std::copy(load.strain.begin(), load.strain.end(), a.strain);
  std::copy(load.stress.begin(), load.stress.end(), a.stress);
  const Cells cells = cells_of(grid, n_coefficients);
  return sum_over_ranks(grid, sweep_of<double>(kernels().outer, source, cells)(a));
}
} // namespace mesoslip::voxel
