#include "eigenvalues/inverse_stiffness.h"

#include "body/rigid_motions.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>

namespace mesoslip
{
namespace
{
/** Unconstrained rigid motions, orthonormal with respect to the mass. */
template <int dim>
std::vector<typename FreeDofs<dim>::Vector>
orthonormal_motions(const ElasticBody<dim> &body, DofMask mask, const FreeDofs<dim> &dofs)
{
  using Vector = typename FreeDofs<dim>::Vector;
  std::vector<NodesAsOne> as_one;
  for (const PlatenDof &dof : dofs.of_platens())
    {
      as_one.push_back({dof.component, dofs.nodes_of_platen(dof.platen)});
      for (const NodeIndex &node : as_one.back().nodes)
        mask.release(dof.component, node);
    }
  std::vector<Vector> motions;
  for (const NodalField<double> &field :
       free_rigid_motions(body, mask, body.foundation().springs, as_one))
    {
      Vector motion = dofs.zero();
      dofs.gather(motion, field);
      for (const Vector &other : motions)
        motion.add(-dofs.mass_product(other, motion), other);
      motion /= std::sqrt(dofs.mass_product(motion, motion));
      motions.push_back(motion);
    }
  return motions;
}
} // namespace

template <int dim>
InverseStiffness<dim>::InverseStiffness(const ElasticBody<dim> &body,
                                        const DofMask &mask,
                                        const FreeDofs<dim> &dofs,
                                        const VibrationModesOptions &options)
  : dofs(dofs)
  , options(options)
  , rigid(orthonormal_motions(body, mask, dofs))
  , solver(body.make_solver())
  , force(body.zero_field())
  , u(force)
{
  solver->set_constrained(mask);
  push_platens(body);
}

template <int dim>
void InverseStiffness<dim>::vmult(Vector &dst, const Vector &src) const
{
  // Mass times a motion is the load that accelerates the body in that motion.
  Vector load(src), motion = dofs.zero();
  for (const Vector &r : rigid)
    {
      dofs.vmult(motion, r);
      load.add(-(r * src), motion);
    }
  dofs.scatter(force, load);
  u.set_zero();
  solve();
  dofs.gather(dst, u);
  if (!responses.empty())
    {
      Eigen::VectorXd push(platen_stiffness.rows());
      for (std::size_t k = 0; k < responses.size(); ++k)
        push[static_cast<Eigen::Index>(k)] = responses[k] * load;
      const Eigen::VectorXd s = platen_stiffness.llt().solve(push);
      for (std::size_t k = 0; k < responses.size(); ++k)
        dst.add(s[static_cast<Eigen::Index>(k)], responses[k]);
    }
  remove_rigid(dst);
}

template <int dim>
void InverseStiffness<dim>::remove_rigid(Vector &x) const
{
  for (const Vector &r : rigid)
    x.add(-dofs.mass_product(r, x), r);
}

template <int dim>
void InverseStiffness<dim>::solve() const
{
  if (options.before_solve)
    options.before_solve(n_solves);
  iterations += solver->solve(u, force, options.tolerance).iterations;
  ++n_solves;
}

/**
 * Marks degrees of freedom of platens that can be compensated by unconstrained rigid
 * motions, one for each motion of platens. A load in the motion is then a resultant,
 * which vmult() has projected out.
 */
template <int dim>
std::vector<bool> InverseStiffness<dim>::platens_that_may_stay() const
{
  const std::size_t n = dofs.of_platens().size();
  std::vector<bool> may(n, false);
  if (n == 0 || rigid.empty())
    return may;
  Eigen::MatrixXd moved(n, rigid.size());
  for (std::size_t m = 0; m < rigid.size(); ++m)
    moved.col(static_cast<Eigen::Index>(m)) =
      Eigen::VectorXd::Map(dofs.of_platens(rigid[m]).data(),
                           static_cast<Eigen::Index>(n)) /
      rigid[m].linfty_norm();
  if (!(moved.cwiseAbs().maxCoeff() > 1e-6))
    return may;
  Eigen::FullPivLU<Eigen::MatrixXd> factors;
  factors.setThreshold(1e-6);
  factors.compute(moved);
  for (std::size_t k = 0; k < n; ++k)
    may[k] =
      factors.permutationP().indices()[static_cast<Eigen::Index>(k)] < factors.rank();
  return may;
}

template <int dim>
void InverseStiffness<dim>::push_platens(const ElasticBody<dim> &body)
{
  const std::vector<bool> may_stay = platens_that_may_stay();
  std::vector<Vector> pulls; // K Z
  for (std::size_t k = 0; k < may_stay.size(); ++k)
    {
      if (may_stay[k])
        continue;
      Vector unit = dofs.zero(), Kz = dofs.zero();
      dofs.set_platen(unit, k, 1.);
      dofs.scatter(u, unit);
      force.set_zero();
      solve();
      responses.push_back(dofs.zero());
      dofs.gather(responses.back(), u);
      body.vmult(force, u);
      dofs.gather_forces(Kz, force);
      pulls.push_back(Kz);
    }
  const auto n = static_cast<Eigen::Index>(pulls.size());
  platen_stiffness.resize(n, n);
  for (Eigen::Index r = 0; r < n; ++r)
    for (Eigen::Index c = 0; c < n; ++c)
      platen_stiffness(r, c) =
        responses[static_cast<std::size_t>(r)] * pulls[static_cast<std::size_t>(c)];
}

template class InverseStiffness<2>;
template class InverseStiffness<3>;
} // namespace mesoslip
