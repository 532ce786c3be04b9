#include "morphology/rectangles.h"

#include "base/errors.h"
#include "io/table.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
const std::vector<std::string> length_columns = {"x_left_mm", "y_bottom_mm", "width_mm",
                                                 "height_mm"};

constexpr double metres_per_millimetre = 1e-3;

/** Number of cells whose centre lies left of (below) @p edge, within [0, n]. */
unsigned int
cells_before(const double edge, const double origin, const double h, const unsigned int n)
{
  const double first = std::ceil((edge - origin) / h - 0.5 - 1e-6);
  return static_cast<unsigned int>(std::clamp(first, 0., static_cast<double>(n)));
}

/** Error message for a rectangle on a grid; empty if it is valid. */
std::string problem(const UniformGrid<2> &grid, const Rectangle &r)
{
  const double right = grid.origin[0] + grid.extent(0);
  const double top   = grid.origin[1] + grid.extent(1);
  if (!(r.x_left < right && r.x_left + r.width > grid.origin[0] && r.y_bottom < top &&
        r.y_bottom + r.height > grid.origin[1]))
    return "the rectangle lies outside the box, which is " + to_text(grid.extent(0)) +
           " m wide and " + to_text(grid.extent(1)) + " m tall; move or remove it";
  if (covered_cells(grid, r).empty())
    return "the rectangle (" + to_text(r.width) + " m wide, " + to_text(r.height) +
           " m tall) contains no cell centre and would vanish; cells are " +
           to_text(grid.spacing[0]) + " m by " + to_text(grid.spacing[1]) +
           " m: refine the grid or remove the rectangle";
  return "";
}

void check_columns(const CsvTable &table, const std::string &file)
{
  for (const std::string &heading : table.columns())
    if (heading != "phase" && std::find(length_columns.begin(), length_columns.end(),
                                        heading) == length_columns.end())
      throw UserError(file + ": unknown column '" + heading +
                      "'; the first line must be x_left_mm,y_bottom_mm,width_mm,"
                      "height_mm, with a column phase if needed");
}
} // namespace

PhaseMap<2> homogeneous_map(const UniformGrid<2> &grid, const std::uint8_t background)
{
  return {grid, std::vector<std::uint8_t>(grid.n_cells(), background)};
}

void fill_box(PhaseMap<2> &map, const CellBox &box, const std::uint8_t phase)
{
  for (unsigned int y = box.y_begin; y < box.y_end && !box.empty(); ++y)
    {
      const auto row =
        map.id.begin() + static_cast<std::ptrdiff_t>(y) * map.grid.cells[0];
      std::fill(row + box.x_begin, row + box.x_end, phase);
    }
}

std::vector<double> area_fractions(const PhaseMap<2> &map, const unsigned int n_phases)
{
  std::vector<double> fractions;
  for (unsigned int p = 0; p < n_phases; ++p)
    fractions.push_back(static_cast<double>(std::count(map.id.begin(), map.id.end(), p)) /
                        static_cast<double>(map.id.size()));
  return fractions;
}

PhaseMap<2> refined_map(const PhaseMap<2> &map, const UniformGrid<2> &grid)
{
  const unsigned int x_ratio = grid.cells[0] / map.grid.cells[0];
  const unsigned int y_ratio = grid.cells[1] / map.grid.cells[1];
  PhaseMap<2> result{grid, {}};
  result.id.reserve(grid.n_cells());
  for (unsigned int y = 0; y < grid.cells[1]; ++y)
    for (unsigned int x = 0; x < grid.cells[0]; ++x)
      result.id.push_back(
        map.id[static_cast<std::size_t>(y / y_ratio) * map.grid.cells[0] + x / x_ratio]);
  return result;
}

CellBox covered_cells(const UniformGrid<2> &grid, const Rectangle &r)
{
  const auto before = [&](const unsigned int direction, const double edge) {
    return cells_before(edge, grid.origin[direction], grid.spacing[direction],
                        grid.cells[direction]);
  };
  return {before(0, r.x_left), before(0, r.x_left + r.width), before(1, r.y_bottom),
          before(1, r.y_bottom + r.height)};
}

PhaseMap<2> draw_rectangles(const UniformGrid<2> &grid,
                            const std::vector<Rectangle> &rectangles)
{
  PhaseMap<2> map = homogeneous_map(grid);
  for (const Rectangle &rectangle : rectangles)
    fill_box(map, covered_cells(grid, rectangle), rectangle.phase);
  return map;
}

std::vector<Rectangle> read_rectangles(const std::string &file,
                                       const UniformGrid<2> &grid)
{
  const CsvTable table = CsvTable::read(file);
  check_columns(table, file);
  std::vector<std::vector<double>> lengths;
  for (const std::string &heading : length_columns)
    lengths.push_back(table.numbers(heading));
  std::vector<double> phases(table.n_rows(), 1.);
  if (table.has_column("phase"))
    phases = table.numbers("phase");

  std::vector<Rectangle> rectangles;
  for (std::size_t row = 0; row < table.n_rows(); ++row)
    {
      for (unsigned int c = 2; c < 4; ++c)
        if (!(lengths[c][row] > 0.))
          table.fail(row, length_columns[c] + " is " + to_text(lengths[c][row]) +
                            " and must be positive");
      if (!(phases[row] >= 0. && phases[row] <= 255. &&
            phases[row] == std::floor(phases[row])))
        table.fail(row, "phase is " + to_text(phases[row]) +
                          " and must be a whole number from 0 to 255");
      rectangles.push_back(
        {lengths[0][row] * metres_per_millimetre, lengths[1][row] * metres_per_millimetre,
         lengths[2][row] * metres_per_millimetre, lengths[3][row] * metres_per_millimetre,
         static_cast<std::uint8_t>(phases[row])});
      if (const std::string what = problem(grid, rectangles.back()); !what.empty())
        table.fail(row, what);
    }
  return rectangles;
}

void write_rectangles(const std::string &file, const std::vector<Rectangle> &rectangles)
{
  std::vector<std::string> columns = length_columns;
  columns.emplace_back("phase");
  TableWriter table(file, columns);
  // Picometres: far below any cell; whole micrometres stay readable.
  const auto millimetres = [](const double metres) {
    return std::round(metres * 1e12) / 1e9;
  };
  for (const Rectangle &r : rectangles)
    table.add_row(std::vector<double>{millimetres(r.x_left), millimetres(r.y_bottom),
                                      millimetres(r.width), millimetres(r.height),
                                      static_cast<double>(r.phase)});
  table.flush();
}
} // namespace mesoslip
