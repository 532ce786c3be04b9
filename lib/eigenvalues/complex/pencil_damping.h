#ifndef mesoslip_eigenvalues_complex_pencil_damping_h
#define mesoslip_eigenvalues_complex_pencil_damping_h

#include "body/elastic_body.h"
#include "eigenvalues/complex/complex_factorization.h"

#include <vector>

namespace mesoslip
{
template <int dim>
class FreeDofs;

/** Mean over all vibrations of what @p damped is over @p stiffness in them, the trace of K^-1 C over their number, from
 * random signs. */
double mean_beta(const RealMatrix &stiffness, const RealMatrix &damped);

/** The drags of nodes on the diagonal of the free degrees of freedom, of a platen their sum. Collective. */
template <int dim>
RealMatrix drags_of(const ElasticBody<dim> &body,
                    const FreeDofs<dim> &dofs,
                    const std::vector<double> &drags);
} // namespace mesoslip

#endif
