#ifndef mesoslip_elasticity_brick_brick_matrices_h
#define mesoslip_elasticity_brick_brick_matrices_h

#include "elasticity/uniform_material.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace mesoslip
{
/** Stiffness of a brick: corners numbered x + 2 y + 4 z, three components per node. */
using BrickMatrix = Eigen::Matrix<double, 24, 24>;

/**
 * Derivatives of the stiffness of a brick (exact integration), which is linear in the
 * material coefficients: one matrix per coefficient of the kernels (n_isotropic or
 * n_general of coefficients.h, with or without mean dilatation, volume / (16 h_y^2)
 * included), for edges @p spacing (m).
 */
std::vector<BrickMatrix> brick_matrices(const std::array<double, 3> &spacing,
                                        const unsigned int n_coefficients);

/** Coefficients of a phase, see coefficients.h. */
std::vector<double> coefficients_of(const ElasticPhase<3> &phase,
                                    const unsigned int n_coefficients);

/** Stiffness matrices of bricks of one shape. */
class BrickStiffness
{
public:
  /** Bricks with edges @p spacing (m). */
  explicit BrickStiffness(const std::array<double, 3> &spacing);

  /** Stiffness of a brick of @p phase, in the units of brick_matrices(). */
  BrickMatrix operator()(const ElasticPhase<3> &phase) const;

private:
  const std::vector<BrickMatrix> matrices;
};
} // namespace mesoslip

#endif
