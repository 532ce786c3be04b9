#include "eigenvalues/vibration_modes.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "eigenvalues/free_dofs.h"
#include "eigenvalues/inverse_stiffness.h"

#include <deal.II/lac/arpack_solver.h>
#include <deal.II/lac/parpack_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

namespace mesoslip
{
namespace
{
using Vector = FreeDofs<2>::Vector; // the same type in 3D

/**
 * Scales @p shape to a largest displacement vector of length one, whose larger component
 * is positive; returns the scale. Among vectors equal up to round-off (mirror images),
 * the node with the lowest number decides.
 */
template <int dim>
double normalize(NodalField<double> &shape, const ElasticBody<dim> &body)
{
  const auto length_of = [&shape](const NodeIndex &node) {
    double length = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      length = std::hypot(length, shape(c, node));
    return length;
  };
  double most = 0.;
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      most = std::max(most, length_of({i, j}));
  most = mpi::max(most, body.communicator());

  // Utilities::MPI::min() of deal.II 9.4 treats unsigned 64-bit numbers as signed.
  constexpr std::uint64_t nowhere = std::numeric_limits<std::int64_t>::max();
  std::uint64_t first             = nowhere;
  NodeIndex place;
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      if (body.number({i, j}) < first && !(most > length_of({i, j}) * (1. + 1e-6)))
        {
          first = body.number({i, j});
          place = {i, j};
        }
  const std::uint64_t lowest = mpi::min(first, body.communicator());
  double factor              = -std::numeric_limits<double>::max();
  if (first == lowest && first != nowhere)
    {
      double component = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        if (std::fabs(shape(c, place)) > std::fabs(component) * (1. + 1e-6))
          component = shape(c, place);
      factor = (component < 0. ? -1. : 1.) * length_of(place);
    }
  factor = mpi::max(factor, body.communicator());
  for (std::size_t k = 0; k < shape.size(); ++k)
    shape.begin()[k] *= (factor < 0. ? -1. : 1.) / std::fabs(factor);
  return std::fabs(factor);
}

} // namespace

template <int dim>
VibrationMode<dim> make_mode(const typename FreeDofs<dim>::Vector &shape,
                             const typename FreeDofs<dim>::Vector &momentum,
                             const FreeDofs<dim> &dofs,
                             const ElasticBody<dim> &body)
{
  VibrationMode<dim> mode;
  mode.shape = body.zero_field();
  dofs.scatter(mode.shape, shape);
  const double uMu                  = shape * momentum;
  const std::array<double, dim> sum = dofs.sums(momentum);
  std::array<double, dim> moved;
  moved.fill(body.total_mass());
  for (const PlatenDof &dof : dofs.of_platens())
    moved[dof.component] += dof.mass;
  for (unsigned int c = 0; c < dim; ++c)
    mode.effective_mass[c] = sum[c] * sum[c] / (uMu * moved[c]);
  const double largest = normalize(mode.shape, body);
  mode.modal_mass      = uMu / (largest * largest);
  return mode;
}

namespace
{
/** Mode from an eigenvector; the frequency is the Rayleigh quotient. */
template <int dim>
VibrationMode<dim> finish_mode(const Vector &eigenvector,
                               const FreeDofs<dim> &dofs,
                               const ElasticBody<dim> &body)
{
  NodalField<double> u = body.zero_field(), field = u;
  Vector Ku = dofs.zero(), Mu = dofs.zero();
  dofs.scatter(u, eigenvector);
  body.vmult(field, u);
  dofs.gather_forces(Ku, field);
  dofs.vmult(Mu, eigenvector);
  VibrationMode<dim> mode = make_mode<dim>(eigenvector, Mu, dofs, body);
  const double omega2     = (eigenvector * Ku) / (eigenvector * Mu);
  mode.frequency          = std::sqrt(std::max(0., omega2)) / (2. * M_PI);
  const double norm       = Ku.l2_norm();
  Ku.add(-omega2, Mu);
  mode.residual = Ku.l2_norm() / norm;
  return mode;
}

/** scale * K^-1 with the eigenvectors @p found (of unit mass) projected out. */
template <int dim>
struct InverseWithout
{
  const InverseStiffness<dim> &inverse;
  const FreeDofs<dim> &dofs;
  const std::vector<Vector> &found;
  double scale = 1.; ///< factor (1/s^2)

  void vmult(Vector &dst, const Vector &src) const
  {
    inverse.vmult(dst, src);
    dst *= scale;
    remove(dst);
  }

  /** Projects out rigid motions and known eigenvectors. */
  void remove(Vector &x) const
  {
    inverse.remove_rigid(x);
    for (const Vector &mode : found)
      x.add(-dofs.mass_product(mode, x), mode);
  }
};

/** Rayleigh quotient omega^2 of a vector. */
template <int dim>
double rayleigh_quotient(const Vector &x,
                         const FreeDofs<dim> &dofs,
                         const ElasticBody<dim> &body)
{
  NodalField<double> u = body.zero_field(), force = u;
  dofs.scatter(u, x);
  body.vmult(force, u);
  Vector Ku = dofs.zero();
  dofs.gather_forces(Ku, force);
  return x * Ku / dofs.mass_product(x, x);
}

/** @p n eigenvectors of the lowest eigenvalues that @p inverse does not project out. */
template <int dim>
std::vector<Vector> lanczos(const FreeDofs<dim> &dofs,
                            InverseWithout<dim> inverse,
                            const ElasticBody<dim> &body,
                            const unsigned int n,
                            const double tolerance,
                            const unsigned int seed)
{
  using dealii::ArpackSolver;
  using dealii::PArpackSolver;
  const unsigned int n_lanczos =
    static_cast<unsigned int>(std::min<std::size_t>(2 * n + 10, dofs.size() - 1));
  const MPI_Comm communicator = body.communicator();
  Vector start                = dofs.zero();
  std::mt19937 generator(seed + mpi::this_mpi_process(communicator));
  std::uniform_real_distribution<> number(-1., 1.);
  for (double &x : start)
    x = number(generator);
  inverse.remove(start);
  // The tolerance of ARPACK is relative to 1 / omega^2, but at least relative to
  // eps^(2/3) in any unit: omega^2 is therefore scaled so that no value is much larger
  // than one.
  inverse.scale = rayleigh_quotient(start, dofs, body);

  std::vector<std::complex<double>> values(n);
  std::vector<Vector> vectors(n, start);
  dealii::SolverControl control(1000, tolerance, false, false);
  if (mpi::n_mpi_processes(communicator) == 1)
    {
      ArpackSolver arpack(control, ArpackSolver::AdditionalData(
                                     n_lanczos, ArpackSolver::largest_magnitude, true));
      arpack.set_initial_vector(start);
      arpack.solve(dofs, dofs, inverse, values, vectors, n);
      return vectors;
    }
  // PARPACK requires entries on every rank.
  if (mpi::min(start.locally_owned_size(), communicator) == 0)
    throw UserError(
      "Modal: one of the processes has no free degree of freedom of its own, "
      "as there are few cells; start fewer of them");
  using Solver = PArpackSolver<Vector>;
  Solver arpack(control, communicator,
                Solver::AdditionalData(n_lanczos, Solver::largest_magnitude, true));
  arpack.reinit(start);
  arpack.set_initial_vector(start);
  try
    {
      arpack.solve(dofs, dofs, inverse, values, vectors, n);
    }
  catch (const dealii::ExceptionBase &)
    {
      throw NotConverged("the Lanczos iteration did not converge");
    }
  return vectors;
}

/**
 * Eigenvectors of the lowest eigenvalues, in no particular order. A Krylov space contains
 * a single vector of a multiple eigenvalue (square, cylinder), and further ones by
 * round-off only. Missing vectors are found by further iterations that project out the
 * known ones, first to a lower accuracy.
 */
template <int dim>
std::vector<Vector> lowest_eigenvectors(const FreeDofs<dim> &dofs,
                                        const InverseStiffness<dim> &inverse,
                                        const ElasticBody<dim> &body,
                                        const unsigned int n_modes)
{
  constexpr double accurate = 1e-10, rough = 1e-3;
  std::vector<Vector> found;
  std::vector<double> quotients; // Rayleigh quotients of found, ascending
  const auto more = [&](const unsigned int n, const double tolerance) {
    return lanczos<dim>(dofs, {inverse, dofs, found}, body, n, tolerance,
                        static_cast<unsigned int>(1 + 1000 * found.size()));
  };
  const auto keep = [&](const std::vector<Vector> &vectors) {
    for (Vector x : vectors)
      {
        x /= std::sqrt(dofs.mass_product(x, x));
        quotients.push_back(rayleigh_quotient(x, dofs, body));
        found.push_back(x);
      }
    std::sort(quotients.begin(), quotients.end());
  };
  keep(more(n_modes, accurate));
  while (found.size() + 1 + inverse.n_rigid() < dofs.size())
    {
      const double last = quotients[n_modes - 1];
      if (!(rayleigh_quotient(more(1, rough)[0], dofs, body) < last * (1. - 1e-6)))
        break;
      keep(more(1, accurate));
    }
  return found;
}
} // namespace

void check_number_of_modes(const std::size_t n_free, const VibrationModesOptions &options)
{
  if (n_free < 2 * options.n_modes + 10)
    throw std::invalid_argument(std::to_string(options.n_modes) + " modes of only " +
                                std::to_string(n_free) + " free degrees of freedom; " +
                                (n_free < 12 ? "there have to be 12 at least"
                                             : "at most half of them, less 5, can be "
                                               "computed"));
}

template <int dim>
VibrationModes<dim> vibration_modes(const ElasticBody<dim> &body,
                                    const DofMask &mask,
                                    const VibrationModesOptions &options)
{
  const FreeDofs<dim> dofs(body, mask, options.platens);
  check_number_of_modes(dofs.size(), options);
  const InverseStiffness<dim> inverse(body, mask, dofs, options);

  VibrationModes<dim> result;
  for (const Vector &x : lowest_eigenvectors(dofs, inverse, body, options.n_modes))
    result.modes.push_back(finish_mode(x, dofs, body));
  std::sort(result.modes.begin(), result.modes.end(),
            [](const VibrationMode<dim> &a, const VibrationMode<dim> &b) {
              return a.frequency < b.frequency;
            });
  result.modes.resize(options.n_modes);
  result.n_rigid_motions   = inverse.n_rigid();
  result.n_solves          = inverse.n_solves;
  result.solver_iterations = inverse.iterations;

  // ArpackSolver reports failures only by assertions of debug builds.
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

template VibrationMode<2> make_mode(const FreeDofs<2>::Vector &,
                                    const FreeDofs<2>::Vector &,
                                    const FreeDofs<2> &,
                                    const ElasticBody<2> &);
template VibrationMode<3> make_mode(const FreeDofs<3>::Vector &,
                                    const FreeDofs<3>::Vector &,
                                    const FreeDofs<3> &,
                                    const ElasticBody<3> &);
template VibrationModes<2>
vibration_modes(const ElasticBody<2> &, const DofMask &, const VibrationModesOptions &);
template VibrationModes<3>
vibration_modes(const ElasticBody<3> &, const DofMask &, const VibrationModesOptions &);
} // namespace mesoslip
