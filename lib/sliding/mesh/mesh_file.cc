#include "sliding/mesh/mesh_file.h"

#include "base/object_exchange.h"
#include "exchange/datasets.h"
#include "io/parallel_rows.h"
#include "mesh/point_blocks.h"

namespace mesoslip
{
template <int dim>
Hdf5File create_mesh_file(const std::string &path,
                          const std::string &format,
                          const BodyMesh<dim> &body,
                          const std::string &digest,
                          const std::string &rve_digest)
{
  Hdf5File file = Hdf5File::create(path);
  file.write_header(format + body.format_ending(), body.oriented.empty() ? 1 : 2, dim,
                    digest);
  write_phases(file, "/material", body.phases, true);
  file.write_attribute("/material", "rve_digest", rve_digest);
  body.write_cells(file);
  return file;
}

template <int dim>
void write_divided_fields(std::optional<Hdf5File> &file,
                          const std::string &path,
                          const std::string &name,
                          const std::vector<const NodalField<double> *> &fields,
                          const BodyMesh<dim> &body,
                          const PointBody<dim> &elastic)
{
  const MPI_Comm communicator = elastic.communicator();
  // Planes of a box are not split.
  std::array<std::size_t, 2> extent = {}; // points in a row of the dataset
  on_root(communicator, [&]() {
    Shape shape = body.vectors_shape();
    extent      = {{body.n_points(), body.n_points() / shape[0]}};
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

#define MESOSLIP_INSTANTIATE(dim)                                                     \
  template Hdf5File create_mesh_file(const std::string &, const std::string &,        \
                                     const BodyMesh<dim> &, const std::string &,      \
                                     const std::string &);                            \
  template void write_divided_fields(std::optional<Hdf5File> &, const std::string &,  \
                                     const std::string &,                             \
                                     const std::vector<const NodalField<double> *> &, \
                                     const BodyMesh<dim> &, const PointBody<dim> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
