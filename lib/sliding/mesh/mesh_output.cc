#include "sliding/mesh/mesh_output.h"

#include "base/exchange.h"
#include "exchange/datasets.h"
#include "program/run_context.h"
#include "sliding/mesh/mesh_file.h"
#include "sliding/transient/result_file.h"


namespace mesoslip
{
namespace
{
const char mesh_snapshots[] = "/snapshots/displacement";
} // namespace

template <int dim>
MeshOutput<dim>::MeshOutput(RunContext &context,
                            const ContactParameters &parameters,
                            const MeshMorphology<dim> &morphology,
                            const MeshBodyDescription &body,
                            const TimeStepChoice &time,
                            const MeshPart<dim> &part)
  : RunOutput<dim>(context, parameters, time)
  , morphology(morphology)
  , body(body)
  , part(part)
{
}

template <int dim>
void MeshOutput<dim>::begin(const Stepper &of_stepper,
                            const std::uint64_t n_done,
                            ContactMapOutput<dim> *map)
{
  stepper                  = &of_stepper;
  n_written                = n_done;
  const std::uint64_t step = stepper->step_number();
  const bool with_rows     = has_snapshots() || map != nullptr;
  // Planes of a box are written as wholes.
  n_together =
    mpi::broadcast(context.root() ? body.n_points / vectors_shape(morphology)[0] : 0, 0,
                   context.communicator());
  on_root(context.communicator(), [&]() {
    const std::string path = context.file("dynamics.h5");
    if (n_done > 0 || (map != nullptr && step > 0))
      {
        file.emplace(Hdf5File::resume(path, "start again without --resume"));
        for (const std::string &name : file->list("/"))
          if (name != "mesh" && name != "grid" && name != "material" &&
              name != "snapshots" && name != "contact_map")
            file->remove("/" + name);
      }
    else
      {
        file.emplace(create_mesh_file(path, "mesoslip-dynamics", morphology, body));
      }
    if (has_snapshots())
      file->reserve_rows(mesh_snapshots, snapshots_shape(steps.size()));
    if (map != nullptr)
      map->reserve(*file, time.n_steps);
    file->flush();
    if (with_rows)
      {
        file->leave();
        file.reset();
      }
  });
  if (has_snapshots())
    {
      blocks.emplace(part, body.n_points, context.communicator(), n_together);
      rows.emplace(context.file("dynamics.h5"), mesh_snapshots, context.communicator());
    }
  if (map == nullptr)
    return;
  for (const std::string &name : map->datasets())
    map_rows[name] = std::make_unique<ParallelRows>(context.file("dynamics.h5"), name,
                                                    context.communicator());
  map->begin(step, [this](const std::string &name, const std::size_t first,
                          const std::vector<double> &values) {
    map_rows.at(name)->write_rows(first, values);
  });
}

template <int dim>
Shape MeshOutput<dim>::snapshots_shape(const std::size_t n) const
{
  Shape shape = vectors_shape(morphology);
  shape.insert(shape.begin(), n);
  return shape;
}

template <int dim>
void MeshOutput<dim>::before_step(const std::uint64_t)
{
  std::array<const double *, dim> u;
  for (unsigned int c = 0; c < dim; ++c)
    u[c] = stepper->u.row(c, 0);
  rows->write(n_written, blocks->first() / n_together, blocks->gather(u));
  ++n_written;
}

template <int dim>
void MeshOutput<dim>::sync()
{
  if (rows)
    rows->sync();
  else if (!map_rows.empty())
    map_rows.begin()->second->sync();
  else
    on_root(context.communicator(), [&]() {
      if (file)
        file->sync();
    });
}

template <int dim>
void MeshOutput<dim>::end()
{
  if (!rows && map_rows.empty())
    return;
  rows.reset();
  map_rows.clear();
  on_root(context.communicator(), [&]() {
    file.emplace(Hdf5File::resume(context.file("dynamics.h5"), "start again"));
  });
}

template <int dim>
void MeshOutput<dim>::write(const TransientResult &result,
                            const ContactMapOutput<dim> *map)
{
  if (map != nullptr)
    map->complete(*file, result.steps_done, time.step.dt);
  write_result(*file, result, context);
  write_contact();
  const std::vector<double> times = this->snapshot_times();
  if (has_snapshots())
    {
      file->reserve_rows(mesh_snapshots, snapshots_shape(n_written));
      write_dataset(*file, "/snapshots/time", {times.size()}, times, "s");
      file->write_unit(mesh_snapshots, "m");
    }
  if (!times.empty())
    show_body(context.file("dynamics.xdmf"), "dynamics.h5", morphology,
              {{"displacement", mesh_snapshots, XdmfField::Values::nodes, {dim}}}, times);
  show_mesh_phases(context.file("dynamics-phases.xdmf"), "dynamics.h5", morphology);
  file->close();
  file.reset();
}

template <int dim>
void MeshOutput<dim>::write_contact()
{
  std::vector<double> position, area;
  for (const double a : body.contact.area)
    area.push_back(-a);
  for (const unsigned int point : body.contact.points)
    for (unsigned int d = 0; d < dim; ++d)
      position.push_back(morphology.point(point)[d]);
  write_dataset(*file, "/contact/point", {body.contact.points.size()},
                body.contact.points);
  write_series(*file, "/contact",
               {{"position", "m", &position, dim},
                {"area", dim == 2 ? "m" : "m^2", &area},
                {"height", "m", &body.contact.height}});
}

template class MeshOutput<2>;
template class MeshOutput<3>;
} // namespace mesoslip
