#include "exchange/loads_file.h"

#include "exchange/cell_datasets.h"
#include "exchange/datasets.h"
#include "exchange/mesh_datasets.h"
#include "exchange/xdmf.h"

#include <filesystem>

namespace mesoslip
{
namespace
{
/** Writes rows of the same length as a dataset. */
void write_rows(Hdf5File &file,
                const std::string &name,
                const std::vector<std::vector<double>> &rows,
                const std::string &unit)
{
  std::vector<double> values;
  for (const std::vector<double> &row : rows)
    values.insert(values.end(), row.begin(), row.end());
  write_dataset(file, name, {rows.size(), rows[0].size()}, values, unit);
}

void write_group(Hdf5File &file, const LoadGroup &group)
{
  write_dataset(file, group.name + "/macroscopic_strain", {group.strain.size()},
                group.strain);
  write_dataset(file, group.name + "/macroscopic_stress", {group.stress.size()},
                group.stress, "Pa");
  for (const LoadHistograms &histogram : group.histogram)
    {
      write_rows(file, histogram.name + "_edges", histogram.edges, histogram.unit);
      write_rows(file, histogram.name + "_share", histogram.share, "-");
    }
}
} // namespace

void reserve_load_fields(const std::string &path,
                         const Shape &shape,
                         const std::vector<LoadField> &fields)
{
  Hdf5File file = Hdf5File::create(path);
  for (const LoadField &field : fields)
    {
      Shape extent = shape;
      if (field.components > 1)
        extent.push_back(field.components);
      file.reserve_rows(field.name, extent, rows_together(shape));
      file.write_unit(field.name, field.unit);
    }
  file.leave();
}

template <int dim>
void write_loads_file(const std::string &path, const LoadsContent<dim> &content)
{
  using Values      = XdmfField::Values;
  const bool is_new = content.fields.empty() && !content.phase_id.empty();
  Hdf5File file     = is_new ? Hdf5File::create(path) : Hdf5File::resume(path);
  file.write_header(loads_format, newest_loads_version, dim, content.digest);
  Shape cells = {content.phase_id.size()};
  if (content.mesh != nullptr)
    write_mesh(file, *content.mesh);
  else
    {
      cells = {content.grid.cells.rbegin(), content.grid.cells.rend()};
      write_grid(file, content.grid);
    }
  write_phases(file, "/phase", content.phases, false);
  if (!content.phase_id.empty())
    write_dataset(file, phases_dataset, cells, content.phase_id);
  write_dataset(file, "/quantity/strain", {content.strains.size()}, content.strains);
  write_dataset(file, "/quantity/stress", {content.stresses.size()}, content.stresses);
  for (const LoadGroup &group : content.groups)
    write_group(file, group);
  file.close();
  if (content.fields.empty())
    return;
  std::vector<XdmfField> shown = {{"phase", phases_dataset, Values::phases}};
  for (const LoadField &field : content.fields)
    shown.push_back({field.name.substr(std::string("/loads/").size()), field.name,
                     Values::cells,
                     field.components > 1 ? Shape{field.components} : Shape()});
  const std::string xdmf = path.substr(0, path.rfind('.')) + ".xdmf",
                    name = std::filesystem::path(path).filename();
  if (content.mesh != nullptr)
    write_xdmf(xdmf, name, *content.mesh, shown);
  else
    write_xdmf(xdmf, name, content.grid, shown);
}

template void write_loads_file(const std::string &, const LoadsContent<2> &);
template void write_loads_file(const std::string &, const LoadsContent<3> &);
} // namespace mesoslip
