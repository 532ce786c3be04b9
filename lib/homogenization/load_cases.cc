#include "homogenization/load_cases.h"

#include "elasticity/uniform_grid_operator.h"
#include "io/exchange.h"

#include <Eigen/Dense>

#include <stdexcept>

namespace mesoslip
{
namespace
{
NodalField<double> zero_field(const UniformGrid<2> &grid)
{
  return NodalField<double>(grid.cells[0] + 1, grid.cells[1] + 1);
}

// Forces on both copies of a node of a periodic side add up.
void fold(NodalField<double> &f)
{
  const unsigned int nx = f.n_columns() - 1, ny = f.n_rows() - 1;
  for (unsigned int c = 0; c < 2; ++c)
    {
      for (unsigned int j = 0; j <= ny; ++j)
        f.row(c, j)[0] = f.row(c, j)[nx] = f.row(c, j)[0] + f.row(c, j)[nx];
      for (unsigned int i = 0; i <= nx; ++i)
        f.row(c, 0)[i] = f.row(c, ny)[i] = f.row(c, 0)[i] + f.row(c, ny)[i];
    }
}

void add(NodalField<double> &x, const NodalField<double> &y, const double factor)
{
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < x.n_rows(); ++j)
      for (unsigned int i = 0; i < x.n_columns(); ++i)
        x.row(c, j)[i] += factor * y.row(c, j)[i];
}

/** Mean stiffness (Pa) of the cells. */
VoigtMatrix<2> voigt_mean(const UniformMaterial &material)
{
  std::vector<std::size_t> n(256, 0);
  for (unsigned int j = 0; j < material.grid().cells[1]; ++j)
    for (unsigned int i = 0; i < material.grid().cells[0]; ++i)
      ++n[material.class_of(i, j)];
  VoigtMatrix<2> mean = VoigtMatrix<2>::Zero();
  for (std::size_t c = 0; c < material.classes().size(); ++c)
    mean += n[c] * material.classes()[c].stiffness / material.grid().n_cells();
  return mean;
}

/** Solver and material of one kind of boundary condition, set up when first needed. */
class CaseSolver
{
public:
  CaseSolver(const UniformMaterial &material,
             const StaticSolverKind kind,
             const double tolerance)
    : material(material)
    , kind(kind)
    , tolerance(tolerance)
    , affine_operator(material)
  {
  }

  /** @throws NotConverged, which names condition and load case. */
  SolverReport
  solve(const BoundaryCondition condition, const unsigned int k, NodalField<double> &u)
  {
    try
      {
        return solve_case(condition, k, u);
      }
    catch (const NotConverged &e)
      {
        static const char *const names[] = {"xx", "yy", "xy"};
        throw NotConverged(to_string(condition) + " " + names[k] + ": " + e.what(),
                           e.reason());
      }
  }

private:
  SolverReport solve_case(const BoundaryCondition condition,
                          const unsigned int k,
                          NodalField<double> &u)
  {
    const UniformGrid<2> &grid = material.grid();
    if (condition == BoundaryCondition::SUBC)
      {
        // Exact in a homogeneous body, a fair guess in others.
        const VoigtMatrix<2> compliance = voigt_mean(material).inverse();
        set_up(condition);
        u = affine_displacement(grid, VoigtVector<2>(compliance.col(k)));
        return solver->solve(u, uniform_traction(grid, k), tolerance);
      }
    u = affine_displacement(grid, k);
    if (material.is_homogeneous())
      return SolverReport();

    // The unknown is the fluctuation: its forces, those of the heterogeneity alone, are
    // what the tolerance refers to.
    set_up(condition);
    NodalField<double> force = zero_field(grid), fluctuation = zero_field(grid);
    affine_operator.vmult(force, u);
    if (condition == BoundaryCondition::PBC)
      fold(force);
    for (std::size_t n = 0; n < force.size(); ++n)
      force.begin()[n] *= -1.;
    const SolverReport report = solver->solve(fluctuation, force, tolerance);
    add(u, fluctuation, 1.);
    return report;
  }

  void set_up(const BoundaryCondition condition)
  {
    if (solver && condition == current)
      return;
    current               = condition;
    const unsigned int nx = material.n_columns(), ny = material.n_rows();
    if (condition == BoundaryCondition::PBC)
      {
        plain_solver.reset();
        solver.reset();
        std::vector<std::uint8_t> ids;
        if (!material.is_homogeneous())
          for (unsigned int j = 0; j + 1 < ny; ++j)
            ids.insert(ids.end(), material.class_row(j), material.class_row(j) + nx - 1);
        std::vector<ElasticClass> classes = material.classes();
        if (material.is_homogeneous())
          classes = {material.classes()[material.homogeneous_class()]};
        periodic_material = std::make_unique<UniformMaterial>(
          material.grid(), classes, ids, Periodicity{true, true});
        solver = make_static_solver(kind, *periodic_material);
        solver->set_held(DofMask(nx, ny));
        return;
      }
    if (!plain_solver)
      plain_solver = make_static_solver(kind, material);
    solver = plain_solver;
    solver->set_held(condition == BoundaryCondition::KUBC ? DofMask::boundary(nx, ny)
                                                          : DofMask(nx, ny));
  }

  const UniformMaterial &material;
  const StaticSolverKind kind;
  const double tolerance;
  BoundaryCondition current = BoundaryCondition::KUBC;
  std::unique_ptr<UniformMaterial> periodic_material;
  const UniformGridOperator affine_operator;
  std::shared_ptr<StaticSolver> plain_solver, solver;
};

// By rows, not as a whole object: fields are large, and MPI counts in int.
void bring_field_to_root(NodalField<double> &u, const int owner, const MPI_Comm comm)
{
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const int n_columns = static_cast<int>(u.n_columns());
  for (unsigned int c = 0; owner != 0 && c < 2; ++c)
    for (unsigned int j = 0; j < u.n_rows(); ++j)
      if (rank == owner)
        MPI_Send(u.row(c, j), n_columns, MPI_DOUBLE, 0, 0, comm);
      else if (rank == 0)
        MPI_Recv(u.row(c, j), n_columns, MPI_DOUBLE, owner, 0, comm, MPI_STATUS_IGNORE);
}
} // namespace

std::string to_string(const BoundaryCondition condition)
{
  return condition == BoundaryCondition::KUBC   ? "KUBC"
         : condition == BoundaryCondition::SUBC ? "SUBC"
                                                : "PBC";
}

BoundaryCondition boundary_condition(const std::string &name)
{
  for (const BoundaryCondition condition :
       {BoundaryCondition::KUBC, BoundaryCondition::SUBC, BoundaryCondition::PBC})
    if (to_string(condition) == name)
      return condition;
  throw std::invalid_argument("'" + name +
                              "' is no boundary condition; use KUBC, SUBC or PBC");
}

NodalField<double> affine_displacement(const UniformGrid<2> &grid,
                                       const VoigtVector<2> &strain)
{
  NodalField<double> u = zero_field(grid);
  for (unsigned int j = 0; j < u.n_rows(); ++j)
    for (unsigned int i = 0; i < u.n_columns(); ++i)
      {
        const double x = i * grid.spacing[0], y = j * grid.spacing[1];
        u.row(0, j)[i] = strain[0] * x + 0.5 * strain[2] * y;
        u.row(1, j)[i] = strain[1] * y + 0.5 * strain[2] * x;
      }
  return u;
}

NodalField<double> affine_displacement(const UniformGrid<2> &grid, const unsigned int k)
{
  return affine_displacement(grid, VoigtVector<2>(VoigtVector<2>::Unit(k)));
}

NodalField<double> uniform_traction(const UniformGrid<2> &grid, const unsigned int k)
{
  NodalField<double> f  = zero_field(grid);
  const unsigned int nx = grid.cells[0], ny = grid.cells[1];
  const double sxx = k == 0 ? 1. : 0., syy = k == 1 ? 1. : 0., sxy = k == 2 ? 1. : 0.;
  for (unsigned int j = 0; j <= ny; ++j)
    {
      const double length = grid.spacing[1] * (j == 0 || j == ny ? 0.5 : 1.);
      f.row(0, j)[nx] += sxx * length;
      f.row(1, j)[nx] += sxy * length;
      f.row(0, j)[0] -= sxx * length;
      f.row(1, j)[0] -= sxy * length;
    }
  for (unsigned int i = 0; i <= nx; ++i)
    {
      const double length = grid.spacing[0] * (i == 0 || i == nx ? 0.5 : 1.);
      f.row(0, ny)[i] += sxy * length;
      f.row(1, ny)[i] += syy * length;
      f.row(0, 0)[i] -= sxy * length;
      f.row(1, 0)[i] -= syy * length;
    }
  return f;
}

std::vector<LoadCaseSolutions>
solve_load_cases(const UniformMaterial &material,
                 const std::vector<BoundaryCondition> &conditions,
                 const StaticSolverKind kind,
                 const double tolerance,
                 const MPI_Comm communicator,
                 const LoadCaseProgress &progress,
                 Timer *timer)
{
  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &n_ranks);
  const unsigned int n_cases = 3 * conditions.size();

  std::vector<LoadCaseSolutions> solutions(conditions.size());
  CaseSolver solver(material, kind, tolerance);
  // Contiguous shares, so that a rank sets up as few kinds of boundary as possible.
  const auto owner = [&](const unsigned int n) {
    return static_cast<int>(n * n_ranks / n_cases);
  };
  for (unsigned int n = 0; n < n_cases; ++n)
    {
      LoadCaseSolutions &solution = solutions[n / 3];
      solution.condition          = conditions[n / 3];
      if (owner(n) == rank)
        {
          const auto scope = optional_scope(timer, to_string(solution.condition).c_str());
          solution.reports[n % 3] =
            solver.solve(solution.condition, n % 3, solution.displacement[n % 3]);
          if (progress)
            progress(n + 1, n_cases);
        }
      else if (rank == 0)
        solution.displacement[n % 3] = zero_field(material.grid());
    }
  for (unsigned int n = 0; n < n_cases; ++n)
    {
      bring_field_to_root(solutions[n / 3].displacement[n % 3], owner(n), communicator);
      broadcast_object(communicator, solutions[n / 3].reports[n % 3], owner(n));
    }
  return solutions;
}
} // namespace mesoslip
