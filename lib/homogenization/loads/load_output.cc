#include "homogenization/loads/load_output.h"

#include "base/text.h"
#include "exchange/loads_file.h"
#include "homogenization/loads/load_members.h"
#include "homogenization/over_members.h"
#include "io/table.h"
#include "material/plausibility.h"
#include "parameters/parameters.h"
#include "program/run_context.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace mesoslip
{
namespace
{
/** Index of the first stress quantity; strains come before. */
template <int dim>
constexpr std::size_t n_strains = n_voigt<dim>;

/** Fields of loads.h5 for every load and condition. */
template <int dim>
std::vector<LoadField> load_fields(const RveParameters &parameters)
{
  const LocalFields<dim> fields = fields_of<dim>(parameters);
  std::vector<LoadField> list;
  for (const BoundaryCondition condition : parameters.conditions)
    for (const PrescribedLoad &load : parameters.loads.loads)
      if (parameters.loads.uses(condition))
        for (const CellDataset &set :
             fields.datasets(load_group(load.name, condition), 0))
          list.push_back({set.name, set.components, fields.quantities()[set.first].unit});
  return list;
}

template <int dim>
std::vector<double> numbers(const VoigtVector<dim> &vector)
{
  return {vector.data(), vector.data() + vector.size()};
}

template <int dim>
LoadGroup file_group(const LoadResult<dim> &result, const RveParameters &parameters)
{
  constexpr auto n_strain = static_cast<std::ptrdiff_t>(n_strains<dim>);
  LoadGroup group{load_group(result.name, result.condition),
                  numbers<dim>(result.strain),
                  numbers<dim>(result.stress),
                  {}};
  for (std::size_t p = 0; p < result.phases.size(); ++p)
    {
      const PhaseUnderLoad &phase = result.phases[p];
      if (phase.histogram.empty() || !(phase.quantities[0].volume > 0.))
        continue;
      std::vector<std::vector<double>> edges;
      for (const Moments &moments : phase.quantities)
        edges.push_back(Bins(moments, parameters.loads.n_bins).edges());
      const std::string name =
        group.name + "/histogram/" + parameters.microstructure.phases[p].name + "/";
      group.histogram.push_back(
        {name + "strain",
         "-",
         {edges.begin(), edges.begin() + n_strain},
         {phase.histogram.begin(), phase.histogram.begin() + n_strain}});
      group.histogram.push_back(
        {name + "stress",
         "Pa",
         {edges.begin() + n_strain, edges.end()},
         {phase.histogram.begin() + n_strain, phase.histogram.end()}});
    }
  return group;
}

template <int dim>
void write_file(const RveParameters &parameters,
                const RveResults<dim> &results,
                const RunContext &context)
{
  LoadsContent<dim> content;
  content.digest   = results.first.digest;
  content.grid     = results.first.grid;
  content.mesh     = results.first.mesh;
  content.phases   = results.first.phases;
  content.phase_id = results.first.phase_id;
  if (parameters.loads.write_fields)
    content.fields = load_fields<dim>(parameters);
  const LocalFields<dim> fields = fields_of<dim>(parameters);
  for (const LocalQuantity &quantity : fields.quantities())
    (quantity.unit == "-" ? content.strains : content.stresses).push_back(quantity.name);
  for (const LoadResult<dim> &result : results.members[0].loads)
    content.groups.push_back(file_group(result, parameters));
  write_loads_file(context.file("loads.h5"), content);
}

/** Appends a text for each axis of a place, or empty texts. */
template <int dim>
void append_place(std::vector<std::string> &row, const std::array<double, 3> &place)
{
  for (unsigned int d = 0; d < dim; ++d)
    row.push_back(to_text(place[d]));
}

template <int dim>
void write_table(const RveParameters &parameters,
                 const RveResults<dim> &results,
                 const RunContext &context)
{
  std::vector<std::string> headings = {
    "load", "condition",          "phase",   "quantity", "unit",
    "mean", "standard_deviation", "minimum", "maximum"};
  for (const char *of : {"minimum", "maximum"})
    for (unsigned int d = 0; d < dim; ++d)
      headings.push_back(std::string(of) + "_at_" + "xyz"[d] + " [m]");
  TableWriter table(context.file("loads.csv"), headings);
  const auto fields = fields_of<dim>(parameters);
  const auto parts  = parts_of(results);
  for (const LoadResult<dim> &result : results.members[0].loads)
    for (std::size_t part = 0; part < parts.size(); ++part)
      for (std::size_t q = 0; q < fields.quantities().size(); ++q)
        {
          const Moments m = moments_in(result, part, q);
          if (!(m.volume > 0.))
            continue;
          std::vector<std::string> row = {result.name,
                                          to_string(result.condition),
                                          parts[part],
                                          fields.quantities()[q].name,
                                          fields.quantities()[q].unit,
                                          to_text(m.mean),
                                          to_text(m.standard_deviation()),
                                          to_text(m.minimum),
                                          to_text(m.maximum)};
          append_place<dim>(row, m.minimum_at);
          append_place<dim>(row, m.maximum_at);
          table.add_row(row);
        }
  table.flush();
}

template <int dim>
void write_ensemble(const RveParameters &parameters,
                    const RveResults<dim> &results,
                    const RunContext &context)
{
  TableWriter table(context.file("loads_ensemble.csv"),
                    {"load", "condition", "phase", "quantity", "unit", "of", "mean",
                     "standard_deviation"});
  const auto fields                                 = fields_of<dim>(parameters);
  const auto parts                                  = parts_of(results);
  using Of                                          = double (*)(const Moments &);
  const std::vector<std::pair<const char *, Of>> of = {
    {"mean", [](const Moments &m) { return m.mean; }},
    {"standard_deviation", [](const Moments &m) { return m.standard_deviation(); }},
    {"minimum", [](const Moments &m) { return m.minimum; }},
    {"maximum", [](const Moments &m) { return m.maximum; }}};
  const std::vector<LoadResult<dim>> &first = results.members[0].loads;
  for (std::size_t k = 0; k < first.size(); ++k)
    for (std::size_t part = 0; part < parts.size(); ++part)
      for (std::size_t q = 0; q < fields.quantities().size(); ++q)
        for (const auto &[name, value] : of)
          {
            const auto [mean, deviation] =
              over_members(results.members.size(), [&, f = value](const std::size_t m) {
                return f(moments_in(results.members[m].loads[k], part, q));
              });
            table.add_row({first[k].name, to_string(first[k].condition), parts[part],
                           fields.quantities()[q].name, fields.quantities()[q].unit, name,
                           to_text(mean), to_text(deviation)});
          }
  table.flush();
}
} // namespace

template <int dim>
std::string reserve_loads(const RveParameters &parameters,
                          const std::string &path,
                          const Shape &shape)
{
  if (parameters.loads.loads.empty() || !parameters.loads.write_fields)
    return {};
  reserve_load_fields(path, shape, load_fields<dim>(parameters));
  return path;
}

template <int dim>
double bytes_of_loads(const RveParameters &parameters, const double n_cells)
{
  double n = 0.;
  if (parameters.loads.write_fields)
    for (const LoadField &field : load_fields<dim>(parameters))
      n += static_cast<double>(field.components);
  return 8. * n * n_cells;
}

namespace
{
/** Whether the shears that MUBC leave coupled explain an @p error. */
template <int dim>
bool is_coupled(const EnsembleMember<dim> &member,
                const BoundaryCondition condition,
                const double error)
{
  return std::any_of(member.responses.begin(), member.responses.end(),
                     [&](const HomogenizedResponse<dim> &response) {
                       return response.condition == condition &&
                              response.coupling > 0.1 * error;
                     });
}
} // namespace

template <int dim>
std::vector<std::string> load_warnings(const RveParameters &parameters,
                                       const std::vector<EnsembleMember<dim>> &members)
{
  std::vector<std::string> sentences;
  if (parameters.loads.loads.empty())
    return sentences;
  if (!fields_of<dim>(parameters).has_invariants())
    sentences.emplace_back(
      "Loads: a phase has Type = stiffness, which says nothing of sigma_zz in plane "
      "strain; von Mises, hydrostatic and principal stresses are left out: give its "
      "moduli as isotropic or orthotropic to have them");
  constexpr double largest_strain = 0.1;
  for (const LoadResult<dim> &result : members[0].loads)
    if (const double strain = result.strain.cwiseAbs().maxCoeff();
        strain > largest_strain)
      sentences.push_back(brief_text(3, "Load ", result.name, ", ",
                                     to_string(result.condition),
                                     ": the macroscopic strain reaches ", 100. * strain,
                                     " %, beyond small strains, and what is written is "
                                     "only proportional to the load; a "
                                     "strain of 0.01 is 1 %"));
  for (const EnsembleMember<dim> &member : members)
    for (const LoadResult<dim> &result : member.loads)
      {
        const double error = std::max(
          {result.strain_residual, result.stress_residual, result.hill_mandel_residual});
        if (error <= tell_above)
          continue;
        std::ostringstream text;
        text
          << std::scientific << std::setprecision(1) << "Load " << result.name << ", "
          << to_string(result.condition)
          << ": means of the local strains and stresses are off the macroscopic ones by "
          << result.strain_residual << " and " << result.stress_residual
          << ", their work by " << result.hill_mandel_residual
          << (is_coupled(member, result.condition, error)
                ? ", as the axes are not those of orthotropy"
                : "; lower Homogenization/Tolerance (now " +
                    to_text(parameters.tolerance) + ")")
          << (members.size() > 1 ? " (" + member.origin + ")" : "");
        sentences.push_back(text.str());
      }
  return sentences;
}

template <int dim>
void write_loads(const RveParameters &parameters,
                 const RveResults<dim> &results,
                 const RunContext &context)
{
  if (parameters.loads.loads.empty())
    return;
  write_table(parameters, results, context);
  if (results.members.size() > 1)
    write_ensemble(parameters, results, context);
  write_file(parameters, results, context);
}

#define MESOSLIP_INSTANTIATE(dim)                                                     \
  template std::string reserve_loads<dim>(const RveParameters &, const std::string &, \
                                          const Shape &);                             \
  template double bytes_of_loads<dim>(const RveParameters &, const double);           \
  template std::vector<std::string> load_warnings<dim>(                               \
    const RveParameters &, const std::vector<EnsembleMember<dim>> &);                 \
  template void write_loads<dim>(const RveParameters &, const RveResults<dim> &,      \
                                 const RunContext &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
