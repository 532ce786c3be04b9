#include "homogenization/volume_analysis.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "exchange/cell_datasets.h"
#include "exchange/loads_file.h"
#include "homogenization/conduction/conduction_output.h"
#include "homogenization/derivatives/derivative_output.h"
#include "homogenization/derivatives/loss_output.h"
#include "homogenization/heat/heat_output.h"
#include "homogenization/loads/load_output.h"
#include "io/drafts.h"
#include "material/bounds.h"
#include "material/engineering_constants.h"
#include "material/plausibility.h"
#include "program/machine.h"
#include "program/run_context.h"

#include <algorithm>
#include <filesystem>
#include <ostream>

namespace mesoslip
{
namespace
{
// Above this tolerance hardly any result passes check_response().
constexpr double largest_useful_residual = 1e-4;

// Whether this version of the program wrote the file with this digest.
bool is_up_to_date(const std::string &path,
                   const std::string &format,
                   const std::string &digest)
{
  if (!std::filesystem::exists(path))
    return false;
  try
    {
      const Hdf5File file = Hdf5File::open(path);
      return file.check_header(format, newest_rve_version) == digest &&
             file.change_note("rve_homogenization").empty();
    }
  catch (const UserError &)
    {
      return false; // not an rve.h5, or damaged: it is computed again
    }
}
} // namespace

/** Bytes of rve.h5: the phases, and the concentration tensors of the first morphology. */
template <int dim>
ResourceNeed VolumeAnalysis<dim>::need() const
{
  const FurtherFields further = further_fields();
  const double tensors        = parameters.write_concentration
                                  ? 8. *
                               (n_voigt<dim> * (n_voigt<dim> + (expands() ? 1. : 0.)) +
                                (further.transverse_thermal_stress ? 1. : 0.) +
                                (further.conduction ? dim * dim : 0.)) *
                               static_cast<double>(parameters.conditions.size())
                                  : 0.;
  const double n              = static_cast<double>(n_cells());
  return {n * (1. + tensors) + bytes_of_loads<dim>(parameters, n),
          "set Homogenization/Write concentration = false, or take fewer cells"};
}

template <int dim>
void VolumeAnalysis<dim>::describe(std::ostream &out) const
{
  std::vector<std::string> warnings;
  for (const std::string &line : describe_morphologies(warnings))
    out << line << '\n';
  for (const std::string &line : lines_of_cells())
    out << line << '\n';
  if (const double bytes = bytes_of_conduction(1); bytes > 0.)
    out << "conduction: about " << bytes_text(bytes) << " on the rank that solves it\n";
  out << n_cases() * parameters.n_members << " load cases, about " << memory() << '\n'
      << bytes_text(need().bytes) << " on the disk\n";
  for (const std::vector<std::string> &sentences : {warnings, slips()})
    for (const std::string &warning : sentences)
      out << "warning: " << warning << '\n';
}

/** Writes rve.h5 with empty concentration tensors; the stiffness is Hill's mean of the
 * bounds. */
template <int dim>
void VolumeAnalysis<dim>::write_draft(const std::string &folder) const
{
  const DraftMark mark(false);
  std::string path;
  RveContent<dim> content;
  bool are_written_by_ranks = false;
  on_root(MPI_COMM_WORLD, [&]() {
    path                           = path_of_draft(folder, "rve.h5");
    content                        = morphology().first;
    content.reserved               = reserved_conditions();
    const auto [phases, fractions] = content.constituents();
    const VoigtMatrix<dim> hill =
      0.5 * (voigt_bound<dim>(phases, fractions) + reuss_bound<dim>(phases, fractions));
    content.stiffness["effective"] = hill;
    for (const BoundaryCondition condition : parameters.conditions)
      content.stiffness[to_string(condition)] = hill;
    FurtherFields heat = further_fields();
    heat.conduction    = false;
    reserve_concentration<dim>(path, shape(), content.reserved, heat);
    for (const auto &[of, D] : content.stiffness)
      if (heat.thermal_stress)
        content.expansion[of].setZero();
    are_written_by_ranks = content.phase_id.empty();
    if (are_written_by_ranks)
      reserve_cells(path, shape(), !content.orientations.empty());
  });
  broadcast(MPI_COMM_WORLD, path);
  broadcast_object(MPI_COMM_WORLD, are_written_by_ranks);
  if (are_written_by_ranks)
    write_cells(path, true);
  on_root(MPI_COMM_WORLD, [&]() { write_rve_file(path, content); });
}

template <int dim>
bool VolumeAnalysis<dim>::expands() const
{
  const auto &phases = parameters.microstructure.phases;
  return std::any_of(phases.begin(), phases.end(),
                     [](const PhaseParameters &phase) { return phase.expands(); });
}

template <int dim>
CellKinds VolumeAnalysis<dim>::kinds_of_cells() const
{
  return {parameters.mean_dilatation, has_simplices() && parameters.mesh.degree == 1};
}

template <int dim>
std::vector<std::string> VolumeAnalysis<dim>::lines_of_cells() const
{
  return lines_on_cells<dim>(make_phases<dim>(parameters.microstructure.phases),
                             kinds_of_cells());
}

template <int dim>
std::vector<std::string> VolumeAnalysis<dim>::slips() const
{
  const auto phases = make_phases<dim>(parameters.microstructure.phases);
  auto ranges       = plausible_phases<dim>(phases);
  for (unsigned int d = 0; grid && d < dim; ++d)
    ranges.push_back(
      plausible_length("Grid/Size along " + std::string(1, "xyz"[d]), grid->extent(d)));
  auto sentences = implausible(ranges);
  for (const std::string &one : stiffness_warnings<dim>(phases, kinds_of_cells()))
    sentences.push_back(one);
  return sentences;
}

template <int dim>
std::string VolumeAnalysis<dim>::advice(const NotConverged &failure) const
{
  if (failure.reason == NotConverged::Reason::not_finite)
    return std::string("check the moduli of Phases and ") +
           (grid ? "Grid/Size, which are in Pa and m" : "Mesh/Scale") +
           ": forces or displacements are beyond the range of numbers";
  // For a mesh the lines on its cells already state the worst angles.
  double aspect = 1.;
  if (grid)
    {
      const auto &edges              = grid->spacing;
      const auto [shortest, longest] = std::minmax_element(edges.begin(), edges.end());
      aspect                         = *longest / *shortest;
    }
  std::string text =
    hard_to_solve<dim>(make_phases<dim>(parameters.microstructure.phases), aspect);
  if (failure.reached <= largest_useful_residual)
    text += (text.empty() ? "" : "; ") +
            brief_text(1, "Homogenization/Tolerance = ", 2. * failure.reached,
                       " would have been met");
  return text;
}

template <int dim>
std::vector<std::string> VolumeAnalysis<dim>::reserved_conditions() const
{
  std::vector<std::string> names;
  if (parameters.write_concentration)
    for (const BoundaryCondition condition : parameters.conditions)
      names.push_back(to_string(condition));
  std::sort(names.begin(), names.end());
  return names;
}

template <int dim>
void VolumeAnalysis<dim>::run(RunContext &context)
{
  bool reuse = context.root() && parameters.reuse &&
               is_up_to_date(context.file("rve.h5"), rve_format, digest) &&
               (parameters.loads.loads.empty() ||
                is_up_to_date(context.file("loads.h5"), loads_format, digest));
  broadcast_object(context.communicator(), reuse);
  if (reuse)
    {
      context.log("rve.h5 is up to date: nothing that determines it has changed");
      if (context.root() && restore_rve_summary(context))
        {
          log_stiffness<dim>(context);
          log_expansion(context);
          log_conductivity(context);
          log_derivatives(context);
          log_loads<dim>(context);
        }
      return;
    }

  context.remove_results({"rve.h5", "rve.xdmf", "stiffness.csv",
                          "engineering_constants.csv", "phase_means.csv", "ensemble.csv",
                          "rectangles.csv", "loads.h5", "loads.xdmf", "loads.csv",
                          "loads_ensemble.csv", "derivatives.csv", "uncertainty.csv",
                          "loss_factors.csv", "expansion.csv", "conductivity.csv"});
  for (const std::string &slip : slips())
    context.warn(slip);
  const unsigned int n_ranks = ranks_of_this_machine();
  on_root(context.communicator(), [&]() {
    require_memory({bytes_of_conduction(n_ranks),
                    "take fewer cells, or leave out Phases/.../Conductivity"});
  });
  RveResults<dim> results;
  try
    {
      results = compute(context);
    }
  catch (const NotConverged &e)
    {
      const std::string more = advice(e);
      throw NumericalFailure(e.what() + (more.empty() ? "" : "; " + more));
    }
  if (!context.root())
    return;
  for (const std::string &warning : result_warnings<dim>(results.members, parameters))
    context.warn(warning);
  for (const std::string &warning : loss_warnings<dim>(parameters, results.members))
    context.warn(warning);
  for (const std::string &warning : expansion_warnings<dim>(parameters, results.members))
    context.warn(warning);
  for (const std::string &warning :
       conductivity_warnings<dim>(parameters, results.members))
    context.warn(warning);
  for (const std::string &warning : load_warnings<dim>(parameters, results.members))
    context.warn(warning);
  const auto scope = context.timer().scope("Output");
  results.effective =
    mean_stiffness<dim>(results.members, effective_conditions(parameters));
  if (!parameters.effective_full)
    results.effective = orthotropic_part<dim>(results.effective);
  results.expansion        = expansions<dim>(parameters, results);
  results.conductivity     = conductivities<dim>(parameters, results);
  results.first.variations = varied_constants<dim>(parameters, results);
  results.first.digest     = digest;
  results.first.fractions  = results.members[0].fractions;
  write_rve_tables<dim>(parameters, results, context);
  write_derivatives<dim>(parameters, results, context);
  write_expansion<dim>(results, context);
  write_conductivity<dim>(results, context);
  write_loads<dim>(parameters, results, context);
  write_rve_summary<dim>(parameters, results, context);
  write_rve_results<dim>(results, context);
}

template class VolumeAnalysis<2>;
template class VolumeAnalysis<3>;
} // namespace mesoslip
