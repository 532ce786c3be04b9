#include "sliding/mesh/mesh_file.h"

#include "exchange/datasets.h"
#include "exchange/mesh_datasets.h"
#include "exchange/xdmf.h"

namespace mesoslip
{
namespace
{
const char phase_of_cells[] = "/material/phase_id";
}

template <int dim>
Hdf5File create_mesh_file(const std::string &path,
                          const std::string &format,
                          const MeshMorphology<dim> &morphology,
                          const MeshBodyDescription &body)
{
  Hdf5File file = Hdf5File::create(path);
  file.write_header(format, 1, dim, body.digest);
  write_mesh(file, morphology.mesh);
  write_phases(file, "/material", morphology.phases, true);
  file.write_attribute("/material", "rve_digest", body.rve_digest);
  std::vector<std::uint8_t> phase_id;
  for (const auto &cell : morphology.mesh.cells)
    phase_id.push_back(static_cast<std::uint8_t>(cell.material_id));
  write_dataset(file, phase_of_cells, {phase_id.size()}, phase_id);
  return file;
}

template <int dim>
void show_mesh_phases(const std::string &path,
                      const std::string &file,
                      const MeshMorphology<dim> &morphology)
{
  write_xdmf(path, file, morphology.mesh,
             {{"phase", phase_of_cells, XdmfField::Values::phases, {}}});
}

#define MESOSLIP_INSTANTIATE(dim)                                              \
  template Hdf5File create_mesh_file(const std::string &, const std::string &, \
                                     const MeshMorphology<dim> &,              \
                                     const MeshBodyDescription &);             \
  template void show_mesh_phases(const std::string &, const std::string &,     \
                                 const MeshMorphology<dim> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
