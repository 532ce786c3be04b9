#include "body/elastic_body.h"

#include "body/grid_body.h"
#include "body/mesh/mesh_body.h"
#include "statics/multigrid/rigid_modes.h"

#include <cmath>

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
void ElasticBody<dim>::copy_duplicates(DofMask &mask) const
{
  for (const auto &[duplicate, original] : duplicates)
    for (unsigned int c = 0; c < dim; ++c)
      if (mask.is_constrained(c, original))
        mask.constrain(c, duplicate);
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

// Eigenvectors for the eigenvalue zero of what the constraints hold of the six motions.
template <>
std::vector<NodalField<double>>
free_rigid_motions(const ElasticBody<3> &body, const DofMask &mask, const bool can_rotate)
{
  using Motions     = Eigen::Matrix<double, 3, 6>;
  const double size = std::hypot(body.extent(0), body.extent(1), body.extent(2));
  // Displacements of a node by unit translations and rotations about the middle.
  const auto motions_of = [&](const NodeIndex &node) {
    const auto p = body.point(node);
    Eigen::Vector3d x;
    for (unsigned int d = 0; d < 3; ++d)
      x[d] = (p[d] - 0.5 * body.extent(d)) / size;
    Motions motions = Motions::Zero();
    motions.leftCols<3>().setIdentity();
    for (unsigned int d = 0; d < 3; ++d)
      motions.col(3 + d) = Eigen::Vector3d::Unit(d).cross(x);
    return motions;
  };
  // A rotation about the axis along which sides are one is the same on both.
  Eigen::Matrix<double, 6, 6> hold = Eigen::Matrix<double, 6, 6>::Zero();
  const Periodicity periodic       = body.periodicity();
  for (unsigned int d = 0; d < 3; ++d)
    if (!can_rotate || (periodic.x && d != 0) || (periodic.y && d != 1))
      hold(3 + d, 3 + d) = 1.;
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      if (mask.bits({i, j}) != 0)
        {
          const Motions motions = motions_of({i, j});
          for (unsigned int c = 0; c < 3; ++c)
            if (mask.is_constrained(c, {i, j}))
              hold += motions.row(c).transpose() * motions.row(c);
        }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(hold);
  std::vector<NodalField<double>> result;
  for (int k = 0; k < 6; ++k)
    if (!(eigen.eigenvalues()[k] > 1e-10 * std::max(1., eigen.eigenvalues()[5])))
      {
        NodalField<double> &motion = result.emplace_back(body.zero_field());
        for (unsigned int j = 0; j < body.n_rows(); ++j)
          for (unsigned int i = 0; i < body.n_columns(); ++i)
            {
              const Eigen::Vector3d u = motions_of({i, j}) * eigen.eigenvectors().col(k);
              for (unsigned int c = 0; c < 3; ++c)
                motion.row(c, j)[i] = u[c];
            }
      }
  return result;
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
template class ElasticBody<3>;
template std::vector<double> phase_volumes(const ElasticBody<2> &);
template std::vector<double> phase_volumes(const ElasticBody<3> &);
} // namespace mesoslip
