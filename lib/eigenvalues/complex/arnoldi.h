#ifndef mesoslip_eigenvalues_complex_arnoldi_h
#define mesoslip_eigenvalues_complex_arnoldi_h

#include <Eigen/Dense>

#include <functional>
#include <optional>

namespace mesoslip
{
/** Options of arnoldi(). */
struct ArnoldiOptions
{
  int count           = 6;     ///< number of eigenvalues
  double tolerance    = 1e-12; ///< relative accuracy of the eigenvalues
  int most_iterations = 300;   ///< largest number of restarts
  unsigned int seed   = 1;     ///< seed of the random start vector
};

/** Eigenvalues, largest first, and unit eigenvectors as columns. */
struct Eigenpairs
{
  Eigen::VectorXcd values;  ///< eigenvalues of the operator
  Eigen::MatrixXcd vectors; ///< in the order of the values
};

/** dst = A src for vectors of the size of the problem. */
using ComplexOperator =
  std::function<void(Eigen::VectorXcd &dst, const Eigen::VectorXcd &src)>;

/**
 * Eigenvalues of largest absolute value of a complex operator on vectors of length @p n,
 * by the implicitly restarted Arnoldi method (ARPACK). Possibly fewer than count
 * converge, at least one; empty if none does. @throws std::invalid_argument unless count
 * + 1 < @p n; NotConverged if ARPACK fails
 */
std::optional<Eigenpairs> arnoldi(const Eigen::Index n,
                                  const ComplexOperator &apply,
                                  const ArnoldiOptions &options);

/**
 * Absolute value of the largest eigenvalue, to the relative @p tolerance; otherwise as
 * arnoldi().
 */
std::optional<double> largest_eigenvalue(const Eigen::Index n,
                                         const ComplexOperator &apply,
                                         const double tolerance);
} // namespace mesoslip

#endif
