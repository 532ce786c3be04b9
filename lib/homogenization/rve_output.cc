#include "homogenization/rve_program.h"

#include "exchange/rve_file.h"
#include "io/json.h"
#include "io/table.h"
#include "material/bounds.h"
#include "material/engineering_constants.h"
#include "morphology/rectangles.h"
#include "parameters/parameters.h"
#include "program/run_context.h"

#include <cmath>
#include <iomanip>
#include <sstream>

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

using nlohmann::json;

json matrix_json(const VoigtMatrix<2> &D)
{
  json rows = json::array();
  for (unsigned int i = 0; i < 3; ++i)
    rows.push_back({D(i, 0), D(i, 1), D(i, 2)});
  return rows;
}

json bounds_json(const Microstructure &microstructure,
                 const std::vector<double> &fractions)
{
  json bounds = {{"voigt", matrix_json(voigt_bound<2>(microstructure.phases, fractions))},
                 {"reuss", matrix_json(reuss_bound<2>(microstructure.phases, fractions))},
                 {"hashin_shtrikman_lower", nullptr},
                 {"hashin_shtrikman_upper", nullptr}};
  if (const auto hs = hashin_shtrikman_bounds(microstructure.phases, fractions))
    {
      bounds["hashin_shtrikman_lower"] =
        matrix_json(plane_isotropic_stiffness(hs->lower));
      bounds["hashin_shtrikman_upper"] =
        matrix_json(plane_isotropic_stiffness(hs->upper));
    }
  return bounds;
}

json ensemble_json(const RveParameters &parameters, const RveResults &results)
{
  json ensemble = {{"members", results.members.size()},
                   {"confidence", parameters.confidence}};
  for (const EnsembleMember &member : results.members)
    ensemble["seeds"].push_back(member.seed);
  for (std::size_t c = 0; c < parameters.conditions.size(); ++c)
    {
      const StiffnessStatistics s =
        stiffness_statistics(results.members, c, parameters.confidence);
      ensemble[to_string(parameters.conditions[c])] = {
        {"mean", matrix_json(s.mean)},
        {"standard_deviation", matrix_json(s.standard_deviation)},
        {"confidence_half_width", matrix_json(s.half_width)}};
    }
  return ensemble;
}

/** A line of the table on the console: a name and six entries, or their names. */
template <typename Entry>
std::string row_text(const std::string &name, const int digits, const Entry &entry)
{
  std::ostringstream line;
  line << std::left << std::setw(22) << name << std::right << std::fixed
       << std::setprecision(digits);
  for (const StiffnessEntry &place : stiffness_entries)
    {
      line << std::setw(9);
      entry(line, place);
    }
  return line.str();
}

std::string stiffness_text(const std::string &name, const json &D)
{
  return row_text(name, 3, [&](std::ostream &line, const StiffnessEntry &place) {
    // Whole MPa; what rounds to zero loses its sign.
    line << std::round(D[place.row][place.column].get<double>() * 1e-6) * 1e-3 + 0.;
  });
}

std::string difference_text(const json &effective, const json &reference)
{
  return row_text(
    "difference (%)", 2, [&](std::ostream &line, const StiffnessEntry &place) {
      const double ref = reference[place.row][place.column].get<double>();
      if (ref != 0.)
        line << 100. * (effective[place.row][place.column].get<double>() / ref - 1.);
      else
        line << "-";
    });
}

// What every solve has to fulfil, and how well it does.
void log_identities(const EnsembleMember &member, RunContext &context)
{
  for (const HomogenizedResponse &r : member.responses)
    {
      const bool stresses = r.condition == BoundaryCondition::SUBC;
      std::ostringstream line;
      line << to_string(r.condition) << ": iterations";
      for (const SolverReport &report : r.reports)
        {
          line << " " << report.iterations;
          if (report.single_iterations)
            line << " (in double precision from " << *report.single_iterations << " on)";
        }
      line << std::scientific << std::setprecision(1) << "; residuals: Hill-Mandel "
           << r.hill_mandel_residual << ", symmetry " << r.symmetry_residual
           << (stresses ? ", <B> = I " : ", <L> = I ") << r.mean_residual;
      if (r.two_phase_residual)
        line << ", two phases " << *r.two_phase_residual;
      context.log(line.str());
    }
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
  auto stored = json::parse(RveFile(context.file("rve.h5")).summary(), nullptr, false);
  if (!stored.is_object() || !stored.contains("stiffness"))
    return false;
  for (const auto &warning : stored.value("warnings", json::array()))
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

void log_stiffness(RunContext &context)
{
  const json &summary = context.summary();
  context.log(
    row_text("Stiffness (GPa)", 3, [](std::ostream &line, const StiffnessEntry &place) {
      line << place.name;
    }));
  const bool several = summary.contains("ensemble");
  for (const char *name : {"KUBC", "SUBC", "PBC"})
    if (several && summary["ensemble"].contains(name))
      {
        const json &entry = summary["ensemble"][name];
        context.log(stiffness_text(std::string(name) + " mean", entry["mean"]));
        context.log(
          stiffness_text(std::string(name) + " deviation", entry["standard_deviation"]));
      }
    else if (!several && !summary["stiffness"][name].is_null())
      {
        context.log(stiffness_text(name, summary["stiffness"][name]));
        context.log(stiffness_text(std::string(name) + " from mean",
                                   summary["stiffness_from_mean"][name]));
      }
  const json &effective = summary["stiffness"]["effective"];
  context.log(stiffness_text("effective", effective));
  if (!summary.contains("reference_stiffness"))
    return;
  context.log(stiffness_text("reference", summary["reference_stiffness"]));
  context.log(difference_text(effective, summary["reference_stiffness"]));
}

void write_rve_summary(const RveParameters &parameters,
                       const RveResults &results,
                       RunContext &context)
{
  const EnsembleMember &first = results.members[0];
  const UniformGrid<2> &grid  = results.microstructure.map.grid;
  json &out                   = context.summary();

  out["dim"]   = 2;
  out["cells"] = grid.n_cells();
  out["dofs"]  = 2 * grid.n_nodes();
  for (std::size_t p = 0; p < results.microstructure.phases.size(); ++p)
    out["phases"].push_back({{"name", results.microstructure.phases[p].name},
                             {"volume_fraction", first.fractions[p]}});
  out["stiffness"] = {{"KUBC", nullptr}, {"SUBC", nullptr}, {"PBC", nullptr}};
  for (const HomogenizedResponse &response : first.responses)
    {
      const std::string name            = to_string(response.condition);
      out["stiffness"][name]            = matrix_json(response.stiffness);
      out["stiffness_from_mean"][name]  = matrix_json(response.stiffness_from_mean);
      out["hill_mandel_residual"][name] = response.hill_mandel_residual;
      out["symmetry_residual"][name]    = response.symmetry_residual;
      out["mean_concentration_residual"][name] = response.mean_residual;
      out["two_phase_residual"][name]          = response.two_phase_residual;
      for (const SolverReport &report : response.reports)
        out["iterations"][name].push_back(report.iterations);
    }
  out["stiffness"]["effective"] = matrix_json(results.effective);
  out["bounds"]                 = bounds_json(results.microstructure, first.fractions);
  for (const EngineeringConstant &c : engineering_constants<2>(results.effective))
    out["engineering_constants"][c.name] = c.value;
  if (results.members.size() > 1)
    out["ensemble"] = ensemble_json(parameters, results);
  if (parameters.reference)
    out["reference_stiffness"] = matrix_json(*parameters.reference);
  log_stiffness(context);
  log_identities(first, context);
}
} // namespace mesoslip
