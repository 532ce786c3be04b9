#ifndef mesoslip_body_grid_body_h
#define mesoslip_body_grid_body_h

#include "body/elastic_body.h"
#include "elasticity/uniform_grid_operator.h"
#include "statics/grid_solver.h"

namespace mesoslip
{
template <int dim>
class GridBody;

/**
 * The body on a uniform grid: products by UniformGridOperator, solves by GridSolver.
 * Replicated on every rank.
 */
template <>
class GridBody<2> : public ElasticBody<2>
{
public:
  /** @p material must outlive the body. */
  explicit GridBody(const UniformMaterial &material,
                    const StaticSolverKind solver = StaticSolverKind::multigrid)
    : GridBody(std::shared_ptr<const UniformMaterial>(std::shared_ptr<void>(), &material),
               solver)
  {
  }

  /** The body shares ownership of the @p given material. */
  GridBody(const std::shared_ptr<const UniformMaterial> &given,
           const StaticSolverKind solver)
    : ElasticBody<2>(
        given->n_columns(), given->n_rows(), given->phases(), given->periodicity())
    , owner(given)
    , material(*given)
    , solver(solver)
    , stiffness(material)
  {
    const UniformGrid<2> &grid = material.grid();
    extents                    = {{grid.extent(0), grid.extent(1)}};
    total_volume               = extents[0] * extents[1];
    mass                       = material.total_mass();
    number_of_cells            = grid.n_cells();

    sides[0].closed = sides[1].closed = periodicity().y;
    sides[2].closed = sides[3].closed = periodicity().x;

    const std::array<unsigned int, 2> last = grid.cells;
    // End nodes have half the length of a cell.
    const auto add = [&](const unsigned int id, const NodeIndex &node,
                         const unsigned int along, const unsigned int k) {
      const double length = grid.spacing[along] * (k == 0 || k == last[along] ? 0.5 : 1.);
      std::array<double, 2> area = {};
      area[id / 2]               = id % 2 == 0 ? -length : length;
      sides[id].nodes.push_back(node);
      sides[id].normal_area.push_back(area);
    };
    for (unsigned int j = 0; j <= last[1]; ++j)
      {
        add(0, {0, j}, 1, j);
        add(1, {last[0], j}, 1, j);
        if (material.periodicity().x)
          copies.push_back({{{last[0], j}, {0, j}}});
      }
    for (unsigned int i = 0; i <= last[0]; ++i)
      {
        add(2, {i, 0}, 0, i);
        add(3, {i, last[1]}, 0, i);
        if (material.periodicity().y)
          copies.push_back({{{i, last[1]}, {i, 0}}});
      }
  }

  std::array<double, 2> point(const NodeIndex &node) const override
  {
    return {{node.i * material.grid().spacing[0], node.j * material.grid().spacing[1]}};
  }

  std::vector<double> mass_of_cells() const override
  {
    std::vector<double> masses(static_cast<std::size_t>(n_columns()) * n_rows());
    for (unsigned int j = 0; j < n_rows(); ++j)
      material.mass_row(j, masses.data() + static_cast<std::size_t>(j) * n_columns());
    return masses;
  }

  std::size_t n_cell_groups() const override
  {
    return material.grid().cells[1];
  }

  void evaluate(const NodalField<double> &u,
                const std::size_t group,
                Cells &cells) const override
  {
    const unsigned int nx = material.grid().cells[0];
    std::vector<double> exx(nx), eyy(nx), gxy(nx);
    stiffness.strain(u, group, exx.data(), eyy.data(), gxy.data());
    cells.phase.resize(nx);
    cells.strain.resize(nx);
    cells.volume.assign(nx, 1.);
    for (unsigned int i = 0; i < nx; ++i)
      {
        cells.phase[i]  = material.phase_of(i, group);
        cells.strain[i] = VoigtVector<2>(exx[i], eyy[i], gxy[i]);
      }
  }

  std::vector<VoigtMatrix<2>> strain_products(const NodalField<double> &u) const override;

  void multiply(NodalField<double> &Ku, const NodalField<double> &u) const override
  {
    stiffness.vmult(Ku, u);
  }

  std::vector<MatrixEntry> stiffness_entries() const override;

  std::unique_ptr<StaticSolver> make_solver() const override
  {
    return std::make_unique<GridSolver>(material, solver);
  }

  std::unique_ptr<ElasticBody<2>> make_periodic() const override
  {
    return std::make_unique<GridBody<2>>(
      std::make_shared<UniformMaterial>(material.with({true, true})), solver);
  }

private:
  const std::shared_ptr<const UniformMaterial> owner; ///< empty: the caller owns it
  const UniformMaterial &material;
  const StaticSolverKind solver;
  const UniformGridOperator stiffness;
};
} // namespace mesoslip

#endif
