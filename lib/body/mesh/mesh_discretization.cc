#include "body/mesh/mesh_discretization.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/reference_cell.h>
#include <deal.II/grid/tria_description.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/vector.h>

namespace mesoslip
{
namespace
{
/** Strain (Voigt order, engineering shear) of a shape function with gradient @p g in
 *  component @p c. */
template <int dim>
VoigtVector<dim> shape_strain(const dealii::Tensor<1, dim> &g, const unsigned int c)
{
  VoigtVector<dim> e = VoigtVector<dim>::Zero();
  e(c)               = g[c];
  if constexpr (dim == 2)
    e(2) = g[1 - c];
  else
    for (unsigned int other = 0; other < dim; ++other)
      if (other != c)
        // yz, xz, xy are the pairs without 0, 1, 2.
        e(3 + (3 - c - other)) = g[other];
  return e;
}

template <int dim>
std::unique_ptr<dealii::FiniteElement<dim>> linear_element(const bool simplices)
{
  if (simplices)
    return std::make_unique<dealii::FESystem<dim>>(dealii::FE_SimplexP<dim>(1), dim);
  return std::make_unique<dealii::FESystem<dim>>(dealii::FE_Q<dim>(1), dim);
}
} // namespace

template <int dim>
MeshDiscretization<dim>::MeshDiscretization(const Mesh<dim> &mesh,
                                            const ElasticBody<dim> &the_body,
                                            const MPI_Comm the_communicator)
  : body(the_body)
  , communicator(the_communicator)
  , triangulation(communicator)
  , element(linear_element<dim>(mesh.n_corners == dim + 1))
{
  distribute(mesh);
  number_dofs(mesh);
  assemble(mesh.phases);
}

// One rank makes the whole triangulation, the others get their parts.
template <int dim>
void MeshDiscretization<dim>::distribute(const Mesh<dim> &mesh)
{
  using namespace dealii;
  const auto create = [&mesh](Triangulation<dim> &serial) {
    std::vector<Point<dim>> points(mesh.points.size());
    for (std::size_t p = 0; p < points.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        points[p][d] = mesh.points[p][d];
    std::vector<CellData<dim>> cells;
    for (std::size_t k = 0; k < mesh.n_cells(); ++k)
      {
        cells.emplace_back(mesh.n_corners);
        cells.back().material_id = mesh.phase[k];
        std::copy_n(&mesh.cells[k * mesh.n_corners], mesh.n_corners,
                    cells.back().vertices.begin());
      }
    serial.create_triangulation(points, cells, SubCellData());
  };
  const auto divide = [](Triangulation<dim> &serial, const MPI_Comm comm, unsigned int) {
    GridTools::partition_triangulation(Utilities::MPI::n_mpi_processes(comm), serial,
                                       SparsityTools::Partitioner::metis);
  };
  triangulation.create_triangulation(
    TriangulationDescription::Utilities::create_description_from_triangulation_in_groups<
      dim, dim>(create, divide, communicator,
                Utilities::MPI::n_mpi_processes(communicator)));
}

// Every rank gets to know the degrees of freedom of all points.
template <int dim>
void MeshDiscretization<dim>::number_dofs(const Mesh<dim> &mesh)
{
  dof_handler.reinit(triangulation);
  dof_handler.distribute_dofs(*element);
  std::vector<Index> known(dim * mesh.points.size(), 0);
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int c = 0; c < dim; ++c)
          known[dim * mesh.cells[cell->id().get_coarse_cell_id() * mesh.n_corners + v] +
                c] = cell->vertex_dof_index(v, c);
  dofs.resize(known.size());
  dealii::Utilities::MPI::max(known, communicator, dofs);
}

template <int dim>
void MeshDiscretization<dim>::assemble(const std::vector<ElasticPhase<dim>> &phases)
{
  using namespace dealii;
  const IndexSet &owned = dof_handler.locally_owned_dofs();
  IndexSet relevant;
  DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  // An original may belong to any rank. Later pairs lead on from corners.
  std::map<Index, Index> originals;
  const auto &pairs = body.duplicate_nodes();
  for (auto pair = pairs.rbegin(); pair != pairs.rend(); ++pair)
    for (unsigned int c = 0; c < dim; ++c)
      {
        const Index original          = dof(c, (*pair)[1]);
        const auto next               = originals.find(original);
        originals[dof(c, (*pair)[0])] = next == originals.end() ? original : next->second;
      }
  IndexSet used = relevant;
  for (const auto &[duplicate, original] : originals)
    if (relevant.is_element(duplicate))
      used.add_index(original);
  constraints.reinit(used);
  for (const auto &[duplicate, original] : originals)
    if (relevant.is_element(duplicate))
      {
        constraints.add_line(duplicate);
        constraints.add_entry(duplicate, original, 1.);
      }
  constraints.close();

  TrilinosWrappers::SparsityPattern pattern(owned, owned, used, communicator);
  DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false,
                                  Utilities::MPI::this_mpi_process(communicator));
  pattern.compress();
  matrix.reinit(pattern);
  mass.reinit(owned, communicator);

  const auto &mapping =
    element->reference_cell().template get_default_linear_mapping<dim>();
  const Quadrature<dim> quadrature =
    element->reference_cell().template get_gauss_type_quadrature<dim>(2);
  FEValues<dim> values(mapping, *element, quadrature,
                       update_values | update_gradients | update_JxW_values);
  const unsigned int n = element->n_dofs_per_cell();
  FullMatrix<double> cell_matrix(n, n);
  dealii::Vector<double> cell_mass(n);
  std::vector<Index> cell_dofs(n);
  std::vector<VoigtVector<dim>> strain(n), stress(n);
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const ElasticPhase<dim> &phase = phases[cell->material_id()];
        values.reinit(cell);
        cell_matrix = 0.;
        cell_mass   = 0.;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            for (unsigned int i = 0; i < n; ++i)
              {
                const unsigned int c = element->system_to_component_index(i).first;
                strain[i]            = shape_strain<dim>(values.shape_grad(i, q), c);
                stress[i]            = values.JxW(q) * phase.stiffness * strain[i];
                cell_mass(i) += phase.density * values.shape_value(i, q) * values.JxW(q);
              }
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                cell_matrix(i, j) += strain[i].dot(stress[j]);
          }
        cell->get_dof_indices(cell_dofs);
        constraints.distribute_local_to_global(cell_matrix, cell_mass, cell_dofs, matrix,
                                               mass);
      }
  matrix.compress(VectorOperation::add);
  mass.compress(VectorOperation::add);
}

template <int dim>
typename MeshDiscretization<dim>::Vector
MeshDiscretization<dim>::to_vector(const NodalField<double> &field) const
{
  const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
  Vector vector(owned, communicator);
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        {
          const Index k = dof(c, {i, j});
          if (owned.is_element(k) && !constraints.is_constrained(k))
            vector[k] = field.row(c, j)[i];
        }
  vector.compress(dealii::VectorOperation::insert);
  return vector;
}

template <int dim>
void MeshDiscretization<dim>::to_field(NodalField<double> &field,
                                       const Vector &vector) const
{
  const dealii::Vector<double> all(vector);
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        field.row(c, j)[i] = all[dof(c, {i, j})];
  body.copy_duplicates(field);
}

template class MeshDiscretization<2>;
} // namespace mesoslip
