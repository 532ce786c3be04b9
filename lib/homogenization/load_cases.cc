#include "homogenization/load_cases.h"

#include "base/object_exchange.h"
#include "material/stiffness.h"

#include <algorithm>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** Mean stiffness (Pa) of the cells. */
VoigtMatrix<2> voigt_mean(const ElasticBody<2> &body)
{
  const std::vector<double> n = phase_volumes(body);
  VoigtMatrix<2> mean         = VoigtMatrix<2>::Zero();
  for (std::size_t p = 0; p < n.size(); ++p)
    mean += n[p] * body.phases()[p].stiffness / body.n_cells();
  return mean;
}

/** Dirichlet components of the nodes on the sides in load case @p k. */
DofMask held_boundary(const ElasticBody<2> &body,
                      const BoundaryCondition condition,
                      const unsigned int k)
{
  DofMask mask(body.n_columns(), body.n_rows());
  for (unsigned int side = 0; side < 4; ++side)
    for (const NodeIndex &node : body.surface(side).nodes)
      for (unsigned int c = 0; c < 2; ++c)
        if (is_prescribed<2>(condition, k, side / 2, c))
          mask.constrain(c, node);
  return mask;
}

/** u = E.x for a strain (engineering shear), x from the lower left corner. */
NodalField<double> affine_displacement(const ElasticBody<2> &body,
                                       const VoigtVector<2> &strain)
{
  NodalField<double> u = body.zero_field();
  for (unsigned int j = 0; j < u.n_rows(); ++j)
    for (unsigned int i = 0; i < u.n_columns(); ++i)
      {
        const auto [x, y] = body.point({i, j});
        u.row(0, j)[i]    = strain[0] * x + 0.5 * strain[2] * y;
        u.row(1, j)[i]    = strain[1] * y + 0.5 * strain[2] * x;
      }
  return u;
}

/** Nodal forces (N/m) of the traction S.n for the unit stress number @p k. */
NodalField<double> uniform_traction(const ElasticBody<2> &body, const unsigned int k)
{
  NodalField<double> f = body.zero_field();
  const double sxx = k == 0 ? 1. : 0., syy = k == 1 ? 1. : 0., sxy = k == 2 ? 1. : 0.;
  for (unsigned int side = 0; side < 4; ++side)
    {
      const SurfaceNodes<2> &surface = body.surface(side);
      for (std::size_t n = 0; n < surface.nodes.size(); ++n)
        {
          const auto [nx, ny] = surface.normal_area[n];
          f(0, surface.nodes[n]) += sxx * nx + sxy * ny;
          f(1, surface.nodes[n]) += sxy * nx + syy * ny;
        }
    }
  return f;
}

/** The solver for one boundary condition, set up at the first use. */
class CaseSolver
{
public:
  CaseSolver(const ElasticBody<2> &body,
             const double tolerance,
             const NodalField<double> &of_heat)
    : body(body)
    , tolerance(tolerance)
    , of_heat(of_heat)
  {
    const std::vector<double> n = phase_volumes(body);
    homogeneous = std::count_if(n.begin(), n.end(), [](double v) { return v > 0.; }) == 1;
    for (std::size_t p = 0; p < n.size(); ++p)
      {
        const ElasticPhase<2> &phase = body.phases()[p];
        orthotropic = orthotropic && (!(n[p] > 0.) || is_orthotropic<2>(phase.stiffness));
        no_shear    = no_shear && (!(n[p] > 0.) || phase.thermal_stress[2] == 0.);
      }
    no_shear = no_shear && orthotropic;
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
        throw NotConverged(to_string(condition) + " " + name_of_case<2>(k) + ": " +
                             e.what(),
                           e.reason, e.reached);
      }
  }

private:
  SolverReport solve_case(const BoundaryCondition condition,
                          const unsigned int k,
                          NodalField<double> &u)
  {
    if (k == n_voigt<2>)
      return solve_heat(condition, u);
    if (condition == BoundaryCondition::SUBC)
      {
        // Initial guess: exact in a homogeneous body.
        const VoigtMatrix<2> compliance = inverse<2>(voigt_mean(body));
        set_up(condition, k);
        u = affine_displacement(body, VoigtVector<2>(compliance.col(k)));
        return solver->solve(u, uniform_traction(body, k), tolerance);
      }
    u = affine_displacement(body, VoigtVector<2>(VoigtVector<2>::Unit(k)));
    if (homogeneous && (condition != BoundaryCondition::MUBC || orthotropic))
      return SolverReport();

    // The unknown is the fluctuation. The tolerance refers to its forces, which the
    // heterogeneity alone causes.
    set_up(condition, k);
    NodalField<double> force = body.zero_field(), fluctuation = body.zero_field();
    body.vmult(force, u);
    if (condition == BoundaryCondition::PBC)
      periodic_body->add_copies(force);
    for (std::size_t n = 0; n < force.size(); ++n)
      force.begin()[n] *= -1.;
    const SolverReport report = solver->solve(fluctuation, force, tolerance);
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = 0; j < u.n_rows(); ++j)
        for (unsigned int i = 0; i < u.n_columns(); ++i)
          u.row(c, j)[i] += fluctuation.row(c, j)[i];
    return report;
  }

  SolverReport solve_heat(const BoundaryCondition condition, NodalField<double> &u)
  {
    u = body.zero_field();
    // Forces inside a homogeneous body cancel; shears load the free components of MUBC.
    if (homogeneous &&
        (condition == BoundaryCondition::KUBC || condition == BoundaryCondition::PBC ||
         (condition == BoundaryCondition::MUBC && no_shear)))
      return SolverReport();
    set_up(condition, n_voigt<2>);
    NodalField<double> force = of_heat;
    if (condition == BoundaryCondition::PBC)
      periodic_body->add_copies(force);
    return solver->solve(u, force, tolerance);
  }

  void set_up(const BoundaryCondition condition, const unsigned int k)
  {
    if (solver && condition == current && !begins_group<2>(condition, k))
      return;
    const bool other_body =
      condition == BoundaryCondition::PBC || current == BoundaryCondition::PBC;
    current = condition;
    if (!solver || other_body)
      {
        solver.reset();
        periodic_body.reset();
        if (condition == BoundaryCondition::PBC)
          periodic_body = body.make_periodic();
        solver = (periodic_body ? *periodic_body : body).make_solver();
      }
    solver->set_constrained(held_boundary(body, condition, k));
  }

  const ElasticBody<2> &body;
  const double tolerance;
  const NodalField<double> &of_heat;
  bool homogeneous          = false; ///< a single phase only
  bool orthotropic          = true;  ///< all phases are orthotropic along x and y
  bool no_shear             = true;  ///< orthotropic phases without thermal shear stress
  BoundaryCondition current = BoundaryCondition::KUBC;
  std::unique_ptr<ElasticBody<2>> periodic_body;
  std::unique_ptr<StaticSolver> solver;
};

// Row by row instead of the whole object: fields are large, and MPI counts in int.
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

const std::array<std::string, 4> condition_names = {{"KUBC", "SUBC", "PBC", "MUBC"}};
} // namespace

std::string to_string(const BoundaryCondition condition)
{
  return condition_names.at(static_cast<std::size_t>(condition));
}

BoundaryCondition boundary_condition(const std::string &name)
{
  const auto found = std::find(condition_names.begin(), condition_names.end(), name);
  if (found == condition_names.end())
    throw std::invalid_argument(
      "'" + name + "' is no boundary condition; use KUBC, SUBC, PBC or MUBC");
  return static_cast<BoundaryCondition>(found - condition_names.begin());
}

std::vector<LoadCaseSolutions>
solve_load_cases(const ElasticBody<2> &body,
                 const std::vector<BoundaryCondition> &conditions,
                 const double tolerance,
                 const MPI_Comm communicator,
                 const std::function<void()> &case_done,
                 Timer *timer,
                 const NodalField<double> &of_heat)
{
  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &n_ranks);
  const std::vector<unsigned int> order = order_of_cases<2>(of_heat.size() > 0);
  const std::size_t n_in_group          = order.size();
  const unsigned int n_cases            = n_in_group * conditions.size();

  std::vector<LoadCaseSolutions> solutions(conditions.size());
  CaseSolver solver(body, tolerance, of_heat);
  // Contiguous ranges of cases, so that a rank sets up as few boundary conditions as
  // possible. On a distributed body all ranks solve each case together.
  const auto owner = [&](const unsigned int n) {
    return static_cast<int>(n * n_ranks / n_cases);
  };
  for (unsigned int n = 0; n < n_cases; ++n)
    {
      LoadCaseSolutions &solution = solutions[n / n_in_group];
      const unsigned int k        = order[n % n_in_group];
      solution.condition          = conditions[n / n_in_group];
      solution.reports.resize(n_in_group);
      if (body.is_distributed() || owner(n) == rank)
        {
          const auto scope = optional_scope(timer, to_string(solution.condition).c_str());
          solution.reports[k] = solver.solve(solution.condition, k, solution.field(k));
          if (case_done)
            case_done();
        }
      else if (rank == 0)
        solution.field(k) = body.zero_field();
    }
  for (unsigned int n = 0; n < n_cases && !body.is_distributed(); ++n)
    {
      LoadCaseSolutions &solution = solutions[n / n_in_group];
      const unsigned int k        = order[n % n_in_group];
      bring_field_to_root(solution.field(k), owner(n), communicator);
      broadcast_object(communicator, solution.reports[k], owner(n));
    }
  return solutions;
}
} // namespace mesoslip
