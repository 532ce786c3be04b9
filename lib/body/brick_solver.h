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
 * Statics of a GridBody<3>: conjugate gradients with the multigrid of voxels, in which components of
 * any nodes may be held. Coarse grids do not know of holds at few nodes; what they leave of rigid
 * motions is solved for besides: with R, the motions where nothing is held, and the inverse of
 * R.(K + S) R. Where single precision does not do, directions in double precision follow.
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
  using Motion = Eigen::Matrix<double, 3, 4>; ///< of 1, x, y, z (m)

  /** In the fields of voxels, in units of the stiffness. */
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
  std::vector<Motion> motions;   ///< that nothing holds, orthonormal
  std::vector<Motion> rigid;     ///< all, of which R is made
  Eigen::MatrixXd inverse_rigid; ///< of R.(K + S) R; empty where that is zero
};
} // namespace mesoslip

#endif
