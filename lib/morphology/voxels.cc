#include "morphology/voxels.h"

#include "base/errors.h"
#include "base/files.h"
#include "base/text.h"
#include "io/numpy_array.h"
#include "morphology/microstructure_parameters.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace mesoslip
{
namespace
{
std::string voxel_numbers(const std::array<unsigned int, 3> &n)
{
  return std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
         std::to_string(n[2]);
}

/** The value of each phase: those of the .prm, or those that occur, ascending. */
std::vector<std::int64_t> values_of_phases(const MicrostructureParameters &p,
                                           const std::vector<std::int64_t> &voxels)
{
  if (!p.image.values.empty())
    return {p.image.values.begin(), p.image.values.end()};
  constexpr std::size_t enough = 256; // more than this is a grey picture
  std::set<std::int64_t> found;
  for (std::size_t k = 0; k < voxels.size() && found.size() <= enough; ++k)
    if (k == 0 || voxels[k] != voxels[k - 1])
      found.insert(voxels[k]);
  if (found.size() != p.phases.size())
    {
      std::vector<std::string> some;
      for (const std::int64_t value : found)
        if (some.size() < 8)
          some.push_back(std::to_string(value));
      const std::string n =
        found.size() > enough ? "more than 256" : std::to_string(found.size());
      throw UserError(p.file + " has " + n + " different values (" + to_text(some) +
                      (found.size() > some.size() ? ", ..." : "") +
                      "), and Phases/Names has " + std::to_string(p.phases.size()) +
                      "; name as many phases, or set Microstructure/Image values");
    }
  return {found.begin(), found.end()};
}

/** Numbers the phases; the array is [z][y][x], so its order is that of the cells. */
std::vector<std::uint8_t> phases_of_voxels(const MicrostructureParameters &p,
                                           const std::vector<std::int64_t> &voxels,
                                           const std::vector<std::int64_t> &values)
{
  std::vector<std::uint8_t> id(voxels.size());
  for (std::size_t k = 0; k < voxels.size(); ++k)
    {
      const auto found = std::find(values.begin(), values.end(), voxels[k]);
      if (found == values.end())
        {
          const std::size_t nx = p.box.cells[0], ny = p.box.cells[1];
          throw UserError(p.file + ": voxel [" + std::to_string(k / nx / ny) + "][" +
                          std::to_string(k / nx % ny) + "][" + std::to_string(k % nx) +
                          "] has the value " + std::to_string(voxels[k]) +
                          ", which is not among Microstructure/Image values");
        }
      id[k] = static_cast<std::uint8_t>(found - values.begin());
    }
  return id;
}

std::string percent_text(const double fraction)
{
  return brief_text(4, 100. * fraction, " %");
}

/** Phases of the cells in the corners, from which the order of the axes shows. */
std::string corners_line(const PhaseMap<3> &map, const std::vector<Phase<3>> &phases)
{
  const auto &n    = map.grid.cells;
  std::string text = "Corners:";
  for (unsigned int corner = 0; corner < 8; ++corner)
    {
      std::array<std::size_t, 3> at = {};
      std::string place;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const bool upper = (corner >> d & 1U) != 0;
          at[d]            = upper ? n[d] - 1 : 0;
          place += std::string(d == 0 ? "" : " ") + "xyz"[d] + (upper ? "+" : "-");
        }
      const std::size_t k = (at[2] * n[1] + at[1]) * n[0] + at[0];
      text += (corner == 0 ? " (" : ", (") + place + ") " + phases[map.id[k]].name;
    }
  return text;
}

/** Fraction of the last phase in up to four slices across each axis. */
std::vector<std::string> slice_lines(const PhaseMap<3> &map,
                                     const std::vector<Phase<3>> &phases)
{
  std::vector<std::string> lines;
  const auto &n              = map.grid.cells;
  const std::uint8_t counted = phases.size() - 1;
  std::size_t stride         = 1;
  for (unsigned int d = 0; d < 3; ++d)
    {
      const unsigned int n_slices = std::min(4U, n[d]);
      std::vector<double> all(n_slices, 0.), part(n_slices, 0.);
      for (std::size_t k = 0; k < map.id.size(); ++k)
        {
          const std::size_t slice = k / stride % n[d] * n_slices / n[d];
          all[slice] += 1.;
          part[slice] += map.id[k] == counted ? 1. : 0.;
        }
      std::string line = "Slices across " + std::string(1, "xyz"[d]) +
                         ", from below: " + phases[counted].name;
      for (unsigned int s = 0; s < n_slices; ++s)
        line += (s == 0 ? " " : ", ") + percent_text(part[s] / all[s]);
      lines.push_back(line);
      stride *= n[d];
    }
  return lines;
}

void describe_phases(VoxelMorphology &result, const std::vector<PhaseParameters> &phases)
{
  std::vector<std::size_t> count(phases.size(), 0);
  for (const std::uint8_t id : result.map.id)
    ++count[id];
  const auto n = static_cast<double>(result.map.id.size());
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      result.fractions.push_back(static_cast<double>(count[p]) / n);
      result.description.push_back("Phase " + std::to_string(p) + ", " + phases[p].name +
                                   ": " + std::to_string(count[p]) + " cells, " +
                                   percent_text(result.fractions[p]) + "; " +
                                   phases[p].text<3>());
      if (count[p] == 0)
        result.warnings.push_back("phase '" + phases[p].name +
                                  "' of Phases/Names fills no cell of the morphology");
    }
}
} // namespace

void check_voxels(const MicrostructureParameters &parameters)
{
  const std::string &file = parameters.file;
  require_readable_file("Microstructure/File: ", file,
                        "it has to name an array of voxels (.npy)");
  const NumpyHeader header = read_numpy_header(file);
  const auto &cells        = parameters.box.cells;
  std::string shape;
  for (const std::size_t n : header.shape)
    shape += "[" + std::to_string(n) + "]";
  if (header.shape.size() != 3)
    throw UserError(file + " is an array " + shape +
                    ", but voxels are one of three axes, [z][y][x]");
  const bool fits = std::equal(cells.begin(), cells.end(), header.shape.rbegin());
  if (!fits)
    throw UserError("Grid/Cells: " + voxel_numbers(cells) + " cells do not fit " + file +
                    ", an array " + shape + " in the order [z][y][x]; set Grid/Cells = " +
                    to_text(std::vector<std::string>{std::to_string(header.shape[2]),
                                                     std::to_string(header.shape[1]),
                                                     std::to_string(header.shape[0])}));
  if (parameters.phases.size() > 256)
    throw UserError("Phases/Names: there may be up to 256 phases of voxels");
}

VoxelMorphology make_voxels(const MicrostructureParameters &parameters)
{
  using Type = MicrostructureParameters::Type;
  VoxelMorphology result;
  const UniformGrid<3> &grid = parameters.box;
  result.map.grid            = grid;
  result.phases              = make_phases<3>(parameters.phases);
  result.description         = {"Grid: " + voxel_numbers(grid.cells) + " cells of " +
                                brief_text(4, grid.spacing[0], " x ", grid.spacing[1], " x ",
                                           grid.spacing[2], " m, ", grid.extent(0), " x ",
                                           grid.extent(1), " x ", grid.extent(2), " m")};
  if (parameters.type == Type::homogeneous)
    {
      result.map.id.assign(grid.n_cells(), 0);
      result.description.emplace_back("Morphology: homogeneous");
      describe_phases(result, parameters.phases);
      result.warnings.clear();
      return result;
    }
  const std::vector<std::int64_t> voxels = read_numpy(parameters.file);
  const auto values                      = values_of_phases(parameters, voxels);
  result.map.id                          = phases_of_voxels(parameters, voxels, values);
  result.description.push_back(
    "Morphology: voxels of " +
    std::filesystem::path(parameters.file).filename().string() + ", one per cell");
  describe_phases(result, parameters.phases);
  result.description.push_back(corners_line(result.map, result.phases));
  for (const std::string &line : slice_lines(result.map, result.phases))
    result.description.push_back(line);
  return result;
}
} // namespace mesoslip
