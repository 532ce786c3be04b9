#include "material/stiffness.h"
#include "statics/voxel/solver.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <numeric>

namespace mesoslip::voxel
{
namespace
{
/** Mean strains of a row of cells, [Voigt component]. */
using RowOfStrains = std::array<std::vector<double>, 6>;

/** Adds the mean strains of a row of cells by component @p c along four rows of nodes,
 * numbered y + 2 z; @p unit is 1 / (4 h). */
void add_strains(const double *const at[4],
                 const double unit[3],
                 const double factor,
                 const unsigned int c,
                 std::array<std::vector<double>, 6> &strain)
{
  double *out[3];
  for (unsigned int d = 0; d < 3; ++d)
    out[d] = strain[voigt_index<3>(c, d)].data();
  const double x = factor * unit[0], y = factor * unit[1], z = factor * unit[2];
  const std::size_t n = strain[0].size();
  for (std::size_t i = 0; i < n; ++i)
    {
      const double n0 = at[0][i] + at[0][i + 1], n1 = at[1][i] + at[1][i + 1],
                   n2 = at[2][i] + at[2][i + 1], n3 = at[3][i] + at[3][i + 1];
      out[0][i] += x * (at[0][i + 1] - at[0][i] + at[1][i + 1] - at[1][i] + at[2][i + 1] -
                        at[2][i] + at[3][i + 1] - at[3][i]);
      out[1][i] += y * (n1 - n0 + n3 - n2);
      out[2][i] += z * (n2 - n0 + n3 - n1);
    }
}

/** Adds the strains of row @p line of plane @p plane of cells (numbers in a field).
 * row(corner, component of a field, j, k) returns one of the four rows of nodes around
 * it, from the first ghost on; on a flat grid these are two rows, each used twice. */
template <typename Row>
void add_strains(const VoxelGrid &grid,
                 const unsigned int line,
                 const unsigned int plane,
                 const Row &row,
                 const double factor,
                 RowOfStrains &strain)
{
  const double unit[3] = {0.25 / grid.spacing[0], 0.25 / grid.spacing[1],
                          0.25 / grid.spacing[2]};
  for (unsigned int c = 0; c < grid.n_components(); ++c)
    {
      const double *at[4];
      for (unsigned int corner = 0; corner < 4; ++corner)
        at[corner] =
          row(corner, c, line + (corner & 1U), plane + (corner >> 1)) + grid.first();
      add_strains(at, unit, factor, grid.axis_of(c), strain);
    }
}
} // namespace

/** Index in the phases of the first cell of a row. */
std::size_t Solver::first_cell_of_row(const unsigned int line,
                                      const unsigned int plane) const
{
  return K.grid.cell_row(line, plane) * K.grid.stride() + K.grid.first();
}

/** Stores the displacements u of load case @p k and the sums needed later. */
void Solver::keep(const unsigned int k)
{
  sum_strains(k);
  iteration.release(); // before memory is allocated
  kept[k] = PackedField();
  kept[k] = PackedField(u);
  for (unsigned int l = 0; l <= k && k != heat; ++l)
    if (!kept[l].empty())
      corrections(l, k) = dot_with_kept(l);
}

/** r.u of load case @p k, summed over the ranks. */
double Solver::dot_with_kept(const unsigned int k)
{
  LineVector<double> row(K.grid.stride());
  double sum = 0.;
  for (unsigned int plane = 1; plane <= K.grid.n_nodes(2); ++plane)
    for (unsigned int line = 1; line <= K.grid.n_nodes(1); ++line)
      for (unsigned int c = 0; c < K.grid.n_components(); ++c)
        {
          // The ghosts of the residual are zero.
          kept[k].read_row(c, line, plane, row.data());
          sum +=
            kernels().mixed_dot(row.size(), iteration.r.row(c, line, plane), row.data());
        }
  return sum_over_ranks(K.grid, sum);
}

/** Sets column @p k of the strain sums of each phase, from the displacements u. */
void Solver::sum_strains(const unsigned int k)
{
  std::vector<double> sums(6 * strains.size());
  RowOfStrains strain;
  for (unsigned int plane = 0; plane < K.grid.n_cell_planes(); ++plane)
    for (unsigned int j = 0; j < K.grid.cells[1]; ++j)
      {
        const unsigned int line = j + K.grid.first(),
                           at   = plane + K.grid.first_cell_plane();
        for (std::vector<double> &component : strain)
          component.assign(K.grid.cells[0], 0.);
        add_strains(
          K.grid, line, at,
          [this](unsigned int, unsigned int c, unsigned int y, unsigned int z) {
            return u.row(c, y, z);
          },
          1., strain);
        const std::size_t first = first_cell_of_row(line, at);
        for (unsigned int m = 0; m < 6; ++m)
          for (unsigned int i = 0; i < K.grid.cells[0]; ++i)
            sums[6 * std::size_t{K.phases[first + i]} + m] += strain[m][i];
      }
  sum_over_ranks(K.grid, sums.data(), static_cast<unsigned int>(sums.size()));
  for (std::size_t id = 0; id < strains.size(); ++id)
    strains[id].col(k) = Eigen::Map<const VoigtVector<3>>(&sums[6 * id]);
}

std::vector<Solver::PhaseStrains> Solver::phase_strains() const
{
  std::vector<PhaseStrains> result;
  for (std::size_t id = 0; id < strains.size(); ++id)
    {
      result.push_back({K.n_cells[id], strains[id]});
      auto of_unit_loads = result[id].sum.leftCols<6>();
      if (K.grid.sides == Sides::free)
        of_unit_loads /= K.modulus;
      else
        of_unit_loads += K.n_cells[id] * VoigtMatrix<3>::Identity();
    }
  return result;
}

/** Volume mean of the stiffness, in units of the modulus. */
VoigtMatrix<3> Solver::mean_stiffness() const
{
  const double all    = std::accumulate(K.n_cells.begin(), K.n_cells.end(), 0.);
  VoigtMatrix<3> mean = VoigtMatrix<3>::Zero();
  for (std::size_t id = 0; id < K.of_phases.size(); ++id)
    mean += K.n_cells[id] / all * K.of_phases[id].stiffness / K.modulus;
  return mean;
}

VoigtMatrix<3> Solver::effective_stiffness() const
{
  AssertThrow(n_solved == K.grid.n_load_cases(),
              dealii::ExcMessage("All load cases have to be solved."));
  if (!multigrid)
    return mean_stiffness() * K.modulus;
  // Loads are constant stresses in each cell: their work is the work on mean strains.
  const double cells          = 1. * K.grid.cells[0] * K.grid.cells[1] * K.grid.cells[2];
  const double volume         = K.grid.spacing[0] * K.grid.spacing[1] * K.grid.spacing[2];
  VoigtMatrix<3> work_of_load = VoigtMatrix<3>::Zero();
  for (std::size_t id = 0; id < strains.size(); ++id)
    if (K.grid.sides == Sides::free)
      work_of_load += strains[id].leftCols<6>() / cells;
    else
      work_of_load -=
        K.of_phases[id].stiffness / K.modulus * strains[id].leftCols<6>() / cells;
  for (unsigned int k = 0; k < 6; ++k)
    for (unsigned int l = k; l < 6; ++l)
      work_of_load(k, l) = work_of_load(l, k) =
        work_of_load(k, l) + corrections(k, l) / (volume * cells);
  if (K.grid.flat) // makes the matrix invertible
    for (const unsigned int k : {1, 3, 5})
      work_of_load(k, k) = 1.;
  if (K.grid.sides == Sides::free)
    return inverse<3>(work_of_load) * K.modulus;
  return (mean_stiffness() - work_of_load) * K.modulus;
}

void Solver::read_phases(const unsigned int line,
                         const unsigned int plane,
                         std::vector<unsigned int> &phase) const
{
  phase.resize(K.grid.cells[0]);
  for (unsigned int i = 0; i < K.grid.cells[0]; ++i)
    phase[i] = K.phases[first_cell_of_row(line, plane) + i];
}

/** Factor from stored displacements to displacements under a unit load, in units of
 * length. */
double Solver::unit_of_kept(const unsigned int load) const
{
  return K.grid.sides == Sides::free && load != heat ? 1. / K.modulus : 1.;
}

void Solver::evaluate(const unsigned int j, const unsigned int k, NodesOfRow &row) const
{
  const unsigned int plane = k + K.grid.first_cell_plane(), line = j + K.grid.first();
  read_phases(line, plane, row.phase);
  row.first = K.grid.first();
  for (unsigned int load = 0; load <= heat; ++load)
    row.factor[load] = unit_of_kept(load);
  for (unsigned int load = 0; load <= heat; ++load)
    for (unsigned int c = 0; c < K.grid.n_components() && !kept[load].empty(); ++c)
      for (unsigned int side = 0; side < 4; ++side)
        {
          std::vector<double> &values = row.u[load][c][side];
          values.resize(kept[load].n_in_row());
          kept[load].read_row(c, line + (side & 1U), plane + (side >> 1), values.data());
        }
}

void Solver::evaluate(const unsigned int j, const unsigned int k, RowOfCells &row) const
{
  const unsigned int plane = k + K.grid.first_cell_plane(), line = j + K.grid.first();
  read_phases(line, plane, row.phase);
  const bool free = K.grid.sides == Sides::free;
  std::array<std::vector<double>, 4> nodes;
  for (unsigned int load = 0; load <= heat; ++load)
    {
      for (unsigned int m = 0; m < 6; ++m)
        row.strain[load][m].assign(K.grid.cells[0], !free && m == load ? 1. : 0.);
      if (kept[load].empty())
        continue;
      for (std::vector<double> &corner : nodes)
        corner.resize(kept[load].n_in_row());
      add_strains(
        K.grid, line, plane,
        [&](unsigned int corner, unsigned int c, unsigned int y, unsigned int z) {
          kept[load].read_row(c, y, z, nodes[corner].data());
          return nodes[corner].data();
        },
        unit_of_kept(load), row.strain[load]);
    }
}
} // namespace mesoslip::voxel
