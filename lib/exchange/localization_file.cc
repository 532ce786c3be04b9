#include "exchange/localization_file.h"

#include "exchange/datasets.h"

#include <filesystem>

namespace mesoslip
{
namespace
{
constexpr int newest_localization_version = 1;

const char localization_format[]  = "mesoslip-localization";
const char localization_program[] = "stress_localization";

/** A series of a probe; the last one is left out without a direct run. */
struct ProbeDataset
{
  const char *name, *unit;
  std::vector<double> LocalizedProbe::*values;
  std::size_t components;
};

const ProbeDataset probe_datasets[] = {
  {"time", "s", &LocalizedProbe::time, 0},
  {"stress", "Pa", &LocalizedProbe::stress, 3},
  {"direct_stress", "Pa", &LocalizedProbe::direct_stress, 3}};

std::string probe_group(const std::string &group, const std::string &name)
{
  return group + "/probes/" + name;
}

/** Extents of a field of @p n components; none of one. */
Shape shape_of_field(const UniformGrid<2> &grid, const std::size_t n)
{
  return n > 1 ? Shape{grid.cells[1], grid.cells[0], n}
               : Shape{grid.cells[1], grid.cells[0]};
}
} // namespace

const std::vector<StressField> &stress_fields()
{
  static const std::vector<StressField> all = {
    {"mean_von_mises", &StressFields::mean_von_mises, {"mean_von_mises"}},
    {"mean_stress",
     &StressFields::mean_stress,
     {"mean_sigma_xx", "mean_sigma_yy", "mean_sigma_xy"}},
    {"deviation_stress",
     &StressFields::deviation_stress,
     {"deviation_sigma_xx", "deviation_sigma_yy", "deviation_sigma_xy"}}};
  return all;
}

LocalizationFile LocalizationFile::create(const std::string &path,
                                          const std::string &digest,
                                          const UniformGrid<2> &grid)
{
  LocalizationFile file(Hdf5File::create(path));
  file.grid = grid;
  file.write_header(localization_format, newest_localization_version, 2, digest);
  write_grid(file, grid);
  return file;
}

LocalizationFile LocalizationFile::open(const std::string &path)
{
  LocalizationFile file(Hdf5File::open(path, "run stress_localization first"));
  file.check_header(localization_format, newest_localization_version, 2,
                    localization_program);
  file.grid = read_grid(file, localization_program);
  return file;
}

void LocalizationFile::write_fields(const StressFields &fields, const std::string &group)
{
  for (const StressField &field : stress_fields())
    if (const auto &values = fields.*field.values; !values.empty())
      {
        const std::size_t n    = field.quantities.size();
        const std::string name = group + "/" + field.name;
        write_dataset(*this, name, shape_of_field(grid, n), values, "Pa");
        shown.push_back(
          {name.substr(1), name, XdmfField::Values::cells, n > 1 ? Shape{n} : Shape{}});
      }
}

void LocalizationFile::write_probe(const LocalizedProbe &probe, const std::string &in)
{
  const std::string group = probe_group(in, probe.name);
  for (const auto &[name, unit, values, components] : probe_datasets)
    if (!(probe.*values).empty() || values != &LocalizedProbe::direct_stress)
      write_series(*this, group, {{name, unit, &(probe.*values), components}});
  write_attribute(group, "position", probe.position);
  write_attribute(group, "cell", probe.cell);
  write_attribute(group, "phase", probe.phase);
  write_attribute(group, "phase_name", probe.phase_name);
}

void LocalizationFile::complete()
{
  close();
  if (!shown.empty())
    write_xdmf(path().substr(0, path().rfind('.')) + ".xdmf",
               std::filesystem::path(path()).filename(), grid, shown);
}

StressFields LocalizationFile::fields(const std::string &group) const
{
  StressFields fields;
  for (const StressField &field : stress_fields())
    if (const std::string name = group + "/" + field.name; exists(name))
      {
        fields.*field.values =
          read<double>(name, shape_of_field(grid, field.quantities.size()));
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
  probe.position   = read_attribute<std::array<double, 2>>(group, "position");
  probe.cell       = read_attribute<std::array<unsigned int, 2>>(group, "cell");
  probe.phase      = read_attribute<unsigned int>(group, "phase");
  probe.phase_name = read_attribute<std::string>(group, "phase_name");
  for (const auto &[dataset, unit, values, components] : probe_datasets)
    if (const std::string full = group + "/" + dataset;
        exists(full) || values != &LocalizedProbe::direct_stress)
      {
        probe.*values = read<double>(
          full, components == 0 ? Shape{any_extent} : Shape{any_extent, components});
        require_unit(full, unit);
      }
  return probe;
}
} // namespace mesoslip
