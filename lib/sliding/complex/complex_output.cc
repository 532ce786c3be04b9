#include "sliding/complex/complex_output.h"

#include "eigenvalues/free_dofs.h"
#include "exchange/datasets.h"
#include "io/table.h"
#include "material/plausibility.h"
#include "sliding/complex/mode_branches.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <nlohmann/json.hpp>

namespace mesoslip
{
namespace
{
nlohmann::json finite_or_null(const double value)
{
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

/** Number of missing modes; null if the count of growing modes is incomplete. */
nlohmann::json missing(const ComplexCase &of_case, const bool counted)
{
  return counted && of_case.all_counted && of_case.n_missing >= 0
           ? nlohmann::json(of_case.n_missing)
           : nlohmann::json();
}

nlohmann::json modes_json(const ComplexCase &of_case, const ContactParts &parts)
{
  nlohmann::json modes = nlohmann::json::array();
  for (const ModeNumbers &mode : of_case.modes)
    {
      modes.push_back({{"frequency", mode.frequency},
                       {"growth_rate", mode.growth_rate},
                       {"growth_by_friction", mode.growth_by_friction},
                       {"growth_by_damping", mode.growth_by_damping},
                       {"residual", mode.residual}});
      for (std::size_t p = 0; p < mode.parts.size(); ++p)
        modes.back()["phases"][parts.names[p]] = {
          {"growth_by_friction", mode.parts[p].growth_by_friction},
          {"motion", mode.parts[p].motion}};
    }
  return modes;
}

void write_modes_table(const ComplexCase &base,
                       const ContactParts &parts,
                       const std::string &path)
{
  std::vector<std::string> columns = {"mode [-]",
                                      "frequency [Hz]",
                                      "growth_rate [1/s]",
                                      "growth_by_friction [1/s]",
                                      "growth_by_damping [1/s]",
                                      "residual [-]"};
  for (std::size_t p = 0; parts.differ() && p < parts.names.size(); ++p)
    {
      columns.push_back("growth_by_friction_" + parts.names[p] + " [1/s]");
      columns.push_back("motion_" + parts.names[p] + " [-]");
    }
  TableWriter table(path, columns);
  double number = 0.;
  for (const ModeNumbers &mode : base.modes)
    {
      std::vector<double> row = {++number,
                                 mode.frequency,
                                 mode.growth_rate,
                                 mode.growth_by_friction,
                                 mode.growth_by_damping,
                                 mode.residual};
      for (const PartOfMode &part : mode.parts)
        row.insert(row.end(), {part.growth_by_friction, part.motion});
      table.add_row(row);
    }
  table.flush();
}

void write_sweep_table(const std::vector<ComplexCase> &sweep,
                       const bool counted,
                       const std::string &swept,
                       const std::string &path)
{
  TableWriter table(path, {swept, "curve [-]", "frequency [Hz]", "growth_rate [1/s]",
                           "residual [-]", "sliding_nodes [-]", "separated_nodes [-]",
                           "missing_modes [-]"});
  const auto branches = mode_branches(sweep);
  for (std::size_t k = 0; k < sweep.size(); ++k)
    for (std::size_t m = 0; m < sweep[k].modes.size(); ++m)
      {
        const ModeNumbers &mode = sweep[k].modes[m];
        const bool unknown      = missing(sweep[k], counted).is_null();
        table.add_row(std::vector<double>{
          sweep[k].value, static_cast<double>(branches[k][m]), mode.frequency,
          mode.growth_rate, mode.residual, static_cast<double>(sweep[k].n_sliding),
          static_cast<double>(sweep[k].n_separated),
          unknown ? std::numeric_limits<double>::quiet_NaN()
                  : static_cast<double>(sweep[k].n_missing)});
      }
  table.flush();
}

/** Real and imaginary part of a shape: the largest displacement vector has length one,
 * and the phase maximizes the real part. */
template <int dim>
std::array<NodalField<double>, 2>
parts_of(const ComplexMode &mode, const FreeDofs<dim> &dofs, const ElasticBody<dim> &body)
{
  const std::complex<double> square = mode.shape.cwiseProduct(mode.shape).sum();
  const ComplexVector turned =
    mode.shape * std::exp(std::complex<double>(0., -0.5 * std::arg(square)));
  std::array<NodalField<double>, 2> parts = {{body.zero_field(), body.zero_field()}};
  typename FreeDofs<dim>::Vector values   = dofs.zero();
  for (unsigned int part = 0; part < 2; ++part)
    {
      for (std::size_t k = 0; k < dofs.size(); ++k)
        {
          const std::complex<double> x = turned[static_cast<Eigen::Index>(k)];
          values[k]                    = part == 0 ? x.real() : x.imag();
        }
      dofs.scatter(parts[part], values);
    }
  double largest = 0.;
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      {
        double length = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          for (const NodalField<double> &part : parts)
            length += part.row(c, j)[i] * part.row(c, j)[i];
        largest = std::max(largest, length);
      }
  for (NodalField<double> &part : parts)
    for (std::size_t k = 0; k < part.size(); ++k)
      part.begin()[k] /= std::sqrt(largest);
  return parts;
}
} // namespace

std::string swept_column(const ContactParameters &parameters)
{
  const ModeSweep sweep = parameters.complex_modes.sweep;
  if (sweep == ModeSweep::coefficient)
    return parameters.friction.coefficient_by_phase ? "friction_coefficient_factor [-]"
                                                    : "friction_coefficient [-]";
  return sweep == ModeSweep::regularization_time ? "regularization_time [s]"
         : sweep == ModeSweep::velocity          ? "velocity [m/s]"
         : sweep == ModeSweep::normal_stiffness  ? "normal_stiffness [Pa/m]"
                                                 : "pressure [Pa]";
}

std::vector<std::string> complex_modes_files()
{
  return {"complex_modes.csv",  "complex_modes_sweep.csv",   "complex_modes.h5",
          "complex_modes.xdmf", "complex_modes-phases.xdmf", "counter_body.h5",
          "counter_body.xdmf",  "counter_body-phases.xdmf"};
}

template <int dim>
void write_complex_tables(const ComplexCases<dim> &cases,
                          const ContactParameters &parameters,
                          RunContext &context)
{
  const ComplexModesParameters &keys = parameters.complex_modes;
  write_modes_table(cases.base, cases.parts, context.file("complex_modes.csv"));
  nlohmann::json &json  = context.summary();
  json["complex_modes"] = modes_json(cases.base, cases.parts);
  json["missing_modes"] = missing(cases.base, keys.count);
  json["growing_modes"] =
    std::count_if(cases.base.modes.begin(), cases.base.modes.end(),
                  [](const ModeNumbers &mode) { return mode.growth_rate > 0.; });
  if (!cases.base.modes.empty())
    {
      json["largest_growth_rate"]         = cases.base.modes.front().growth_rate;
      json["frequency_of_largest_growth"] = cases.base.modes.front().frequency;
    }
  json["lowest_frequency"]  = keys.lowest_frequency;
  json["highest_frequency"] = cases.highest_frequency;
  json["least_growth_rate"] = keys.least_growth;
  json["largest_growth_rate_counted"] =
    keys.count ? nlohmann::json(cases.base.fastest_counted) : nlohmann::json();
  json["nothing_grows_above"] = finite_or_null(cases.base.nothing_grows_above);
  json["regularization_time"] = cases.base.delta;
  json["flat_velocity"]       = parameters.contact.flat_velocity.amplitude();
  json["rayleigh_beta"]       = parameters.step.beta;
  json["rayleigh_alpha"]      = parameters.step.alpha;
  if (!parameters.step.beta_of_phases.empty())
    json["rayleigh_beta_of_phases"] = parameters.step.beta_of_phases;
  if (!parameters.step.alpha_of_phases.empty())
    json["rayleigh_alpha_of_phases"] = parameters.step.alpha_of_phases;
  json["normal_stiffness"] = finite_or_null(parameters.contact.normal_spring.stiffness);
  json["tangential_stiffness"] = finite_or_null(parameters.contact.tangential_stiffness);
  json["sliding_nodes"]        = cases.base.n_sliding;
  json["separated_nodes"]      = cases.base.n_separated;
  json["steepest_friction_fall"] = parameters.contact.law.coefficient_law
                                     ? nlohmann::json(cases.base.steepest_fall)
                                     : nlohmann::json();
  json["shear_impedance"]        = cases.shear_impedance;
  if (cases.parts.differ())
    {
      const std::vector<double> shares = cases.parts.of_contact(cases.state);
      for (std::size_t p = 0; p < shares.size(); ++p)
        json["contact_phases"][cases.parts.names[p]] = shares[p];
    }
  json["shifts"]           = cases.modes.n_shifts;
  json["factorizations"]   = cases.modes.n_factorizations;
  json["solves"]           = cases.modes.n_solves;
  json["bytes_of_factors"] = cases.modes.factor_bytes;
  if (keys.sweep == ModeSweep::none)
    return;
  write_sweep_table(cases.sweep, keys.count, swept_column(parameters),
                    context.file("complex_modes_sweep.csv"));
  for (const ComplexCase &of_case : cases.sweep)
    json["sweep"].push_back({{"value", of_case.value},
                             {"separated_nodes", of_case.n_separated},
                             {"missing_modes", missing(of_case, keys.count)},
                             {"complex_modes", modes_json(of_case, cases.parts)}});
}

template <int dim>
ComplexShapes write_complex_modes(Hdf5File &file,
                                  const ComplexCases<dim> &cases,
                                  const ElasticBody<dim> &body,
                                  const ContactParameters &parameters)
{
  const std::string group = "/complex_modes";
  std::vector<double> frequency, growth, shares;
  std::array<std::vector<double>, dim> place;
  for (const NodeIndex &node : cases.state.contact.nodes)
    for (unsigned int c = 0; c < dim; ++c)
      place[c].push_back(body.point(node)[c]);
  const FreeDofs<dim> &dofs = cases.dofs.front();
  const std::size_t n_nodes = place[0].size(),
                    n       = std::min<std::size_t>(cases.modes.modes.size(),
                                              parameters.complex_modes.n_shapes);
  ComplexShapes shapes;
  for (std::size_t k = 0; k < n; ++k)
    {
      const ComplexMode &mode = cases.modes.modes[k];
      shapes.numbers.push_back(static_cast<double>(k) + 1.);
      frequency.push_back(mode.frequency());
      growth.push_back(mode.s.real());
      for (std::size_t i = 0; i < n_nodes; ++i)
        shares.push_back(i < static_cast<std::size_t>(mode.growth_by_friction.size())
                           ? mode.growth_by_friction[static_cast<Eigen::Index>(i)]
                           : 0.);
      const auto parts = parts_of(mode, dofs, body);
      for (unsigned int part = 0; part < 2; ++part)
        shapes.parts[part].push_back(parts[part]);
    }
  std::vector<Series> series = {{"frequency", "Hz", &frequency},
                                {"growth_rate", "1/s", &growth}};
  write_series(file, group, series);
  std::vector<Series> contact = {
    {"friction_coefficient", "-", &cases.state.contact.friction}};
  for (unsigned int c = 0; c < dim; ++c)
    contact.push_back({std::string(1, "xyz"[c]), "m", &place[c]});
  std::vector<double> at_once, by_state;
  for (const FrictionSlopes &slopes : cases.state.contact.slopes)
    {
      at_once.push_back(slopes.rate);
      by_state.push_back(slopes.state);
    }
  if (!at_once.empty())
    {
      contact.push_back({"coefficient_slope", "s/m", &at_once});
      contact.push_back({"coefficient_slope_by_state", "s/m", &by_state});
    }
  write_series(file, group + "/contact", contact);
  if (n > 0)
    write_dataset(file, group + "/contact/growth_by_friction", {n, n_nodes}, shares,
                  "1/s");
  return shapes;
}

#define MESOSLIP_INSTANTIATE(dim)                                                   \
  template void write_complex_tables(const ComplexCases<dim> &,                     \
                                     const ContactParameters &, RunContext &);      \
  template ComplexShapes write_complex_modes(Hdf5File &, const ComplexCases<dim> &, \
                                             const ElasticBody<dim> &,              \
                                             const ContactParameters &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
