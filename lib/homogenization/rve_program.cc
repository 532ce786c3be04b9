#include "homogenization/rve_program.h"

#include "base/digest.h"
#include "base/object_exchange.h"
#include "base/version.h"
#include "grid/instruction_set.h"
#include "homogenization/volume_analysis.h"
#include "parameters/keys.h"

namespace mesoslip
{
namespace
{
// Raise this when the same parameters get different results: existing rve.h5 files are
// then computed again. 2: ensembles on several ranks had been wrong. 3: cells coarser
// than the pixels of an image took the pixel at their centre, and gamma changed a PNG.
constexpr double revision = 3.;

// Digest of the inputs of rve.h5: the computation, the parameters that matter and the
// content of the input file.
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

std::unique_ptr<Analysis> make_volume_analysis(Keys &keys)
{
  resolve(InstructionSet::automatic); // reports an invalid MESOSLIP_ISA
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

} // namespace mesoslip
