#include "body/mesh/ml_solver.h"

#include "base/exchange.h"
#include "body/mesh/conjugate_gradients.h"
#include "body/rigid_motions.h"

#include <Eigen/Dense>

namespace mesoslip
{
namespace
{
/** A node of the body, possibly of another rank. */
template <int dim>
struct Place
{
  std::array<double, dim> point = {}; ///< position (m), see ElasticBody::point()
  std::array<dealii::types::global_dof_index, dim> dofs = {}; ///< its degrees of freedom
};

/** The node of the whole body with the largest @p distance, on all ranks. */
template <int dim, typename Distance>
Place<dim> farthest(const ElasticBody<dim> &body,
                    const MeshDiscretization<dim> &discretization,
                    const Distance &distance)
{
  NodeIndex best;
  double most = -1.;
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      if (body.is_counted({i, j}))
        if (const double x = distance(body.point({i, j})); x > most)
          {
            most = x;
            best = {i, j};
          }
  Place<dim> place;
  if (most >= 0.)
    {
      place.point = body.point(best);
      for (unsigned int c = 0; c < dim; ++c)
        place.dofs[c] = discretization.dof(c, best);
    }
  const MPI_Comm ranks       = body.communicator();
  const bool has_it          = most == mpi::max(most, ranks);
  const unsigned int n_ranks = mpi::n_mpi_processes(ranks),
                     owner =
                       mpi::min(has_it ? mpi::this_mpi_process(ranks) : n_ranks, ranks);
  return mpi::broadcast(place, static_cast<int>(owner), ranks);
}

/** Three nodes far from one another and not collinear. */
template <int dim>
std::array<Place<dim>, 3> distant_nodes(const ElasticBody<dim> &body,
                                        const MeshDiscretization<dim> &discretization)
{
  using Vector         = Eigen::Matrix<double, dim, 1>;
  using Point          = std::array<double, dim>;
  const auto offset_of = [](const Point &point, const Point &from) {
    Vector offset;
    for (unsigned int d = 0; d < dim; ++d)
      offset[d] = point[d] - from[d];
    return offset;
  };
  const auto a      = farthest(body, discretization,
                               [&](const Point &p) { return offset_of(p, Point()).norm(); });
  const auto b      = farthest(body, discretization,
                               [&](const Point &p) { return offset_of(p, a.point).norm(); });
  const Vector line = offset_of(b.point, a.point).normalized();
  return {{a, b, farthest(body, discretization, [&](const Point &p) {
             const Vector offset = offset_of(p, a.point);
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
void MlSolver<dim>::set_constrained_on_springs(const DofMask &mask,
                                               const std::vector<SpringEntry> &on)
{
  const std::vector<SpringEntry> springs = with_foundation(body.foundation(), on);
  is_ready                               = true;
  constrained_dofs                       = mask;
  // Axis after axis, so that masters of masters are constrained, too.
  for (const auto &[copy, master] : body.periodic_copies())
    for (unsigned int c = 0; c < dim; ++c)
      if (constrained_dofs.is_constrained(c, copy))
        constrained_dofs.constrain(c, master);
  fixed = discretization.held_by(constrained_dofs);

  motions.clear();
  for (const NodalField<double> &field :
       free_rigid_motions(body, constrained_dofs, springs))
    {
      Vector motion = discretization.to_vector(field);
      remove_motions(motion);
      motion /= motion.l2_norm();
      motions.push_back(motion);
    }
  if (!motions.empty())
    support(springs);
  constrained.copy_without(discretization.stiffness(), fixed);
  add_springs(springs, constrained);
  if (discretization.has_two_matrices())
    {
      gentle.copy_without(discretization.to_precondition(), fixed);
      add_springs(springs, gentle);
    }
  set_up_preconditioner();
}

// Statically determinate supports carry no load, as forces are in equilibrium.
template <int dim>
void MlSolver<dim>::support(const std::vector<SpringEntry> &springs)
{
  const RigidMotions<dim> rigid(body);
  auto hold          = rigid.hold_of(constrained_dofs, springs);
  std::size_t n_free = motions.size();
  const auto owned   = discretization.lumped_mass().locally_owned_elements();
  for (const Place<dim> &place : distant_nodes(body, discretization))
    for (unsigned int c = dim; c-- > 0 && n_free > 0;)
      {
        const auto row      = rigid.at(place.point).row(c).eval();
        const auto trial    = (hold + row.transpose() * row).eval();
        const std::size_t n = RigidMotions<dim>::left_by(trial).size();
        if (n == n_free)
          continue;
        n_free = n;
        hold   = trial;
        if (owned.is_element(place.dofs[c]))
          fixed[owned.index_within_set(place.dofs[c])] = true;
      }
  Assert(n_free == 0, dealii::ExcInternalError());
}

// A rank adds the springs whose rows it owns.
template <int dim>
void MlSolver<dim>::add_springs(const std::vector<SpringEntry> &springs,
                                DistributedMatrix &matrix) const
{
  const auto owned = discretization.lumped_mass().locally_owned_elements();
  for (const SpringEntry &spring : springs)
    {
      const auto row    = discretization.dof(spring.c, spring.node),
                 column = discretization.dof(spring.d, spring.node);
      if (body.is_counted(spring.node) && owned.is_element(row) &&
          owned.is_element(column) && !fixed[owned.index_within_set(row)] &&
          !fixed[owned.index_within_set(column)])
        matrix.add(row, {column}, {spring.stiffness});
    }
  matrix.compress();
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
  preconditioner.initialize(discretization.has_two_matrices() ? gentle : constrained,
                            rigid);
}

template <int dim>
void MlSolver<dim>::clear_fixed(Vector &x) const
{
  for (std::size_t k = 0; k < fixed.size(); ++k)
    if (fixed[k])
      x.begin()[k] = 0.;
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
  if (!is_ready)
    set_constrained(DofMask(body.n_columns(), body.n_rows()));
  // Residuals are relative to the residual of the prescribed values alone.
  const Vector prescribed = discretization.to_vector(u, constrained_dofs);
  Vector f                = discretization.to_vector(force), r(f);
  remove_motions(f);
  const auto residual = [&](const Vector &x) {
    discretization.stiffness().vmult(r, x);
    r.sadd(-1., 1., f);
    clear_fixed(r);
    return r.l2_norm();
  };
  const double reference = residual(prescribed);
  // An initial guess would move the supports of a floating body.
  Vector x = motions.empty() ? discretization.to_vector(u) : prescribed;
  SolverReport report;
  report.residual = reference == 0. ? 0. : residual(x) / reference;
  if (!(report.residual <= tolerance))
    {
      Vector correction(x);
      correction = 0.;
      report = conjugate_gradients(constrained, correction, r, preconditioner, reference,
                                   tolerance);
      // GAMG aggregates may mix constrained and free components; CG corrects this up to
      // its tolerance.
      clear_fixed(correction);
      x += correction;
    }
  remove_motions(x);
  discretization.to_field(u, x);
  return report;
}

template class MlSolver<2>;
template class MlSolver<3>;
} // namespace mesoslip
