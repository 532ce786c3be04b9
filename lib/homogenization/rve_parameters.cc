#include "homogenization/rve_parameters.h"

#include "io/errors.h"
#include "io/key_use.h"
#include "io/parameters.h"
#include "material/stiffness.h"

#include <algorithm>
#include <stdexcept>

namespace mesoslip
{
void RveParameters::declare(dealii::ParameterHandler &prm, const RawParameters &raw)
{
  MicrostructureParameters::declare(prm, raw);
  {
    const ParameterSection section(prm, "Homogenization");
    declare_word_list(
      prm, "Boundary conditions", {"KUBC", "SUBC"}, {"KUBC", "SUBC", "PBC"},
      "Uniform strain, uniform stress or periodic fluctuations; any of them");
    declare_selection(
      prm, "Solver", "multigrid", {"multigrid", "jacobi", "assembled"},
      "Conjugate gradients with multigrid or with the diagonal, or Trilinos' "
      "matrix and ML as an independent path");
    declare_double(prm, "Tolerance", 1e-8, Range::open(0., 1.),
                   "Relative residual at which a load case is solved [-]");
    declare_selection(
      prm, "Effective", "mean", {"mean", "KUBC", "SUBC", "PBC"},
      "The effective stiffness: the mean of KUBC and SUBC, or one of the three");
    declare_selection(
      prm, "Effective symmetry", "orthotropic", {"orthotropic", "full"},
      "Orthotropic: D13 = D23 = 0 in the effective stiffness, as in eq. (10)");
    declare_bool(prm, "Write concentration", true,
                 "Keep the concentration tensors of all cells, which localization needs");
    declare_bool(prm, "Reuse", true,
                 "Keep an rve.h5 in the output folder that has the same inputs");
    declare_double_list(prm, "Reference stiffness", {}, Range::any(),
                        "Compared with the results: D11, D12, D22, D33 or all six [Pa]",
                        0, 6);
  }
  const ParameterSection section(prm, "Ensemble");
  declare_integer(prm, "Members", 1, 1, 100000,
                  "Morphologies, of the seeds Seed, Seed + 1, ... [-]");
  declare_double(prm, "Confidence", 0.95, Range::open(0., 1.),
                 "Of the interval of the mean [-]");
}

void RveParameters::check_keys(const KeyUse &use)
{
  MicrostructureParameters::check_keys(use);
  use.only_if(use.value("Ensemble/Members") != "1" || use.is_typed("Ensemble/Members"),
              {"Ensemble/Confidence"}, "there is one morphology", "set Ensemble/Members");
}

RveParameters RveParameters::parse(dealii::ParameterHandler &prm)
{
  RveParameters p;
  p.microstructure.parse(prm);
  {
    const ParameterSection section(prm, "Homogenization");
    for (const std::string &name : get_word_list(prm, "Boundary conditions"))
      {
        const BoundaryCondition condition = boundary_condition(name);
        if (std::find(p.conditions.begin(), p.conditions.end(), condition) ==
            p.conditions.end())
          p.conditions.push_back(condition);
      }
    p.solver                = static_solver_kind(get_string(prm, "Solver"));
    p.tolerance             = get_double(prm, "Tolerance");
    p.effective             = get_string(prm, "Effective");
    p.effective_orthotropic = get_string(prm, "Effective symmetry") == "orthotropic";
    p.write_concentration   = get_bool(prm, "Write concentration");
    p.reuse                 = get_bool(prm, "Reuse");
    const auto reference    = get_double_list(prm, "Reference stiffness");
    if (!reference.empty())
      try
        {
          p.reference = stiffness_from_coefficients<2>(reference);
        }
      catch (const std::invalid_argument &e)
        {
          throw UserError(std::string("Homogenization/Reference stiffness: ") + e.what());
        }
  }
  {
    const ParameterSection section(prm, "Ensemble");
    p.n_members  = get_integer(prm, "Members");
    p.confidence = get_double(prm, "Confidence");
  }
  if (p.conditions.empty())
    throw UserError(
      "Homogenization/Boundary conditions is empty; name KUBC, SUBC, PBC or "
      "several of them");
  if (p.effective != "mean" &&
      std::find(p.conditions.begin(), p.conditions.end(),
                boundary_condition(p.effective)) == p.conditions.end())
    throw UserError("Homogenization/Effective is " + p.effective +
                    ", which is not among the Boundary conditions");
  if (p.n_members > 1 &&
      p.microstructure.type != MicrostructureParameters::Type::random_fibres)
    throw UserError("Ensemble/Members is " + std::to_string(p.n_members) +
                    ", but only random fibres differ between members; set Members = 1");
  p.microstructure.check();
  return p;
}
} // namespace mesoslip
