#include "exchange/orientation_datasets.h"

#include "base/errors.h"
#include "exchange/datasets.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
const char of_cells[]  = "/orientation/id";
const char of_phases[] = "/orientation/phase";
const char angles[]    = "/orientation/euler_angles";
} // namespace

void write_orientations(Hdf5File &file,
                        const Orientations &orientations,
                        const Shape &cells)
{
  if (orientations.empty())
    return;
  const std::size_t n = orientations.materials.size();
  std::vector<std::uint8_t> phases;
  std::vector<double> euler;
  for (const OrientedPhase &material : orientations.materials)
    {
      phases.push_back(static_cast<std::uint8_t>(material.phase));
      euler.insert(euler.end(), material.euler_angles.begin(),
                   material.euler_angles.end());
    }
  write_dataset(file, of_phases, {n}, phases);
  write_dataset(file, angles, {n, 3}, euler, "degree");
  write_dataset(file, of_cells, cells, orientations.id);
}

Orientations read_orientations(const Hdf5File &file,
                               const std::string &phases_of_cells,
                               const std::size_t n_phases,
                               const std::string &program)
{
  Orientations found;
  if (!file.exists("/orientation"))
    return found;
  const std::string hint = program + " writes it";
  const auto phases      = file.read<std::uint8_t>(of_phases, {any_extent}, hint);
  const auto euler       = file.read<double>(angles, {phases.size(), 3}, hint);
  found.id               = file.read<std::uint16_t>(of_cells);
  const auto phase_id    = file.read<std::uint8_t>(phases_of_cells, {}, hint);
  for (std::size_t m = 0; m < phases.size(); ++m)
    found.materials.push_back(
      {phases[m], {{euler[3 * m], euler[3 * m + 1], euler[3 * m + 2]}}});
  bool fits =
    !phases.empty() && found.id.size() == phase_id.size() &&
    std::all_of(phases.begin(), phases.end(),
                [n_phases](const std::uint8_t phase) { return phase < n_phases; });
  for (std::size_t k = 0; fits && k < phase_id.size(); ++k)
    fits = found.id[k] < phases.size() && phases[found.id[k]] == phase_id[k];
  if (!fits || !std::all_of(euler.begin(), euler.end(),
                            [](const double angle) { return std::isfinite(angle); }))
    throw UserError(file.path() +
                    ": /orientation does not give each cell an orientation "
                    "of its phase; run " +
                    program + " again");
  return found;
}
} // namespace mesoslip
