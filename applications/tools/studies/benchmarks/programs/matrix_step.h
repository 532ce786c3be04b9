#ifndef mesoslip_tests_benchmarks_matrix_step_h
#define mesoslip_tests_benchmarks_matrix_step_h

#include "verification/mesh_sliding/mesh_sliding.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/vector.h>

namespace verification
{
/** Product with the matrix of a whole mesh, and the update of u and w. */
template <int dim>
class MatrixStep
{
public:
  explicit MatrixStep(const MeshCase<dim> &c)
  {
    const MeshPart<dim> part =
      distribute(c.mesh, std::vector<unsigned int>(c.mesh.cells.size()), MPI_COMM_SELF);
    const std::size_t n = dim * part.points.size();
    dealii::DynamicSparsityPattern couplings(n, n);
    for (const auto &cell : part.cells)
      for (const unsigned int v : cell.vertices)
        for (const unsigned int other : cell.vertices)
          for (unsigned int k = 0; k < dim * dim; ++k)
            couplings.add(dim * v + k / dim, dim * other + k % dim);
    matrix.reinit(couplings);
    for (auto *field : {&u, &w, &f, &inverse_mass})
      field->reinit(n);
  }

  void advance()
  {
    matrix.vmult(f, u);
    for (std::size_t k = 0; k < u.size(); ++k)
      {
        w[k] -= 1e-10 * inverse_mass[k] * f[k];
        u[k] += 1e-10 * w[k];
      }
  }

private:
  dealii::TrilinosWrappers::SparseMatrix matrix;
  dealii::Vector<double> u, w, f, inverse_mass;
};
} // namespace verification

#endif
