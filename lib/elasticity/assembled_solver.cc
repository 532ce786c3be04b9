#include "elasticity/assembled_solver.h"

#include "elasticity/ml_conjugate_gradients.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>

namespace mesoslip
{
namespace
{
/** The rigid motions (translations, then rotations) in the locally owned unknowns. */
template <int dim>
std::vector<std::vector<double>> rigid_motions(const dealii::DoFHandler<dim> &dof_handler)
{
  const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
  std::vector<std::vector<double>> motions(dim == 2 ? 3 : 6,
                                           std::vector<double>(owned.n_elements(), 0.));
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (!cell->is_artificial())
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int c = 0; c < dim; ++c)
          {
            const auto dof = cell->vertex_dof_index(v, c);
            if (!owned.is_element(dof))
              continue;
            const auto i  = owned.index_within_set(dof);
            const auto &x = cell->vertex(v);
            motions[c][i] = 1.;
            if (dim == 2)
              motions[2][i] = c == 0 ? -x[1] : x[0];
            else
              // Rotation about axis a: e_a cross x.
              for (unsigned int a = 0; a < dim; ++a)
                if (a != c)
                  {
                    const unsigned int other = 3 - a - c;
                    motions[dim + a][i] = (c == (a + 1) % 3 ? -1. : 1.) * x[other % dim];
                  }
          }
  return motions;
}
} // namespace

template <int dim>
struct AssembledSolver<dim>::Implementation
{
  explicit Implementation(const AssembledOperator<dim> &stiffness)
    : solver(stiffness.matrix(), rigid_motions(stiffness.dof_handler()), dim)
  {
  }

  MlConjugateGradients solver;
};

template <int dim>
AssembledSolver<dim>::AssembledSolver(const AssembledOperator<dim> &stiffness)
  : implementation(std::make_unique<Implementation>(stiffness))
{
}

template <int dim>
AssembledSolver<dim>::~AssembledSolver() = default;

template <int dim>
void AssembledSolver<dim>::set_held(const dealii::IndexSet &held)
{
  implementation->solver.set_held(held);
}

template <int dim>
SolverReport
AssembledSolver<dim>::solve(dealii::TrilinosWrappers::MPI::Vector &u,
                            const dealii::TrilinosWrappers::MPI::Vector &force,
                            const double tolerance)
{
  return implementation->solver.solve(u, force, tolerance);
}

template class AssembledSolver<2>;
template class AssembledSolver<3>;
} // namespace mesoslip
