#include "eigenvalues/inverse_stiffness.h"

#include "body/rigid_motions.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** The rigid motions that nothing holds, orthonormal with respect to the mass. */
template <int dim>
std::vector<typename FreeDofs<dim>::Vector>
orthonormal_motions(const ElasticBody<dim> &body, DofMask mask, const FreeDofs<dim> &dofs)
{
  using Vector = typename FreeDofs<dim>::Vector;
  for (const unsigned int c : dofs.platen_components())
    for (const NodeIndex &node : body.surface(ElasticBody<dim>::top).nodes)
      mask.release(c, node);
  std::vector<Vector> motions;
  // Neither can a platen turn.
  for (const NodalField<double> &field : free_rigid_motions(
         body, mask, dofs.platen_components().empty(), body.foundation().springs))
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
  push_platen(body);
}

template <int dim>
void InverseStiffness<dim>::vmult(Vector &dst, const Vector &src) const
{
  // The mass times a motion is the load that accelerates the body in that motion.
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

/** In its component @p k: then a load on it is a resultant, and vmult() has projected it out. */
template <int dim>
bool InverseStiffness<dim>::platen_moves_freely(const std::size_t k) const
{
  return std::any_of(rigid.begin(), rigid.end(), [&](const Vector &r) {
    return std::fabs(dofs.of_platen(r)[k]) > 1e-6 * r.linfty_norm();
  });
}

template <int dim>
void InverseStiffness<dim>::push_platen(const ElasticBody<dim> &body)
{
  std::vector<Vector> pulls; // K Z
  for (std::size_t k = 0; k < dofs.platen_components().size(); ++k)
    {
      if (platen_moves_freely(k))
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
