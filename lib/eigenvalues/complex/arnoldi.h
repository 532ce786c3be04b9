#ifndef mesoslip_eigenvalues_complex_arnoldi_h
#define mesoslip_eigenvalues_complex_arnoldi_h

#include <Eigen/Dense>

#include <functional>
#include <optional>

namespace mesoslip
{
/** What is wanted of arnoldi(). */
struct ArnoldiOptions
{
  int count           = 6;     ///< of eigenvalues
  double tolerance    = 1e-12; ///< relative, of the eigenvalues
  int most_iterations = 300;   ///< restarts
  unsigned int seed   = 1;     ///< of the random start
};

/** Eigenvalues, largest first, and their vectors as columns, of length one. */
struct Eigenpairs
{
  Eigen::VectorXcd values;  ///< of the operator
  Eigen::MatrixXcd vectors; ///< in the order of the values
};

/** dst = A src for vectors of the length of the problem. */
using ComplexOperator =
  std::function<void(Eigen::VectorXcd &dst, const Eigen::VectorXcd &src)>;

/**
 * The eigenvalues of largest size of a complex operator on vectors of length @p n, by the
 * implicitly restarted Arnoldi method (ARPACK). The number that converged, at least one,
 * may be less than count. Nothing if none does.
 * @throws std::invalid_argument unless count + 1 < @p n; NotConverged if ARPACK fails
 */
std::optional<Eigenpairs> arnoldi(const Eigen::Index n,
                                  const ComplexOperator &apply,
                                  const ArnoldiOptions &options);

/** Size of the largest eigenvalue alone, to the relative @p tolerance; else as arnoldi(). */
std::optional<double> largest_eigenvalue(const Eigen::Index n,
                                         const ComplexOperator &apply,
                                         const double tolerance);
} // namespace mesoslip

#endif
