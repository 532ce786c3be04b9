#include "sliding/analyses/phases_of_contact.h"

#include "base/errors.h"
#include "exchange/datasets.h"

namespace mesoslip
{
namespace
{
const std::string phases_group = "/contact/phases";
const char run_again[]         = "run contact_dynamics again";
const char share_of_phases[]   = "/contact/phases/share";
} // namespace

void write_phases_of_contact(Hdf5File &file, const PhasesOfContact &phases)
{
  std::vector<Series> series = {{"youngs_modulus", "Pa", &phases.youngs_modulus},
                                {"volume_fraction", "-", &phases.volume_fraction}};
  if (!phases.friction.empty())
    series.push_back({"friction_coefficient", "-", &phases.friction});
  write_series(file, phases_group, series);
  std::vector<double> shares;
  for (const std::vector<double> &of_phase : phases.share)
    shares.insert(shares.end(), of_phase.begin(), of_phase.end());
  const std::size_t n = phases.names.size();
  write_dataset(file, share_of_phases, {n, shares.size() / n}, shares, "-");
  file.write_attribute(phases_group, "name", phases.names);
}

PhasesOfContact read_phases_of_contact(const Hdf5File &file)
{
  if (!file.exists(phases_group))
    throw UserError(file.path() + " has no " + phases_group +
                    ", as its body is homogeneous or an earlier version wrote it; name "
                    "a run of a heterogeneous body, or make it again");
  PhasesOfContact phases;
  phases.names = file.read_attribute<std::vector<std::string>>(phases_group, "name");
  const Shape n_phases = {phases.names.size()};
  const auto of_phases = [&](const std::string &name) {
    return file.read<double>(phases_group + "/" + name, n_phases, run_again);
  };
  phases.youngs_modulus  = of_phases("youngs_modulus");
  phases.volume_fraction = of_phases("volume_fraction");
  if (file.exists(phases_group + "/friction_coefficient"))
    phases.friction = of_phases("friction_coefficient");
  const auto shares =
    file.read<double>(share_of_phases, {n_phases[0], any_extent}, run_again);
  if (shares.empty())
    throw UserError(file.path() + ": " + share_of_phases + " is empty; " + run_again);
  const auto n_nodes = static_cast<std::ptrdiff_t>(shares.size() / n_phases[0]);
  for (auto first = shares.begin(); first != shares.end(); first += n_nodes)
    phases.share.emplace_back(first, first + n_nodes);
  return phases;
}
} // namespace mesoslip
