#ifndef mesoslip_elasticity_brick_brick_matrices_h
#define mesoslip_elasticity_brick_brick_matrices_h

#include "elasticity/uniform_material.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace mesoslip
{
/** Stiffness of a brick: node x + 2 y + 4 z of its corners, three components a node. */
using BrickMatrix = Eigen::Matrix<double, 24, 24>;

/**
 * The stiffness of a brick (exact integration) is linear in that of its material: the
 * matrices that belong to the coefficients of the kernels (n_isotropic or n_general of
 * coefficients.h, apart or not, volume / (16 h_y^2) included) for edges h.
 */
std::vector<BrickMatrix> brick_matrices(const std::array<double, 3> &spacing,
                                        const unsigned int n_coefficients);

/** The coefficients of a phase, see coefficients.h. */
std::vector<double> coefficients_of(const ElasticPhase<3> &phase,
                                    const unsigned int n_coefficients);

/** The stiffness of bricks of one shape. */
class BrickStiffness
{
public:
  /** Of bricks with the edges @p spacing. */
  explicit BrickStiffness(const std::array<double, 3> &spacing);

  /** Of a brick of @p phase, in the unit of brick_matrices(). */
  BrickMatrix operator()(const ElasticPhase<3> &phase) const;

private:
  const std::vector<BrickMatrix> matrices;
};
} // namespace mesoslip

#endif
