#include "eigenvalues/complex/pencil_damping.h"

#include "eigenvalues/free_dofs.h"

#include <random>

namespace mesoslip
{
double mean_beta(const RealMatrix &stiffness, const RealMatrix &damped)
{
  constexpr int n_samples     = 20;
  const ComplexMatrix complex = stiffness.cast<std::complex<double>>();
  ComplexFactorization factors(complex);
  factors.factorize(complex);
  std::mt19937 generator(1);
  std::bernoulli_distribution coin;
  double sum = 0.;
  for (int k = 0; k < n_samples; ++k)
    {
      Eigen::VectorXd signs(stiffness.rows());
      for (double &sign : signs)
        sign = coin(generator) ? 1. : -1.;
      ComplexVector solution;
      factors.solve(solution, (damped * signs).cast<std::complex<double>>());
      sum += signs.dot(solution.real());
    }
  return sum / (n_samples * static_cast<double>(stiffness.rows()));
}

template <int dim>
RealMatrix drags_of(const ElasticBody<dim> &body,
                    const FreeDofs<dim> &dofs,
                    const std::vector<double> &drags)
{
  NodalField<double> field = body.zero_field();
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        field(c, {i, j}) = drags[std::size_t{j} * body.n_columns() + i];
  typename FreeDofs<dim>::Vector values = dofs.zero();
  dofs.gather_forces(values, field);
  std::vector<Eigen::Triplet<double, std::int64_t>> diagonal;
  for (std::size_t k = 0; k < dofs.size(); ++k)
    diagonal.emplace_back(k, k, values.local_element(k));
  const auto n = static_cast<Eigen::Index>(dofs.size());
  RealMatrix matrix(n, n);
  matrix.setFromTriplets(diagonal.begin(), diagonal.end());
  return matrix;
}

template RealMatrix
drags_of(const ElasticBody<2> &, const FreeDofs<2> &, const std::vector<double> &);
template RealMatrix
drags_of(const ElasticBody<3> &, const FreeDofs<3> &, const std::vector<double> &);
} // namespace mesoslip
