#ifndef mesoslip_eigenvalues_complex_complex_factorization_h
#define mesoslip_eigenvalues_complex_complex_factorization_h

#include <Eigen/Sparse>

#include <complex>
#include <cstdint>
#include <memory>
#include <vector>

namespace mesoslip
{
/** Complex matrices in compressed columns with the index type of UMFPACK. */
using ComplexMatrix =
  Eigen::SparseMatrix<std::complex<double>, Eigen::ColMajor, std::int64_t>;

/** Real matrices in compressed columns with the index type of UMFPACK. */
using RealMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;

/** A complex number per unknown. */
using ComplexVector = Eigen::VectorXcd;

/**
 * LU factors of sparse complex matrices with a common sparsity pattern (UMFPACK), which
 * is ordered once.
 */
class ComplexFactorization
{
public:
  /**
   * Orders the unknowns of @p pattern; its values do not matter. @throws NotConverged if
   * there is not enough memory
   */
  explicit ComplexFactorization(const ComplexMatrix &pattern);

  ~ComplexFactorization();
  ComplexFactorization(const ComplexFactorization &) = delete; ///< owns factors
  ComplexFactorization &
  operator=(const ComplexFactorization &) = delete; ///< owns factors

  /**
   * Factorizes a matrix with this pattern. @throws NotConverged if it is singular or
   * there is not enough memory
   */
  void factorize(const ComplexMatrix &given);

  /** x = A^-1 b. */
  void solve(ComplexVector &x, const ComplexVector &b) const;

  /** Phase of the determinant (rad). */
  double phase_of_determinant() const;

  /** Memory of the last factors (bytes). */
  double bytes() const
  {
    return size_of_factors;
  }

private:
  void forget_factors();

  struct Handles; ///< objects of UMFPACK
  const std::unique_ptr<Handles> handles;
  ComplexMatrix matrix; ///< copy that UMFPACK reads in solve()
  double size_of_factors = 0.;
  mutable std::vector<std::int64_t> integers; ///< work space
  mutable std::vector<double> numbers;        ///< work space
};
} // namespace mesoslip

#endif
