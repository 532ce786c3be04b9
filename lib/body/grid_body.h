#ifndef mesoslip_body_grid_body_h
#define mesoslip_body_grid_body_h

#include "body/elastic_body.h"
#include "elasticity/uniform_grid_operator.h"

namespace mesoslip
{
template <int dim>
class GridBody;

/**
 * The body on a uniform grid: UniformGridOperator for products and GridSolver for
 * solves. All of it is on every rank.
 */
template <>
class GridBody<2> : public ElasticBody<2>
{
public:
  /** @p material must outlive the body. */
  explicit GridBody(const UniformMaterial &material,
                    const StaticSolverKind solver = StaticSolverKind::multigrid);

  /** The body keeps the @p given material. */
  GridBody(const std::shared_ptr<const UniformMaterial> &given,
           const StaticSolverKind solver);

  std::array<double, 2> point(const NodeIndex &node) const override;
  std::vector<double> lumped_mass() const override;
  std::size_t n_cell_groups() const override;
  void evaluate(const NodalField<double> &u,
                const std::size_t group,
                Cells &cells) const override;
  void vmult(NodalField<double> &Ku, const NodalField<double> &u) const override;
  std::unique_ptr<StaticSolver> make_solver() const override;
  std::unique_ptr<ElasticBody<2>> make_periodic() const override;

private:
  void find_sides();

  const std::shared_ptr<const UniformMaterial> owner; ///< empty for a material of others
  const UniformMaterial &material;
  const StaticSolverKind solver;
  const UniformGridOperator stiffness;
};
} // namespace mesoslip

#endif
