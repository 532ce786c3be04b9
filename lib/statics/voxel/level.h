#ifndef mesoslip_statics_voxel_level_h
#define mesoslip_statics_voxel_level_h

#include "elasticity/brick/brick_matrices.h"
#include "grid/cell_indices.h"
#include "statics/voxel/kernels/kernels.h"
#include "statics/voxel/voxel_field.h"

#include <utility>
#include <vector>

namespace mesoslip::voxel
{
/** Coefficients of the cells of a grid, as in kernels.h: [z][y][coefficient][stride]. */
struct CellStiffness
{
  unsigned int n_coefficients = 0; ///< n_isotropic, n_general or n_plane, apart or not
  LineVector<float> numbers;       ///< zero outside of the body

  /** Coefficient @p m of a row of cells. */
  float *row(const VoxelGrid &grid,
             const unsigned int m,
             const unsigned int j,
             const unsigned int k)
  {
    return &numbers[(grid.cell_row(j, k) * n_coefficients + m) * grid.stride()];
  }
};

/** Polynomial of a smoother: its degree and the part of the spectrum it damps, from the
 * largest eigenvalue down to this fraction of it. */
struct Smoothing
{
  unsigned int degree = 2;      ///< number of steps
  double range        = 1. / 8; ///< fraction of the largest eigenvalue
};

/** Stiffness of springs at nodes, in the kernels' unit; empty fields: no springs. */
struct Springs
{
  VoxelField<float> direct; ///< xx, yy and zz
  VoxelField<float> mixed;  ///< yz, xz and xy
};

/** A grid of the multigrid: stiffness in single precision and a Chebyshev smoother with
 * the diagonal. */
class Level
{
public:
  /** Estimates the largest eigenvalue of D^-1 K without the constrained components
   * @p held. */
  Level(const VoxelGrid &grid, CellStiffness &&stiffness, const HeldComponents &held);

  /** Sets constrained components of Sides::mixed and springs. The eigenvalue estimate is
   * kept: it is an upper bound, since it was made without them. */
  void hold(const HeldComponents &held, const Springs &by_springs = {});

  /** Indices of constrained components in the numbers of a VoxelField. */
  const std::vector<std::size_t> &held() const
  {
    return held_places;
  }

  /** Sets the constrained components of @p field, the numbers of a VoxelField, to
   * zero. */
  void clear_held(float *field) const;

  /** Looks stiffness up by phase from now on (as in kernels.h) and frees the per-cell
   * coefficients. @p phases must outlive the level. @p table: see SweepArguments,
   * @p of_product: the table of product(). */
  void take_phases(const CellIndices &phases,
                   const Source kind_of_phases,
                   LineVector<float> &&table,
                   LineVector<float> &&of_product);

  /** out = K x, with ghosts of x set; returns x.K x over all ranks. Collective. */
  double product(VoxelField<float> &x, VoxelField<float> &out);

  /** out = b - K x. */
  void residual(VoxelField<float> &x, const VoxelField<float> &b, VoxelField<float> &out);

  /** Improves x, or starts from zero. @p d is overwritten. */
  void smooth(const Smoothing &smoothing,
              const bool from_zero,
              VoxelField<float> &x,
              const VoxelField<float> &b,
              VoxelField<float> &d);

  const VoxelGrid grid;    ///< nodes and cells
  CellStiffness stiffness; ///< coefficients of the cells

  /** An entry of the spring stiffness matrix; indices refer to the numbers of a
   * VoxelField. */
  struct Spring
  {
    std::size_t row    = 0;  ///< index of the force component
    std::size_t column = 0;  ///< index of the displacement component
    float stiffness    = 0.; ///< in the kernels' unit
  };

  /** Spring entries of locally owned nodes. */
  const std::vector<Spring> &springs() const
  {
    return all_springs;
  }

private:
  SweepArguments<float> arguments(VoxelField<float> &x);
  void take_springs(const Springs &given);
  void add_forces_of_springs(const VoxelField<float> &x, VoxelField<float> &forces) const;
  void step_on_springs(const SweepArguments<float> &step,
                       VoxelField<float> &x,
                       const VoxelField<float> &b,
                       VoxelField<float> &d);
  unsigned int n_diagonals() const
  {
    return cells == Cells::cubes && grid.sides != Sides::mixed ? 1 : grid.n_components();
  }
  void first_step(const float factor, const VoxelField<float> &b, VoxelField<float> &x);
  void set_inverse_diagonal();
  void estimate_largest_eigenvalue();

  /** [z][y][n_diagonals][stride]; one value for the three components of cubes unless some
   * are constrained. */
  LineVector<float> inverse;
  std::vector<std::size_t>
    held_places; ///< constrained indices in fields and in `inverse`, which is zero there
  std::vector<Spring> all_springs;
  std::vector<std::pair<std::size_t, float>> replaced; ///< entries, original values
  VoxelField<float> left;                              ///< residual of a step on springs
  LineVector<float> work;
  LineVector<float> table, product_table;
  const CellIndices *phase = nullptr;
  Cells cells;
  Source source  = Source::stored;
  double largest = 0.;
};

/** Stiffness of a brick for each coefficient of the kernels; on a flat grid the unknowns
 * along x and z at both ends of y coincide, and there are none along y. */
std::vector<BrickMatrix> cell_matrices(const VoxelGrid &grid,
                                       const unsigned int n_coefficients);

/** Kind of the cells of a grid with this number of coefficients. */
Cells cells_of(const VoxelGrid &grid, const unsigned int n_coefficients);

/** The sweep for a source and kind of cells. */
template <typename Number>
auto sweep_of(const Kernels::Sweeps<Number> &sweeps,
              const Source source,
              const Cells cells)
{
  return sweeps[static_cast<unsigned int>(source)][static_cast<unsigned int>(cells)];
}

/** Arguments of a sweep that follow from the grid. Resizes @p work. */
template <typename Number>
SweepArguments<Number> sweep_arguments(const VoxelGrid &grid, LineVector<Number> &work)
{
  SweepArguments<Number> a = {};
  for (unsigned int d = 0; d < 3; ++d)
    a.n[d] = grid.n_nodes(d);
  a.stride   = grid.stride();
  a.periodic = grid.is_periodic(0);
  a.ratio[0] = static_cast<Number>(grid.ratio(0));
  a.ratio[1] = static_cast<Number>(grid.ratio(2));
  work.resize((n_work_rows + 6 * (std::size_t{a.n[1]} + 1)) * a.stride);
  a.work = work.data();
  return a;
}
} // namespace mesoslip::voxel

#endif
