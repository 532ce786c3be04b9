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

/** Polynomial of a smoother: its degree, and the share of the spectrum it works on, from
 *  the largest eigenvalue down to this fraction of it. */
struct Smoothing
{
  unsigned int degree = 2;      ///< steps
  double range        = 1. / 8; ///< of the spectrum
};

/** Stiffness of springs that hold nodes, in units of that of the kernels; without numbers there are
 *  none. */
struct Springs
{
  VoxelField<float> direct; ///< xx, yy and zz
  VoxelField<float> mixed;  ///< yz, xz and xy
};

/** A grid of the multigrid: stiffness in single precision and Chebyshev's smoother with the
 *  diagonal. */
class Level
{
public:
  /** Estimates the largest eigenvalue of D^-1 K where what is @p held is left out. */
  Level(const VoxelGrid &grid, CellStiffness &&stiffness, const HeldComponents &held);

  /** Holds other components of Sides::mixed, and nodes by springs; the estimate stays, which is not
   *  less than that where none is held. */
  void hold(const HeldComponents &held, const Springs &by_springs = {});

  /** Places of the held components in the numbers of a VoxelField. */
  const std::vector<std::size_t> &held() const
  {
    return held_places;
  }

  /** Zero for the components of @p field, the numbers of a VoxelField, that are held. */
  void clear_held(float *field) const;

  /** From now on the stiffness is that of the phases of the cells, which have to outlive it,
   *  as in kernels.h; what is stored is given back. @p table: as SweepArguments has it, @p
   *  of_product: that of product(). */
  void take_phases(const CellIndices &phases,
                   const Source kind_of_phases,
                   LineVector<float> &&table,
                   LineVector<float> &&of_product);

  /** out = K x, ghosts of x set; returns x.K x over all ranks. Collective. */
  double product(VoxelField<float> &x, VoxelField<float> &out);

  /** out = b - K x. */
  void residual(VoxelField<float> &x, const VoxelField<float> &b, VoxelField<float> &out);

  /** Improves x, or starts from zero. @p d is overwritten. */
  void smooth(const Smoothing &smoothing,
              const bool from_zero,
              VoxelField<float> &x,
              const VoxelField<float> &b,
              VoxelField<float> &d);

  const VoxelGrid grid;    ///< its cells
  CellStiffness stiffness; ///< of them

  /** Part of a row of the stiffness of springs; places in the numbers of a VoxelField. */
  struct Spring
  {
    std::size_t row    = 0;  ///< place of the component of the force
    std::size_t column = 0;  ///< place of that of the displacement
    float stiffness    = 0.; ///< in units of that of the kernels
  };

  /** Those of this rank's nodes. */
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

  /** [z][y][n_diagonals][stride]; equal for the three components of cubes unless some are
   *  held. */
  LineVector<float> inverse;
  std::vector<std::size_t>
    held_places; ///< in fields, and in inverse, which is zero there
  std::vector<Spring> all_springs;
  std::vector<std::pair<std::size_t, float>> replaced; ///< of inverse, by springs or zero
  VoxelField<float> left;                              ///< residual of a step on springs
  LineVector<float> work;
  LineVector<float> table, product_table;
  const CellIndices *phase = nullptr;
  Cells cells;
  Source source  = Source::stored;
  double largest = 0.;
};

/** Stiffness of a brick for each coefficient of the kernels; of a flat grid the unknowns along
 *  x and z of both ends of y are the same, and those along y are none. */
std::vector<BrickMatrix> cell_matrices(const VoxelGrid &grid,
                                       const unsigned int n_coefficients);

/** What the cells of a grid are, with so many coefficients. */
Cells cells_of(const VoxelGrid &grid, const unsigned int n_coefficients);

/** The sweep for these cells. */
template <typename Number>
auto sweep_of(const Kernels::Sweeps<Number> &sweeps,
              const Source source,
              const Cells cells)
{
  return sweeps[static_cast<unsigned int>(source)][static_cast<unsigned int>(cells)];
}

/** Arguments of a sweep that follow from the grid. @p work gets its size. */
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
