#include "exchange/datasets.h"

#include "base/errors.h"
#include "io/table.h"
#include "material/stiffness.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mesoslip
{
namespace
{
UserError wrong(const Hdf5File &file,
                const std::string &object,
                const std::string &what,
                const std::string &program)
{
  return UserError(file.path() + ": " + object + " " + what + "; run " + program +
                   " again");
}

/** A number of each phase that is a dataset of its own; not all files have the last. */
struct PhaseNumber
{
  const char *name, *unit;
  double Phase<2>::*member;
};

const PhaseNumber phase_numbers[] = {
  {"/density", "kg/m^3", &Phase<2>::density},
  {"/friction_coefficient", "-", &Phase<2>::friction_coefficient}};
} // namespace

void write_series(Hdf5File &file,
                  const std::string &group,
                  const std::vector<Series> &series)
{
  for (const Series &s : series)
    write_dataset(file, group + "/" + s.name,
                  s.components == 0
                    ? Shape{s.values->size()}
                    : Shape{s.values->size() / s.components, s.components},
                  *s.values, s.unit);
}

void write_table(const std::string &path,
                 const std::vector<Series> &series,
                 const std::size_t most_rows)
{
  std::vector<std::string> headings;
  std::size_t n = series.front().values->size();
  for (const Series &s : series)
    {
      headings.push_back(s.name + " [" + s.unit + "]");
      n = std::min(n, s.values->size());
    }
  const std::size_t stride = std::max<std::size_t>(1, n / most_rows);
  TableWriter table(path, headings);
  std::vector<double> row(series.size());
  for (std::size_t k = 0; k < n; k += stride)
    {
      for (std::size_t c = 0; c < series.size(); ++c)
        row[c] = (*series[c].values)[k];
      table.add_row(row);
    }
  table.flush();
}

UniformGrid<2> read_grid(const Hdf5File &file, const std::string &program)
{
  using std::vector;
  const std::string hint = program + " writes it";
  const auto cells   = file.read_attribute<vector<unsigned int>>("/grid", "cells", hint);
  const auto spacing = file.read_attribute<vector<double>>("/grid", "spacing", hint);
  const auto start   = file.read_attribute<vector<double>>("/grid", "origin", hint);
  UniformGrid<2> grid;
  if (cells.size() != 2 || spacing.size() != 2 || start.size() != 2)
    throw wrong(file, "/grid", "does not describe a grid in 2D", program);
  for (unsigned int d = 0; d < 2; ++d)
    {
      grid.cells[d]   = cells[d];
      grid.spacing[d] = spacing[d];
      grid.origin[d]  = start[d];
      if (cells[d] == 0 || cells[d] > 1000000 || !(spacing[d] > 0.) ||
          !std::isfinite(spacing[d]) || !std::isfinite(start[d]))
        throw wrong(file, "/grid", "has sizes that make no sense", program);
    }
  return grid;
}

void write_grid(Hdf5File &file, const UniformGrid<2> &grid)
{
  const auto write = [&](const char *name, const auto &values) {
    file.write_attribute("/grid", name, std::vector(values.begin(), values.end()));
  };
  file.create_group("/grid");
  write("cells", grid.cells);
  write("spacing", grid.spacing);
  write("origin", grid.origin);
}

void require_stiffness(const Hdf5File &file,
                       const std::string &object,
                       const VoigtMatrix<2> &D,
                       const std::string &program)
{
  try
    {
      check_stiffness<2>(D);
    }
  catch (const std::invalid_argument &e)
    {
      throw wrong(file, object, std::string("cannot be used: ") + e.what(), program);
    }
}

void require_phases(const Hdf5File &file,
                    const std::string &dataset,
                    const std::vector<std::uint8_t> &id,
                    const std::size_t n,
                    const std::string &program)
{
  if (std::any_of(id.begin(), id.end(), [n](const std::uint8_t p) { return p >= n; }))
    throw wrong(file, dataset, "names a phase that the file does not have", program);
}

std::vector<Phase<2>> read_phases(const Hdf5File &file,
                                  const std::string &group,
                                  const bool with_friction,
                                  const std::string &program)
{
  const std::string hint = program + " writes it";
  const auto names       = file.read<std::string>(group + "/name", {}, hint);
  const std::size_t n    = names.size();
  const auto D           = file.read<double>(group + "/stiffness", {n, 3, 3}, hint);
  file.require_unit(group + "/stiffness", "Pa");
  if (n == 0)
    throw wrong(file, group + "/name", "is empty", program);
  std::vector<Phase<2>> phases(n);
  for (std::size_t p = 0; p < n; ++p)
    {
      phases[p].name      = names[p];
      phases[p].stiffness = Eigen::Map<const VoigtMatrix<2>>(D.data() + 9 * p);
      require_stiffness(file, group + "/stiffness of '" + names[p] + "'",
                        phases[p].stiffness, program);
    }
  for (std::size_t k = 0; k < (with_friction ? 2 : 1); ++k)
    {
      const PhaseNumber &number = phase_numbers[k];
      const std::string dataset = group + number.name;
      const auto values         = file.read<double>(dataset, {n}, hint);
      file.require_unit(dataset, number.unit);
      for (std::size_t p = 0; p < n; ++p)
        if (!((phases[p].*number.member = values[p]) >= 0.))
          throw wrong(file, dataset, "holds a negative value", program);
    }
  return phases;
}

void write_phases(Hdf5File &file,
                  const std::string &group,
                  const std::vector<Phase<2>> &phases,
                  const bool with_friction)
{
  const std::size_t n = phases.size();
  std::vector<std::string> names;
  std::vector<double> stiffness;
  for (const Phase<2> &phase : phases)
    {
      names.push_back(phase.name);
      stiffness.insert(stiffness.end(), phase.stiffness.data(),
                       phase.stiffness.data() + phase.stiffness.size());
    }
  write_dataset(file, group + "/name", {n}, names);
  write_dataset(file, group + "/stiffness", {n, 3, 3}, stiffness, "Pa");
  for (std::size_t k = 0; k < (with_friction ? 2 : 1); ++k)
    {
      std::vector<double> values;
      for (const Phase<2> &phase : phases)
        values.push_back(phase.*phase_numbers[k].member);
      write_dataset(file, group + phase_numbers[k].name, {n}, values,
                    phase_numbers[k].unit);
    }
}

XdmfGrid xdmf_grid(const UniformGrid<2> &grid)
{
  return {2,
          {{grid.cells[0], grid.cells[1], 1}},
          {{grid.origin[0], grid.origin[1], 0.}},
          {{grid.spacing[0], grid.spacing[1], 1.}}};
}

XdmfField xdmf_phases(const std::string &file, const std::string &dataset)
{
  XdmfField field;
  field.name    = "phase";
  field.file    = file;
  field.dataset = dataset;
  field.centre  = XdmfField::Centre::cell;
  field.number  = XdmfField::Number::uint8;
  return field;
}
} // namespace mesoslip
