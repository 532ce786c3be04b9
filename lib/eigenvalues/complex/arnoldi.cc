#include "eigenvalues/complex/arnoldi.h"

#include "statics/static_solver.h"

#include <algorithm>
#include <array>
#include <complex>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

// Complex drivers of ARPACK with their Fortran names; deal.II has the real ones.
extern "C"
{
  void znaupd_(int *ido,
               const char *bmat,
               const int *n,
               const char *which,
               const int *nev,
               const double *tol,
               std::complex<double> *resid,
               const int *ncv,
               std::complex<double> *v,
               const int *ldv,
               int *iparam,
               int *ipntr,
               std::complex<double> *workd,
               std::complex<double> *workl,
               const int *lworkl,
               double *rwork,
               int *info);
  void zneupd_(const int *rvec,
               const char *howmny,
               int *select,
               std::complex<double> *d,
               std::complex<double> *z,
               const int *ldz,
               const std::complex<double> *sigma,
               std::complex<double> *workev,
               const char *bmat,
               const int *n,
               const char *which,
               const int *nev,
               const double *tol,
               std::complex<double> *resid,
               const int *ncv,
               std::complex<double> *v,
               const int *ldv,
               int *iparam,
               int *ipntr,
               std::complex<double> *workd,
               std::complex<double> *workl,
               const int *lworkl,
               double *rwork,
               int *info);
}

namespace mesoslip
{
namespace
{
using Complex = std::complex<double>;

/** Memory of ARPACK between calls. */
struct Workspace
{
  Workspace(const int n, const ArnoldiOptions &options)
    : n(n)
    , nev(options.count)
    , ncv(std::min(2 * options.count + 10, n))
    , n_work(3 * ncv * ncv + 5 * ncv)
    , tolerance(options.tolerance)
    , residual(static_cast<std::size_t>(n))
    , basis(static_cast<std::size_t>(n) * static_cast<std::size_t>(ncv))
    , exchanged(3 * static_cast<std::size_t>(n))
    , work(static_cast<std::size_t>(n_work))
    , real_work(static_cast<std::size_t>(ncv))
  {
    std::mt19937 random(options.seed);
    std::uniform_real_distribution<double> number(-1., 1.);
    for (Complex &x : residual)
      x = Complex(number(random), number(random));
    parameters[0] = 1; // exact shifts
    parameters[2] = options.most_iterations;
    parameters[3] = 1;
    parameters[6] = 1; // A x = lambda x
  }

  const int n, nev, ncv, n_work;
  const double tolerance;
  std::vector<Complex> residual, basis, exchanged, work;
  std::vector<double> real_work;
  std::array<int, 11> parameters = {};
  std::array<int, 14> pointers   = {};
  int info                       = 1; // start vector in residual
};

void iterate(Workspace &w, const ComplexOperator &apply)
{
  int task = 0;
  Eigen::VectorXcd source(w.n), result(w.n);
  while (true)
    {
      znaupd_(&task, "I", &w.n, "LM", &w.nev, &w.tolerance, w.residual.data(), &w.ncv,
              w.basis.data(), &w.n, w.parameters.data(), w.pointers.data(),
              w.exchanged.data(), w.work.data(), &w.n_work, w.real_work.data(), &w.info);
      if (task != 1 && task != -1)
        return;
      source = Eigen::Map<Eigen::VectorXcd>(w.exchanged.data() + w.pointers[0] - 1, w.n);
      apply(result, source);
      Eigen::Map<Eigen::VectorXcd>(w.exchanged.data() + w.pointers[1] - 1, w.n) = result;
    }
}

Eigenpairs extract(Workspace &w)
{
  const int with_vectors = 1;
  const Complex shift    = 0.;
  std::vector<int> select(static_cast<std::size_t>(w.ncv));
  std::vector<Complex> values(static_cast<std::size_t>(w.nev) + 1),
    vector_work(2 * static_cast<std::size_t>(w.ncv));
  zneupd_(&with_vectors, "A", select.data(), values.data(), w.basis.data(), &w.n, &shift,
          vector_work.data(), "I", &w.n, "LM", &w.nev, &w.tolerance, w.residual.data(),
          &w.ncv, w.basis.data(), &w.n, w.parameters.data(), w.pointers.data(),
          w.exchanged.data(), w.work.data(), &w.n_work, w.real_work.data(), &w.info);
  if (w.info != 0)
    throw NotConverged("ARPACK could not form eigenvectors: zneupd returned " +
                       std::to_string(w.info));
  const std::size_t n_found = static_cast<std::size_t>(w.parameters[4]);
  std::vector<std::size_t> order(n_found);
  for (std::size_t k = 0; k < n_found; ++k)
    order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(values[a]) > std::abs(values[b]);
  });
  Eigenpairs result;
  const Eigen::Map<const Eigen::MatrixXcd> basis(w.basis.data(), w.n, w.ncv);
  result.values.resize(static_cast<Eigen::Index>(n_found));
  result.vectors.resize(w.n, static_cast<Eigen::Index>(n_found));
  for (std::size_t k = 0; k < n_found; ++k)
    {
      const auto place          = static_cast<Eigen::Index>(k);
      result.values[place]      = values[order[k]];
      result.vectors.col(place) = basis.col(static_cast<Eigen::Index>(order[k]));
    }
  return result;
}
} // namespace

std::optional<Eigenpairs>
arnoldi(const Eigen::Index n, const ComplexOperator &apply, const ArnoldiOptions &options)
{
  if (options.count + 1 >= n)
    throw std::invalid_argument("ARPACK finds fewer eigenvalues than unknowns but one");
  Workspace w(static_cast<int>(n), options);
  iterate(w, apply);
  if (w.info != 0 && w.info != 1)
    throw NotConverged("ARPACK failed: znaupd returned " + std::to_string(w.info));
  if (w.parameters[4] < 1)
    return std::nullopt;
  w.info = 0;
  return extract(w);
}

std::optional<double> largest_eigenvalue(const Eigen::Index n,
                                         const ComplexOperator &apply,
                                         const double tolerance)
{
  ArnoldiOptions options;
  options.count     = 2;
  options.tolerance = tolerance;
  const auto found  = arnoldi(n, apply, options);
  return found ? std::make_optional(std::abs(found->values[0])) : std::nullopt;
}
} // namespace mesoslip
