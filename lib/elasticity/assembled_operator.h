#ifndef mesoslip_elasticity_assembled_operator_h
#define mesoslip_elasticity_assembled_operator_h

#include "material/voigt.h"

#include <memory>
#include <vector>

namespace dealii
{
template <int, int>
class Triangulation;
template <int, int>
class DoFHandler;
namespace TrilinosWrappers
{
class SparseMatrix;
namespace MPI
{
class Vector;
}
} // namespace TrilinosWrappers
} // namespace dealii

namespace mesoslip
{
/**
 * The stiffness of FE_Q(1) elements on any triangulation of quadrilaterals or hexahedra,
 * as a Trilinos matrix in compressed rows: the general path and the reference of
 * UniformGridOperator. No constraints. With a parallel triangulation (shared or
 * distributed) rows belong to the owner of the degree of freedom. The triangulation must
 * outlive the operator. deal.II 9.4 numbers the components of a node together.
 */
template <int dim>
class AssembledOperator
{
public:
  /**
   * @p stiffness (Pa) and @p density (kg/m^3) by material id of the cell. Throws
   * std::invalid_argument when a cell has an id beyond the tables.
   */
  AssembledOperator(const dealii::Triangulation<dim, dim> &triangulation,
                    const std::vector<VoigtMatrix<dim>> &stiffness,
                    const std::vector<double> &density);

  ~AssembledOperator();

  /** dst = K src; both as made by initialize_vector(). */
  void vmult(dealii::TrilinosWrappers::MPI::Vector &dst,
             const dealii::TrilinosWrappers::MPI::Vector &src) const;

  /** A vector of the locally owned degrees of freedom, zero. */
  void initialize_vector(dealii::TrilinosWrappers::MPI::Vector &vector) const;

  /** Row sums of the consistent mass (kg, or kg/m in 2D), one entry a degree of freedom.
   */
  const dealii::TrilinosWrappers::MPI::Vector &lumped_mass() const;

  /** Diagonal of K. */
  void diagonal(dealii::TrilinosWrappers::MPI::Vector &diagonal) const;

  /** 1/2 u.K u (J) on all ranks. */
  double elastic_energy(const dealii::TrilinosWrappers::MPI::Vector &u) const;

  /** Numbering of the degrees of freedom. */
  const dealii::DoFHandler<dim, dim> &dof_handler() const;

  /** K (N/m), without constraints. */
  const dealii::TrilinosWrappers::SparseMatrix &matrix() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};
} // namespace mesoslip

#endif
