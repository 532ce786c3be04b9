#include "sliding/given_body.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "base/text.h"
#include "body/elastic_body.h"
#include "eigenvalues/free_dofs.h"
#include "material/plausibility.h"
#include "program/run_context.h"
#include "sliding/counter/counter_text.h"
#include "sliding/given_grid.h"
#include "sliding/mesh/box_body.h"
#include "sliding/mesh/given_mesh.h"
#include "sliding/pair/given_pair.h"
#include "sliding/supports/plausible_supports.h"
#include "sliding/supports/support_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

namespace mesoslip
{
template <int dim>
GivenBody<dim>::GivenBody(const ContactParameters &parameters)
  : parameters(parameters)
{
}

template <int dim>
void GivenBody<dim>::check_damping() const
{
  const std::size_t n = known.phases.size();
  std::string names;
  for (const Phase<dim> &phase : known.phases)
    names += (names.empty() ? "" : ", ") + phase.name;
  const auto check = [&](const std::string &key, const std::size_t given) {
    if (given != 1 && given != n)
      throw UserError(key + " has " + std::to_string(given) +
                      " values, but the body has " + std::to_string(n) +
                      (n == 1 ? " phase, " : " phases, ") + names +
                      "; give one value, or one for each phase in this order");
  };
  check("Time/Rayleigh beta", parameters.n_betas);
  check("Body/Rayleigh alpha", parameters.n_alphas);
}

template <int dim>
void GivenBody<dim>::describe(std::ostream &out, const double more_memory) const
{
  for (const std::string &line : told())
    out << line << '\n';
  BodyMemory memory = known.memory;
  memory.on_rank_0 += more_memory;
  out << dim * known.n_points << " degrees of freedom\n"
      << memory.text(mpi::n_mpi_processes(MPI_COMM_WORLD)) << '\n';
  for (const std::string &warning : known.warnings)
    out << "warning: " << warning << '\n';
}

template <int dim>
std::vector<std::string> GivenBody<dim>::told() const
{
  std::vector<std::string> all = known.lines;
  for (const SideSupport *side : parameters.suspended())
    if (const std::string line = support_text(
          parameters.is_turned_over() ? turned_over(*side, dim) : *side, dim);
        !line.empty())
      all.push_back(line);
  return all;
}

template <int dim>
void GivenBody<dim>::log(RunContext &context) const
{
  for (const std::string &line : told())
    context.log(line);
  for (const std::string &warning : known.warnings)
    context.warn(warning);
}

template <int dim>
ContactPlaces GivenBody<dim>::contact_nodes() const
{
  const double n = static_cast<double>(known.size.area.size());
  double area    = 0.;
  for (const double of_node : known.size.area)
    area += std::fabs(of_node);
  return {known.contact_place, known.contact_height,
          dim == 2 ? area / (n - 1.) : std::sqrt(area / n)};
}

template <int dim>
void GivenBody<dim>::look_at_flat()
{
  const auto warnings = look_at_profile(parameters, known.scales, contact_nodes());
  known.warnings.insert(known.warnings.end(), warnings.begin(), warnings.end());
  if (!parameters.contact.profile)
    return;
  const std::string &file = parameters.profile.file,
                    text  = parameters.contact.profile->text();
  known.lines.push_back("Flat: height = " + text +
                        (file.empty() ? " m" : " (" + file + ")"));
  if (!file.empty())
    known.contents += "Content of Flat/Profile file = " + text + "\n";
}

template <int dim>
void GivenBody<dim>::summarize(const std::string &analysis, RunContext &context) const
{
  nlohmann::json &json = context.summary();
  json["dim"]          = dim;
  json["cells"]        = known.size.n_cells;
  json["dofs"]         = dim * known.n_points;
  json["analysis"]     = analysis;
  json["material"]     = known.heterogeneous ? "heterogeneous" : "homogeneous";
}

template <int dim>
void GivenBody<dim>::write_and_show(std::optional<Hdf5File> &file,
                                    const std::string &path,
                                    const std::vector<ShownFields> &shown,
                                    const std::vector<double> &numbers) const
{
  std::vector<XdmfField> of_file;
  for (const ShownFields &fields : shown)
    {
      write_fields(file, path, fields.dataset, fields.fields);
      if (file && !fields.unit.empty())
        file->write_unit(fields.dataset, fields.unit);
      of_file.push_back({fields.name, fields.dataset, XdmfField::Values::nodes, {dim}});
    }
  if (!file)
    return;
  file->close();
  show(path, of_file, numbers);
}

template <int dim>
void GivenBody<dim>::add_lines_on_cells()
{
  for (const std::string &line : lines_on_cells<dim>(
         known.phases, {parameters.body.mean_dilatation, known.has_simplices}))
    known.lines.push_back(line);
}

template <int dim>
void GivenBody<dim>::add_implausible(std::vector<std::string> &sentences,
                                     std::vector<PlausibleRange> ranges,
                                     const BodyScales &scales) const
{
  const FrictionParameters &friction = parameters.friction;
  if (friction.has_constant_coefficient())
    ranges.push_back(plausible_friction("Friction/Coefficient", friction.coefficient));
  if (parameters.analysis == ContactAnalysis::static_contact)
    ranges.push_back(plausible_pressure("Supports/Top/Pressure",
                                        std::fabs(parameters.top.pressure.amplitude()),
                                        scales.stiffness));
  const ContactSetup &flat = parameters.contact;
  if (flat.is_compliant())
    ranges.push_back(plausible_springs(
      "Flat/Normal stiffness", flat.normal_spring.stiffness, parameters, scales.height));
  if (flat.slips_on_springs())
    ranges.push_back(plausible_springs(
      "Flat/Tangential stiffness", flat.tangential_stiffness, parameters, scales.height));
  for (const SideSupport *side : parameters.suspended())
    for (const PlausibleRange &range : plausible_suspension(parameters, *side, scales))
      ranges.push_back(range);
  for (const std::string &sentence : implausible(ranges))
    sentences.push_back(sentence);
  for (const std::string &sentence : stiffness_warnings<dim>(
         known.phases, {parameters.body.mean_dilatation, known.has_simplices}))
    sentences.push_back(sentence);
}

template <int dim>
std::vector<Platen> GivenBody<dim>::platens(const TopSetup &top) const
{
  std::vector<Platen> all;
  if (top.is_platen)
    all.push_back({top_nodes().nodes, top.moves(dim), top.platen_mass});
  const std::vector<SideSupport> sides = loaded_sides();
  std::vector<SupportNodes> nodes      = side_nodes();
  for (std::size_t k = 0; k < sides.size(); ++k)
    if (sides[k].is_platen)
      all.push_back({nodes[k].nodes, known.size.side_moves[k], sides[k].platen_mass});
  return all;
}

template <int dim>
VibrationModes<dim> GivenBody<dim>::modes(const TopSetup &top,
                                          const bool contact_held,
                                          const VibrationModesOptions &options) const
{
  return vibration_modes<dim>(elastic(), held(top, contact_held), options);
}

template <int dim>
std::size_t GivenBody<dim>::n_platen_moves(const TopSetup &top) const
{
  std::vector<std::array<bool, 3>> all = known.size.side_moves;
  if (top.is_platen)
    all.push_back(top.moves(dim));
  std::size_t n = 0;
  for (const std::array<bool, 3> &moves : all)
    n += static_cast<std::size_t>(std::count(moves.begin(), moves.end(), true));
  return n;
}

namespace
{
/** Nodes with other movers: a side adds only the diagonal of its dashpots to them, see
 * SuspendedNodes. */
using MovedNodes = std::set<std::array<unsigned int, 2>>;

template <int dim>
void add_to(Foundation &foundation,
            const SupportNodes &support,
            const Suspension &suspension,
            const MovedNodes &movers,
            const MovedNodes &copies)
{
  for (std::size_t k = 0; k < support.nodes.size(); ++k)
    {
      const NodeIndex &node = support.nodes[k];
      const double area     = support.carried.area[k];
      if (!(area > 0.) || copies.count(std::array<unsigned int, 2>{{node.i, node.j}}) > 0)
        continue;
      for (unsigned int c = 0; c < dim; ++c)
        {
          if (suspension.stiffness[c] > 0.)
            foundation.springs.push_back({node, c, c, area * suspension.stiffness[c]});
          if (suspension.dashpot[c] > 0.)
            foundation.dashpots.push_back({node, c, c, area * suspension.dashpot[c]});
          for (unsigned int d = 0; d < dim && suspension.absorbing; ++d)
            if (c == d ||
                movers.count(std::array<unsigned int, 2>{{node.i, node.j}}) == 0)
              foundation.dashpots.push_back(
                {node, c, d, area * support.carried.impedance[dim * c + d][k]});
        }
      if (suspension.mass > 0.)
        foundation.masses.emplace_back(node, area * suspension.mass);
    }
}
} // namespace

template <int dim>
Foundation GivenBody<dim>::foundation() const
{
  Foundation foundation;
  const SupportNodes top = top_nodes();
  MovedNodes movers, copies; // nodes moved by earlier surfaces; periodic copies
  for (const auto &[copy, master] : elastic().periodic_copies())
    copies.insert(std::array<unsigned int, 2>{{copy.i, copy.j}});
  add_to<dim>(foundation, top, parameters.top.suspension, movers, copies);
  const auto take = [&](const std::vector<NodeIndex> &nodes) {
    for (const NodeIndex &node : nodes)
      movers.insert(std::array<unsigned int, 2>{{node.i, node.j}});
  };
  take(contact_of_elastic());
  take(top.nodes);
  const std::vector<SideSupport> sides  = parameters.loaded_sides();
  const std::vector<SupportNodes> nodes = side_nodes();
  for (std::size_t k = 0; k < sides.size(); ++k)
    {
      add_to<dim>(foundation, nodes[k], sides[k].suspension, movers, copies);
      take(nodes[k].nodes);
    }
  return foundation;
}

namespace
{
template <int dim>
std::unique_ptr<GivenBody<dim>> make_of_kind(const ContactParameters &parameters)
{
  if (parameters.counter && parameters.analysis != ContactAnalysis::transient)
    return std::make_unique<GivenPair<dim>>(parameters);
  if constexpr (dim == 2)
    if (parameters.mesh.is_plane_grid())
      return std::make_unique<GivenGrid>(parameters);
  std::unique_ptr<BodyMesh<dim>> mesh;
  if constexpr (dim == 3)
    if (!parameters.mesh.is_given())
      mesh = std::make_unique<BoxBody>();
  if (!mesh)
    mesh = std::make_unique<BodyMesh<dim>>();
  return std::make_unique<GivenMesh<dim>>(parameters, std::move(mesh));
}
} // namespace

template <int dim>
std::unique_ptr<GivenBody<dim>> make_given_body(const ContactParameters &parameters)
{
  auto body = make_of_kind<dim>(parameters);
  body->look_at_flat();
  return body;
}

template class GivenBody<2>;
template class GivenBody<3>;
template std::unique_ptr<GivenBody<2>> make_given_body(const ContactParameters &);
template std::unique_ptr<GivenBody<3>> make_given_body(const ContactParameters &);
} // namespace mesoslip
