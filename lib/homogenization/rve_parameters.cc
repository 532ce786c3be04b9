#include "homogenization/ensemble.h"

#include "base/digest.h"
#include "base/errors.h"
#include "base/files.h"
#include "material/stiffness.h"
#include "parameters/keys.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** Refuses keys that have no effect with a mesh. */
void refuse_keys_of_grids(const Keys &keys, const RveParameters &parameters)
{
  const bool grid          = parameters.mesh.files.empty();
  const std::string reason = "Mesh/File is given";
  keys.only_if(grid, {"Grid/", "Microstructure/", "Ensemble/Members"}, reason,
               "leave Mesh/File empty");
  const bool voxels = grid && parameters.mesh.dim == 3;
  keys.only_if(voxels ? parameters.solver == StaticSolverKind::multigrid
                      : grid || parameters.solver == StaticSolverKind::ml,
               {"Homogenization/Solver"},
               voxels ? "Dimension is 3 and voxels are solved with multigrid"
                      : reason + " and meshes are solved with ml",
               voxels ? "set it to multigrid" : "set it to ml");
}
/** @throws UserError unless all phases or no phase has a conductivity, within the range
 * of accurate solutions */
void check_conductivities(const std::vector<PhaseParameters> &phases)
{
  constexpr double most = 1e10;
  const auto has_none   = [](const PhaseParameters &phase) {
    return phase.conductivities.empty();
  };
  const auto without = std::find_if(phases.begin(), phases.end(), has_none),
             with    = std::find_if_not(phases.begin(), phases.end(), has_none);
  if (with == phases.end())
    return;
  if (without != phases.end())
    throw UserError("Phases: " + without->name + " has no Conductivity and " +
                    with->name + " has one; give it for all phases or for none");
  double least = with->conductivities[0], largest = least;
  for (const PhaseParameters &phase : phases)
    for (const double k : phase.conductivities)
      {
        least   = std::min(least, k);
        largest = std::max(largest, k);
      }
  if (largest > most * (1 + 1e-12) * least) // a ratio of 1e10 may round above it
    throw UserError("Phases/.../Conductivity: the largest, " + to_text(largest) +
                    ", is more than 1e10 times the least, " + to_text(least) +
                    ", beyond which round-off decides; raise the least");
}
} // namespace

void RveParameters::bind(Keys &keys)
{
  mesh.has_grids_in_3d = true;
  mesh.has_degrees     = true;
  mesh.bind(keys);
  microstructure.has_grids_in_3d = true;
  microstructure.is_volume       = true;
  microstructure.bind(keys, mesh.files.empty() ? mesh.dim : 2);
  {
    const auto section             = keys.section("Homogenization");
    std::vector<std::string> names = {"KUBC", "SUBC"};
    keys.bind_list(
      "Boundary conditions", names, {"KUBC", "SUBC", "PBC", "MUBC"},
      "Boundary conditions of the load cases, one or more of: KUBC, "
      "displacements of a uniform strain; SUBC, tractions of a uniform "
      "stress; PBC, periodic fluctuations about a uniform strain; MUBC, mixed "
      "uniform conditions: normal displacements or, in shear, tangential "
      "ones, of a uniform strain without other tractions, for axes of orthotropy along "
      "those of space. KUBC is "
      "an upper and SUBC a lower bound of large volumes [-]");
    keys.bind(
      "Solver", solver, {"multigrid", "jacobi", "ml", "divided"},
      "Preconditioner of conjugate gradients: multigrid, geometric multigrid on "
      "the grid, where each rank has whole load cases; jacobi, the diagonal, "
      "which takes more iterations; ml, Trilinos' algebraic multigrid ML on a "
      "mesh of deal.II with the same cells, which the ranks divide among "
      "themselves; divided, the multigrid of voxels in 2D, where all ranks divide "
      "the rows of cells among themselves, with the least memory, which is taken "
      "instead of multigrid if that does not fit into the memory [-]");
    keys.renamed("Solver = assembled", "ml");
    bind_mean_dilatation(keys, mean_dilatation);
    keys.bind("Tolerance", tolerance, Range::open(0., 1.),
              "Norm of the residual over that of the load at which conjugate gradients "
              "stop. Lower it if the run warns that few digits hold [-]");
    keys.bind("Effective", effective, {"mean", "KUBC", "SUBC", "PBC", "MUBC"},
              "Effective stiffness of the composite, which contact_dynamics reads: the "
              "mean of KUBC and SUBC or, unless both are wanted, of all boundary "
              "conditions; or the one of a single boundary condition [-]");
    keys.bind("Effective symmetry", effective_full, {"orthotropic", "full"},
              "orthotropic: the entries that couple a shear to anything else, in 2D D13 "
              "and D23, are set to 0 in the effective stiffness, as in eq. (10) of the "
              "paper; full: they are kept [-]");
    keys.bind(
      "Derivatives", derivatives,
      "Write how the stiffness of the composite changes with each constant of each "
      "phase, from the energies of the unit load cases without a further solve; they "
      "are computed, too, where a phase has a Relative deviation [-]");
    keys.bind(
      "Loss", complex_loss, {"first order", "complex"},
      "Loss factors of the composite: first order, from the energies of the phases "
      "under the unit load cases; complex, those of the complex stiffness, from two "
      "further solves of all load cases [-]");
    keys.only_if(largest_loss_factor(*this) > 0. || !complex_loss, {"Loss"},
                 "no phase has a Loss factor", "give one under Phases");
    keys.bind(
      "Write concentration", write_concentration,
      "Keep the concentration tensors of all cells in rve.h5: "
      "stress_localization needs them; 72 bytes a cell and condition in 2D, 288 in "
      "3D [-]");
    keys.bind("Reuse", reuse,
              "Keep an rve.h5 in the output folder that was made from the same inputs, "
              "and compute nothing [-]");
    keys.bind_list(
      "Reference stiffness", reference, Range::any(),
      "Stiffness that the effective one is compared with in the tables, for "
      "instance a published one; entries as for Phases/.../Stiffness. Empty: "
      "no comparison [Pa]",
      0, 21);
    conditions.clear();
    for (const std::string &name : names)
      if (const BoundaryCondition condition = boundary_condition(name);
          std::find(conditions.begin(), conditions.end(), condition) == conditions.end())
        conditions.push_back(condition);
  }
  {
    const auto section = keys.section("Ensemble");
    keys.bind("Members", n_members, 1, 100000,
              "Number of random morphologies, of the seeds Seed, Seed + 1, ... of "
              "Microstructure/Random fibres or Random inclusions [-]");
    keys.bind("Confidence", confidence, Range::open(0., 1.),
              "Probability with which the interval that is given for the mean stiffness "
              "of all morphologies contains it (Student's t) [-]");
  }
  loads.bind(keys, mesh.dim);
  refuse_keys_of_grids(keys, *this);
  if (!mesh.files.empty())
    n_members = mesh.files.size();
  keys.only_if(n_members != 1 || keys.is_typed("Ensemble/Members"),
               {"Ensemble/Confidence"}, "there is one morphology",
               "set Ensemble/Members or several meshes");
}

void RveParameters::check() const
{
  if (conditions.empty())
    throw UserError(
      "Homogenization/Boundary conditions is empty; name KUBC, SUBC, PBC, MUBC or "
      "several of them");
  if (effective != "mean" && std::find(conditions.begin(), conditions.end(),
                                       boundary_condition(effective)) == conditions.end())
    throw UserError("Homogenization/Effective is " + effective +
                    ", which is not among the Boundary conditions");
  loads.check(conditions, microstructure.phases);
  check_conductivities(microstructure.phases);
  for (const PhaseParameters &phase : microstructure.phases)
    if (mesh.dim == 2 && phase.type == PhaseParameters::Type::stiffness &&
        !(loads.von_mises_limit.empty() && loads.principal_limit.empty()))
      throw UserError(
        "Loads/Von Mises limit and Principal stress limit need sigma_zz, of "
        "which Phases/" +
        phase.name +
        "/Type = stiffness says nothing in 2D; give the moduli as isotropic "
        "or orthotropic, or remove the limits");
  try
    {
      if (!reference.empty() && mesh.dim == 2)
        stiffness_from_coefficients<2>(reference);
      else if (!reference.empty())
        stiffness_from_coefficients<3>(reference);
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(std::string("Homogenization/Reference stiffness: ") + e.what());
    }
  if (!mesh.files.empty())
    {
      for (const std::string &file : mesh.files)
        require_readable_file("Mesh/File: ", file, "it has to name a mesh of Gmsh");
      std::map<std::string, std::string> contents;
      for (const std::string &file : mesh.files)
        if (const auto [same, is_new] =
              contents.emplace(Digest().add_file(file).hex(), file);
            !is_new)
          throw UserError("Mesh/File: " + same->second + " and " + file +
                          " are one mesh; members of an ensemble have to differ");
      for (const PhaseParameters &phase : microstructure.phases)
        mesh.dim == 2 ? phase.check<2>() : phase.check<3>();
      return;
    }
  if (n_members > 1 && !microstructure.is_random())
    throw UserError("Ensemble/Members is " + std::to_string(n_members) +
                    ", but only random fibres and random inclusions differ between "
                    "members; set Members = 1");
  microstructure.check();
}
} // namespace mesoslip
