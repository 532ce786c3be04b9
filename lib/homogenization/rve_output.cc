#include "homogenization/rve_output.h"

#include "exchange/rve_file.h"
#include "io/table.h"
#include "io/xdmf.h"
#include "material/engineering_constants.h"
#include "morphology/rectangles.h"
#include "parameters/parameters.h"
#include "program/run_context.h"

#include <nlohmann/json.hpp>

namespace mesoslip
{
namespace
{
const char *const voigt_name[3] = {"xx", "yy", "xy"};

void write_phases(Hdf5File &file, const Microstructure &microstructure)
{
  std::vector<double> stiffness, density, friction;
  std::vector<std::string> names;
  for (const Phase<2> &phase : microstructure.phases)
    {
      stiffness.insert(stiffness.end(), phase.stiffness.data(),
                       phase.stiffness.data() + 9);
      density.push_back(phase.density);
      friction.push_back(phase.friction_coefficient);
      names.push_back(phase.name);
    }
  const UniformGrid<2> &grid = microstructure.map.grid;
  const std::size_t n        = names.size();
  file.write("/phase/id", {grid.cells[1], grid.cells[0]}, microstructure.map.id);
  file.write("/phase/stiffness", {n, 3, 3}, stiffness);
  file.write("/phase/density", {n}, density);
  file.write("/phase/friction_coefficient", {n}, friction);
  file.write("/phase/name", {n}, names);
  file.write_unit("/phase/id", "-");
  file.write_unit("/phase/stiffness", "Pa");
  file.write_unit("/phase/density", "kg/m^3");
  file.write_unit("/phase/friction_coefficient", "-");
  file.write_unit("/phase/name", "-");
}

std::string concentration_name(const BoundaryCondition condition)
{
  return (condition == BoundaryCondition::SUBC ? "/stress_concentration/"
                                               : "/concentration/") +
         to_string(condition);
}

std::vector<std::string> stiffness_row(const std::string &name, const VoigtMatrix<2> &D)
{
  std::vector<std::string> row = {name};
  for (const auto &[i, j, entry] : stiffness_entries)
    row.push_back(to_text(D(i, j)));
  return row;
}
} // namespace

void write_rve_file(const RveParameters &parameters,
                    const RveResults &results,
                    const std::string &digest,
                    RunContext &context)
{
  const UniformGrid<2> &grid = results.microstructure.map.grid;
  Hdf5File file              = Hdf5File::create(context.file("rve.h5"));
  file.write_header("mesoslip-rve", rve_format_version, 2, digest);
  file.write<std::string>("/summary", {1}, {context.summary().dump()});
  file.write_unit("/summary", "-");
  write_grid(file, grid);
  write_phases(file, results.microstructure);
  const auto write_stiffness = [&](const std::string &name, const VoigtMatrix<2> &D) {
    file.write("/stiffness/" + name, {3, 3}, D.data());
    file.write_unit("/stiffness/" + name, "Pa");
  };
  write_stiffness("effective", results.effective);

  XdmfGrid xdmf_grid;
  xdmf_grid.cells   = {{grid.cells[0], grid.cells[1], 1}};
  xdmf_grid.spacing = {{grid.spacing[0], grid.spacing[1], 1.}};
  XdmfField phase;
  phase.name                    = "phase";
  phase.file                    = "rve.h5";
  phase.dataset                 = "/phase/id";
  phase.centre                  = XdmfField::Centre::cell;
  phase.number                  = XdmfField::Number::uint8;
  std::vector<XdmfField> fields = {phase};

  for (const HomogenizedResponse &response : results.members[0].responses)
    {
      write_stiffness(to_string(response.condition), response.stiffness);
      if (!parameters.write_concentration)
        continue;
      const std::string name = concentration_name(response.condition);
      file.write(name, {grid.cells[1], grid.cells[0], 3, 3}, response.concentration);
      file.write_unit(name, "-");
      XdmfField field;
      field.name       = name.substr(1);
      field.file       = "rve.h5";
      field.dataset    = name;
      field.centre     = XdmfField::Centre::cell;
      field.components = 9;
      field.columns    = 3;
      for (const char *row : voigt_name)
        for (const char *column : voigt_name)
          field.component_names.push_back(std::string(row) + "_" + column);
      fields.push_back(field);
    }
  file.close();
  write_xdmf(context.file("rve.xdmf"), xdmf_grid, fields);
}

bool restore_rve_summary(RunContext &context)
{
  const Hdf5File file = Hdf5File::open(context.file("rve.h5"));
  const auto texts    = file.exists("/summary") ? file.read<std::string>("/summary")
                                                : std::vector<std::string>();
  if (texts.size() != 1)
    return false;
  auto stored = nlohmann::json::parse(texts[0], nullptr, false);
  if (!stored.is_object() || !stored.contains("stiffness"))
    return false;
  for (const auto &warning : stored.value("warnings", nlohmann::json::array()))
    if (warning.is_string())
      context.warn(warning.get<std::string>());
  stored.erase("warnings");
  context.summary().update(stored);
  return true;
}

void write_rve_tables(const RveParameters &parameters,
                      const RveResults &results,
                      const RunContext &context)
{
  const EnsembleMember &first      = results.members[0];
  std::vector<std::string> entries = {"of"};
  for (const StiffnessEntry &entry : stiffness_entries)
    entries.push_back(std::string(entry.name) + " [Pa]");
  TableWriter stiffness(context.file("stiffness.csv"), entries);
  for (const HomogenizedResponse &response : first.responses)
    {
      const std::string name = to_string(response.condition);
      stiffness.add_row(stiffness_row(name, response.stiffness));
      stiffness.add_row(stiffness_row(name + " from mean", response.stiffness_from_mean));
    }
  stiffness.add_row(stiffness_row("effective", results.effective));
  if (parameters.reference)
    stiffness.add_row(stiffness_row("reference", *parameters.reference));
  stiffness.flush();

  TableWriter constants(context.file("engineering_constants.csv"),
                        {"name", "value", "unit", "meaning"});
  for (const EngineeringConstant &c : engineering_constants<2>(results.effective))
    constants.add_row({c.name, to_text(c.value), c.unit, c.meaning});
  constants.flush();

  std::vector<std::string> headings = {"condition", "phase", "fraction [-]", "tensor"};
  for (const char *row : voigt_name)
    for (const char *column : voigt_name)
      headings.push_back(std::string("mean_") + row + "_" + column + " [-]");
  TableWriter means(context.file("phase_means.csv"), headings);
  for (const HomogenizedResponse &response : first.responses)
    for (std::size_t p = 0; p < response.phase_means.size(); ++p)
      {
        std::vector<std::string> row = {
          to_string(response.condition), results.microstructure.phases[p].name,
          to_text(first.fractions[p]),
          response.condition == BoundaryCondition::SUBC ? "B (stress)" : "L (strain)"};
        for (unsigned int e = 0; e < 9; ++e)
          row.push_back(to_text(response.phase_means[p](e / 3, e % 3)));
        means.add_row(row);
      }
  means.flush();

  TableWriter ensemble(context.file("ensemble.csv"),
                       {"condition", "entry", "mean [Pa]", "standard_deviation [Pa]",
                        "confidence_half_width [Pa]", "relative_error [-]",
                        "reference [Pa]", "difference [%]"});
  for (std::size_t c = 0; c < parameters.conditions.size(); ++c)
    {
      const StiffnessStatistics s =
        stiffness_statistics(results.members, c, parameters.confidence);
      for (const auto &[i, j, name] : stiffness_entries)
        {
          const double ref = parameters.reference ? (*parameters.reference)(i, j) : 0.;
          ensemble.add_row({to_string(parameters.conditions[c]), name,
                            to_text(s.mean(i, j)), to_text(s.standard_deviation(i, j)),
                            to_text(s.half_width(i, j)), to_text(s.relative_error(i, j)),
                            parameters.reference ? to_text(ref) : "",
                            ref != 0. ? to_text(100. * (s.mean(i, j) / ref - 1.)) : ""});
        }
    }
  ensemble.flush();
  if (!results.microstructure.rectangles.empty())
    write_rectangles(context.file("rectangles.csv"), results.microstructure.rectangles);
}
} // namespace mesoslip
