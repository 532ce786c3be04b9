#ifndef mesoslip_material_symmetric_eigenvalues_h
#define mesoslip_material_symmetric_eigenvalues_h

#include <Eigen/Core>

namespace mesoslip
{
/** Eigenvalues, ascending, of a small symmetric @p matrix by Eigen's solver, which takes
 * seconds to compile. */
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd &matrix);

/** Generalized eigenvalues of A x = lambda B x, ascending, with B positive definite. */
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B);
} // namespace mesoslip

#endif
