#include "dynamics/critical_time_step.h"

#include "base/exchange.h"
#include "elasticity/uniform_grid_operator.h"
#include "grid/nodal_field.h"
#include "material/symmetric_eigenvalues.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>

namespace mesoslip
{
double critical_time_step(const double omega, const double beta2, const double beta)
{
  if (!(omega > 0.) || !(beta2 > 0.) || !(beta >= 0.))
    throw std::invalid_argument(
      "the critical time step needs positive omega and beta2 and beta not negative");
  const double xi = beta * omega / 2.;
  // (sqrt(xi^2 + 2b) - xi) / b without cancellation.
  return 2. / (std::sqrt(xi * xi + 2. * beta2) + xi) / omega;
}

namespace
{
/** Largest eigenpair of the leading Lanczos matrix: value and last component. */
std::pair<double, double> largest_ritz_pair(const std::vector<double> &diagonal,
                                            const std::vector<double> &off)
{
  const Eigen::Map<const Eigen::VectorXd> d(diagonal.data(), diagonal.size());
  const Eigen::Map<const Eigen::VectorXd> e(off.data(), diagonal.size() - 1);
  // Eigen compares off-diagonals with the roots of diagonals and does not scale a
  // tridiagonal matrix: large numbers, such as squared frequencies, may fail to converge.
  const double scale =
    std::max(d.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(d / scale, e / scale);
  if (solver.info() != Eigen::Success)
    throw std::runtime_error(
      "the eigenvalues of the Lanczos matrix were not found; check that "
      "stiffness and density are finite");
  const auto last = d.size() - 1;
  return {scale * solver.eigenvalues()[last], solver.eigenvectors()(last, last)};
}

/**
 * A symmetric positive semi-definite operator with unknowns distributed over the ranks.
 */
struct Operator
{
  /** y = M^-1/2 K M^-1/2 x for the unknowns of this rank. */
  std::function<void(std::vector<double> &, const std::vector<double> &)> apply;

  double bound          = std::numeric_limits<double>::infinity(); ///< bound (1/s)
  MPI_Comm communicator = MPI_COMM_SELF;
};

/** Random start vector, the same in each run. */
class StartNumbers
{
public:
  double operator()()
  {
    return distribution(generator);
  }

private:
  std::mt19937 generator{20080101};
  std::uniform_real_distribution<double> distribution{-1., 1.};
};

FrequencyEstimate iterate(const Operator &op,
                          std::vector<double> v,
                          const double tolerance,
                          const unsigned int max_iterations)
{
  // Lanczos without reorthogonalization: the extreme Ritz values are not affected.
  const std::size_t n = v.size();
  const auto total = [&](const auto number) { return mpi::sum(number, op.communicator); };
  const std::uint64_t n_all = total(std::uint64_t(n));
  std::vector<double> old(n, 0.), y(n), diagonal, off;
  double square = 0.;
  for (const double x : v)
    square += x * x;
  const double start = std::sqrt(total(square));
  for (double &x : v)
    x /= start;

  FrequencyEstimate estimate;
  estimate.upper = op.bound;
  double before  = 0.;
  for (unsigned int k = 1; k <= max_iterations; ++k)
    {
      op.apply(y, v);
      estimate.iterations = k;
      double alpha        = 0.;
      for (std::size_t i = 0; i < n; ++i)
        alpha += y[i] * v[i];
      alpha  = total(alpha);
      square = 0.;
      for (std::size_t i = 0; i < n; ++i)
        {
          y[i] -= alpha * v[i] + before * old[i];
          square += y[i] * y[i];
        }
      const double next = std::sqrt(total(square));
      diagonal.push_back(alpha);
      const bool exhausted = !(next > 1e-12 * std::abs(diagonal[0])) || k >= n_all;
      if (k % 5 == 0 || k == max_iterations || exhausted)
        {
          const auto pair       = largest_ritz_pair(diagonal, off);
          const double residual = exhausted ? 0. : next * std::abs(pair.second);
          estimate.lower        = std::sqrt(std::max(pair.first, 0.));
          estimate.upper =
            std::min(op.bound, std::sqrt(std::max(pair.first, 0.) + residual));
          // A small residual shows that an eigenvalue is near, not that it is the largest
          // one. After a random start it is, once the Ritz value has had time to rise.
          if (exhausted ||
              (k >= 30 && estimate.upper <= (1. + tolerance) * estimate.lower))
            break;
        }
      off.push_back(next);
      before = next;
      old.swap(v);
      for (std::size_t i = 0; i < n; ++i)
        v[i] = y[i] / next;
    }
  return estimate;
}
} // namespace

double element_frequency_bound(const UniformMaterial &material)
{
  const double hx = material.grid().spacing[0], hy = material.grid().spacing[1];
  double largest = 0.;
  for (const unsigned int k : material.phases_that_occur())
    {
      const ElasticPhase<2> &phase = material.phases()[k];
      const double stiffest = symmetric_eigenvalues(cell_stiffness(phase, {{hx, hy}}))[7];
      largest = std::max(largest, stiffest / (phase.density * hx * hy / 4.));
    }
  return std::sqrt(largest);
}

FrequencyEstimate largest_frequency(const UniformMaterial &material,
                                    const double tolerance,
                                    const unsigned int max_iterations)
{
  // The free grid: periodic sides act like constraints on it.
  const UniformMaterial free = material.with({});
  const UniformGridOperator stiffness(free);
  const unsigned int columns = free.n_columns(), n_rows = free.n_rows();

  NodalField<double> x(columns, n_rows), f(columns, n_rows), scale(columns, n_rows);
  for (unsigned int j = 0; j < n_rows; ++j)
    for (const unsigned int c : {0u, 1u})
      {
        double *s = scale.row(c, j);
        free.mass_row(j, s);
        for (unsigned int i = 0; i < columns; ++i)
          s[i] = 1. / std::sqrt(s[i]);
      }
  // Calls function(k, component, node) for each unknown.
  const auto for_each = [&](const auto &function) {
    std::size_t k = 0;
    for (unsigned int j = 0; j < n_rows; ++j)
      for (const unsigned int c : {0u, 1u})
        for (unsigned int i = 0; i < columns; ++i, ++k)
          function(k, c, NodeIndex{i, j});
  };
  const auto apply = [&](std::vector<double> &y, const std::vector<double> &v) {
    for_each([&](const std::size_t k, const unsigned int c, const NodeIndex &node) {
      x(c, node) = scale(c, node) * v[k];
    });
    stiffness.vmult(f, x);
    for_each([&](const std::size_t k, const unsigned int c, const NodeIndex &node) {
      y[k] = scale(c, node) * f(c, node);
    });
  };
  std::vector<double> start(2 * std::size_t(columns) * n_rows);
  StartNumbers random;
  for (double &value : start)
    value = random();
  return iterate({apply, element_frequency_bound(free)}, std::move(start), tolerance,
                 max_iterations);
}

namespace
{
/**
 * Frequency estimate on the locally owned points of a part, dim unknowns per point:
 * @p multiply (y, v, s) replaces y by s K s v with one number s per point; @p mass has
 * all points.
 */
template <int dim, typename Multiply>
FrequencyEstimate frequency_of_part(const MeshPart<dim> &part,
                                    const std::vector<double> &mass,
                                    const Multiply &multiply,
                                    Operator op,
                                    const double tolerance,
                                    const unsigned int max_iterations)
{
  std::vector<double> scale;
  for (unsigned int i = 0; i < part.n_distinct; ++i)
    scale.push_back(1. / std::sqrt(mass[i]));
  op.apply = [&](std::vector<double> &y, const std::vector<double> &v) {
    multiply(y, v, scale);
  };
  // A point of the mesh gets the same random numbers for any number of ranks.
  std::vector<std::pair<unsigned int, unsigned int>> points;
  for (unsigned int i = 0; i < part.n_distinct; ++i)
    points.emplace_back(part.point_in_mesh[i], i);
  std::sort(points.begin(), points.end());
  std::vector<double> start(dim * std::size_t(part.n_distinct));
  StartNumbers random;
  unsigned int drawn = 0;
  for (const auto &[in_mesh, i] : points)
    for (; drawn <= in_mesh; ++drawn)
      for (unsigned int c = 0; c < dim; ++c)
        start[dim * std::size_t(i) + c] = random();
  return iterate(op, start, tolerance, max_iterations);
}
} // namespace

template <int dim>
FrequencyEstimate largest_frequency(const MeshOperator<dim> &op,
                                    const double tolerance,
                                    const unsigned int max_iterations)
{
  constexpr unsigned int stride = kernels::node_stride<dim>;
  LineVector<double> field = op.zero_field(), f = field;
  const auto multiply = [&](std::vector<double> &y, const std::vector<double> &v,
                            const std::vector<double> &scale) {
    std::fill(field.begin(), field.end(), 0.);
    std::fill(f.begin(), f.end(), 0.);
    for (std::size_t i = 0; i < scale.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        field[i * stride + c] = scale[i] * v[i * dim + c];
    // Zeros at ghost points: the sum is the value of the owner.
    op.sum_up(field.data());
    op.add_product(f.data(), field.data());
    for (std::size_t i = 0; i < scale.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        y[i * dim + c] = scale[i] * f[i * stride + c];
  };
  return frequency_of_part(op.part, op.lumped_mass(), multiply,
                           {{}, std::numeric_limits<double>::infinity(), op.communicator},
                           tolerance, max_iterations);
}

FrequencyEstimate largest_frequency(const BrickOperator &op,
                                    const double tolerance,
                                    const unsigned int max_iterations)
{
  const MeshPart<3> &part = op.slab().part;
  auto field = NodalField<double>::of_points(part.points.size(), 3), f = field;
  const auto multiply = [&](std::vector<double> &y, const std::vector<double> &v,
                            const std::vector<double> &scale) {
    for (unsigned int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < scale.size(); ++i)
        field.row(c, 0)[i] = scale[i] * v[3 * i + c];
    op.set_points_of_others(field);
    op.multiply(f, field);
    for (unsigned int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < scale.size(); ++i)
        y[3 * i + c] = scale[i] * f.row(c, 0)[i];
  };
  return frequency_of_part(part, op.lumped_mass(), multiply,
                           {{}, op.frequency_bound(), op.communicator}, tolerance,
                           max_iterations);
}

namespace
{
/**
 * Lengths of blocks (at least a dozen cells) into which @p n cells in a row can be cut.
 */
std::vector<unsigned int> lengths_of_blocks(const unsigned int n)
{
  const unsigned int parts = std::max(1U, n / 12), length = n / parts;
  return n % parts == 0 ? std::vector<unsigned int>{length}
                        : std::vector<unsigned int>{length, length + 1};
}
} // namespace

FrequencyEstimate largest_frequency_of_blocks(const UniformGrid<3> &grid,
                                              const ElasticPhase<3> &phase,
                                              const InstructionSet isa)
{
  FrequencyEstimate largest;
  BrickBox block{grid, {}};
  const auto zeros = [](const CellBlock<3> &cells) {
    return std::vector<std::uint16_t>(cells.n_cells());
  };
  for (const unsigned int nx : lengths_of_blocks(grid.cells[0]))
    for (const unsigned int ny : lengths_of_blocks(grid.cells[1]))
      for (const unsigned int nz : lengths_of_blocks(grid.cells[2]))
        {
          block.grid.cells = {{nx, ny, nz}};
          const BrickOperator op(divide_box(block, zeros, 1, MPI_COMM_SELF), {phase},
                                 MPI_COMM_SELF, isa);
          const FrequencyEstimate of_block = largest_frequency(op);
          if (of_block.upper > largest.upper)
            largest = of_block;
        }
  return largest;
}

template FrequencyEstimate
largest_frequency(const MeshOperator<2> &, const double, const unsigned int);
template FrequencyEstimate
largest_frequency(const MeshOperator<3> &, const double, const unsigned int);

double
critical_time_step(const UniformMaterial &material, const double beta2, const double beta)
{
  return critical_time_step(largest_frequency(material).upper, beta2, beta);
}
} // namespace mesoslip
