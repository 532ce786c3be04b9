#include "eigenvalues/vibration_modes.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "body/rigid_motions.h"
#include "eigenvalues/free_dofs.h"

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
using Vector = FreeDofs<2>::Vector; // in 3D the same

/** The rigid motions that nothing holds, orthonormal with respect to the mass. */
template <int dim>
std::vector<Vector>
orthonormal_motions(const ElasticBody<dim> &body, DofMask mask, const FreeDofs<dim> &dofs)
{
  if (dofs.has_platen())
    for (const NodeIndex &node : body.surface(ElasticBody<dim>::top).nodes)
      mask.release(dim - 1, node);
  std::vector<Vector> motions;
  // Neither can a platen turn.
  for (const NodalField<double> &field :
       free_rigid_motions(body, mask, !dofs.has_platen()))
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
    if (dofs.has_platen() && !platen_moves_freely())
      push_platen(body);
  }

  void vmult(Vector &dst, const Vector &src) const
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
      return std::fabs(dofs.of_platen(r)) > 1e-6 * r.linfty_norm();
    });
  }

  void push_platen(const ElasticBody<dim> &body)
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

  const FreeDofs<dim> &dofs;
  const VibrationModesOptions &options;
  const std::vector<Vector> rigid;
  std::unique_ptr<StaticSolver> solver;
  mutable NodalField<double> force, u;
  Vector response;              ///< z; empty without a platen or when nothing resists it
  double platen_stiffness = 0.; ///< z.K z (N/m^2)
};

/**
 * Divides @p shape by its largest displacement vector, which is returned, with the sign that
 * makes the larger component of that positive. Of mirror images, which are equal up to
 * round-off, the node with the lowest number decides.
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

  // Utilities::MPI::min() of deal.II 9.4 takes unsigned numbers of 64 bits for signed ones.
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
  Vector Ku = dofs.zero(), Mu = dofs.zero();
  dofs.scatter(mode.shape, eigenvector);
  body.vmult(field, mode.shape);
  dofs.gather_forces(Ku, field);
  dofs.vmult(Mu, eigenvector);
  const double uMu = eigenvector * Mu, omega2 = eigenvector * Ku / uMu;
  mode.frequency = std::sqrt(std::max(0., omega2)) / (2. * M_PI);

  const std::array<double, dim> momentum = dofs.sums(Mu);
  for (unsigned int c = 0; c < dim; ++c)
    {
      const double moved     = body.total_mass() + (c + 1 == dim ? platen_mass : 0.);
      mode.effective_mass[c] = momentum[c] * momentum[c] / (uMu * moved);
    }

  double norm = Ku.l2_norm();
  Ku.add(-omega2, Mu);
  mode.residual = Ku.l2_norm() / norm;

  const double largest = normalize(mode.shape, body);
  mode.modal_mass      = uMu / (largest * largest);
  return mode;
}

/** The eigenvectors of the lowest eigenvalues, in no particular order. */
template <int dim>
std::vector<Vector> lowest_eigenvectors(const FreeDofs<dim> &dofs,
                                        const InverseStiffness<dim> &inverse,
                                        const MPI_Comm communicator,
                                        const unsigned int n_modes)
{
  using dealii::ArpackSolver;
  using dealii::PArpackSolver;
  const unsigned int n_lanczos =
    static_cast<unsigned int>(std::min<std::size_t>(2 * n_modes + 10, dofs.size() - 1));
  Vector start = dofs.zero();
  std::mt19937 generator(1 + mpi::this_mpi_process(communicator));
  std::uniform_real_distribution<> number(-1., 1.);
  for (double &x : start)
    x = number(generator);
  inverse.remove_rigid(start);

  std::vector<std::complex<double>> values(n_modes);
  std::vector<Vector> vectors(n_modes, start);
  dealii::SolverControl control(1000, 1e-10, false, false);
  if (mpi::n_mpi_processes(communicator) == 1)
    {
      ArpackSolver arpack(control, ArpackSolver::AdditionalData(
                                     n_lanczos, ArpackSolver::largest_magnitude, true));
      arpack.set_initial_vector(start);
      arpack.solve(dofs, dofs, inverse, values, vectors, n_modes);
      return vectors;
    }
  // PARPACK takes no part without entries.
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
      arpack.solve(dofs, dofs, inverse, values, vectors, n_modes);
    }
  catch (const dealii::ExceptionBase &)
    {
      throw NotConverged("the Lanczos iteration did not converge");
    }
  return vectors;
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
  const FreeDofs<dim> dofs(body, mask, options.platen_mass);
  check_number_of_modes(dofs.size(), options);
  const InverseStiffness<dim> inverse(body, mask, dofs, options);

  VibrationModes<dim> result;
  for (const Vector &x :
       lowest_eigenvectors(dofs, inverse, body.communicator(), options.n_modes))
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
