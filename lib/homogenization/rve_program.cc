#include "homogenization/rve_program.h"

#include "base/digest.h"
#include "base/errors.h"
#include "base/object_exchange.h"
#include "base/version.h"
#include "exchange/loads_file.h"
#include "exchange/rve_file.h"
#include "grid/instruction_set.h"
#include "homogenization/loads/load_output.h"
#include "homogenization/volume_analysis.h"
#include "io/drafts.h"
#include "io/hdf5_file.h"
#include "material/bounds.h"
#include "material/engineering_constants.h"
#include "material/plausibility.h"
#include "parameters/keys.h"
#include "program/run_context.h"

#include <filesystem>

namespace mesoslip
{
namespace
{
// To be raised when the same parameters come to have other results: an rve.h5 of before
// is then made again. 2: ensembles on several ranks had been wrong. 3: cells coarser than
// the pixels of an image took the pixel at their centre, and gamma changed a PNG.
constexpr double revision = 3.;

// With a tolerance above this, hardly a result is as accurate as check_response() asks for.
constexpr double largest_useful_residual = 1e-4;

// What determines rve.h5: the computation, the parameters that matter and the content of
// the input file.
std::string inputs_digest(const Keys &keys, const RveParameters &parameters)
{
  Digest digest;
  digest.add(version).add(revision);
  digest.add(canonical_parameters(keys, {"Output folder", "Homogenization/Reuse"}));
  for (const std::string &file : parameters.mesh.files)
    digest.add_file(file);
  const MicrostructureParameters &microstructure = parameters.microstructure;
  if (microstructure.type == MicrostructureParameters::Type::voxels)
    for (const std::string &file :
         microstructure.voxels.source(microstructure.file).files())
      digest.add_file(file);
  else if (!microstructure.file.empty())
    digest.add_file(microstructure.file);
  for (const std::string &file :
       {microstructure.orientation.file, microstructure.orientation.table})
    if (!file.empty())
      digest.add_file(file);
  return digest.hex();
}

// As this program has written it, with this digest.
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
      return false; // Something else of that name, or damaged: it is made again.
    }
}

} // namespace

/** Bytes of rve.h5: the phases, and the concentration tensors of the first morphology. */
template <int dim>
ResourceNeed VolumeAnalysis<dim>::need() const
{
  const double tensors = parameters.write_concentration
                           ? 8. * n_voigt<dim> * n_voigt<dim> *
                               static_cast<double>(parameters.conditions.size())
                           : 0.;
  return {n_cells() * (1. + tensors) + bytes_of_loads<dim>(parameters, n_cells()),
          "set Homogenization/Write concentration = false, or take fewer cells"};
}

/** rve.h5 with empty concentration tensors; the stiffness is Hill's mean, between the bounds. */
template <int dim>
void VolumeAnalysis<dim>::write_draft(const std::string &folder) const
{
  const DraftMark mark(false);
  std::string path;
  RveContent<dim> content;
  on_root(MPI_COMM_WORLD, [&]() {
    path                           = path_of_draft(folder, "rve.h5");
    content                        = morphology();
    const auto [phases, fractions] = content.constituents();
    const VoigtMatrix<dim> hill =
      0.5 * (voigt_bound<dim>(phases, fractions) + reuss_bound<dim>(phases, fractions));
    content.stiffness["effective"] = hill;
    for (const BoundaryCondition condition : parameters.conditions)
      {
        content.stiffness[to_string(condition)] = hill;
        if (parameters.write_concentration)
          content.reserved.push_back(to_string(condition));
      }
    if (content.mesh != nullptr)
      reserve_concentration<dim>(path, content.phase_id.size(), content.reserved);
    else
      reserve_concentration(path, content.grid, content.reserved);
  });
  broadcast(MPI_COMM_WORLD, path);
  write_cells_of_draft(path);
  on_root(MPI_COMM_WORLD, [&]() { write_rve_file(path, content); });
}

template <int dim>
std::string VolumeAnalysis<dim>::causes(const NotConverged &failure,
                                        const double aspect) const
{
  std::string text =
    hard_to_solve<dim>(make_phases<dim>(parameters.microstructure.phases), aspect);
  if (failure.reached <= largest_useful_residual)
    text += (text.empty() ? "" : "; ") +
            brief_text(1, "Homogenization/Tolerance = ", 2. * failure.reached,
                       " would have been met");
  return text;
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
          log_loads<dim>(context);
        }
      return;
    }

  context.remove_results({"rve.h5", "rve.xdmf", "stiffness.csv",
                          "engineering_constants.csv", "phase_means.csv", "ensemble.csv",
                          "rectangles.csv", "loads.h5", "loads.xdmf", "loads.csv",
                          "loads_ensemble.csv"});
  for (const std::string &slip : slips())
    context.warn(slip);
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
  for (const std::string &warning : load_warnings<dim>(parameters, results.members))
    context.warn(warning);
  const auto scope = context.timer().scope("Output");
  results.effective =
    mean_stiffness<dim>(results.members, effective_conditions(parameters));
  if (!parameters.effective_full)
    results.effective = orthotropic_part<dim>(results.effective);
  results.first.digest    = digest;
  results.first.fractions = results.members[0].fractions;
  write_rve_tables<dim>(parameters, results, context);
  write_loads<dim>(parameters, results, context);
  write_rve_summary<dim>(parameters, results, context);
  write_rve_results<dim>(results, context);
}

namespace
{
std::unique_ptr<Analysis> make_volume_analysis(Keys &keys)
{
  resolve(InstructionSet::automatic); // tells what is wrong with MESOSLIP_ISA
  RveParameters parameters;
  parameters.bind(keys);
  parameters.check();
  if (parameters.mesh.files.empty() && parameters.mesh.dim == 3)
    require_voxel_memory(parameters);
  std::string digest;
  on_root(MPI_COMM_WORLD, [&]() { digest = inputs_digest(keys, parameters); });
  broadcast(MPI_COMM_WORLD, digest);
  if (parameters.mesh.files.empty())
    return parameters.mesh.dim == 2 ? make_grid_analysis(parameters, digest)
                                    : make_voxel_analysis(parameters, digest);
  return parameters.mesh.dim == 2 ? make_mesh_analysis<2>(parameters, digest)
                                  : make_mesh_analysis<3>(parameters, digest);
}
} // namespace

Application rve_homogenization_program()
{
  return {"rve_homogenization",
          "Effective stiffness and concentration tensors of a representative volume.",
          [](Keys &keys) { RveParameters().bind(keys); }, make_volume_analysis,
          "an rve.h5 with a guess of the stiffness"};
}

template class VolumeAnalysis<2>;
template class VolumeAnalysis<3>;
} // namespace mesoslip
