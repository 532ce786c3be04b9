#include "material/symmetric_eigenvalues.h"

#include <Eigen/Eigenvalues>

namespace mesoslip
{
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd &matrix)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
    .eigenvalues();
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B)
{
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, B,
                                                                   Eigen::EigenvaluesOnly)
    .eigenvalues();
}
} // namespace mesoslip
