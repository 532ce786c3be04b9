#include "body/brick_solver.h"

#include "base/exchange.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/**
 * Factor by which single precision can reduce the residual reliably: displacements may
 * grow over the whole body, and the forces of cells cancel.
 */
constexpr double trusted = 1e-2;

/** Limit of iterations in single precision; slower convergence indicates round-off. */
constexpr unsigned int most_in_single = 200;
} // namespace

BrickSolver::BrickSolver(const GridBody<3> &body)
  : body(body)
  , K(body.stiffness())
  , iteration(K)
  , load(K.grid)
  , product(K.grid)
  , correction(K.grid)
{
  for (int m = 0; m < RigidMotions<3>::n; ++m)
    rigid.push_back(motion_of(RigidMotions<3>::Coefficients::Unit(m)));
}

void BrickSolver::set_constrained_on_springs(const DofMask &mask,
                                             const std::vector<SpringEntry> &more)
{
  const std::vector<SpringEntry> on = with_foundation(body.foundation(), more);
  voxel::HeldComponents held(K.grid);
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    if (const auto at = body.voxel_node({i, 0}); at && mask.bits({i, 0}) != 0)
      for (unsigned int c = 0; c < 3; ++c)
        if (mask.is_constrained(c, {i, 0}))
          held.row(c, (*at)[1], (*at)[2])[(*at)[0]] = 1.F;
  held.set_ghosts();
  if (!multigrid)
    multigrid = K.make_multigrid({});
  voxel::Springs of_nodes;
  take_springs(on, of_nodes);
  multigrid->hold(std::move(held), std::move(of_nodes));
  find_motions(mask, on);
  condense_motions();
}

/**
 * Stores the springs at nodes of this rank in springs and, if any rank has springs, in
 * @p fields.
 */
void BrickSolver::take_springs(const std::vector<SpringEntry> &on, voxel::Springs &fields)
{
  springs.clear();
  if (mpi::max(on.empty() ? 0 : 1, body.communicator()) > 0)
    fields.direct = fields.mixed = voxel::VoxelField<float>(K.grid);
  for (const SpringEntry &spring : on)
    if (const auto at = body.voxel_node(spring.node); at && body.is_counted(spring.node))
      {
        const auto place = [&](const unsigned int c) {
          return static_cast<std::size_t>(load.row(c, (*at)[1], (*at)[2]) - load.data()) +
                 (*at)[0];
        };
        const double stiffness = spring.stiffness / body.unit_stiffness();
        springs.push_back({place(spring.c), place(spring.d), stiffness});
        const bool is_direct = spring.c == spring.d;
        float *row =
          (is_direct ? fields.direct : fields.mixed)
            .row(is_direct ? spring.c : 3 - spring.c - spring.d, (*at)[1], (*at)[2]);
        row[(*at)[0]] += static_cast<float>(is_direct ? stiffness : 0.5 * stiffness);
      }
}

/** Motion for given coefficients of the rigid motions. */
BrickSolver::Motion
BrickSolver::motion_of(const RigidMotions<3>::Coefficients &coefficients) const
{
  const RigidMotions<3> all(body);
  Motion motion;
  motion.col(0) = all.at({}) * coefficients;
  for (unsigned int d = 0; d < 3; ++d)
    {
      std::array<double, 3> point = {};
      point[d]                    = body.extent(d);
      motion.col(1 + d) = (all.at(point) * coefficients - motion.col(0)) / body.extent(d);
    }
  return motion;
}

/** Finds the rigid motions that constraints and springs leave free. */
void BrickSolver::find_motions(const DofMask &mask, const std::vector<SpringEntry> &on)
{
  const auto put = [this](const Motion &motion) {
    std::fill_n(product.data(), product.size(), 0.);
    add_motion(motion, product);
  };
  motions.clear();
  const auto hold = RigidMotions<3>(body).hold_of(mask, on);
  for (const auto &left : RigidMotions<3>::left_by(hold))
    {
      Motion motion = motion_of(left);
      for (unsigned int again = 0; again < 2; ++again)
        {
          put(motion);
          for (const Motion &other : motions)
            motion -= dot(other, product) * other;
        }
      put(motion);
      motions.emplace_back(motion / std::sqrt(dot(motion, product)));
    }
}

/** R.(K + S) R, unless all of it is round-off. */
void BrickSolver::condense_motions()
{
  const auto n      = static_cast<Eigen::Index>(rigid.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index m = 0; m < n; ++m)
    {
      std::fill_n(correction.data(), correction.size(), 0.);
      add_motion(rigid[static_cast<std::size_t>(m)], correction);
      clear_held(correction);
      correction.set_ghosts();
      take_forces(correction, multigrid->finest_buffer());
      for (Eigen::Index l = 0; l < n; ++l)
        A(l, m) = -dot(rigid[static_cast<std::size_t>(l)], product);
    }
  inverse_rigid.resize(0, 0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(0.5 * (A + A.transpose()));
  // The stiffness of a cell is about one in these units.
  const double least = 1e-9 * std::max(modes.eigenvalues()[n - 1], 1e-3);
  if (!(modes.eigenvalues()[n - 1] > least))
    return;
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(n);
  for (Eigen::Index m = 0; m < n; ++m)
    if (modes.eigenvalues()[m] > least)
      inverse[m] = 1. / modes.eigenvalues()[m];
  inverse_rigid =
    modes.eigenvectors() * inverse.asDiagonal() * modes.eigenvectors().transpose();
}

/** Displacement at the first node of a row, and its increment from node to node. */
std::array<double, 2> BrickSolver::along_row(const Motion &motion,
                                             const unsigned int c,
                                             const unsigned int j,
                                             const unsigned int k) const
{
  const auto &h = K.grid.spacing;
  return {{motion(c, 0) + K.length * (motion(c, 2) * (j - 1.) * h[1] +
                                      motion(c, 3) * (k + K.grid.below() - 1.) * h[2]),
           K.length * motion(c, 1) * h[0]}};
}

template <typename Number>
void BrickSolver::add_motion(const Motion &motion, voxel::VoxelField<Number> &field) const
{
  for_each_row(K.grid,
               [&](const unsigned int c, const unsigned int j, const unsigned int k) {
                 const auto [first, step] = along_row(motion, c, j, k);
                 Number *row              = field.row(c, j, k) + 1;
                 for (unsigned int i = 0; i < K.grid.n_nodes(0); ++i)
                   row[i] += static_cast<Number>(first + i * step);
               });
}

/** Dot product over all ranks. */
template <typename Number>
double BrickSolver::dot(const Motion &motion,
                        const voxel::VoxelField<Number> &field) const
{
  double sum = 0.;
  for_each_row(K.grid,
               [&](const unsigned int c, const unsigned int j, const unsigned int k) {
                 const auto [first, step] = along_row(motion, c, j, k);
                 const Number *row        = field.row(c, j, k) + 1;
                 for (unsigned int i = 0; i < K.grid.n_nodes(0); ++i)
                   sum += row[i] * (first + i * step);
               });
  return sum_over_ranks(K.grid, sum);
}

void BrickSolver::remove_motions(Field &field) const
{
  for (const Motion &motion : motions)
    add_motion(-dot(motion, field) * motion, field);
}

/** Sets all unconstrained components to zero. */
void BrickSolver::keep_held(Field &field) const
{
  std::vector<double> values;
  for (const std::size_t place : multigrid->finest().held())
    values.push_back(field.data()[place]);
  std::fill_n(field.data(), field.size(), 0.);
  std::size_t next = 0;
  for (const std::size_t place : multigrid->finest().held())
    field.data()[place] = values[next++];
  field.set_ghosts();
}

double BrickSolver::square_of(const Field &field) const
{
  double sum = 0.;
  for_each_row(K.grid,
               [&](const unsigned int c, const unsigned int j, const unsigned int k) {
                 const double *row = field.row(c, j, k) + 1;
                 for (unsigned int i = 0; i < K.grid.n_nodes(0); ++i)
                   sum += row[i] * row[i];
               });
  return sum_over_ranks(K.grid, sum);
}

void BrickSolver::clear_held(Field &field) const
{
  for (const std::size_t place : multigrid->finest().held())
    field.data()[place] = 0.;
}

/** product = -(K + S) v, zero at constrained components. */
void BrickSolver::take_forces(Field &v, voxel::VoxelField<float> &rounded)
{
  K.forces({}, v, rounded, product.data());
  for (const Spring &spring : springs)
    product.data()[spring.row] -= spring.stiffness * v.data()[spring.column];
  clear_held(product);
}

/**
 * product = load - (K + S) v; the load is zero at constrained components. Returns the
 * square of its norm.
 */
double BrickSolver::unbalanced(Field &v, voxel::VoxelField<float> &rounded)
{
  take_forces(v, rounded);
  for_each_row(K.grid,
               [&](const unsigned int c, const unsigned int j, const unsigned int k) {
                 const double *given = load.row(c, j, k) + 1;
                 double *row         = product.row(c, j, k) + 1;
                 for (unsigned int i = 0; i < K.grid.n_nodes(0); ++i)
                   row[i] += given[i];
               });
  return square_of(product);
}

/** z += R (R.(K + S) R)^-1 R.r */
void BrickSolver::move_rigidly(voxel::VoxelField<float> &z,
                               const voxel::VoxelField<float> &r) const
{
  Eigen::VectorXd resultant(inverse_rigid.rows());
  for (std::size_t m = 0; m < rigid.size(); ++m)
    resultant[static_cast<Eigen::Index>(m)] = dot(rigid[m], r);
  const Eigen::VectorXd moved = inverse_rigid * resultant;
  Motion all                  = Motion::Zero();
  for (std::size_t m = 0; m < rigid.size(); ++m)
    all += moved[static_cast<Eigen::Index>(m)] * rigid[m];
  add_motion(all, z);
  multigrid->finest().clear_held(z.data());
  z.set_ghosts();
}

SolverReport BrickSolver::solve(NodalField<double> &u,
                                const NodalField<double> &force,
                                const double tolerance)
{
  if (!multigrid)
    set_constrained(DofMask(body.n_columns(), 1));
  voxel::VoxelField<float> &rounded = multigrid->finest_buffer();
  body.to_voxels(force, load);
  for (std::size_t i = 0; i < load.size(); ++i)
    load.data()[i] /= body.unit_stiffness();
  remove_motions(load);
  clear_held(load);

  // Residuals are relative to the residual of the prescribed values alone.
  body.to_voxels(u, correction);
  keep_held(correction);
  const double reference = std::sqrt(unbalanced(correction, rounded));
  double norm            = reference;
  if (!motions.empty() || reference == 0.) // it would only be shifted rigidly
    body.from_voxels(correction, u);
  else
    {
      body.to_voxels(u, correction);
      norm = std::sqrt(unbalanced(correction, rounded));
    }
  SolverReport report;
  report.residual = reference == 0. ? 0. : norm / reference;
  if (report.residual <= tolerance)
    return report;
  for (std::size_t i = 0; i < load.size(); ++i)
    load.data()[i] = product.data()[i] / norm;
  std::fill_n(correction.data(), correction.size(), 0.);

  voxel::ConjugateGradients::Problem problem;
  problem.residual = [this](Field &v, voxel::VoxelField<float> &r) {
    const double square = unbalanced(v, r);
    for_each_row(
      K.grid, [&](const unsigned int c, const unsigned int j, const unsigned int k) {
        std::copy_n(product.row(c, j, k), K.grid.n_nodes(0) + 1, r.row(c, j, k));
        r.row(c, j, k)[0] = 0.F;
      });
    return square;
  };
  if (inverse_rigid.size() > 0)
    problem.improve = [this](auto &z, const auto &r) { move_rigidly(z, r); };
  problem.round_off = [this](const Field &v) {
    return std::numeric_limits<double>::epsilon() * std::sqrt(square_of(v));
  };
  problem.tolerance    = tolerance * reference / norm;
  problem.trusted_drop = trusted;
  problem.limit        = most_in_single;
  try
    {
      report = iteration.solve(correction, *multigrid, problem);
    }
  catch (const NotConverged &e)
    {
      if (e.reason == NotConverged::Reason::not_finite)
        throw;
      report                   = iteration.report;
      report.single_iterations = report.iterations;
      iterate_in_double(problem, report);
    }
  report.residual *= norm / reference;

  body.to_voxels(u, product);
  for (std::size_t i = 0; i < product.size(); ++i)
    product.data()[i] += norm * correction.data()[i];
  remove_motions(product);
  product.set_ghosts();
  body.from_voxels(product, u);
  return report;
}
} // namespace mesoslip
