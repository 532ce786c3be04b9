#include "dynamics/vibration_modes.h"

#include "dynamics/free_dofs.h"
#include "elasticity/uniform_grid_operator.h"

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
using Vector = FreeDofs::Vector;

/** The lumped mass, as ARPACK wants it. */
struct MassMatrix
{
  const FreeDofs &dofs;

  void vmult(Vector &dst, const Vector &src) const
  {
    for (std::size_t k = 0; k < dofs.size(); ++k)
      dst[k] = dofs.mass(k) * src[k];
  }
};

/** u = a - r y, v = b + r x with lengths from the middle in widths of the body. */
std::array<double, 3> rigid_motion(const UniformGrid<2> &grid, const FreeDofs::Place &p)
{
  const double width = grid.extent(0);
  const double x     = p.i * grid.spacing[0] / width - 0.5;
  const double y     = (p.j * grid.spacing[1] - 0.5 * grid.extent(1)) / width;
  return p.component == 0 ? std::array<double, 3>{{1., 0., -y}}
                          : std::array<double, 3>{{0., 1., x}};
}

/** The rigid motions that nothing holds, orthonormal with respect to the mass. */
std::vector<Vector> free_rigid_motions(const UniformMaterial &material,
                                       const DofMask &held,
                                       const FreeDofs &dofs)
{
  const bool platen    = dofs.platen() != FreeDofs::none;
  Eigen::Matrix3d hold = Eigen::Matrix3d::Zero();
  // Neither can a platen turn.
  if (material.periodicity().x || material.periodicity().y || platen)
    hold(2, 2) = 1.;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < held.n_rows(); ++j)
      for (unsigned int i = 0; i < held.n_columns(); ++i)
        if (held.is_held(c, i, j) && !(platen && c == 1 && j + 1 == held.n_rows()))
          {
            const auto m = rigid_motion(material.grid(), {c, i, j});
            const Eigen::Vector3d motion(m[0], m[1], m[2]);
            hold += motion * motion.transpose();
          }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(hold);

  std::vector<Vector> motions;
  for (int k = 0; k < 3; ++k)
    {
      if (eigen.eigenvalues()[k] > 1e-10 * std::max(1., eigen.eigenvalues()[2]))
        continue;
      const Eigen::Vector3d a = eigen.eigenvectors().col(k);
      Vector motion(dofs.size());
      for (std::size_t d = 0; d < dofs.size(); ++d)
        {
          const auto m = rigid_motion(material.grid(), dofs.place(d));
          motion[d]    = a[0] * m[0] + a[1] * m[1] + a[2] * m[2];
        }
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
class InverseStiffness
{
public:
  InverseStiffness(const UniformGridOperator &stiffness,
                   const DofMask &held,
                   const FreeDofs &dofs,
                   const MassMatrix &mass,
                   const VibrationModesOptions &options)
    : dofs(dofs)
    , mass(mass)
    , options(options)
    , rigid(free_rigid_motions(stiffness.material(), held, dofs))
    , solver(make_static_solver(options.solver, stiffness.material()))
    , force(stiffness.material().n_columns(), stiffness.material().n_rows())
    , u(force)
  {
    solver->set_held(held);
    if (dofs.platen() != FreeDofs::none && !platen_moves_freely())
      push_platen(stiffness);
  }

  void vmult(Vector &dst, const Vector &src) const
  {
    // The mass times a motion is the load that accelerates the body in that motion.
    Vector load(src), motion(src.size());
    for (const Vector &r : rigid)
      {
        mass.vmult(motion, r);
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

  void push_platen(const UniformGridOperator &stiffness)
  {
    Vector unit(dofs.size()), Kz(dofs.size());
    unit[dofs.platen()] = 1.;
    dofs.scatter(u, unit);
    solve();
    response.reinit(dofs.size());
    dofs.gather(response, u);
    stiffness.vmult(force, u);
    dofs.gather_forces(Kz, force);
    platen_stiffness = response * Kz;
  }

  const FreeDofs &dofs;
  const MassMatrix &mass;
  const VibrationModesOptions &options;
  const std::vector<Vector> rigid;
  std::unique_ptr<StaticSolver> solver;
  mutable NodalField<double> force, u;
  Vector response;              ///< z; empty without a platen or when nothing resists it
  double platen_stiffness = 0.; ///< z.K z (N/m^2)
};

/** Rayleigh quotient, residual, normalisation and masses of an eigenvector. */
VibrationMode finish_mode(const Vector &eigenvector,
                          const FreeDofs &dofs,
                          const MassMatrix &mass,
                          const UniformGridOperator &stiffness,
                          const double platen_mass)
{
  const UniformMaterial &material = stiffness.material();
  VibrationMode mode;
  mode.shape = NodalField<double>(material.n_columns(), material.n_rows());
  NodalField<double> field(material.n_columns(), material.n_rows());
  Vector Ku(dofs.size()), Mu(dofs.size());
  dofs.scatter(mode.shape, eigenvector);
  stiffness.vmult(field, mode.shape);
  dofs.gather_forces(Ku, field);
  mass.vmult(Mu, eigenvector);
  const double uMu = eigenvector * Mu, omega2 = eigenvector * Ku / uMu;
  mode.frequency = std::sqrt(std::max(0., omega2)) / (2. * M_PI);

  std::array<double, 2> momentum = {};
  for (std::size_t k = 0; k < dofs.size(); ++k)
    momentum[dofs.place(k).component] += Mu[k];
  const std::array<double, 2> moved = {
    {material.total_mass(), material.total_mass() + platen_mass}};
  for (unsigned int c = 0; c < 2; ++c)
    mode.effective_mass[c] = momentum[c] * momentum[c] / (uMu * moved[c]);

  double norm = Ku.l2_norm();
  Ku.add(-omega2, Mu);
  mode.residual = Ku.l2_norm() / norm;

  double largest = 0., sign = 1.;
  for (unsigned int j = 0; j < material.n_rows(); ++j)
    for (unsigned int i = 0; i < material.n_columns(); ++i)
      {
        const double x = mode.shape.row(0, j)[i], y = mode.shape.row(1, j)[i];
        // Mirror images are equal up to round-off; the first of them decides.
        if (std::hypot(x, y) > largest * (1. + 1e-6))
          {
            largest = std::hypot(x, y);
            sign    = (std::fabs(x) >= std::fabs(y) ? x : y) < 0. ? -1. : 1.;
          }
      }
  for (std::size_t k = 0; k < mode.shape.size(); ++k)
    mode.shape.begin()[k] *= sign / largest;
  mode.modal_mass = uMu / (largest * largest);
  return mode;
}

/** The eigenvectors of the lowest eigenvalues, in no particular order. */
std::vector<Vector> lowest_eigenvectors(const MassMatrix &mass,
                                        const InverseStiffness &inverse,
                                        const std::size_t n_dofs,
                                        const unsigned int n_modes)
{
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
  arpack.solve(mass, mass, inverse, values, vectors, n_modes);
  return vectors;
}
} // namespace

void check_number_of_modes(const UniformMaterial &material,
                           const DofMask &held,
                           const VibrationModesOptions &options)
{
  const std::size_t n = FreeDofs(material, held, options.platen_mass).size();
  if (n < 2 * options.n_modes + 10)
    throw std::invalid_argument(std::to_string(options.n_modes) + " modes of only " +
                                std::to_string(n) +
                                " free degrees of freedom; at most half of them, less 5, "
                                "can be computed");
}

VibrationModes vibration_modes(const UniformMaterial &material,
                               const DofMask &held,
                               const VibrationModesOptions &options)
{
  check_number_of_modes(material, held, options);
  const FreeDofs dofs(material, held, options.platen_mass);
  const MassMatrix mass{dofs};
  const UniformGridOperator stiffness(material);
  const InverseStiffness inverse(stiffness, held, dofs, mass, options);

  VibrationModes result;
  for (const Vector &x : lowest_eigenvectors(mass, inverse, dofs.size(), options.n_modes))
    result.modes.push_back(
      finish_mode(x, dofs, mass, stiffness, options.platen_mass.value_or(0.)));
  std::sort(result.modes.begin(), result.modes.end(),
            [](const VibrationMode &a, const VibrationMode &b) {
              return a.frequency < b.frequency;
            });
  result.n_rigid_motions   = inverse.n_rigid();
  result.n_solves          = inverse.n_solves;
  result.solver_iterations = inverse.iterations;

  // ArpackSolver reports failures through assertions of debug builds only.
  for (const VibrationMode &mode : result.modes)
    if (!(mode.residual <= 1e-4))
      {
        std::ostringstream what;
        what << "the Lanczos iteration left a mode at " << mode.frequency
             << " Hz with a relative residual of " << mode.residual;
        throw NotConverged(what.str());
      }
  return result;
}
} // namespace mesoslip
