#include "eigenvalues/vibration_modes.h"

#include "eigenvalues/free_dofs.h"
#include <deal.II/lac/arpack_solver.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

namespace mesoslip
{
namespace
{
using Vector = dealii::Vector<double>; // as FreeDofs has it

/** The rigid motions that nothing holds, orthonormal with respect to the mass. */
template <int dim>
std::vector<Vector>
orthonormal_motions(const ElasticBody<dim> &body, DofMask mask, const FreeDofs<dim> &dofs)
{
  const bool platen = dofs.platen() != FreeDofs<dim>::none;
  if (platen)
    for (const NodeIndex &node : body.surface(ElasticBody<dim>::top).nodes)
      mask.release(dim - 1, node);
  std::vector<Vector> motions;
  // Neither can a platen turn.
  for (const NodalField<double> &field : free_rigid_motions(body, mask, !platen))
    {
      Vector motion(dofs.size());
      dofs.gather(motion, field);
      for (const Vector &other : motions)
        motion.add(-dofs.mass_product(other, motion), other);
      motion /= std::sqrt(dofs.mass_product(motion, motion));
      motions.push_back(motion);
    }
  return motions;
}

/**
 * K^-1 on loads without resultant; solutions have no rigid motion (in the mass' sense).
 * Under a platen the body is solved for with the top held, u = K_hh^-1 f, and moves with
 * the platen on top of that: u + s z, where z is the response to a unit displacement of
 * the platen and s = z.f / z.K z, as z.K u = 0.
 */
template <int dim>
class InverseStiffness
{
public:
  InverseStiffness(const ElasticBody<dim> &body,
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
    if (dofs.platen() != FreeDofs<dim>::none && !platen_moves_freely())
      push_platen(body);
  }

  void vmult(Vector &dst, const Vector &src) const
  {
    // The mass times a motion is the load that accelerates the body in that motion.
    Vector load(src), motion(src.size());
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

  void remove_rigid(Vector &x) const
  {
    for (const Vector &r : rigid)
      x.add(-dofs.mass_product(r, x), r);
  }

  unsigned int n_rigid() const
  {
    return rigid.size();
  }

  mutable unsigned int n_solves = 0, iterations = 0;

private:
  void solve() const
  {
    if (options.before_solve)
      options.before_solve(n_solves);
    iterations += solver->solve(u, force, options.tolerance).iterations;
    ++n_solves;
  }

  /** Then a load on it is a resultant, and vmult() has projected it out. */
  bool platen_moves_freely() const
  {
    return std::any_of(rigid.begin(), rigid.end(), [this](const Vector &r) {
      return std::fabs(r[dofs.platen()]) > 1e-6 * r.linfty_norm();
    });
  }

  void push_platen(const ElasticBody<dim> &body)
  {
    Vector unit(dofs.size()), Kz(dofs.size());
    unit[dofs.platen()] = 1.;
    dofs.scatter(u, unit);
    solve();
    response.reinit(dofs.size());
    dofs.gather(response, u);
    body.vmult(force, u);
    dofs.gather_forces(Kz, force);
    platen_stiffness = response * Kz;
  }

  const FreeDofs<dim> &dofs;
  const VibrationModesOptions &options;
  const std::vector<Vector> rigid;
  std::unique_ptr<StaticSolver> solver;
  mutable NodalField<double> force, u;
  Vector response;              ///< z; empty without a platen or when nothing resists it
  double platen_stiffness = 0.; ///< z.K z (N/m^2)
};

/** Rayleigh quotient, residual, normalisation and masses of an eigenvector. */
template <int dim>
VibrationMode<dim> finish_mode(const Vector &eigenvector,
                               const FreeDofs<dim> &dofs,
                               const ElasticBody<dim> &body,
                               const double platen_mass)
{
  VibrationMode<dim> mode;
  mode.shape               = body.zero_field();
  NodalField<double> field = mode.shape;
  Vector Ku(dofs.size()), Mu(dofs.size());
  dofs.scatter(mode.shape, eigenvector);
  body.vmult(field, mode.shape);
  dofs.gather_forces(Ku, field);
  dofs.vmult(Mu, eigenvector);
  const double uMu = eigenvector * Mu, omega2 = eigenvector * Ku / uMu;
  mode.frequency = std::sqrt(std::max(0., omega2)) / (2. * M_PI);

  std::array<double, dim> momentum = {};
  for (std::size_t k = 0; k < dofs.size(); ++k)
    momentum[dofs.component(k)] += Mu[k];
  for (unsigned int c = 0; c < dim; ++c)
    {
      const double moved     = body.total_mass() + (c + 1 == dim ? platen_mass : 0.);
      mode.effective_mass[c] = momentum[c] * momentum[c] / (uMu * moved);
    }

  double norm = Ku.l2_norm();
  Ku.add(-omega2, Mu);
  mode.residual = Ku.l2_norm() / norm;

  double largest = 0., sign = 1.;
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      {
        double length = 0., component = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double u = mode.shape.row(c, j)[i];
            length         = std::hypot(length, u);
            if (std::fabs(u) > std::fabs(component))
              component = u;
          }
        // Mirror images are equal up to round-off; the first of them decides.
        if (length > largest * (1. + 1e-6))
          {
            largest = length;
            sign    = component < 0. ? -1. : 1.;
          }
      }
  for (std::size_t k = 0; k < mode.shape.size(); ++k)
    mode.shape.begin()[k] *= sign / largest;
  mode.modal_mass = uMu / (largest * largest);
  return mode;
}

/** The eigenvectors of the lowest eigenvalues, in no particular order. */
template <int dim>
std::vector<Vector> lowest_eigenvectors(const FreeDofs<dim> &dofs,
                                        const InverseStiffness<dim> &inverse,
                                        const unsigned int n_modes)
{
  const std::size_t n_dofs = dofs.size();
  const unsigned int n_lanczos =
    static_cast<unsigned int>(std::min<std::size_t>(2 * n_modes + 10, n_dofs - 1));
  Vector start(n_dofs);
  std::mt19937 generator(1);
  std::uniform_real_distribution<> number(-1., 1.);
  for (double &x : start)
    x = number(generator);
  inverse.remove_rigid(start);

  std::vector<std::complex<double>> values(n_modes);
  std::vector<Vector> vectors(n_modes, Vector(n_dofs));
  dealii::SolverControl control(1000, 1e-10, false, false);
  dealii::ArpackSolver arpack(
    control, dealii::ArpackSolver::AdditionalData(
               n_lanczos, dealii::ArpackSolver::largest_magnitude, true));
  arpack.set_initial_vector(start);
  arpack.solve(dofs, dofs, inverse, values, vectors, n_modes);
  return vectors;
}
} // namespace

void check_number_of_modes(const std::size_t n_free, const VibrationModesOptions &options)
{
  if (n_free < 2 * options.n_modes + 10)
    throw std::invalid_argument(std::to_string(options.n_modes) + " modes of only " +
                                std::to_string(n_free) +
                                " free degrees of freedom; at most half of them, less 5, "
                                "can be computed");
}

template <int dim>
VibrationModes<dim> vibration_modes(const ElasticBody<dim> &body,
                                    const DofMask &mask,
                                    const VibrationModesOptions &options)
{
  const FreeDofs<dim> dofs(body, mask, options.platen_mass);
  check_number_of_modes(dofs.size(), options);
  const InverseStiffness<dim> inverse(body, mask, dofs, options);

  VibrationModes<dim> result;
  for (const Vector &x : lowest_eigenvectors(dofs, inverse, options.n_modes))
    result.modes.push_back(finish_mode(x, dofs, body, options.platen_mass.value_or(0.)));
  std::sort(result.modes.begin(), result.modes.end(),
            [](const VibrationMode<dim> &a, const VibrationMode<dim> &b) {
              return a.frequency < b.frequency;
            });
  result.n_rigid_motions   = inverse.n_rigid();
  result.n_solves          = inverse.n_solves;
  result.solver_iterations = inverse.iterations;

  // ArpackSolver reports failures through assertions of debug builds only.
  for (const VibrationMode<dim> &mode : result.modes)
    if (!(mode.residual <= 1e-4))
      {
        std::ostringstream what;
        what << "the Lanczos iteration left a mode at " << mode.frequency
             << " Hz with a relative residual of " << mode.residual;
        throw NotConverged(what.str());
      }
  return result;
}

template VibrationModes<2>
vibration_modes(const ElasticBody<2> &, const DofMask &, const VibrationModesOptions &);
template VibrationModes<3>
vibration_modes(const ElasticBody<3> &, const DofMask &, const VibrationModesOptions &);
} // namespace mesoslip
