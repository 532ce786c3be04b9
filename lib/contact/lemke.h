#ifndef mesoslip_contact_lemke_h
#define mesoslip_contact_lemke_h

#include <Eigen/Dense>

#include <optional>

namespace mesoslip
{
/**
 * A z >= 0 with w = M z + q >= 0 and z^T w = 0, by Lemke's complementary pivots that start along
 * @p cover > 0, ties broken by the lexicographic order. Nothing if they end on a ray: then there may
 * be a solution, unless M is such that Lemke's method finds one whenever there is, as with
 * z^T M z >= 0 for all z.
 */
std::optional<Eigen::VectorXd>
lemke(const Eigen::MatrixXd &M, const Eigen::VectorXd &q, const Eigen::VectorXd &cover);

/** Whether no z >= 0 has M z + q >= 0, so that nothing solves the problem, by a certificate (Farkas): a
 * y >= 0 with M^T y <= 0 and q^T y < 0. M and q have entries of the size of one. */
bool is_infeasible(const Eigen::MatrixXd &M, const Eigen::VectorXd &q);
} // namespace mesoslip

#endif
