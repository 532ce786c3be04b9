#include "homogenization/conduction/conduction_volume.h"

#include "base/errors.h"
#include "body/mesh/conjugate_gradients.h"
#include "mesh/linear_cell.h"

#include <deal.II/base/quadrature.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/** Loads of a homogeneous volume cancel to round-off; below this share of the cells'
 * loads they are zero. */
constexpr double cancelled = 1e-12;

/** Tolerance of the residual, relative to the load of the best conductor, that keeps the
 * currents of the worst conductor accurate. */
template <int dim>
double tolerance_for(const std::vector<Tensor2<dim>> &conductivity, const double wanted)
{
  double least = conductivity[0](0, 0), largest = least;
  for (const Tensor2<dim> &k : conductivity)
    {
      const auto eigenvalues =
        Eigen::SelfAdjointEigenSolver<Tensor2<dim>>(k, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .eval();
      least   = std::min(least, eigenvalues[0]);
      largest = std::max(largest, eigenvalues[dim - 1]);
    }
  return std::max(1e-14, std::min(wanted, 1e-3 * least / largest));
}
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
    unknown[periodic ? mesh.master(0) : 0] = held; // fixes the constant
  n_unknowns = 0;
  for (unsigned int p = 0; p < unknown.size(); ++p)
    if (unknown[p] != held && !(periodic && mesh.master(p) != p))
      unknown[p] = n_unknowns++;
  for (unsigned int p = 0; periodic && p < unknown.size(); ++p)
    unknown[p] = unknown[mesh.master(p)];
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

/** Calls visit(number of the cell, conductivity, gradients of all load cases, volume) at
 * the quadrature points. */
template <int dim>
template <typename Visit>
void ConductionVolume<dim>::for_each_gradient(const Visit &visit) const
{
  for_each_cell([&](const std::size_t k, const CellGradients &gradients) {
    const Cell &cell = cells.mesh.cells[k];
    Eigen::Matrix<double, Eigen::Dynamic, dim> T(cell.vertices.size(), int{dim});
    for (std::size_t v = 0; v < cell.vertices.size(); ++v)
      for (unsigned int axis = 0; axis < dim; ++axis)
        T(static_cast<Eigen::Index>(v), axis) = fluctuation[axis][cell.vertices[v]];
    for (std::size_t q = 0; q < gradients.volume.size(); ++q)
      {
        Tensor2<dim> g = gradients.of_corners[q] * T;
        if (condition != BoundaryCondition::SUBC)
          g += Tensor2<dim>::Identity();
        visit(k, cells.conductivity[cell.material_id], g, gradients.volume[q]);
      }
  });
}

template <int dim>
std::vector<double> ConductionVolume<dim>::concentration() const
{
  std::vector<Tensor2<dim>> sums(cells.mesh.cells.size(), Tensor2<dim>::Zero());
  std::vector<double> volumes(sums.size(), 0.), values;
  for_each_gradient([&](const std::size_t k, const Tensor2<dim> &C, const Tensor2<dim> &g,
                        const double volume) {
    sums[k] += volume * (condition == BoundaryCondition::SUBC ? Tensor2<dim>(C * g) : g);
    volumes[k] += volume;
  });
  values.reserve(sums.size() * dim * dim);
  for (std::size_t k = 0; k < sums.size(); ++k)
    for (Eigen::Index e = 0; e < sums[k].size(); ++e)
      values.push_back(sums[k].data()[e] / volumes[k]);
  return values;
}

template <int dim>
ConductionResponse<dim> ConductionVolume<dim>::evaluate() const
{
  const bool fluxes = condition == BoundaryCondition::SUBC;
  ConductionResponse<dim> response;
  response.condition  = condition;
  Tensor2<dim> energy = Tensor2<dim>::Zero(), gradient = energy, flux = energy;
  double volume = 0.;
  for_each_gradient([&](const std::size_t, const Tensor2<dim> &C, const Tensor2<dim> &g,
                        const double part) {
    energy += part * g.transpose() * C * g;
    gradient += part * g;
    flux += part * C * g;
    volume += part;
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
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      response.residual =
        std::max(response.residual, std::fabs(by_energy(i, j) - by_mean(i, j)) /
                                      std::sqrt(by_energy(i, i) * by_energy(j, j)));
  if (!by_energy.allFinite())
    response.residual = std::numeric_limits<double>::quiet_NaN();
  return response;
}

template <int dim>
ConductionResponse<dim> ConductionVolume<dim>::solve(const BoundaryCondition wanted,
                                                     const double tolerance)
{
  condition           = wanted;
  const double needed = tolerance_for<dim>(cells.conductivity, tolerance);
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
      iterations.push_back(0);
      if (n_unknowns > 0)
        iterations.back() = solve_case(axis, needed).iterations;
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
