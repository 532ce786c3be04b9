#ifndef mesoslip_eigenvalues_complex_complex_factorization_h
#define mesoslip_eigenvalues_complex_complex_factorization_h

#include <Eigen/Sparse>

#include <complex>
#include <cstdint>
#include <memory>
#include <vector>

namespace mesoslip
{
/** Complex matrices in compressed columns with the indices of UMFPACK. */
using ComplexMatrix =
  Eigen::SparseMatrix<std::complex<double>, Eigen::ColMajor, std::int64_t>;

/** Real matrices likewise. */
using RealMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;

/** Complex numbers, one for each unknown. */
using ComplexVector = Eigen::VectorXcd;

/**
 * LU factors of sparse complex matrices that have their entries in the same places
 * (UMFPACK): these are ordered once.
 */
class ComplexFactorization
{
public:
  /** Orders the unknowns of @p pattern, whose numbers do not matter. @throws
   * NotConverged when there is not enough memory */
  explicit ComplexFactorization(const ComplexMatrix &pattern);

  ~ComplexFactorization();
  ComplexFactorization(const ComplexFactorization &) = delete; ///< owns factors
  ComplexFactorization &
  operator=(const ComplexFactorization &) = delete; ///< owns factors

  /** Factorizes a matrix with that pattern. @throws NotConverged if it is singular or
   * there is not enough memory */
  void factorize(const ComplexMatrix &given);

  /** x = A^-1 b. */
  void solve(ComplexVector &x, const ComplexVector &b) const;

  /** Of the determinant (rad). */
  double phase_of_determinant() const;

  /** Bytes of the last factors. */
  double bytes() const
  {
    return size_of_factors;
  }

private:
  void forget_factors();

  struct Handles; ///< of UMFPACK
  const std::unique_ptr<Handles> handles;
  ComplexMatrix matrix; ///< which UMFPACK looks at in solve()
  double size_of_factors = 0.;
  mutable std::vector<std::int64_t> integers; ///< work space
  mutable std::vector<double> numbers;        ///< work space
};
} // namespace mesoslip

#endif
