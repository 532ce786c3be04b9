#include "eigenvalues/complex/complex_factorization.h"

#include "statics/static_solver.h"

#include <umfpack.h>

#include <array>
#include <string>

namespace mesoslip
{
static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t), "indices of UMFPACK");

struct ComplexFactorization::Handles
{
  void *symbolic = nullptr;
  void *numeric  = nullptr;
  std::array<double, UMFPACK_CONTROL> control;
  std::array<double, UMFPACK_INFO> info;
};

namespace
{
/** Complex numbers for UMFPACK: interleaved real and imaginary parts. */
const double *packed(const std::complex<double> *values)
{
  return reinterpret_cast<const double *>(values);
}

/** Converts to the integer type of UMFPACK. */
const SuiteSparse_long *indices(const std::int64_t *values)
{
  return reinterpret_cast<const SuiteSparse_long *>(values);
}

void require(const double status, const std::string &task)
{
  if (status == UMFPACK_OK)
    return;
  throw NotConverged("UMFPACK could not " + task +
                     (status == UMFPACK_ERROR_out_of_memory
                        ? ": there is not enough memory"
                      : status == UMFPACK_WARNING_singular_matrix
                        ? ": the matrix is singular"
                        : ": error " + std::to_string(static_cast<int>(status))));
}
} // namespace

ComplexFactorization::ComplexFactorization(const ComplexMatrix &pattern)
  : handles(std::make_unique<Handles>())
  , integers(static_cast<std::size_t>(pattern.rows()))
  , numbers(4 * static_cast<std::size_t>(pattern.rows()))
{
  umfpack_zl_defaults(handles->control.data());
  // Structurally symmetric matrix with large diagonal entries.
  handles->control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  handles->control[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
  handles->control[UMFPACK_IRSTEP]   = 0; // Arnoldi residuals judge the solves
  require(umfpack_zl_symbolic(
            pattern.rows(), pattern.cols(), indices(pattern.outerIndexPtr()),
            indices(pattern.innerIndexPtr()), packed(pattern.valuePtr()), nullptr,
            &handles->symbolic, handles->control.data(), handles->info.data()),
          "order the unknowns");
}

ComplexFactorization::~ComplexFactorization()
{
  forget_factors();
  umfpack_zl_free_symbolic(&handles->symbolic);
}

void ComplexFactorization::forget_factors()
{
  if (handles->numeric != nullptr)
    umfpack_zl_free_numeric(&handles->numeric);
}

void ComplexFactorization::factorize(const ComplexMatrix &given)
{
  forget_factors();
  matrix = given;
  require(umfpack_zl_numeric(indices(matrix.outerIndexPtr()),
                             indices(matrix.innerIndexPtr()), packed(matrix.valuePtr()),
                             nullptr, handles->symbolic, &handles->numeric,
                             handles->control.data(), handles->info.data()),
          "factorize the matrix of " + std::to_string(matrix.rows()) + " unknowns");
  size_of_factors =
    handles->info[UMFPACK_NUMERIC_SIZE] * handles->info[UMFPACK_SIZE_OF_UNIT];
}

void ComplexFactorization::solve(ComplexVector &x, const ComplexVector &b) const
{
  x.resize(b.size());
  require(umfpack_zl_wsolve(
            UMFPACK_A, indices(matrix.outerIndexPtr()), indices(matrix.innerIndexPtr()),
            packed(matrix.valuePtr()), nullptr, reinterpret_cast<double *>(x.data()),
            nullptr, packed(b.data()), nullptr, handles->numeric, handles->control.data(),
            handles->info.data(), reinterpret_cast<SuiteSparse_long *>(integers.data()),
            numbers.data()),
          "solve");
}

double ComplexFactorization::phase_of_determinant() const
{
  // A number between 1 and 10, and the power of ten.
  std::array<double, 2> mantissa = {};
  double exponent                = 0.;
  require(umfpack_zl_get_determinant(mantissa.data(), nullptr, &exponent,
                                     handles->numeric, handles->info.data()),
          "compute a determinant");
  return std::arg(std::complex<double>(mantissa[0], mantissa[1]));
}
} // namespace mesoslip
