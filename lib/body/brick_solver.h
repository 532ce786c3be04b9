#ifndef mesoslip_body_brick_solver_h
#define mesoslip_body_brick_solver_h

#include "body/brick_body.h"
#include "body/rigid_motions.h"
#include "statics/voxel/conjugate_gradients.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * Static solver of a GridBody<3>: conjugate gradients with voxel multigrid; components of
 * any nodes may be constrained. Coarse grids ignore constraints at few nodes. The
 * remaining rigid motions are therefore solved for separately, with R, the rigid motions
 * set to zero at constrained components, and the inverse of R.(K + S) R. If single
 * precision does not suffice, iterations in double precision follow.
 */
class BrickSolver : public StaticSolver
{
public:
  /** @p body must outlive it. */
  explicit BrickSolver(const GridBody<3> &body);

  void set_constrained(const DofMask &mask) override
  {
    set_constrained_on_springs(mask, {});
  }

  void set_constrained_on_springs(const DofMask &mask,
                                  const std::vector<SpringEntry> &more) override;

  SolverReport solve(NodalField<double> &u,
                     const NodalField<double> &force,
                     const double tolerance) override;

private:
  using Field  = voxel::VoxelField<double>;
  using Motion = Eigen::Matrix<double, 3, 4>; ///< coefficients of 1, x, y, z (m)

  /** A spring between two entries of voxel fields, in units of the stiffness. */
  struct Spring
  {
    std::size_t row, column;
    double stiffness;
  };

  void take_springs(const std::vector<SpringEntry> &on, voxel::Springs &fields);
  void find_motions(const DofMask &mask, const std::vector<SpringEntry> &on);
  Motion motion_of(const RigidMotions<3>::Coefficients &coefficients) const;
  void condense_motions();
  void keep_held(Field &field) const;
  void clear_held(Field &field) const;
  void take_forces(Field &v, voxel::VoxelField<float> &rounded);
  double unbalanced(Field &v, voxel::VoxelField<float> &rounded);
  std::array<double, 2> along_row(const Motion &motion,
                                  const unsigned int c,
                                  const unsigned int j,
                                  const unsigned int k) const;
  double square_of(const Field &field) const;
  template <typename Number>
  void add_motion(const Motion &motion, voxel::VoxelField<Number> &field) const;
  template <typename Number>
  double dot(const Motion &motion, const voxel::VoxelField<Number> &field) const;
  void remove_motions(Field &field) const;

  void iterate_in_double(const voxel::ConjugateGradients::Problem &problem,
                         SolverReport &report);
  void move_rigidly(voxel::VoxelField<float> &z, const voxel::VoxelField<float> &r) const;

  const GridBody<3> &body;
  const voxel::Stiffness &K;
  std::unique_ptr<voxel::Multigrid> multigrid;
  voxel::ConjugateGradients iteration;
  Field load, product, correction;
  std::vector<Spring> springs;
  std::vector<Motion> motions;   ///< unconstrained rigid motions, orthonormal
  std::vector<Motion> rigid;     ///< all rigid motions, the columns of R
  Eigen::MatrixXd inverse_rigid; ///< inverse of R.(K + S) R; empty if the matrix is zero
};
} // namespace mesoslip

#endif
