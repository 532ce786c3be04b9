#include "contact/anderson_acceleration.h"

#include <gtest/gtest.h>

using namespace mesoslip;

namespace
{
/** What @p acceleration makes of x = A x + b after n steps from zero. */
Eigen::Vector3d iterate(AndersonAcceleration &acceleration,
                        const Eigen::Matrix3d &A,
                        const unsigned int n)
{
  const Eigen::Vector3d b(1., -2., 0.5);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(3);
  for (unsigned int k = 0; k < n; ++k)
    x = acceleration.next(x, A * x + b);
  return x;
}
} // namespace

// As good as GMRES: a linear iteration of three unknowns ends after four steps, also where it
// diverges by itself.
TEST(AndersonAcceleration, EndsOnALinearIteration)
{
  Eigen::Matrix3d A;
  A << 0.5, 0.2, 0., -0.3, 1.5, 0.1, 0.4, 0., -2.;
  const Eigen::Vector3d b(1., -2., 0.5);
  AndersonAcceleration acceleration;
  const Eigen::Vector3d found = iterate(acceleration, A, 5);
  EXPECT_LT((found - (Eigen::Matrix3d::Identity() - A).inverse() * b).norm(), 1e-12);
}

// What comes again tells nothing new: friction of nodes that hardly touch may be the same in two
// iterations.
TEST(AndersonAcceleration, TakesTheImageOfWhatComesAgain)
{
  const Eigen::VectorXd x = Eigen::Vector3d(1., -2., 0.5),
                        g = Eigen::Vector3d(1., -2., 0.75);
  AndersonAcceleration acceleration;
  for (unsigned int k = 0; k < 4; ++k)
    EXPECT_EQ(acceleration.next(x, g), g);
}
