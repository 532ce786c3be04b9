#include "body/point_body.h"

#include "base/exchange.h"

namespace mesoslip
{
template <int dim>
std::vector<std::uint64_t> PointBody<dim>::owned_points() const
{
  std::vector<std::uint64_t> numbers;
  for (std::size_t k = 0; k < n_owned; ++k)
    numbers.push_back(this->number({static_cast<unsigned int>(k % this->n_columns()),
                                    static_cast<unsigned int>(k / this->n_columns())}));
  return numbers;
}

template <int dim>
std::vector<double> PointBody<dim>::values_at(const std::vector<unsigned int> &numbers,
                                              const NodalField<double> &field) const
{
  std::vector<double> values(dim * numbers.size(), 0.);
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (const auto node = find(numbers[k]); node && this->index(*node) < n_owned)
      for (unsigned int c = 0; c < dim; ++c)
        values[dim * k + c] = field(c, *node);
  sum_over_ranks(values, this->communicator());
  return values;
}

template class PointBody<2>;
template class PointBody<3>;
} // namespace mesoslip
