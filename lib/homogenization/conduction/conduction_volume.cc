#include "homogenization/conduction/conduction_volume.h"

#include "base/errors.h"
#include "body/mesh/conjugate_gradients.h"
#include "mesh/linear_cell.h"

#include <deal.II/base/quadrature.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** What is left of the loads of a homogeneous volume, relative to those of its cells, is round-off. */
constexpr double cancelled = 1e-12;
} // namespace

template <int dim>
template <typename Visit>
void ConductionVolume<dim>::for_each_cell(const Visit &visit) const
{
  CellGradients gradients;
  std::size_t of_corners = 0;
  for (std::size_t k = 0; k < cells.mesh.cells.size(); ++k)
    {
      const std::vector<unsigned int> &corners = cells.mesh.cells[k].vertices;
      if (cells.are_equal && of_corners == corners.size())
        {
          visit(k, gradients);
          continue;
        }
      of_corners = corners.size();
      gradients  = CellGradients();
      const LinearCell<dim> shape(corners.size());
      const auto quadrature = shape.quadrature();
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const auto n = static_cast<Eigen::Index>(corners.size());
          Eigen::Matrix<double, dim, Eigen::Dynamic> reference(dim, n), points(dim, n);
          for (Eigen::Index v = 0; v < n; ++v)
            {
              const auto corner   = static_cast<unsigned int>(v);
              const auto gradient = shape.gradient(quadrature.point(q), corner);
              for (unsigned int d = 0; d < dim; ++d)
                {
                  reference(d, v) = gradient[d];
                  points(d, v)    = cells.mesh.points[corners[corner]][d];
                }
            }
          const Eigen::Matrix<double, dim, dim> jacobian = points * reference.transpose();
          gradients.of_corners.emplace_back(jacobian.inverse().transpose() * reference);
          gradients.volume.push_back(jacobian.determinant() * quadrature.weight(q));
        }
      visit(k, gradients);
    }
}

template <int dim>
void ConductionVolume<dim>::number_unknowns(const unsigned int axis)
{
  const Mesh<dim> &mesh = cells.mesh;
  std::fill(unknown.begin(), unknown.end(), 0);
  for (unsigned int side = 0; side < 2 * dim; ++side)
    if (condition == BoundaryCondition::KUBC ||
        (condition == BoundaryCondition::MUBC && side / 2 == axis))
      for (const unsigned int point : cells.sides[side])
        unknown[point] = held;
  const bool periodic = condition == BoundaryCondition::PBC;
  if (periodic || condition == BoundaryCondition::SUBC)
    unknown[periodic ? mesh.original(0) : 0] = held; // the constant
  n_unknowns = 0;
  for (unsigned int p = 0; p < unknown.size(); ++p)
    if (unknown[p] != held && !(periodic && mesh.original(p) != p))
      unknown[p] = n_unknowns++;
  for (unsigned int p = 0; periodic && p < unknown.size(); ++p)
    unknown[p] = unknown[mesh.original(p)];
}

template <int dim>
void ConductionVolume<dim>::assemble()
{
  using Index                = DistributedMatrix::Index;
  const dealii::IndexSet all = dealii::complete_index_set(n_unknowns);
  dealii::DynamicSparsityPattern pattern(n_unknowns, n_unknowns, all);
  std::vector<Index> columns;
  for (const Cell &cell : cells.mesh.cells)
    {
      columns.clear();
      for (const unsigned int point : cell.vertices)
        if (unknown[point] != held)
          columns.push_back(unknown[point]);
      for (const Index row : columns)
        pattern.add_entries(row, columns.begin(), columns.end());
    }
  matrix.reinit(all, pattern, 1, MPI_COMM_SELF);
  for (DistributedVector &load : loads)
    load.reinit(all, MPI_COMM_SELF);
  gross_loads = {};
  std::vector<double> values;
  for_each_cell([&](const std::size_t k, const CellGradients &gradients) {
    const Cell &cell           = cells.mesh.cells[k];
    const Tensor2<dim> &C      = cells.conductivity[cell.material_id];
    const auto n               = static_cast<Eigen::Index>(cell.vertices.size());
    Eigen::MatrixXd stiffness  = Eigen::MatrixXd::Zero(n, n),
                    load_cases = Eigen::MatrixXd::Zero(n, dim);
    for (std::size_t q = 0; q < gradients.volume.size(); ++q)
      {
        const auto &B = gradients.of_corners[q];
        stiffness.noalias() += gradients.volume[q] * B.transpose() * C * B;
        if (condition == BoundaryCondition::SUBC)
          load_cases.noalias() += gradients.volume[q] * B.transpose();
        else
          load_cases.noalias() -= gradients.volume[q] * B.transpose() * C;
      }
    for (unsigned int axis = 0; axis < dim; ++axis)
      gross_loads[axis] += load_cases.col(axis).squaredNorm();
    for (Eigen::Index i = 0; i < n; ++i)
      {
        const unsigned int row = unknown[cell.vertices[static_cast<std::size_t>(i)]];
        if (row == held)
          continue;
        for (unsigned int axis = 0; axis < dim; ++axis)
          loads[axis](row) += load_cases(i, axis);
        columns.clear();
        values.clear();
        for (Eigen::Index j = 0; j < n; ++j)
          if (const unsigned int column =
                unknown[cell.vertices[static_cast<std::size_t>(j)]];
              column != held)
            {
              columns.push_back(column);
              values.push_back(stiffness(i, j));
            }
        matrix.add(row, columns, values);
      }
  });
  matrix.compress();
  DistributedVector constant(all, MPI_COMM_SELF);
  constant = 1.;
  preconditioner.initialize(matrix, {constant});
}

template <int dim>
SolverReport ConductionVolume<dim>::solve_case(const unsigned int axis,
                                               const double tolerance)
{
  SolverReport report;
  DistributedVector x(dealii::complete_index_set(n_unknowns), MPI_COMM_SELF);
  const double reference = loads[axis].l2_norm();
  if (reference > cancelled * std::sqrt(gross_loads[axis]))
    report =
      conjugate_gradients(matrix, x, loads[axis], preconditioner, reference, tolerance,
                          "conduction, " + to_string(condition) + " " + "xyz"[axis]);
  fluctuation[axis].assign(unknown.size(), 0.);
  for (std::size_t p = 0; p < unknown.size(); ++p)
    if (unknown[p] != held)
      fluctuation[axis][p] = x(unknown[p]);
  return report;
}

template <int dim>
ConductionResponse<dim> ConductionVolume<dim>::evaluate() const
{
  const bool fluxes = condition == BoundaryCondition::SUBC;
  ConductionResponse<dim> response;
  response.condition  = condition;
  Tensor2<dim> energy = Tensor2<dim>::Zero(), gradient = energy, flux = energy;
  double volume = 0.;
  for_each_cell([&](const std::size_t k, const CellGradients &gradients) {
    const Cell &cell      = cells.mesh.cells[k];
    const Tensor2<dim> &C = cells.conductivity[cell.material_id];
    Eigen::Matrix<double, Eigen::Dynamic, dim> T(cell.vertices.size(), int{dim});
    for (std::size_t v = 0; v < cell.vertices.size(); ++v)
      for (unsigned int axis = 0; axis < dim; ++axis)
        T(static_cast<Eigen::Index>(v), axis) = fluctuation[axis][cell.vertices[v]];
    Tensor2<dim> sum = Tensor2<dim>::Zero();
    double of_cell   = 0.;
    for (std::size_t q = 0; q < gradients.volume.size(); ++q)
      {
        Tensor2<dim> g = gradients.of_corners[q] * T;
        if (!fluxes)
          g += Tensor2<dim>::Identity();
        energy += gradients.volume[q] * g.transpose() * C * g;
        sum += gradients.volume[q] * g;
        of_cell += gradients.volume[q];
      }
    gradient += sum;
    flux += C * sum;
    volume += of_cell;
    response.concentration.push_back((fluxes ? Tensor2<dim>(C * sum) : sum) / of_cell);
  });
  energy /= volume;
  const Tensor2<dim> mean = (fluxes ? gradient : flux) / volume;
  Tensor2<dim> by_energy = energy, by_mean = 0.5 * (mean + mean.transpose());
  if (fluxes)
    {
      by_energy = (2. * by_mean - energy).inverse().eval();
      by_mean   = by_mean.inverse().eval();
    }
  else if (condition == BoundaryCondition::MUBC)
    for (Tensor2<dim> *one : {&by_energy, &by_mean})
      *one = Tensor2<dim>(one->diagonal().asDiagonal());
  response.conductivity = by_energy;
  response.residual =
    (by_energy - by_mean).cwiseAbs().maxCoeff() / by_energy.cwiseAbs().maxCoeff();
  return response;
}

template <int dim>
ConductionResponse<dim> ConductionVolume<dim>::solve(const BoundaryCondition wanted,
                                                     const double tolerance)
{
  condition = wanted;
  if (condition == BoundaryCondition::PBC && !cells.not_periodic.empty())
    throw UserError(cells.not_periodic);
  std::vector<unsigned int> iterations;
  for (unsigned int axis = 0; axis < dim; ++axis)
    {
      if (axis == 0 || condition == BoundaryCondition::MUBC)
        {
          number_unknowns(axis);
          if (n_unknowns > 0)
            assemble();
        }
      if (n_unknowns > 0)
        iterations.push_back(solve_case(axis, tolerance).iterations);
      else
        fluctuation[axis].assign(unknown.size(), 0.);
    }
  ConductionResponse<dim> response = evaluate();
  response.iterations              = iterations;
  return response;
}

template class ConductionVolume<2>;
template class ConductionVolume<3>;
} // namespace mesoslip
