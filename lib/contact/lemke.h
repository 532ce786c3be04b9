#ifndef mesoslip_contact_lemke_h
#define mesoslip_contact_lemke_h

#include <Eigen/Dense>

#include <optional>

namespace mesoslip
{
/**
 * Solves z >= 0, w = M z + q >= 0, z^T w = 0 by Lemke's complementary pivots starting
 * along @p cover > 0, with lexicographic tie breaking. Empty if the pivots end on a ray:
 * a solution may then still exist, unless M belongs to a class for which Lemke's method
 * finds every solvable case, such as z^T M z >= 0 for all z.
 */
std::optional<Eigen::VectorXd>
lemke(const Eigen::MatrixXd &M, const Eigen::VectorXd &q, const Eigen::VectorXd &cover);

/**
 * Whether no z >= 0 has M z + q >= 0, so that the problem has no solution. Based on a
 * certificate (Farkas): a y >= 0 with M^T y <= 0 and q^T y < 0. Entries of M and q must
 * have order one.
 */
bool is_infeasible(const Eigen::MatrixXd &M, const Eigen::VectorXd &q);
} // namespace mesoslip

#endif
