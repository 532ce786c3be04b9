#ifndef mesoslip_eigenvalues_complex_pencil_damping_h
#define mesoslip_eigenvalues_complex_pencil_damping_h

#include "body/elastic_body.h"
#include "eigenvalues/complex/complex_factorization.h"

#include <vector>

namespace mesoslip
{
template <int dim>
class FreeDofs;

/**
 * Mean over all vibrations of the quotient of @p damped and @p stiffness: the trace of
 * K^-1 C over the number of vibrations, estimated with random signs.
 */
double mean_beta(const RealMatrix &stiffness, const RealMatrix &damped);

/**
 * Diagonal matrix of the nodal drags for the free degrees of freedom; a platen has the
 * sum of its nodes. Collective.
 */
template <int dim>
RealMatrix drags_of(const ElasticBody<dim> &body,
                    const FreeDofs<dim> &dofs,
                    const std::vector<double> &drags);
} // namespace mesoslip

#endif
