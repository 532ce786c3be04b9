#include "exchange/datasets.h"

#include "base/errors.h"
#include "io/table.h"
#include "material/stiffness.h"

#include <algorithm>
#include <array>
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

/** A number per phase with its own dataset; some files lack the last one. */
template <int dim>
struct PhaseNumber
{
  const char *name, *unit;
  double Phase<dim>::*member;
};

template <int dim>
const PhaseNumber<dim> phase_numbers[] = {
  {"/density", "kg/m^3", &Phase<dim>::density},
  {"/friction_coefficient", "-", &Phase<dim>::friction_coefficient}};
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

template <int dim>
UniformGrid<dim> read_grid(const Hdf5File &file, const std::string &program)
{
  using Numbers          = std::array<double, dim>;
  using Counts           = std::array<unsigned int, dim>;
  const std::string hint = program + " writes it";
  UniformGrid<dim> grid;
  grid.cells   = file.read_attribute<Counts>("/grid", "cells", hint);
  grid.spacing = file.read_attribute<Numbers>("/grid", "spacing", hint);
  grid.origin  = file.read_attribute<Numbers>("/grid", "origin", hint);
  for (unsigned int d = 0; d < dim; ++d)
    if (grid.cells[d] == 0 || grid.cells[d] > 1000000 || !(grid.spacing[d] > 0.))
      throw wrong(file, "/grid", "has sizes that make no sense", program);
  return grid;
}

template <int dim>
void write_grid(Hdf5File &file, const UniformGrid<dim> &grid)
{
  file.write_attribute("/grid", "cells", grid.cells);
  file.write_attribute("/grid", "spacing", grid.spacing);
  file.write_attribute("/grid", "origin", grid.origin);
}

template <int dim>
void require_stiffness(const Hdf5File &file,
                       const std::string &object,
                       const VoigtMatrix<dim> &D,
                       const std::string &program)
{
  try
    {
      check_stiffness<dim>(D);
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

template <int dim>
std::vector<Phase<dim>> read_phases(const Hdf5File &file,
                                    const std::string &group,
                                    const bool with_friction,
                                    const std::string &program)
{
  const std::string hint  = program + " writes it";
  const auto names        = file.read<std::string>(group + "/name", {}, hint);
  const std::size_t n     = names.size();
  constexpr std::size_t v = n_voigt<dim>;
  const auto D            = file.read<double>(group + "/stiffness", {n, v, v}, hint);
  file.require_unit(group + "/stiffness", "Pa");
  if (n == 0)
    throw wrong(file, group + "/name", "is empty", program);
  std::vector<Phase<dim>> phases(n);
  for (std::size_t p = 0; p < n; ++p)
    {
      phases[p].name      = names[p];
      phases[p].stiffness = Eigen::Map<const VoigtMatrix<dim>>(D.data() + v * v * p);
      require_stiffness<dim>(file, group + "/stiffness of '" + names[p] + "'",
                             phases[p].stiffness, program);
    }
  for (std::size_t k = 0; k < (with_friction ? 2 : 1); ++k)
    {
      const PhaseNumber<dim> &number = phase_numbers<dim>[k];
      const std::string dataset      = group + number.name;
      const auto values              = file.read<double>(dataset, {n}, hint);
      file.require_unit(dataset, number.unit);
      for (std::size_t p = 0; p < n; ++p)
        if (!((phases[p].*number.member = values[p]) >= 0.))
          throw wrong(file, dataset, "holds a negative value", program);
    }
  return phases;
}

template <int dim>
void write_phases(Hdf5File &file,
                  const std::string &group,
                  const std::vector<Phase<dim>> &phases,
                  const bool with_friction)
{
  const std::size_t n = phases.size();
  std::vector<std::string> names;
  std::vector<double> stiffness;
  for (const Phase<dim> &phase : phases)
    {
      names.push_back(phase.name);
      stiffness.insert(stiffness.end(), phase.stiffness.data(),
                       phase.stiffness.data() + phase.stiffness.size());
    }
  write_dataset(file, group + "/name", {n}, names);
  write_dataset(file, group + "/stiffness", {n, n_voigt<dim>, n_voigt<dim>}, stiffness,
                "Pa");
  for (std::size_t k = 0; k < (with_friction ? 2 : 1); ++k)
    {
      std::vector<double> values;
      for (const Phase<dim> &phase : phases)
        values.push_back(phase.*phase_numbers<dim>[k].member);
      write_dataset(file, group + phase_numbers<dim>[k].name, {n}, values,
                    phase_numbers<dim>[k].unit);
    }
}

template void require_stiffness<2>(const Hdf5File &,
                                   const std::string &,
                                   const VoigtMatrix<2> &,
                                   const std::string &);
template void require_stiffness<3>(const Hdf5File &,
                                   const std::string &,
                                   const VoigtMatrix<3> &,
                                   const std::string &);
template UniformGrid<2> read_grid(const Hdf5File &, const std::string &);
template UniformGrid<3> read_grid(const Hdf5File &, const std::string &);
template void write_grid(Hdf5File &, const UniformGrid<2> &);
template void write_grid(Hdf5File &, const UniformGrid<3> &);
template std::vector<Phase<3>>
read_phases<3>(const Hdf5File &, const std::string &, const bool, const std::string &);
template std::vector<Phase<2>>
read_phases<2>(const Hdf5File &, const std::string &, const bool, const std::string &);
template void write_phases<2>(Hdf5File &,
                              const std::string &,
                              const std::vector<Phase<2>> &,
                              const bool);
template void write_phases<3>(Hdf5File &,
                              const std::string &,
                              const std::vector<Phase<3>> &,
                              const bool);
} // namespace mesoslip
