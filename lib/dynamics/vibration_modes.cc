#include "dynamics/vibration_modes.h"

#include "elasticity/uniform_grid_operator.h"

#include <deal.II/lac/arpack_solver.h>
#include <deal.II/lac/vector.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <sstream>

namespace mesoslip
{
namespace
{
using Vector = dealii::Vector<double>;

/** The free degrees of freedom, numbered; duplicates of periodic sides are left out. */
class FreeDofs
{
public:
  FreeDofs(const UniformMaterial &material, const DofMask &held)
    : periodic(material.periodicity())
    , n_columns(material.n_columns())
    , n_rows(material.n_rows())
  {
    const NodalField<double> layout(n_columns, n_rows);
    std::vector<double> row(n_columns);
    for (unsigned int j = 0; j + periodic.y < n_rows; ++j)
      {
        material.mass_row(j, row.data());
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int i = 0; i + periodic.x < n_columns; ++i)
            if (!held.is_held(c, i, j))
              {
                offsets.push_back(layout.row(c, j) - layout.begin() + i);
                masses.push_back(row[i]);
                places.push_back({c, i, j});
              }
      }
  }

  struct Place
  {
    unsigned int component, i, j;
  };

  std::size_t size() const
  {
    return offsets.size();
  }
  double mass(const std::size_t k) const
  {
    return masses[k];
  }
  const Place &place(const std::size_t k) const
  {
    return places[k];
  }

  /** Held entries become zero, duplicates copies. */
  void scatter(NodalField<double> &field, const Vector &values) const
  {
    field.set_zero();
    for (std::size_t k = 0; k < offsets.size(); ++k)
      field.begin()[offsets[k]] = values[k];
    for (unsigned int c = 0; c < 2; ++c)
      {
        for (unsigned int j = 0; periodic.x && j < n_rows; ++j)
          field.row(c, j)[n_columns - 1] = field.row(c, j)[0];
        if (periodic.y)
          std::copy_n(field.row(c, 0), n_columns, field.row(c, n_rows - 1));
      }
  }

  void gather(Vector &values, const NodalField<double> &field) const
  {
    for (std::size_t k = 0; k < offsets.size(); ++k)
      values[k] = field.begin()[offsets[k]];
  }

private:
  const Periodicity periodic;
  const unsigned int n_columns, n_rows;
  std::vector<std::size_t> offsets;
  std::vector<double> masses;
  std::vector<Place> places;
};

/** The lumped mass of the free degrees of freedom. */
struct MassMatrix
{
  const FreeDofs &dofs;

  void vmult(Vector &dst, const Vector &src) const
  {
    for (std::size_t k = 0; k < dofs.size(); ++k)
      dst[k] = dofs.mass(k) * src[k];
  }

  double dot(const Vector &x, const Vector &y) const
  {
    double sum = 0.;
    for (std::size_t k = 0; k < dofs.size(); ++k)
      sum += dofs.mass(k) * x[k] * y[k];
    return sum;
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
                                       const FreeDofs &dofs,
                                       const MassMatrix &mass)
{
  Eigen::Matrix3d hold = Eigen::Matrix3d::Zero();
  if (material.periodicity().x || material.periodicity().y)
    hold(2, 2) = 1.;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < held.n_rows(); ++j)
      for (unsigned int i = 0; i < held.n_columns(); ++i)
        if (held.is_held(c, i, j))
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
        motion.add(-mass.dot(other, motion), other);
      motion /= std::sqrt(mass.dot(motion, motion));
      motions.push_back(motion);
    }
  return motions;
}

/** K^-1 on loads without resultant; solutions have no rigid motion (in the mass' sense).
 */
class InverseStiffness
{
public:
  InverseStiffness(const UniformMaterial &material,
                   const DofMask &held,
                   const FreeDofs &dofs,
                   const MassMatrix &mass,
                   const VibrationModesOptions &options)
    : dofs(dofs)
    , mass(mass)
    , options(options)
    , rigid(free_rigid_motions(material, held, dofs, mass))
    , solver(make_static_solver(options.solver, material))
    , force(material.n_columns(), material.n_rows())
    , u(material.n_columns(), material.n_rows())
  {
    solver->set_held(held);
  }

  void vmult(Vector &dst, const Vector &src) const
  {
    if (options.before_solve)
      options.before_solve(n_solves);
    // The mass times a motion is the load that accelerates the body in that motion.
    Vector load(src), motion(src.size());
    for (const Vector &r : rigid)
      {
        mass.vmult(motion, r);
        load.add(-(r * src), motion);
      }
    dofs.scatter(force, load);
    u.set_zero();
    iterations += solver->solve(u, force, options.tolerance).iterations;
    ++n_solves;
    dofs.gather(dst, u);
    remove_rigid(dst);
  }

  void remove_rigid(Vector &x) const
  {
    for (const Vector &r : rigid)
      x.add(-mass.dot(r, x), r);
  }

  unsigned int n_rigid() const
  {
    return rigid.size();
  }

  mutable unsigned int n_solves = 0, iterations = 0;

private:
  const FreeDofs &dofs;
  const MassMatrix &mass;
  const VibrationModesOptions &options;
  const std::vector<Vector> rigid;
  std::unique_ptr<StaticSolver> solver;
  mutable NodalField<double> force, u;
};

/** Rayleigh quotient, residual, normalisation and masses of an eigenvector. */
VibrationMode finish_mode(const Vector &eigenvector,
                          const FreeDofs &dofs,
                          const MassMatrix &mass,
                          const UniformGridOperator &stiffness)
{
  const UniformMaterial &material = stiffness.material();
  VibrationMode mode;
  mode.shape = NodalField<double>(material.n_columns(), material.n_rows());
  NodalField<double> field(material.n_columns(), material.n_rows());
  Vector Ku(dofs.size()), Mu(dofs.size());
  dofs.scatter(mode.shape, eigenvector);
  stiffness.vmult(field, mode.shape);
  dofs.gather(Ku, field);
  mass.vmult(Mu, eigenvector);
  const double uMu = eigenvector * Mu, omega2 = eigenvector * Ku / uMu;
  mode.frequency = std::sqrt(std::max(0., omega2)) / (2. * M_PI);

  std::array<double, 2> momentum = {};
  for (std::size_t k = 0; k < dofs.size(); ++k)
    momentum[dofs.place(k).component] += Mu[k];
  for (unsigned int c = 0; c < 2; ++c)
    mode.effective_mass[c] = momentum[c] * momentum[c] / (uMu * material.total_mass());

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

VibrationModes vibration_modes(const UniformMaterial &material,
                               const DofMask &held,
                               const VibrationModesOptions &options)
{
  const FreeDofs dofs(material, held);
  const MassMatrix mass{dofs};
  if (dofs.size() < 2 * options.n_modes + 10)
    throw std::invalid_argument(
      std::to_string(options.n_modes) + " modes of only " + std::to_string(dofs.size()) +
      " free degrees of freedom; at most half of them, less 5, can "
      "be computed");
  const InverseStiffness inverse(material, held, dofs, mass, options);
  const UniformGridOperator stiffness(material);

  VibrationModes result;
  for (const Vector &x : lowest_eigenvectors(mass, inverse, dofs.size(), options.n_modes))
    result.modes.push_back(finish_mode(x, dofs, mass, stiffness));
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
