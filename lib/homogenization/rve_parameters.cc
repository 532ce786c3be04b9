#include "homogenization/rve_parameters.h"

#include "base/errors.h"
#include "material/stiffness.h"
#include "parameters/keys.h"

#include <algorithm>
#include <stdexcept>

namespace mesoslip
{
void RveParameters::bind(Keys &keys)
{
  microstructure.bind(keys);
  {
    const auto section             = keys.section("Homogenization");
    std::vector<std::string> names = {"KUBC", "SUBC"};
    std::vector<double> coefficients;
    keys.bind_list(
      "Boundary conditions", names, {"KUBC", "SUBC", "PBC"},
      "Uniform strain, uniform stress or periodic fluctuations; any of them");
    keys.bind(
      "Solver", solver, {"multigrid", "jacobi", "ml"},
      "Preconditioner of conjugate gradients: geometric multigrid or the diagonal on the "
      "grid; or Trilinos' algebraic multigrid ML on a mesh of deal.II with the same "
      "cells, which the ranks divide among themselves");
    keys.bind("Tolerance", tolerance, Range::open(0., 1.),
              "Relative residual at which a load case is solved [-]");
    keys.bind("Effective", effective, {"mean", "KUBC", "SUBC", "PBC"},
              "The effective stiffness: the mean of KUBC and SUBC, or one of the three");
    keys.bind("Effective symmetry", effective_full, {"orthotropic", "full"},
              "Orthotropic: D13 = D23 = 0 in the effective stiffness, as in eq. (10)");
    keys.bind("Write concentration", write_concentration,
              "Keep the concentration tensors of all cells, which localization needs");
    keys.bind("Reuse", reuse,
              "Keep an rve.h5 in the output folder that has the same inputs");
    keys.bind_list("Reference stiffness", coefficients, Range::any(),
                   "Compared with the results: D11, D12, D22, D33 or all six [Pa]", 0, 6);
    conditions.clear();
    for (const std::string &name : names)
      if (const BoundaryCondition condition = boundary_condition(name);
          std::find(conditions.begin(), conditions.end(), condition) == conditions.end())
        conditions.push_back(condition);
    if (!coefficients.empty())
      try
        {
          reference = stiffness_from_coefficients<2>(coefficients);
        }
      catch (const std::invalid_argument &e)
        {
          throw UserError(std::string("Homogenization/Reference stiffness: ") + e.what());
        }
  }
  const auto section = keys.section("Ensemble");
  keys.bind("Members", n_members, 1, 100000,
            "Morphologies, of the seeds Seed, Seed + 1, ... [-]");
  keys.bind("Confidence", confidence, Range::open(0., 1.),
            "Of the interval of the mean [-]");
}

void RveParameters::check_keys(const Keys &keys)
{
  MicrostructureParameters::check_keys(keys);
  keys.only_if(keys.value("Ensemble/Members") != "1" || keys.is_typed("Ensemble/Members"),
               {"Ensemble/Confidence"}, "there is one morphology",
               "set Ensemble/Members");
}

void RveParameters::check() const
{
  if (conditions.empty())
    throw UserError(
      "Homogenization/Boundary conditions is empty; name KUBC, SUBC, PBC or "
      "several of them");
  if (effective != "mean" && std::find(conditions.begin(), conditions.end(),
                                       boundary_condition(effective)) == conditions.end())
    throw UserError("Homogenization/Effective is " + effective +
                    ", which is not among the Boundary conditions");
  if (n_members > 1 &&
      microstructure.type != MicrostructureParameters::Type::random_fibres)
    throw UserError("Ensemble/Members is " + std::to_string(n_members) +
                    ", but only random fibres differ between members; set Members = 1");
  microstructure.check();
}
} // namespace mesoslip
