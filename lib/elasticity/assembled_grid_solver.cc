#include "elasticity/assembled_solver.h"

#include "elasticity/ml_conjugate_gradients.h"
#include "elasticity/multigrid/rigid_modes.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>

#include <cmath>

namespace mesoslip
{
namespace
{
dealii::Triangulation<2> make_triangulation(const UniformMaterial &material)
{
  const UniformGrid<2> &grid = material.grid();
  dealii::Triangulation<2> triangulation;
  dealii::GridGenerator::subdivided_hyper_rectangle(
    triangulation, {grid.cells[0], grid.cells[1]}, dealii::Point<2>(),
    dealii::Point<2>(grid.extent(0), grid.extent(1)));
  for (const auto &cell : triangulation.active_cell_iterators())
    {
      const auto centre = cell->center();
      cell->set_material_id(
        material.class_of(static_cast<unsigned int>(centre[0] / grid.spacing[0]),
                          static_cast<unsigned int>(centre[1] / grid.spacing[1])));
    }
  return triangulation;
}

AssembledOperator<2> assemble(const UniformMaterial &material,
                              const dealii::Triangulation<2> &triangulation)
{
  std::vector<VoigtMatrix<2>> stiffness;
  std::vector<double> density;
  for (const ElasticClass &c : material.classes())
    {
      stiffness.push_back(c.stiffness);
      density.push_back(c.density);
    }
  return AssembledOperator<2>(triangulation, stiffness, density);
}
} // namespace

/** Unknown 2 (j n_columns + i) + c of the nodes that are different. */
struct AssembledGridSolver::Implementation
{
  explicit Implementation(const UniformMaterial &the_material)
    : material(the_material)
    , n_columns(the_material.n_columns() - the_material.periodicity().x)
    , n_rows(the_material.n_rows() - the_material.periodicity().y)
  {
    join_matrix();
    std::vector<std::vector<double>> motions(3, std::vector<double>(n_unknowns()));
    for (unsigned int k = 0; k < n_unknowns(); ++k)
      {
        const unsigned int c = k % 2, i = k / 2 % n_columns, j = k / 2 / n_columns;
        motions[c][k] = 1.;
        motions[2][k] =
          c == 0 ? -(j * material.grid().spacing[1]) : i * material.grid().spacing[0];
      }
    if (material.periodicity().x || material.periodicity().y)
      motions.pop_back();
    solver = std::make_unique<MlConjugateGradients>(matrix, motions, 2);
  }

  unsigned int n_unknowns() const
  {
    return 2 * n_columns * n_rows;
  }

  unsigned int
  unknown(const unsigned int c, const unsigned int i, const unsigned int j) const
  {
    return 2 * (j % n_rows * n_columns + i % n_columns) + c;
  }

  /** The matrix of the operator, entries of nodes that are one added up. */
  void join_matrix()
  {
    const dealii::Triangulation<2> triangulation = make_triangulation(material);
    const AssembledOperator<2> op                = assemble(material, triangulation);
    std::vector<unsigned int> map(op.matrix().m());
    for (const auto &cell : op.dof_handler().active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        {
          const auto &x = cell->vertex(v);
          for (unsigned int c = 0; c < 2; ++c)
            map[cell->vertex_dof_index(v, c)] =
              unknown(c, std::lround(x[0] / material.grid().spacing[0]),
                      std::lround(x[1] / material.grid().spacing[1]));
        }
    // deal.II's iterators clear a buffer as long as the matrix is wide for each row.
    const Epetra_CrsMatrix &epetra = op.matrix().trilinos_matrix();
    const auto for_each_entry      = [&](const auto &function) {
      for (int row = 0; row < epetra.NumMyRows(); ++row)
        {
          int n = 0, *columns = nullptr;
          double *values = nullptr;
          epetra.ExtractMyRowView(row, n, values, columns);
          for (int k = 0; k < n; ++k)
            function(map[epetra.GRID64(row)], map[epetra.GCID64(columns[k])], values[k]);
        }
    };
    dealii::DynamicSparsityPattern pattern(n_unknowns());
    for_each_entry([&](const unsigned int row, const unsigned int column, double) {
      pattern.add(row, column);
    });
    matrix.reinit(dealii::complete_index_set(n_unknowns()), pattern, MPI_COMM_SELF,
                  false);
    for_each_entry([&](const unsigned int row, const unsigned int column,
                       const double value) { matrix.add(row, column, value); });
    matrix.compress(dealii::VectorOperation::add);
  }

  const UniformMaterial &material;
  unsigned int n_columns;
  unsigned int n_rows;
  dealii::TrilinosWrappers::SparseMatrix matrix;
  std::unique_ptr<MlConjugateGradients> solver;
  DofMask held;
  multigrid::RigidModes modes;
};

AssembledGridSolver::AssembledGridSolver(const UniformMaterial &material)
  : implementation(std::make_unique<Implementation>(material))
{
  set_held(DofMask(material.n_columns(), material.n_rows()));
}

AssembledGridSolver::~AssembledGridSolver() = default;

void AssembledGridSolver::set_held(const DofMask &mask)
{
  Implementation &s = *implementation;
  s.modes           = multigrid::RigidModes(s.material, mask);
  dealii::IndexSet held(s.n_unknowns());
  for (unsigned int j = 0; j < mask.n_rows(); ++j)
    for (unsigned int i = 0; i < mask.n_columns(); ++i)
      for (unsigned int c = 0; c < 2; ++c)
        if (mask.is_held(c, i, j))
          held.add_index(s.unknown(c, i, j));
  // Supports that are just enough carry nothing when the forces are in equilibrium.
  s.held                  = mask;
  DofMask supported       = mask;
  std::size_t n_free      = s.modes.modes().size();
  const unsigned int last = s.material.n_columns() - 1;
  for (const auto &dof : {std::array<unsigned int, 2>{{0, 0}}, {{1, 0}}, {{1, last}}})
    {
      DofMask trial = supported;
      trial.hold(dof[0], dof[1], 0);
      const std::size_t n = multigrid::RigidModes(s.material, trial).modes().size();
      if (n == n_free)
        continue;
      n_free    = n;
      supported = trial;
      held.add_index(s.unknown(dof[0], dof[1], 0));
    }
  s.solver->set_held(held);
}

SolverReport AssembledGridSolver::solve(NodalField<double> &u,
                                        const NodalField<double> &force,
                                        const double tolerance)
{
  Implementation &s          = *implementation;
  const dealii::IndexSet all = dealii::complete_index_set(s.n_unknowns());
  dealii::TrilinosWrappers::MPI::Vector x(all, MPI_COMM_SELF), f(all, MPI_COMM_SELF);
  for (unsigned int j = 0; j < s.n_rows; ++j)
    for (unsigned int i = 0; i < s.n_columns; ++i)
      for (unsigned int c = 0; c < 2; ++c)
        {
          const bool keep       = s.modes.empty() || s.held.is_held(c, i, j);
          x(s.unknown(c, i, j)) = keep ? u.row(c, j)[i] : 0.;
          f(s.unknown(c, i, j)) = force.row(c, j)[i];
        }
  x.compress(dealii::VectorOperation::insert);
  f.compress(dealii::VectorOperation::insert);
  const SolverReport report = s.solver->solve(x, f, tolerance);
  for (unsigned int j = 0; j < u.n_rows(); ++j)
    for (unsigned int i = 0; i < u.n_columns(); ++i)
      for (unsigned int c = 0; c < 2; ++c)
        u.row(c, j)[i] = x(s.unknown(c, i, j));
  s.modes.remove_from(u);
  return report;
}
} // namespace mesoslip
