#include "exchange/orientation_datasets.h"

#include "base/errors.h"
#include "exchange/cell_datasets.h"
#include "exchange/datasets.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
const char of_phases[] = "/orientation/phase";
const char angles[]    = "/orientation/euler_angles";

UserError misfit(const Hdf5File &file, const std::string &program)
{
  return UserError(file.path() +
                   ": /orientation does not give each cell an orientation of its phase; "
                   "run " +
                   program + " again");
}
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
  if (!orientations.id.empty())
    write_dataset(file, orientations_dataset, cells, orientations.id);
}

CellMaterials::CellMaterials(const Hdf5File &file,
                             const std::string &phases_of_cells,
                             const std::size_t n,
                             const std::string &of_program)
  : phases(phases_of_cells)
  , n_phases(n)
  , program(of_program)
{
  if (file.exists(phases))
    shape = file.shape(phases);
  if (!file.exists("/orientation"))
    return;
  const std::string hint = program + " writes it";
  const auto phase       = file.read<std::uint8_t>(of_phases, {any_extent}, hint);
  const auto euler       = file.read<double>(angles, {phase.size(), 3}, hint);
  for (std::size_t m = 0; m < phase.size(); ++m)
    oriented.push_back({phase[m], {{euler[3 * m], euler[3 * m + 1], euler[3 * m + 2]}}});
  const bool fits = !phase.empty() &&
                    file.shape(orientations_dataset, hint) == file.shape(phases, hint) &&
                    std::all_of(phase.begin(), phase.end(),
                                [this](const std::uint8_t p) { return p < n_phases; });
  if (!fits)
    throw misfit(file, program);
}

std::vector<std::uint16_t> CellMaterials::of_cells(const Hdf5File &file,
                                                   const std::size_t first,
                                                   const std::size_t count) const
{
  const auto phase =
    read_cells<std::uint8_t>(file, phases, first, count, program + " writes it");
  require_phases(file, phases, phase, n_phases, program);
  if (oriented.empty())
    return {phase.begin(), phase.end()};
  auto id = read_cells<std::uint16_t>(file, orientations_dataset, first, count);
  for (std::size_t k = 0; k < count; ++k)
    if (id[k] >= oriented.size() || oriented[id[k]].phase != phase[k])
      throw misfit(file, program);
  return id;
}

Orientations CellMaterials::orientations(const Hdf5File &file) const
{
  Orientations all;
  if (oriented.empty())
    return all;
  std::size_t n = 1;
  for (const std::size_t extent : shape)
    n *= extent;
  all.materials = oriented;
  all.id        = of_cells(file, 0, n);
  return all;
}
} // namespace mesoslip
