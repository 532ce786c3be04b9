#include "morphology/grid_parameters.h"

#include "base/errors.h"
#include "base/text.h"
#include "grid/size_text.h"
#include "parameters/keys.h"

#include <cmath>
#include <vector>

namespace mesoslip
{
void GridParameters::bind(Keys &keys)
{
  const auto section     = keys.section("Grid");
  std::vector<long> list = {cells[0], cells[1]};
  std::vector<double> spacing;
  keys.bind_list("Cells", list, 1, 1000000, "Numbers of cells along x and y [-]", 2, 2);
  keys.bind("Size", size, Range::length(), "Width (x) and height (y) of the box [m]");
  keys.bind_list("Spacing", spacing, Range::length(),
                 "Instead of the size: edge of the square cells, or their width and "
                 "height. Empty: size over cells [m]",
                 0, 2);
  for (unsigned int d = 0; d < 2; ++d)
    {
      cells[d] = static_cast<unsigned int>(list[d]);
      if (!spacing.empty())
        size[d] = cells[d] * spacing[d % spacing.size()];
    }
}

void GridParameters::check_keys(const Keys &keys)
{
  const auto numbers = [&](const char *key) {
    std::vector<double> values;
    for (const std::string &item : split_list(keys.value(key)))
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
  keys.only_if(agrees(0) && agrees(1), {"Grid/Size"},
               "Grid/Cells times Grid/Spacing make a box of " +
                 lengths_text(found[0], found[1]),
               "leave Grid/Spacing empty");
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
