#include "mesh/point_blocks.h"

#include "base/exchange.h"

#include <deal.II/base/mpi_noncontiguous_partitioner.templates.h>

#include <numeric>
#include <tuple>

namespace mesoslip
{
namespace
{
using Index = dealii::types::global_dof_index;

using Exchange = dealii::Utilities::MPI::NoncontiguousPartitioner;

std::vector<Index> numbers_between(const std::size_t begin, const std::size_t end)
{
  std::vector<Index> numbers(end - begin);
  std::iota(numbers.begin(), numbers.end(), static_cast<Index>(begin));
  return numbers;
}
} // namespace

std::pair<std::size_t, std::size_t> block_of_rank(const std::size_t n_all,
                                                  const MPI_Comm communicator,
                                                  const std::size_t n_together)
{
  const std::size_t rank     = mpi::this_mpi_process(communicator),
                    n_ranks  = mpi::n_mpi_processes(communicator);
  const std::size_t n_groups = n_all / n_together;
  return {rank * n_groups / n_ranks * n_together,
          (rank + 1) * n_groups / n_ranks * n_together};
}

NumberedBlocks::NumberedBlocks(const std::vector<std::uint64_t> &numbers,
                               const std::size_t n_all,
                               const MPI_Comm communicator,
                               const std::size_t n_together)
  : n_owned(numbers.size())
{
  std::tie(begin, end) = block_of_rank(n_all, communicator, n_together);
  exchange =
    std::make_shared<const Exchange>(std::vector<Index>(numbers.begin(), numbers.end()),
                                     numbers_between(begin, end), communicator);
}

void NumberedBlocks::gather(const double *owned, std::vector<double> &block) const
{
  block.resize(size());
  exchange->export_to_ghosted_array<double>(
    dealii::ArrayView<const double>(owned, n_owned),
    dealii::ArrayView<double>(block.data(), block.size()));
}

std::vector<double> NumberedBlocks::gather(const std::vector<double> &owned,
                                           const std::size_t n,
                                           const std::size_t first,
                                           const std::size_t count) const
{
  std::vector<double> block(size() * count), one(n_owned), in_block;
  for (std::size_t c = 0; c < count; ++c)
    {
      for (std::size_t k = 0; k < one.size(); ++k)
        one[k] = owned[k * n + first + c];
      gather(one.data(), in_block);
      for (std::size_t k = 0; k < in_block.size(); ++k)
        block[k * count + c] = in_block[k];
    }
  return block;
}

NumbersFromBlocks::NumbersFromBlocks(const std::vector<unsigned int> &needed,
                                     const std::size_t n_all,
                                     const MPI_Comm communicator)
  : n_needed(needed.size())
{
  std::tie(begin, end) = block_of_rank(n_all, communicator, 1);
  exchange             = std::make_shared<const Exchange>(
    numbers_between(begin, end), std::vector<Index>(needed.begin(), needed.end()),
    communicator);
}

std::vector<double> NumbersFromBlocks::bring(const std::vector<double> &block,
                                             const std::size_t n) const
{
  std::vector<double> values(n_needed * n), one(size()), brought(n_needed);
  for (std::size_t c = 0; c < n; ++c)
    {
      for (std::size_t k = 0; k < one.size(); ++k)
        one[k] = block[k * n + c];
      exchange->export_to_ghosted_array<double>(
        dealii::ArrayView<const double>(one.data(), one.size()),
        dealii::ArrayView<double>(brought.data(), brought.size()));
      for (std::size_t k = 0; k < n_needed; ++k)
        values[k * n + c] = brought[k];
    }
  return values;
}

template <int dim>
PointBlocks<dim>::PointBlocks(const MeshPart<dim> &part,
                              const std::size_t n_points,
                              const MPI_Comm communicator,
                              const std::size_t n_together)
  : blocks({part.point_in_mesh.begin(), part.point_in_mesh.begin() + part.n_owned},
           n_points,
           communicator,
           n_together)
{
}

template <int dim>
std::vector<double>
PointBlocks<dim>::gather(const std::array<const double *, dim> &owned) const
{
  std::vector<double> values(size() * dim), component;
  for (unsigned int d = 0; d < dim; ++d)
    {
      blocks.gather(owned[d], component);
      for (std::size_t i = 0; i < component.size(); ++i)
        values[i * dim + d] = component[i];
    }
  return values;
}

template class PointBlocks<2>;
template class PointBlocks<3>;
} // namespace mesoslip
