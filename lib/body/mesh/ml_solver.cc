#include "body/mesh/ml_solver.h"

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

#include <Eigen/Dense>
#include <Epetra_CrsMatrix.h>

#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
constexpr unsigned int max_iterations = 2000;

/** Three nodes that are far from one another and not in line. */
template <int dim>
std::array<NodeIndex, 3> distant_nodes(const ElasticBody<dim> &body)
{
  using Vector         = Eigen::Matrix<double, dim, 1>;
  const auto offset_of = [&](const NodeIndex &node, const NodeIndex &from) {
    Vector offset;
    for (unsigned int d = 0; d < dim; ++d)
      offset[d] = body.point(node)[d] - body.point(from)[d];
    return offset;
  };
  const auto farthest = [&](const auto &distance) {
    NodeIndex best;
    double most = -1.;
    for (unsigned int j = 0; j < body.n_rows(); ++j)
      for (unsigned int i = 0; i < body.n_columns(); ++i)
        if (const double x = distance(NodeIndex{i, j}); x > most)
          {
            most = x;
            best = {i, j};
          }
    return best;
  };
  const NodeIndex a = {0, 0}, b = farthest([&](const NodeIndex &node) {
                                return offset_of(node, a).norm();
                              });
  const Vector line = offset_of(b, a).normalized();
  return {{a, b, farthest([&](const NodeIndex &node) {
             const Vector offset = offset_of(node, a);
             return (offset - line * line.dot(offset)).norm();
           })}};
}
} // namespace

template <int dim>
MlSolver<dim>::MlSolver(const ElasticBody<dim> &the_body,
                        const MeshDiscretization<dim> &the_discretization)
  : body(the_body)
  , discretization(the_discretization)
{
}

template <int dim>
void MlSolver<dim>::set_constrained(const DofMask &mask)
{
  constrained_dofs = mask;
  fixed.assign(discretization.n_dofs(), false);
  // Axis after axis, so that the original of an original is held as well.
  for (const auto &[duplicate, original] : body.duplicate_nodes())
    for (unsigned int c = 0; c < dim; ++c)
      if (constrained_dofs.is_constrained(c, duplicate))
        constrained_dofs.constrain(c, original);
  for (unsigned int j = 0; j < constrained_dofs.n_rows(); ++j)
    for (unsigned int i = 0; i < constrained_dofs.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        fixed[discretization.dof(c, {i, j})] = constrained_dofs.is_constrained(c, {i, j});
  for (const auto &pair : body.duplicate_nodes())
    for (unsigned int c = 0; c < dim; ++c)
      fixed[discretization.dof(c, pair[0])] = true;

  motions.clear();
  for (const NodalField<double> &field : free_rigid_motions(body, constrained_dofs))
    {
      Vector motion = discretization.to_vector(field);
      remove_motions(motion);
      motion /= motion.l2_norm();
      motions.push_back(motion);
    }
  if (!motions.empty())
    support(constrained_dofs);
  copy_without_fixed();
  set_up_preconditioner();
}

// Supports that are just enough carry nothing, as forces are in equilibrium.
template <int dim>
void MlSolver<dim>::support(DofMask mask)
{
  const std::vector<NodeIndex> &bottom = body.surface(ElasticBody<dim>::bottom).nodes;
  std::vector<NodeIndex> nodes;
  if (bottom.size() > 1)
    nodes = {bottom.front(), bottom.back(), bottom[bottom.size() / 2], bottom[1]};
  // A round body may have no lower side, or one that is too small to stand on.
  for (const NodeIndex &node : distant_nodes(body))
    nodes.push_back(node);
  for (NodeIndex &node : nodes) // duplicates have no row of their own
    for (const auto &[duplicate, original] : body.duplicate_nodes())
      if (duplicate.i == node.i && duplicate.j == node.j)
        node = original;
  std::vector<std::pair<unsigned int, NodeIndex>> candidates;
  for (unsigned int c = 0; c < dim; ++c)
    candidates.emplace_back(c, nodes.front());
  for (std::size_t k = 1; k < nodes.size(); ++k)
    for (unsigned int c = dim; c-- > 0;)
      candidates.emplace_back(c, nodes[k]);
  std::size_t n_free = motions.size();
  for (const auto &[c, node] : candidates)
    {
      if (n_free == 0)
        return;
      DofMask trial = mask;
      trial.constrain(c, node);
      const std::size_t n = free_rigid_motions(body, trial).size();
      if (n == n_free)
        continue;
      n_free                             = n;
      mask                               = trial;
      fixed[discretization.dof(c, node)] = true;
    }
  Assert(n_free == 0, dealii::ExcInternalError());
}

// Dropping rows and columns keeps the matrix symmetric, which ML relies on. (deal.II's
// iterators clear a buffer as long as the matrix is wide for each row they visit.)
template <int dim>
void MlSolver<dim>::copy_without_fixed()
{
  constrained.copy_from(discretization.stiffness());
  const Epetra_CrsMatrix &epetra = constrained.trilinos_matrix();
  for (int i = 0; i < epetra.NumMyRows(); ++i)
    {
      int n = 0, *columns = nullptr;
      double *values = nullptr;
      epetra.ExtractMyRowView(i, n, values, columns);
      const auto row = epetra.GRID64(i);
      for (int k = 0; k < n; ++k)
        {
          const auto column = epetra.GCID64(columns[k]);
          if (column != row && (fixed[row] || fixed[column]))
            values[k] = 0.;
        }
    }
}

template <int dim>
void MlSolver<dim>::set_up_preconditioner()
{
  std::vector<Vector> rigid;
  for (const NodalField<double> &field :
       free_rigid_motions(body, DofMask(body.n_columns(), body.n_rows())))
    {
      rigid.push_back(discretization.to_vector(field));
      clear_fixed(rigid.back());
    }
  preconditioner.initialize(constrained, dim, rigid);
}

template <int dim>
void MlSolver<dim>::clear_fixed(Vector &x) const
{
  const auto range = x.local_range();
  for (Index k = range.first; k < range.second; ++k)
    if (fixed[k])
      x(k) = 0.;
  x.compress(dealii::VectorOperation::insert);
}

template <int dim>
void MlSolver<dim>::remove_motions(Vector &x) const
{
  for (const Vector &motion : motions)
    x.add(-(motion * x), motion);
}

template <int dim>
SolverReport MlSolver<dim>::solve(NodalField<double> &u,
                                  const NodalField<double> &force,
                                  const double tolerance)
{
  if (fixed.empty())
    set_constrained(DofMask(body.n_columns(), body.n_rows()));
  // The scale is the residual of the prescribed values alone.
  NodalField<double> values = body.zero_field();
  for (unsigned int j = 0; j < constrained_dofs.n_rows(); ++j)
    for (unsigned int i = 0; i < constrained_dofs.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        if (constrained_dofs.is_constrained(c, {i, j}))
          values.row(c, j)[i] = u.row(c, j)[i];
  const Vector prescribed = discretization.to_vector(values);
  Vector f                = discretization.to_vector(force), r(f);
  remove_motions(f);
  const auto residual = [&](const Vector &x) {
    discretization.stiffness().vmult(r, x);
    r.sadd(-1., 1., f);
    clear_fixed(r);
    return r.l2_norm();
  };
  const double reference = residual(prescribed);
  if (!std::isfinite(reference))
    throw NotConverged("conjugate gradients with ML met numbers that are not finite",
                       NotConverged::Reason::not_finite);
  // A first guess would move the supports of a floating body.
  Vector x = motions.empty() ? discretization.to_vector(u) : prescribed;
  SolverReport report;
  report.residual = reference > 0. ? residual(x) / reference : 0.;
  if (report.residual > tolerance)
    report = solve_free(x, r, reference, tolerance);
  remove_motions(x);
  discretization.to_field(u, x);
  return report;
}

template <int dim>
SolverReport MlSolver<dim>::solve_free(Vector &x,
                                       Vector &residual,
                                       const double reference,
                                       const double tolerance)
{
  Vector correction(x);
  correction = 0.;
  dealii::SolverControl control(max_iterations, tolerance * reference);
  dealii::SolverCG<Vector> conjugate_gradients(control);
  try
    {
      conjugate_gradients.solve(constrained, correction, residual, preconditioner);
    }
  catch (const dealii::SolverControl::NoConvergence &e)
    {
      std::ostringstream text;
      text << "conjugate gradients with ML stopped after " << e.last_step
           << " iterations at a relative residual of " << e.last_residual / reference
           << ", wanted " << tolerance;
      throw NotConverged(text.str());
    }
  x += correction;
  SolverReport report;
  report.iterations = control.last_step();
  report.residual   = control.last_value() / reference;
  return report;
}

template class MlSolver<2>;
template class MlSolver<3>;
} // namespace mesoslip
