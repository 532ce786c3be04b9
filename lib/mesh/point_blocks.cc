#include "mesh/point_blocks.h"

#include <deal.II/base/mpi_noncontiguous_partitioner.templates.h>

#include <numeric>

namespace mesoslip
{
NumberedBlocks::NumberedBlocks(const std::vector<std::uint64_t> &numbers,
                               const std::size_t n_all,
                               const MPI_Comm communicator,
                               const std::size_t n_together)
  : n_owned(numbers.size())
{
  namespace mpi              = dealii::Utilities::MPI;
  const std::size_t rank     = mpi::this_mpi_process(communicator),
                    n_rank   = mpi::n_mpi_processes(communicator);
  const std::size_t n_groups = n_all / n_together;
  begin                      = rank * n_groups / n_rank * n_together;
  end                        = (rank + 1) * n_groups / n_rank * n_together;
  using Index                = dealii::types::global_dof_index;
  const std::vector<Index> owned(numbers.begin(), numbers.end());
  std::vector<Index> block(end - begin);
  std::iota(block.begin(), block.end(), static_cast<Index>(begin));
  exchange.reinit(owned, block, communicator);
}

void NumberedBlocks::gather(const double *owned, std::vector<double> &block) const
{
  block.resize(size());
  exchange.export_to_ghosted_array<double>(
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
