#include "exchange/rve/orientation_datasets.h"

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

/** Writes phase and orientation of each material. */
void write_oriented(Hdf5File &file, const std::vector<OrientedPhase> &materials)
{
  const std::size_t n = materials.size();
  std::vector<std::uint8_t> phases;
  std::vector<double> euler;
  for (const OrientedPhase &material : materials)
    {
      phases.push_back(static_cast<std::uint8_t>(material.phase));
      euler.insert(euler.end(), material.euler_angles.begin(),
                   material.euler_angles.end());
    }
  write_dataset(file, of_phases, {n}, phases);
  write_dataset(file, angles, {n, 3}, euler, "degree");
}
} // namespace

void write_orientations(Hdf5File &file,
                        const Orientations &orientations,
                        const Shape &cells)
{
  if (orientations.empty())
    return;
  write_oriented(file, orientations.materials);
  if (!orientations.id.empty())
    write_dataset(file, orientations_dataset, cells, orientations.id);
}

void write_materials(Hdf5File &file,
                     const std::string &phases,
                     const UniformGrid<3> &grid,
                     const std::vector<OrientedPhase> &oriented,
                     const CellReader &materials_in)
{
  if (!oriented.empty())
    write_oriented(file, oriented);
  reserve_cells(file, phases, shape_of_cells(grid), !oriented.empty());
  for_each_piece(whole_block(grid), [&](const CellBlock<3> &block) {
    const std::vector<std::uint16_t> materials = materials_in(block);
    std::vector<std::uint8_t> phase;
    for (const std::uint16_t m : materials)
      phase.push_back(
        static_cast<std::uint8_t>(oriented.empty() ? m : oriented[m].phase));
    file.write_row(phases, block.first[2], phase);
    if (!oriented.empty())
      file.write_row(orientations_dataset, block.first[2], materials);
  });
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

/**
 * Reads both datasets by @p read (dataset, a number of its type) and checks them, see
 * of_cells().
 */
template <typename Read>
std::vector<std::uint16_t> CellMaterials::checked(const Hdf5File &file,
                                                  const Read &read) const
{
  const std::vector<std::uint8_t> phase = read(phases, std::uint8_t());
  require_phases(file, phases, phase, n_phases, program);
  if (oriented.empty())
    return {phase.begin(), phase.end()};
  const std::vector<std::uint16_t> id = read(orientations_dataset, std::uint16_t());
  for (std::size_t k = 0; k < id.size(); ++k)
    if (id[k] >= oriented.size() || oriented[id[k]].phase != phase[k])
      throw misfit(file, program);
  return id;
}

std::vector<std::uint16_t> CellMaterials::of_cells(const Hdf5File &file,
                                                   const std::size_t first,
                                                   const std::size_t count) const
{
  return checked(file, [&](const std::string &dataset, auto number) {
    return read_cells<decltype(number)>(file, dataset, first, count,
                                        program + " writes it");
  });
}

template <int dim>
std::vector<std::uint16_t> CellMaterials::of_cells(const Hdf5File &file,
                                                   const CellBlock<dim> &block) const
{
  const Shape offset(block.first.rbegin(), block.first.rend()),
    count(block.cells.rbegin(), block.cells.rend());
  return checked(file, [&](const std::string &dataset, auto number) {
    return file.read_block<decltype(number)>(dataset, offset, count,
                                             program + " writes it");
  });
}

template std::vector<std::uint16_t> CellMaterials::of_cells(const Hdf5File &,
                                                            const CellBlock<2> &) const;
template std::vector<std::uint16_t> CellMaterials::of_cells(const Hdf5File &,
                                                            const CellBlock<3> &) const;
} // namespace mesoslip
