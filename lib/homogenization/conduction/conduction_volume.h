#ifndef mesoslip_homogenization_conduction_conduction_volume_h
#define mesoslip_homogenization_conduction_conduction_volume_h

#include "body/mesh/algebraic_multigrid.h"
#include "homogenization/conduction/conduction_cells.h"
#include "homogenization/conduction/conduction_response.h"

#include <array>
#include <vector>

namespace mesoslip
{
/**
 * The conduction of heat or of a current, q = k grad T, div q = 0, in a volume element:
 * finite elements with the linear shape functions of the cells, conjugate gradients with
 * algebraic multigrid, on one rank. Load cases are unit gradients G along the axes,
 *
 *     KUBC   T = G.x on the boundary
 *     PBC    T = G.x + periodic
 *     SUBC   q.n = Q.n, Q a unit flux
 *     MUBC   T = G.x across its axis, q.n = 0 on the other sides
 */
template <int dim>
class ConductionVolume
{
public:
  /** @p given must outlive it. */
  explicit ConductionVolume(const ConductionCells<dim> &given)
    : cells(given)
    , unknown(given.mesh.points.size())
  {
  }

  /** @throws NotConverged, UserError if opposite sides have points that are not opposite (PBC) */
  ConductionResponse<dim> solve(const BoundaryCondition wanted, const double tolerance);

  /** Mean gradient in each cell for a unit gradient, a column per axis (SUBC: the flux
   * for a unit flux), under the condition that was solved last: [cells][dim][dim]. */
  std::vector<double> concentration() const;

private:
  /** Gradients of the shape functions at the quadrature points of a cell, a column for
   * each corner. */
  struct CellGradients
  {
    std::vector<Eigen::Matrix<double, dim, Eigen::Dynamic>> of_corners; ///< 1/m
    std::vector<double> volume;                                         ///< JxW (m^dim)
  };

  /** Calls visit(number, gradients) with each cell. */
  template <typename Visit>
  void for_each_cell(const Visit &visit) const;

  void number_unknowns(const unsigned int axis);
  void assemble();
  SolverReport solve_case(const unsigned int axis, const double tolerance);
  template <typename Visit>
  void for_each_gradient(const Visit &visit) const;
  ConductionResponse<dim> evaluate() const;

  static constexpr unsigned int held = ~0U; ///< marks a Dirichlet point in `unknown`

  const ConductionCells<dim> &cells;
  BoundaryCondition condition = BoundaryCondition::KUBC;
  std::vector<unsigned int> unknown; ///< number of the unknown of each point, or held
  unsigned int n_unknowns = 0;
  DistributedMatrix matrix;
  AlgebraicMultigrid preconditioner;
  std::array<DistributedVector, dim> loads;
  std::array<double, dim> gross_loads = {};         ///< load norms before terms cancel
  std::array<std::vector<double>, dim> fluctuation; ///< at the points (SUBC: all of T)
};
} // namespace mesoslip

#endif
