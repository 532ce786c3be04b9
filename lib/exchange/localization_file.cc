#include "exchange/localization_file.h"

#include "exchange/datasets.h"
#include "exchange/mesh_datasets.h"
#include "io/parallel_rows.h"

#include <filesystem>

namespace mesoslip
{
namespace
{
constexpr int newest_localization_version = 1;

const char localization_format[]  = "mesoslip-localization";
const char localization_program[] = "stress_localization";

/** A series of a probe; the last one is omitted without a direct run. */
struct ProbeDataset
{
  const char *name, *unit;
  std::vector<double> LocalizedProbe::*values;
  bool has_components;
};

const ProbeDataset probe_datasets[] = {
  {"time", "s", &LocalizedProbe::time, false},
  {"stress", "Pa", &LocalizedProbe::stress, true},
  {"direct_stress", "Pa", &LocalizedProbe::direct_stress, true}};

std::string probe_group(const std::string &group, const std::string &name)
{
  return group + "/probes/" + name;
}

template <int dim>
std::vector<std::string> component_names(const std::string &prefix)
{
  std::vector<std::string> names;
  for (const char *name : voigt_names<dim>)
    names.push_back(prefix + name);
  return names;
}

template <int dim>
std::vector<StressField> fields_in()
{
  return {{"mean_von_mises",
           &FieldSelection::von_mises,
           &StressFields::mean_von_mises,
           {"mean_von_mises"}},
          {"mean_stress", &FieldSelection::mean, &StressFields::mean_stress,
           component_names<dim>("mean_sigma_")},
          {"deviation_stress", &FieldSelection::deviation,
           &StressFields::deviation_stress, component_names<dim>("deviation_sigma_")}};
}
} // namespace

std::vector<StressField> stress_fields(const unsigned int dim,
                                       const FieldSelection &fields)
{
  std::vector<StressField> selected;
  for (const StressField &field : dim == 2 ? fields_in<2>() : fields_in<3>())
    if (fields.*field.is_wanted)
      selected.push_back(field);
  return selected;
}

/** Shape of a field with @p n components; no component axis for n = 1. */
Shape LocalizationFile::shape_of_field(const std::size_t n) const
{
  Shape shape = cells;
  if (n > 1)
    shape.push_back(n);
  return shape;
}

template <int dim>
LocalizationFile LocalizationFile::create(const std::string &path,
                                          const std::string &digest,
                                          const UniformGrid<dim> &grid)
{
  LocalizationFile file(Hdf5File::create(path), dim, shape_of_cells(grid));
  file.write_header(localization_format, newest_localization_version, dim, digest);
  write_grid(file, grid);
  file.write_shown = [grid](const std::string &xdmf, const std::string &h5,
                            const std::vector<XdmfField> &fields) {
    write_xdmf(xdmf, h5, grid, fields);
  };
  return file;
}

template <int dim>
LocalizationFile LocalizationFile::create(const std::string &path,
                                          const std::string &digest,
                                          const Mesh<dim> &mesh)
{
  LocalizationFile file(Hdf5File::create(path), dim, {mesh.cells.size()});
  file.write_header(localization_format, newest_localization_version, dim, digest);
  write_mesh(file, mesh);
  file.write_shown = [&mesh](const std::string &xdmf, const std::string &h5,
                             const std::vector<XdmfField> &fields) {
    write_xdmf(xdmf, h5, mesh, fields);
  };
  return file;
}

LocalizationFile LocalizationFile::open(const std::string &path)
{
  Hdf5File opened = Hdf5File::open(path, "run stress_localization first");
  opened.check_header(localization_format, newest_localization_version, 2,
                      localization_program);
  const UniformGrid<2> grid = read_grid<2>(opened, localization_program);
  return {std::move(opened), 2, shape_of_cells(grid)};
}

void LocalizationFile::reserve_fields(const FieldSelection &fields,
                                      const std::string &group)
{
  for (const StressField &field : stress_fields(dimension, fields))
    {
      const std::size_t n    = field.quantities.size();
      const std::string name = group + "/" + field.name;
      reserve(name, shape_of_field(n));
      write_unit(name, "Pa");
      shown.push_back(
        {name.substr(1), name, XdmfField::Values::cells, n > 1 ? Shape{n} : Shape{}});
    }
}

void write_fields(const std::string &path,
                  const unsigned int dim,
                  const FieldSelection &selection,
                  const StressFields &fields,
                  const std::string &group,
                  const std::size_t first_row,
                  const MPI_Comm communicator)
{
  for (const StressField &field : stress_fields(dim, selection))
    ParallelRows(path, group + "/" + field.name, communicator)
      .write_rows(first_row, fields.*field.values);
}

void LocalizationFile::write_probe(const LocalizedProbe &probe, const std::string &in)
{
  const std::string group = probe_group(in, probe.name);
  for (const auto &[name, unit, values, has_components] : probe_datasets)
    if (!(probe.*values).empty() || values != &LocalizedProbe::direct_stress)
      write_series(*this, group,
                   {{name, unit, &(probe.*values), has_components ? n_components() : 0}});
  write_attribute(group, "position", probe.position);
  write_attribute(group, "cell", probe.cell);
  write_attribute(group, "phase", probe.phase);
  write_attribute(group, "phase_name", probe.phase_name);
}

void LocalizationFile::complete()
{
  Hdf5File::resume(path()).close();
  if (!shown.empty())
    write_shown(path().substr(0, path().rfind('.')) + ".xdmf",
                std::filesystem::path(path()).filename(), shown);
}

StressFields LocalizationFile::fields(const std::string &group) const
{
  StressFields fields;
  for (const StressField &field : stress_fields(dimension))
    if (const std::string name = group + "/" + field.name; exists(name))
      {
        fields.*field.values =
          read<double>(name, shape_of_field(field.quantities.size()));
        require_unit(name, "Pa");
      }
  return fields;
}

LocalizedProbe LocalizationFile::probe(const std::string &name,
                                       const std::string &in) const
{
  const std::string group = probe_group(in, name);
  LocalizedProbe probe;
  probe.name       = name;
  probe.position   = read_attribute<std::vector<double>>(group, "position");
  probe.cell       = read_attribute<std::vector<unsigned int>>(group, "cell");
  probe.phase      = read_attribute<unsigned int>(group, "phase");
  probe.phase_name = read_attribute<std::string>(group, "phase_name");
  for (const auto &[dataset, unit, values, has_components] : probe_datasets)
    if (const std::string full = group + "/" + dataset;
        exists(full) || values != &LocalizedProbe::direct_stress)
      {
        probe.*values = read<double>(
          full, has_components ? Shape{any_extent, n_components()} : Shape{any_extent});
        require_unit(full, unit);
      }
  return probe;
}

template LocalizationFile LocalizationFile::create(const std::string &,
                                                   const std::string &,
                                                   const UniformGrid<2> &);
template LocalizationFile LocalizationFile::create(const std::string &,
                                                   const std::string &,
                                                   const UniformGrid<3> &);
template LocalizationFile
LocalizationFile::create(const std::string &, const std::string &, const Mesh<2> &);
template LocalizationFile
LocalizationFile::create(const std::string &, const std::string &, const Mesh<3> &);
} // namespace mesoslip
