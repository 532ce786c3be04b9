#include "microstructure/grid_parameters.h"

#include "grid/size_text.h"
#include "io/errors.h"
#include "io/key_use.h"
#include "io/parameters.h"
#include "io/text.h"

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <vector>

namespace mesoslip
{
void GridParameters::declare(dealii::ParameterHandler &prm)
{
  const GridParameters defaults;
  const ParameterSection section(prm, "Grid");
  declare_integer_list(prm, "Cells", {defaults.cells[0], defaults.cells[1]}, 1, 1000000,
                       "Numbers of cells along x and y [-]", 2, 2);
  declare_double_list(prm, "Size", {defaults.size[0], defaults.size[1]}, Range::length(),
                      "Width (x) and height (y) of the box [m]", 2, 2);
  declare_double_list(prm, "Spacing", {}, Range::length(),
                      "Instead of the size: edge of the square cells, or their width and "
                      "height. Empty: size over cells [m]",
                      0, 2);
}

void GridParameters::check_keys(const KeyUse &use)
{
  const auto numbers = [&](const char *key) {
    std::vector<double> values;
    for (const std::string &item : split_list(use.value(key)))
      if (double value; parse_number(item, value))
        values.push_back(value);
    return values;
  };
  const std::vector<double> cells = numbers("Grid/Cells"), size = numbers("Grid/Size"),
                            spacing = numbers("Grid/Spacing");
  if (spacing.empty())
    return;
  const std::array<double, 2> found = {
    {cells.at(0) * spacing.front(), cells.at(1) * spacing.back()}};
  const auto agrees = [&](const unsigned int d) {
    return std::abs(size.at(d) - found[d]) <= 1e-9 * found[d];
  };
  use.only_if(agrees(0) && agrees(1), {"Grid/Size"},
              "Grid/Cells times Grid/Spacing make a box of " +
                lengths_text(found[0], found[1]),
              "leave Grid/Spacing empty");
}

void GridParameters::parse(dealii::ParameterHandler &prm)
{
  const ParameterSection section(prm, "Grid");
  const std::vector<long> cell_list   = get_integer_list(prm, "Cells");
  const std::vector<double> size_list = get_double_list(prm, "Size");
  const std::vector<double> spacing   = get_double_list(prm, "Spacing");
  for (unsigned int d = 0; d < 2; ++d)
    {
      cells[d] = static_cast<unsigned int>(cell_list.at(d));
      size[d] =
        spacing.empty() ? size_list.at(d) : cells[d] * spacing.at(d % spacing.size());
    }
}

void GridParameters::check() const
{
  double n = 1.;
  for (unsigned int d = 0; d < 2; ++d)
    {
      n *= cells[d];
      if (!Range::length().contains(size[d]))
        throw UserError("Grid/Size: " + to_text(size[d]) +
                        " m is not the size of a box; give two lengths " +
                        Range::length().text());
    }
  if (!(n >= 1. && n < 2147483648.))
    throw UserError("Grid/Cells: " + to_text(n) +
                    " cells are none or too many; there may be up to 2^31");
}

UniformGrid<2> GridParameters::grid() const
{
  UniformGrid<2> result;
  result.cells = cells;
  for (unsigned int d = 0; d < 2; ++d)
    result.spacing[d] = size[d] / cells[d];
  return result;
}
} // namespace mesoslip
