#include "exchange/rve_file.h"

#include "base/errors.h"
#include "material/stiffness.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mesoslip
{
namespace
{
const std::string origin_hint = "rve_homogenization writes it";

UserError wrong(const Hdf5File &file, const std::string &object, const std::string &what)
{
  return UserError(file.path() + ": " + object + " " + what +
                   "; run rve_homogenization again");
}

void require_stiffness(const Hdf5File &file,
                       const std::string &object,
                       const VoigtMatrix<2> &D)
{
  try
    {
      check_stiffness<2>(D);
    }
  catch (const std::invalid_argument &e)
    {
      throw wrong(file, object, std::string("cannot be used: ") + e.what());
    }
}

std::vector<Phase<2>> read_phases(const Hdf5File &file)
{
  const std::vector<std::string> names =
    file.read<std::string>("/phase/name", {}, origin_hint);
  const std::size_t n = names.size();
  const auto D        = file.read<double>("/phase/stiffness", {n, 3, 3}, origin_hint);
  const auto density  = file.read<double>("/phase/density", {n}, origin_hint);
  const auto friction =
    file.read<double>("/phase/friction_coefficient", {n}, origin_hint);
  if (n == 0)
    throw wrong(file, "/phase/name", "is empty");
  file.require_unit("/phase/stiffness", "Pa");
  file.require_unit("/phase/density", "kg/m^3");

  std::vector<Phase<2>> phases(n);
  for (std::size_t p = 0; p < n; ++p)
    {
      phases[p].name                 = names[p];
      phases[p].stiffness            = Eigen::Map<const VoigtMatrix<2>>(D.data() + 9 * p);
      phases[p].density              = density[p];
      phases[p].friction_coefficient = friction[p];
      require_stiffness(file, "/phase/stiffness of '" + names[p] + "'",
                        phases[p].stiffness);
      if (!(density[p] >= 0.))
        throw wrong(file, "/phase/density", "holds a negative value");
      if (!(friction[p] >= 0.))
        throw wrong(file, "/phase/friction_coefficient", "holds a negative value");
    }
  return phases;
}
} // namespace

UniformGrid<2> read_grid(const Hdf5File &file, const std::string &hint)
{
  using std::vector;
  const auto cells   = file.read_attribute<vector<unsigned int>>("/grid", "cells", hint);
  const auto spacing = file.read_attribute<vector<double>>("/grid", "spacing", hint);
  const auto start   = file.read_attribute<vector<double>>("/grid", "origin", hint);
  UniformGrid<2> grid;
  if (cells.size() != 2 || spacing.size() != 2 || start.size() != 2)
    throw wrong(file, "/grid", "does not describe a grid in 2D");
  for (unsigned int d = 0; d < 2; ++d)
    {
      grid.cells[d]   = cells[d];
      grid.spacing[d] = spacing[d];
      grid.origin[d]  = start[d];
      if (cells[d] == 0 || cells[d] > 1000000 || !(spacing[d] > 0.) ||
          !std::isfinite(spacing[d]) || !std::isfinite(start[d]))
        throw wrong(file, "/grid", "has sizes that make no sense");
    }
  return grid;
}

void write_grid(Hdf5File &file, const UniformGrid<2> &grid)
{
  file.create_group("/grid");
  file.write_attribute("/grid", "cells",
                       std::vector<unsigned int>(grid.cells.begin(), grid.cells.end()));
  file.write_attribute("/grid", "spacing",
                       std::vector<double>(grid.spacing.begin(), grid.spacing.end()));
  file.write_attribute("/grid", "origin",
                       std::vector<double>(grid.origin.begin(), grid.origin.end()));
}

RveFile::RveFile(Hdf5File &&opened)
  : file(std::move(opened))
{
  the_digest = file.check_header("mesoslip-rve", rve_format_version, 2, origin_hint);
  the_grid   = read_grid(file, origin_hint);
  the_phases = read_phases(file);
}

RveFile RveFile::open(const std::string &path)
{
  return RveFile(Hdf5File::open(path, "run rve_homogenization first"));
}

std::vector<std::uint8_t> RveFile::phase_id() const
{
  auto id = file.read<std::uint8_t>("/phase/id", {the_grid.cells[1], the_grid.cells[0]},
                                    origin_hint);
  if (*std::max_element(id.begin(), id.end()) >= the_phases.size())
    throw wrong(file, "/phase/id", "names a phase that /phase/name does not have");
  return id;
}

double RveFile::mean_density() const
{
  std::vector<std::size_t> count(the_phases.size());
  for (const std::uint8_t id : phase_id())
    ++count[id];
  double sum = 0.;
  for (std::size_t p = 0; p < count.size(); ++p)
    sum += the_phases[p].density * count[p];
  return sum / the_grid.n_cells();
}

VoigtMatrix<2> RveFile::stiffness(const std::string &name) const
{
  const auto D = file.read<double>("/stiffness/" + name, {3, 3},
                                   "run rve_homogenization with " + name +
                                     " among its boundary conditions");
  file.require_unit("/stiffness/" + name, "Pa");
  const VoigtMatrix<2> stiffness = Eigen::Map<const VoigtMatrix<2>>(D.data());
  require_stiffness(file, "/stiffness/" + name, stiffness);
  return stiffness;
}

std::vector<double> RveFile::concentration(const std::string &name) const
{
  return file.read<double>(
    "/concentration/" + name, {the_grid.cells[1], the_grid.cells[0], 3, 3},
    "run rve_homogenization with " + name +
      " among its boundary conditions and its concentration tensors written");
}
} // namespace mesoslip
