#include "elasticity/mesh_operator.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Separates cells with shared points or periodic points from other cells. */
template <int dim>
std::vector<std::vector<Cell>> split_cells(const MeshPart<dim> &part)
{
  std::vector<bool> is_shared(part.points.size(), false);
  for (const auto &neighbour : part.neighbours)
    for (const unsigned int p : neighbour.points)
      is_shared[p] = true;
  for (const auto &[copy, first] : part.copies)
    is_shared[copy] = is_shared[first] = true;
  std::vector<std::vector<Cell>> cells(2);
  for (const auto &cell : part.cells)
    {
      const bool at_border =
        std::any_of(cell.vertices.begin(), cell.vertices.end(),
                    [&](const unsigned int p) { return is_shared[p]; });
      cells[at_border ? 0 : 1].push_back(cell);
    }
  return cells;
}
} // namespace

template <int dim>
MeshOperator<dim>::MeshOperator(const MeshPart<dim> &part,
                                const std::vector<ElasticPhase<dim>> &phases,
                                const MPI_Comm communicator,
                                const InstructionSet isa)
  : part(part)
  , communicator(communicator)
  , isa(resolve(isa))
  , elements(part.points, split_cells(part), phases, this->isa)
  , shared(part, kernels::node_stride<dim>, communicator)
  , mass(mesoslip::lumped_mass(part.points, part.cells, phases))
{
  constexpr unsigned int stride = kernels::node_stride<dim>;
  LineVector<double> sums       = zero_field();
  for (std::size_t i = 0; i < mass.size(); ++i)
    sums[i * stride] = mass[i];
  sum_up(sums.data());
  for (std::size_t i = 0; i < mass.size(); ++i)
    mass[i] = sums[i * stride];
}

template <int dim>
void MeshOperator<dim>::add_product(double *f, const double *u) const
{
  elements.add_product(0, f, u);
  shared.start(f);
  elements.add_product(1, f, u);
  shared.finish(f);
}

template <int dim>
std::string MeshOperator<dim>::kernel_name() const
{
  return to_string(isa) + " cells, " + std::to_string(elements.n_congruent_cells()) +
         " of " + std::to_string(part.cells.size()) + " congruent";
}

template class MeshOperator<2>;
template class MeshOperator<3>;
} // namespace mesoslip
