#include "homogenization/rve_program.h"

#include "exchange/rve_file.h"
#include "homogenization/conduction/conduction_output.h"
#include "homogenization/derivatives/derivative_output.h"
#include "homogenization/heat/heat_output.h"
#include "homogenization/loads/load_output.h"
#include "io/json.h"
#include "io/table.h"
#include "material/bounds.h"
#include "material/engineering_constants.h"
#include "material/stiffness.h"
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
template <int dim>
std::vector<std::string> stiffness_row(const std::string &name, const VoigtMatrix<dim> &D)
{
  std::vector<std::string> row = {name};
  for (const StiffnessEntry &entry : stiffness_entries<dim>())
    row.push_back(to_text(D(entry.row, entry.column)));
  return row;
}

using nlohmann::json;

template <int dim>
json matrix_json(const VoigtMatrix<dim> &D)
{
  json rows = json::array();
  for (unsigned int i = 0; i < n_voigt<dim>; ++i)
    rows.push_back(std::vector<double>(D.row(i).begin(), D.row(i).end()));
  return rows;
}

template <int dim>
json bounds_json(const RveContent<dim> &content)
{
  const auto [phases, fractions] = content.constituents();
  json bounds = {{"voigt", matrix_json<dim>(voigt_bound<dim>(phases, fractions))},
                 {"reuss", matrix_json<dim>(reuss_bound<dim>(phases, fractions))},
                 {"hashin_shtrikman_lower", nullptr},
                 {"hashin_shtrikman_upper", nullptr}};
  if (const auto hs = hashin_shtrikman_bounds<dim>(phases, fractions))
    {
      bounds["hashin_shtrikman_lower"] =
        matrix_json<dim>(isotropic_stiffness<dim>(hs->lower));
      bounds["hashin_shtrikman_upper"] =
        matrix_json<dim>(isotropic_stiffness<dim>(hs->upper));
    }
  return bounds;
}

template <int dim>
json ensemble_json(const RveParameters &parameters, const RveResults<dim> &results)
{
  json ensemble = {{"members", results.members.size()},
                   {"confidence", parameters.confidence}};
  for (std::size_t m = 0; m < results.members.size(); ++m)
    if (parameters.mesh.files.empty())
      ensemble["seeds"].push_back(parameters.microstructure.seed() + m);
    else
      ensemble["meshes"].push_back(parameters.mesh.files[m]);
  for (std::size_t c = 0; c < parameters.conditions.size(); ++c)
    {
      const StiffnessStatistics<dim> s =
        stiffness_statistics<dim>(results.members, c, parameters.confidence);
      ensemble[to_string(parameters.conditions[c])] = {
        {"mean", matrix_json<dim>(s.mean)},
        {"standard_deviation", matrix_json<dim>(s.standard_deviation)},
        {"confidence_half_width", matrix_json<dim>(s.half_width)}};
    }
  return ensemble;
}

/** A row of the console table: a name and entries, or the names of entries. In 3D either
 * the orthotropic entries or, with @p couplings, the entries that couple a shear to
 * another component. */
template <int dim, typename Entry>
std::string row_text(const std::string &name,
                     const int digits,
                     const bool couplings,
                     const Entry &entry)
{
  std::ostringstream line;
  line << std::left << std::setw(22) << name << std::right << std::fixed
       << std::setprecision(digits);
  for (const StiffnessEntry &place : stiffness_entries<dim>())
    if (dim == 2 || place.couples_shear(dim) == couplings)
      {
        line << std::setw(9);
        entry(line, place);
      }
  return line.str();
}

template <int dim>
std::string stiffness_text(const std::string &name, const bool couplings, const json &D)
{
  return row_text<dim>(
    name, 3, couplings, [&](std::ostream &line, const StiffnessEntry &place) {
      // Rounded to MPa; adding 0 removes the sign of -0.
      line << std::round(D[place.row][place.column].get<double>() * 1e-6) * 1e-3 + 0.;
    });
}

template <int dim>
std::string difference_text(const bool couplings, const json &D, const json &reference)
{
  return row_text<dim>(
    "difference (%)", 2, couplings, [&](std::ostream &line, const StiffnessEntry &place) {
      const double ref = reference[place.row][place.column].get<double>();
      if (ref != 0.)
        line << 100. * (D[place.row][place.column].get<double>() / ref - 1.);
      else
        line << "-";
    });
}

// Logs the residuals of the identities that every solve has to fulfil.
template <int dim>
void log_identities(const EnsembleMember<dim> &member, RunContext &context)
{
  for (const HomogenizedResponse<dim> &r : member.responses)
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

template <int dim>
void write_rve_tables(const RveParameters &parameters,
                      const RveResults<dim> &results,
                      const RunContext &context)
{
  const EnsembleMember<dim> &first = results.members[0];
  std::vector<std::string> entries = {"of"};
  for (const StiffnessEntry &entry : stiffness_entries<dim>())
    entries.push_back(entry.name + " [Pa]");
  TableWriter stiffness(context.file("stiffness.csv"), entries);
  for (const HomogenizedResponse<dim> &response : first.responses)
    {
      const std::string name = to_string(response.condition);
      stiffness.add_row(stiffness_row<dim>(name, response.stiffness));
      stiffness.add_row(
        stiffness_row<dim>(name + " from mean", response.stiffness_from_mean));
    }
  stiffness.add_row(stiffness_row<dim>("effective", results.effective));
  if (!parameters.reference.empty())
    stiffness.add_row(stiffness_row<dim>(
      "reference", stiffness_from_coefficients<dim>(parameters.reference)));
  stiffness.flush();

  TableWriter constants(context.file("engineering_constants.csv"),
                        {"name", "value", "unit", "meaning"});
  for (const EngineeringConstant &c : engineering_constants<dim>(results.effective))
    constants.add_row({c.name, to_text(c.value), c.unit, c.meaning});
  constants.flush();

  std::vector<std::string> headings = {"condition", "phase", "fraction [-]", "tensor"};
  for (const char *row : voigt_names<dim>)
    for (const char *column : voigt_names<dim>)
      headings.push_back(std::string("mean_") + row + "_" + column + " [-]");
  TableWriter means(context.file("phase_means.csv"), headings);
  for (const HomogenizedResponse<dim> &response : first.responses)
    for (std::size_t p = 0; p < response.phase_means.size(); ++p)
      {
        std::vector<std::string> row = {
          to_string(response.condition), results.first.phases[p].name,
          to_text(first.fractions[p]),
          response.condition == BoundaryCondition::SUBC ? "B (stress)" : "L (strain)"};
        const VoigtMatrix<dim> &tensor = response.phase_means[p];
        for (Eigen::Index e = 0; e < tensor.size(); ++e)
          row.push_back(to_text(tensor.data()[e]));
        means.add_row(row);
      }
  means.flush();

  TableWriter ensemble(context.file("ensemble.csv"),
                       {"condition", "entry", "mean [Pa]", "standard_deviation [Pa]",
                        "confidence_half_width [Pa]", "relative_error [-]",
                        "reference [Pa]", "difference [%]"});
  for (std::size_t c = 0; c < parameters.conditions.size(); ++c)
    {
      const StiffnessStatistics<dim> s =
        stiffness_statistics<dim>(results.members, c, parameters.confidence);
      for (const auto &[i, j, name] : stiffness_entries<dim>())
        {
          const double ref =
            parameters.reference.empty()
              ? 0.
              : stiffness_from_coefficients<dim>(parameters.reference)(i, j);
          ensemble.add_row({to_string(parameters.conditions[c]), name,
                            to_text(s.mean(i, j)), to_text(s.standard_deviation(i, j)),
                            to_text(s.half_width(i, j)), to_text(s.relative_error(i, j)),
                            parameters.reference.empty() ? "" : to_text(ref),
                            ref != 0. ? to_text(100. * (s.mean(i, j) / ref - 1.)) : ""});
        }
    }
  ensemble.flush();
  if (!results.rectangles.empty())
    write_rectangles(context.file("rectangles.csv"), results.rectangles);
}

/** Logs in 3D the entries that couple a shear to another component (@p couplings), or all
 * remaining entries. */
template <int dim>
void log_entries(RunContext &context, const bool couplings)
{
  const json &summary = context.summary();
  const auto log      = [&](const std::string &name, const json &D) {
    context.log(stiffness_text<dim>(name, couplings, D));
  };
  context.log(row_text<dim>(
    couplings ? "Couplings (GPa)" : "Stiffness (GPa)", 3, couplings,
    [](std::ostream &line, const StiffnessEntry &place) { line << place.name; }));
  const bool several = summary.contains("ensemble");
  for (const std::string name : {"KUBC", "SUBC", "PBC", "MUBC"})
    if (several && summary["ensemble"].contains(name))
      {
        log(name + " mean", summary["ensemble"][name]["mean"]);
        log(name + " deviation", summary["ensemble"][name]["standard_deviation"]);
      }
    else if (!several && !summary["stiffness"].value(name, json()).is_null())
      {
        log(name, summary["stiffness"][name]);
        log(name + " from mean", summary["stiffness_from_mean"][name]);
      }
  const json &effective = summary["stiffness"]["effective"];
  log("effective", effective);
  if (!summary.contains("reference_stiffness"))
    return;
  log("reference", summary["reference_stiffness"]);
  context.log(difference_text<dim>(couplings, effective, summary["reference_stiffness"]));
}

template <int dim>
void log_stiffness(RunContext &context)
{
  log_entries<dim>(context, false);
  const json &D = context.summary()["stiffness"]["effective"];
  for (const StiffnessEntry &place : stiffness_entries<dim>())
    if (dim == 3 && place.couples_shear(dim) && D[place.row][place.column] != 0.)
      return log_entries<dim>(context, true);
}

template <int dim>
void write_rve_summary(const RveParameters &parameters,
                       const RveResults<dim> &results,
                       RunContext &context)
{
  const EnsembleMember<dim> &first = results.members[0];
  json &out                        = context.summary();

  out["dim"]   = dim;
  out["cells"] = results.first.n_cells();
  out["dofs"]  = dim * results.n_nodes;
  for (std::size_t p = 0; p < results.first.phases.size(); ++p)
    out["phases"].push_back(
      {{"name", results.first.phases[p].name}, {"volume_fraction", first.fractions[p]}});
  out["stiffness"] = {
    {"KUBC", nullptr}, {"SUBC", nullptr}, {"PBC", nullptr}, {"MUBC", nullptr}};
  for (const HomogenizedResponse<dim> &response : first.responses)
    {
      const std::string name            = to_string(response.condition);
      out["stiffness"][name]            = matrix_json<dim>(response.stiffness);
      out["stiffness_from_mean"][name]  = matrix_json<dim>(response.stiffness_from_mean);
      out["hill_mandel_residual"][name] = response.hill_mandel_residual;
      out["symmetry_residual"][name]    = response.symmetry_residual;
      out["mean_concentration_residual"][name] = response.mean_residual;
      out["two_phase_residual"][name]          = response.two_phase_residual;
      for (const SolverReport &report : response.reports)
        out["iterations"][name].push_back(report.iterations);
    }
  out["stiffness"]["effective"] = matrix_json<dim>(results.effective);
  out["bounds"]                 = bounds_json<dim>(results.first);
  for (const EngineeringConstant &c : engineering_constants<dim>(results.effective))
    out["engineering_constants"][c.name] = c.value;
  if (results.members.size() > 1)
    out["ensemble"] = ensemble_json<dim>(parameters, results);
  if (!parameters.reference.empty())
    out["reference_stiffness"] =
      matrix_json<dim>(stiffness_from_coefficients<dim>(parameters.reference));
  summarize_expansion<dim>(results, out);
  summarize_conductivity<dim>(parameters, results, out);
  summarize_derivatives<dim>(parameters, results, out);
  if (!parameters.loads.loads.empty())
    out["loads"] = loads_json<dim>(parameters, results);
  log_stiffness<dim>(context);
  log_identities(first, context);
  log_expansion(context);
  log_conductivity(context);
  log_derivatives(context);
  log_loads<dim>(context);
}

template void
write_rve_tables<2>(const RveParameters &, const RveResults<2> &, const RunContext &);
template void log_stiffness<2>(RunContext &);
template void
write_rve_summary<2>(const RveParameters &, const RveResults<2> &, RunContext &);
template void
write_rve_tables<3>(const RveParameters &, const RveResults<3> &, const RunContext &);
template void log_stiffness<3>(RunContext &);
template void
write_rve_summary<3>(const RveParameters &, const RveResults<3> &, RunContext &);
} // namespace mesoslip
