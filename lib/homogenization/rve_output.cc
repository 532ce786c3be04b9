#include "homogenization/rve_output.h"

#include "exchange/rve_file.h"
#include "io/table.h"
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
  RveContent content;
  content.digest                 = digest;
  content.summary                = context.summary().dump();
  content.grid                   = results.microstructure.map.grid;
  content.phases                 = results.microstructure.phases;
  content.phase_id               = results.microstructure.map.id;
  content.stiffness["effective"] = results.effective;
  for (const HomogenizedResponse &response : results.members[0].responses)
    {
      const std::string name  = to_string(response.condition);
      content.stiffness[name] = response.stiffness;
      if (parameters.write_concentration)
        content.concentration[name] = &response.concentration;
    }
  RveFile::write(context.file("rve.h5"), content);
}

bool restore_rve_summary(RunContext &context)
{
  auto stored =
    nlohmann::json::parse(RveFile(context.file("rve.h5")).summary(), nullptr, false);
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
