#ifndef mesoslip_contact_cone_newton_h
#define mesoslip_contact_cone_newton_h

#include <Eigen/Core>

#include <vector>

namespace mesoslip
{
/**
 * Nodes on a flat at rest: forces of the flat on the nodes are F + S d, with
 * displacements d from the state in which all nodes touch and stick.
 */
struct ConeProblem
{
  /** A contact node: indices of its components in d. */
  struct Node
  {
    Eigen::Index normal = 0;         ///< index of the normal component
    std::vector<Eigen::Index> along; ///< indices of the free tangential components
    double mu = 0.;                  ///< coefficient of friction
  };

  Eigen::MatrixXd S;       ///< N/m
  Eigen::VectorXd F;       ///< N
  std::vector<Node> nodes; ///< nodes that no side constrains

  /** Stiffness of the augmentation in the augmented forces f - c d (N/m). */
  double c = 0.;
};

/**
 * Displacements for which each node touches, and sticks or slips with full friction
 * against its displacement, or is separated. Damped semismooth Newton method for the
 * augmented forces (Alart and Curnier 1991); the coefficients of friction grow from 0 in
 * ten steps. Convergence is not guaranteed: the caller must check the result.
 */
Eigen::VectorXd cone_newton(const ConeProblem &problem);
} // namespace mesoslip

#endif
