#include "body/mesh/curved_mapping.h"

#include "base/exchange.h"
#include "mesh/curved/curved_cells.h"

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace mesoslip
{
namespace
{
/** Quadratic mapping of the reference cell with edges and faces curved as in the mesh. */
template <int dim>
class CurvedMapping : public dealii::MappingFE<dim>
{
public:
  /**
   * Middle nodes of all cells of the mesh, cell after cell; shared by copies of the
   * mapping.
   */
  using Nodes = std::shared_ptr<const std::vector<CurvedNode<dim>>>;

  /** Mapping with the scalar @p element of degree 2 and the nodes of @p all cells. */
  CurvedMapping(const dealii::FiniteElement<dim> &element, const Nodes &all)
    : dealii::MappingFE<dim>(element)
    , nodes(all)
  {
  }

  std::unique_ptr<dealii::Mapping<dim>> clone() const override
  {
    return std::make_unique<CurvedMapping<dim>>(*this);
  }

  /** Returns true: corners stay in place; the volume of a cell may change. */
  bool preserves_vertex_locations() const override
  {
    return true;
  }

protected:
  std::vector<dealii::Point<dim>> compute_mapping_support_points(
    const typename dealii::Triangulation<dim>::cell_iterator &cell) const override
  {
    auto points       = dealii::MappingFE<dim>::compute_mapping_support_points(cell);
    const auto number = cell->id().get_coarse_cell_id();
    auto node         = std::lower_bound(
              nodes->begin(), nodes->end(), number,
              [](const CurvedNode<dim> &a, const auto wanted) { return a.cell < wanted; });
    for (; node != nodes->end() && node->cell == number; ++node)
      for (unsigned int d = 0; d < dim; ++d)
        points[node->node][d] += node->offset[d];
    return points;
  }

private:
  Nodes nodes;
};
} // namespace

template <int dim>
dealii::hp::MappingCollection<dim>
mappings_of(const Mesh<dim> &mesh, const MPI_Comm communicator, const unsigned int degree)
{
  std::vector<CurvedNode<dim>> curved;
  if (degree > 1)
    curved = mpi::broadcast(curved_nodes(mesh), 0, communicator);
  if (curved.empty())
    return dealii::hp::MappingCollection<dim>(
      dealii::MappingQ<dim>(1), dealii::MappingFE<dim>(dealii::FE_SimplexP<dim>(1)));
  const auto nodes =
    std::make_shared<const std::vector<CurvedNode<dim>>>(std::move(curved));
  return dealii::hp::MappingCollection<dim>(
    CurvedMapping<dim>(dealii::FE_Q<dim>(2), nodes),
    CurvedMapping<dim>(dealii::FE_SimplexP<dim>(2), nodes));
}

template dealii::hp::MappingCollection<2>
mappings_of(const Mesh<2> &, const MPI_Comm, const unsigned int);
template dealii::hp::MappingCollection<3>
mappings_of(const Mesh<3> &, const MPI_Comm, const unsigned int);
} // namespace mesoslip
