#ifndef mesoslip_contact_cone_newton_h
#define mesoslip_contact_cone_newton_h

#include <Eigen/Core>

#include <vector>

namespace mesoslip
{
/** Nodes on a flat at rest: the forces of the flat on them are F + S d, d being their displacements from
 * where they touch and stick. */
struct ConeProblem
{
  /** A node of the contact: where its components are in d. */
  struct Node
  {
    Eigen::Index normal = 0;         ///< that along the normal
    std::vector<Eigen::Index> along; ///< those that are free, one or two
    double mu = 0.;                  ///< coefficient of friction
  };

  Eigen::MatrixXd S;       ///< N/m
  Eigen::VectorXd F;       ///< N
  std::vector<Node> nodes; ///< those that a side does not hold

  /** Of the forces that pull a displaced node back in the augmented forces f - c d (N/m). */
  double c = 0.;
};

/**
 * Displacements with which each node touches, and sticks or has all its friction against its displacement, or
 * is free: a semismooth Newton method on the augmented forces (Alart and Curnier 1991), damped, with the coefficients of
 * friction grown from 0 in ten steps. It need not have come to its end: whoever asks checks what he gets.
 */
Eigen::VectorXd cone_newton(const ConeProblem &problem);
} // namespace mesoslip

#endif
