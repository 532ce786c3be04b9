#ifndef mesoslip_homogenization_load_cases_h
#define mesoslip_homogenization_load_cases_h

#include "base/timer.h"
#include "body/elastic_body.h"
#include "grid/nodal_field.h"
#include "material/voigt.h"

#include <array>
#include <functional>
#include <mpi.h>
#include <string>
#include <vector>

namespace mesoslip
{
/** Boundary condition that applies a macroscopic strain or stress to the volume. */
enum class BoundaryCondition
{
  KUBC, ///< u = E.x on the boundary
  SUBC, ///< sigma.n = S.n on the boundary
  PBC,  ///< u = E.x + periodic

  /** Mixed uniform conditions on a box, for axes of orthotropy along x, y (and z). Normal
   * strains: u.n = (E.x).n on all sides, tangential traction zero. A shear of two axes:
   * on the sides across these axes tangential displacements of E.x, normal traction
   * zero; on all other sides u.n = 0, tangential traction zero. */
  MUBC
};

/** "KUBC", "SUBC", "PBC" or "MUBC", as in the .prm. */
std::string to_string(const BoundaryCondition condition);

/** @throws std::invalid_argument */
BoundaryCondition boundary_condition(const std::string &name);

/** Whether load case @p k (Voigt, or n_voigt: heat) of KUBC or MUBC prescribes the
 * displacement along axis @p c on the sides across axis @p across. */
template <int dim>
bool is_prescribed(const BoundaryCondition condition,
                   const unsigned int k,
                   const unsigned int across,
                   const unsigned int c)
{
  if (condition != BoundaryCondition::MUBC)
    return condition == BoundaryCondition::KUBC;
  // In a shear of the axes a and b the sides across a and b are planes of antisymmetry.
  const bool antisymmetric =
    k >= dim && k < n_voigt<dim> && (dim == 2 || across + 3 != k);
  return (c == across) != antisymmetric;
}

/** Load cases in solution order. If the volume is @p heated, the case of one kelvin
 * (number n_voigt) follows the normal strains, whose prescribed displacements it
 * shares. */
template <int dim>
std::vector<unsigned int> order_of_cases(const bool heated)
{
  std::vector<unsigned int> order;
  for (unsigned int k = 0; k < n_voigt<dim>; ++k)
    {
      order.push_back(k);
      if (heated && k + 1 == dim)
        order.push_back(n_voigt<dim>);
    }
  return order;
}

/** Name of a load case in messages. */
template <int dim>
std::string name_of_case(const unsigned int k)
{
  if (k < n_voigt<dim>)
    return std::string(voigt_names<dim>[k]); // without std::string cppcheck misreads it
  return "heat";
}

/** Whether load case @p k prescribes displacements on other components than the case
 * before. */
template <int dim>
bool begins_group(const BoundaryCondition condition, const unsigned int k)
{
  return k == 0 || (condition == BoundaryCondition::MUBC && k >= dim && k < n_voigt<dim>);
}

/** The three solutions for unit macroscopic strains (KUBC, PBC, MUBC) or stresses (SUBC). */
struct LoadCaseSolutions
{
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< for the solutions

  /**
   * Displacements (m) under xx, yy and xy = 1 (engineering shear for strains; 1 Pa for
   * stresses); for PBC with the affine part E.x included, x from the lower left corner.
   */
  std::array<NodalField<double>, 3> displacement;

  /** Displacements (m) of one kelvin without macroscopic strain (SUBC: stress); empty
   * without thermal expansion. */
  NodalField<double> of_heat;

  /** Displacement field of load case @p k. */
  NodalField<double> &field(const unsigned int k)
  {
    if (k < displacement.size())
      return displacement[k];
    return of_heat;
  }

  /** Displacement field of load case @p k, read only. */
  const NodalField<double> &field(const unsigned int k) const
  {
    if (k < displacement.size())
      return displacement[k];
    return of_heat;
  }

  std::vector<SolverReport>
    reports; ///< solver iterations and residuals of these solves, by load case
};

/**
 * Solves the three load cases of each condition. The cases are dealt out to the ranks of
 * @p communicator and collected on rank 0; the other ranks return reports only. On a
 * distributed body the ranks solve each case together and all return everything.
 * @p of_heat are the nodal forces (N/m) of one kelvin, without periodic copies; empty:
 * no thermal expansion. @p case_done, if any, is called after each load case of this
 * rank; @p timer, if any, gets a section for each condition.
 * @throws NotConverged
 */
std::vector<LoadCaseSolutions>
solve_load_cases(const ElasticBody<2> &body,
                 const std::vector<BoundaryCondition> &conditions,
                 const double tolerance,
                 const MPI_Comm communicator,
                 const std::function<void()> &case_done = {},
                 Timer *timer                           = nullptr,
                 const NodalField<double> &of_heat      = NodalField<double>());

} // namespace mesoslip

#endif
