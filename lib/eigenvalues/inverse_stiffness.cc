#include "eigenvalues/inverse_stiffness.h"

#include "body/rigid_motions.h"

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
  if (dofs.has_platen())
    for (const NodeIndex &node : body.surface(ElasticBody<dim>::top).nodes)
      mask.release(dim - 1, node);
  std::vector<Vector> motions;
  // Neither can a platen turn.
  for (const NodalField<double> &field :
       free_rigid_motions(body, mask, !dofs.has_platen(), body.foundation().springs))
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
  if (dofs.has_platen() && !platen_moves_freely())
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
  if (response.size() > 0)
    dst.add(response * load / platen_stiffness, response);
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

/** Then a load on it is a resultant, and vmult() has projected it out. */
template <int dim>
bool InverseStiffness<dim>::platen_moves_freely() const
{
  return std::any_of(rigid.begin(), rigid.end(), [this](const Vector &r) {
    return std::fabs(dofs.of_platen(r)) > 1e-6 * r.linfty_norm();
  });
}

template <int dim>
void InverseStiffness<dim>::push_platen(const ElasticBody<dim> &body)
{
  Vector unit = dofs.zero(), Kz = dofs.zero();
  dofs.set_platen(unit, 1.);
  dofs.scatter(u, unit);
  solve();
  response = dofs.zero();
  dofs.gather(response, u);
  body.vmult(force, u);
  dofs.gather_forces(Kz, force);
  platen_stiffness = response * Kz;
}

template class InverseStiffness<2>;
template class InverseStiffness<3>;
} // namespace mesoslip
