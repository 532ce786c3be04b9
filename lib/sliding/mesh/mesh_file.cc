#include "sliding/mesh/mesh_file.h"

#include "base/object_exchange.h"
#include "exchange/datasets.h"
#include "exchange/mesh_datasets.h"
#include "exchange/orientation_datasets.h"
#include "exchange/xdmf.h"
#include "io/parallel_rows.h"
#include "mesh/point_blocks.h"

namespace mesoslip
{
namespace
{
const char phase_of_cells[] = "/material/phase_id";

/** Grid or mesh, and the phases of the cells. */
template <int dim>
void write_cells(Hdf5File &file, const MeshMorphology<dim> &morphology)
{
  if constexpr (dim == 3)
    if (morphology.box)
      {
        write_grid(file, morphology.box->grid);
        return write_materials(file, phase_of_cells, morphology.box->grid,
                               morphology.oriented, morphology.materials_in);
      }
  write_mesh(file, morphology.mesh);
  std::vector<std::uint8_t> phase_id;
  for (const auto &cell : morphology.mesh.cells)
    phase_id.push_back(static_cast<std::uint8_t>(cell.material_id));
  write_dataset(file, phase_of_cells, {phase_id.size()}, phase_id);
}
} // namespace

template <int dim>
Hdf5File create_mesh_file(const std::string &path,
                          const std::string &format,
                          const MeshMorphology<dim> &morphology,
                          const std::string &digest,
                          const std::string &rve_digest)
{
  Hdf5File file = Hdf5File::create(path);
  file.write_header(morphology.box ? format : format + "-mesh",
                    morphology.oriented.empty() ? 1 : 2, dim, digest);
  write_phases(file, "/material", morphology.phases, true);
  file.write_attribute("/material", "rve_digest", rve_digest);
  write_cells(file, morphology);
  return file;
}

template <int dim>
Shape vectors_shape(const MeshMorphology<dim> &morphology)
{
  if (!morphology.box)
    return {morphology.mesh.points.size(), dim};
  const auto &n = morphology.box->grid.cells;
  return {std::size_t{n[2]} + 1, std::size_t{n[1]} + 1, std::size_t{n[0]} + 1, dim};
}

template <int dim>
void write_divided_fields(std::optional<Hdf5File> &file,
                          const std::string &path,
                          const std::string &name,
                          const std::vector<const NodalField<double> *> &fields,
                          const MeshMorphology<dim> &morphology,
                          const MeshBody<dim> &elastic)
{
  const MPI_Comm communicator = elastic.communicator();
  // Planes of a box are written as wholes.
  std::array<std::size_t, 2> extent = {}; // of the points, of one row of the dataset
  on_root(communicator, [&]() {
    Shape shape = vectors_shape(morphology);
    extent      = {{morphology.n_points(), morphology.n_points() / shape[0]}};
    shape.insert(shape.begin(), fields.size());
    file->reserve_rows(name, shape);
    file->leave();
    file.reset();
  });
  broadcast_object(communicator, extent);
  const PointBlocks<dim> blocks(elastic.owned_points(), extent[0], communicator,
                                extent[1]);
  {
    ParallelRows rows(path, name, communicator);
    for (std::size_t k = 0; k < fields.size(); ++k)
      {
        std::array<const double *, dim> components;
        for (unsigned int c = 0; c < dim; ++c)
          components[c] = fields[k]->row(c, 0);
        rows.write(k, blocks.first() / extent[1], blocks.gather(components));
      }
  }
  on_root(communicator, [&]() { file.emplace(Hdf5File::resume(path, "start again")); });
}

template <int dim>
void show_mesh(const std::string &path,
               const MeshMorphology<dim> &morphology,
               const std::vector<XdmfField> &fields,
               const std::vector<double> &times)
{
  const std::vector<XdmfField> phases = {
    {"phase", phase_of_cells, XdmfField::Values::phases, {}}};
  if constexpr (dim == 3)
    if (morphology.box)
      return show_file(path, morphology.box->grid, fields, times, phases);
  show_file(path, morphology.mesh, fields, times, phases);
}

#define MESOSLIP_INSTANTIATE(dim)                                                      \
  template Hdf5File create_mesh_file(const std::string &, const std::string &,         \
                                     const MeshMorphology<dim> &, const std::string &, \
                                     const std::string &);                             \
  template Shape vectors_shape(const MeshMorphology<dim> &);                           \
  template void write_divided_fields(                                                  \
    std::optional<Hdf5File> &, const std::string &, const std::string &,               \
    const std::vector<const NodalField<double> *> &, const MeshMorphology<dim> &,      \
    const MeshBody<dim> &);                                                            \
  template void show_mesh(const std::string &, const MeshMorphology<dim> &,            \
                          const std::vector<XdmfField> &, const std::vector<double> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
