#include "body/elastic_body.h"

#include "body/grid_body.h"
#include "body/mesh/mesh_body.h"
#include "statics/multigrid/rigid_modes.h"

namespace mesoslip
{
template <int dim>
void ElasticBody<dim>::add_duplicates(NodalField<double> &field) const
{
  for (const auto &[duplicate, original] : duplicates)
    for (unsigned int c = 0; c < dim; ++c)
      field(c, duplicate) = field(c, original) = field(c, original) + field(c, duplicate);
}

template <int dim>
void ElasticBody<dim>::copy_duplicates(NodalField<double> &field) const
{
  for (const auto &[duplicate, original] : duplicates)
    for (unsigned int c = 0; c < dim; ++c)
      field(c, duplicate) = field(c, original);
}

template <int dim>
std::vector<double> phase_volumes(const ElasticBody<dim> &body)
{
  std::vector<double> volumes(body.phases().size(), 0.);
  const NodalField<double> zero = body.zero_field();
  typename ElasticBody<dim>::Cells cells;
  for (std::size_t group = 0; group < body.n_cell_groups(); ++group)
    {
      body.evaluate(zero, group, cells);
      for (std::size_t k = 0; k < cells.phase.size(); ++k)
        volumes[cells.phase[k]] += cells.volume[k];
    }
  return volumes;
}

template <>
std::vector<NodalField<double>>
free_rigid_motions(const ElasticBody<2> &body, const DofMask &mask, const bool can_rotate)
{
  // Lengths are measured from the middle in widths of the body.
  const double width  = body.extent(0);
  const auto position = [&](const NodeIndex &node) {
    const auto p = body.point(node);
    return std::array<double, 2>{
      {p[0] / width - 0.5, (p[1] - 0.5 * body.extent(1)) / width}};
  };
  const Periodicity periodic = body.periodicity();
  std::vector<NodalField<double>> motions;
  for (const Eigen::Vector3d &a :
       motions_left_by(mask, can_rotate && !periodic.x && !periodic.y, position))
    {
      NodalField<double> motion = body.zero_field();
      for (unsigned int j = 0; j < body.n_rows(); ++j)
        for (unsigned int i = 0; i < body.n_columns(); ++i)
          {
            const auto [x, y]   = position({i, j});
            motion.row(0, j)[i] = a[0] - a[2] * y;
            motion.row(1, j)[i] = a[1] + a[2] * x;
          }
      motions.push_back(std::move(motion));
    }
  return motions;
}

std::unique_ptr<ElasticBody<2>> make_body(const UniformMaterial &material,
                                          const StaticSolverKind solver,
                                          const MPI_Comm communicator)
{
  if (solver == StaticSolverKind::ml)
    return std::make_unique<MeshBody<2>>(mesh_of_grid(material), communicator);
  return std::make_unique<GridBody<2>>(material, solver);
}

template class ElasticBody<2>;
template std::vector<double> phase_volumes(const ElasticBody<2> &);
} // namespace mesoslip
