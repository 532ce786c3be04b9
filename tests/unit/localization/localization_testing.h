#ifndef mesoslip_tests_unit_localization_testing_h
#define mesoslip_tests_unit_localization_testing_h

#include "../io/io_testing.h"
#include "exchange/datasets.h"
#include "exchange/rve_file.h"
#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "localization/localization_program.h"
#include "material/stiffness.h"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace mesoslip_tests
{
using namespace mesoslip;

inline UniformGrid<2> make_grid(const unsigned int nx, const unsigned int ny)
{
  return {{{nx, ny}}, {{6e-3 / nx, 4e-3 / ny}}};
}

/** Displacement [ny + 1][nx + 1][2] of a function of (x, y). */
inline std::vector<double>
nodal(const UniformGrid<2> &grid,
      const std::function<std::array<double, 2>(double, double)> &u)
{
  std::vector<double> values;
  for (unsigned int j = 0; j <= grid.cells[1]; ++j)
    for (unsigned int i = 0; i <= grid.cells[0]; ++i)
      {
        const auto value = u(i * grid.spacing[0], j * grid.spacing[1]);
        values.insert(values.end(), value.begin(), value.end());
      }
  return values;
}

/** Displacement of a uniform strain, with some rigid motion. */
inline std::vector<double> uniform_strain(const UniformGrid<2> &grid,
                                          const double xx,
                                          const double yy,
                                          const double xy)
{
  return nodal(grid, [=](const double x, const double y) {
    const double turn = 1e-3;
    return std::array<double, 2>{
      {1e-5 + xx * x + (0.5 * xy - turn) * y, -2e-5 + (0.5 * xy + turn) * x + yy * y}};
  });
}

/** The materials of the tests. */
inline std::vector<Phase<2>> test_phases()
{
  return {{"matrix", isotropic_stiffness<2>(30e9, 0.2), 1700., 0.2},
          {"fibre", isotropic_stiffness<2>(240e9, 0.3), 2400., 0.3}};
}

/** All cells of a grid. */
template <int dim>
CellBlock<dim> all_cells(const UniformGrid<dim> &grid)
{
  return {{}, grid.cells};
}

/** The content of a small rve.h5: two isotropic phases, L with mean one. */
struct TestRve
{
  UniformGrid<2> grid = make_grid(6, 4);
  std::vector<std::uint8_t> phase;
  std::array<VoigtMatrix<2>, 2> stiffness = {
    {test_phases()[0].stiffness, test_phases()[1].stiffness}};
  std::vector<double> L;

  TestRve()
  {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> number(-0.5, 0.5);
    for (std::size_t k = 0; k < grid.n_cells(); ++k)
      phase.push_back(k % 5 == 1 ? 1 : 0);
    for (std::size_t k = 0; k < 9 * grid.n_cells(); ++k)
      L.push_back(number(generator));
    for (unsigned int c = 0; c < 9; ++c)
      {
        double mean = 0.;
        for (std::size_t k = 0; k < grid.n_cells(); ++k)
          mean += L[9 * k + c] / static_cast<double>(grid.n_cells());
        for (std::size_t k = 0; k < grid.n_cells(); ++k)
          L[9 * k + c] += (c % 4 == 0 ? 1. : 0.) - mean;
      }
  }

  /** C_phase L, or C_phase alone, of a cell. */
  VoigtMatrix<2> matrix(const std::size_t cell, const bool with_L = true) const
  {
    VoigtMatrix<2> M = stiffness[phase[cell]];
    if (with_L)
      M = M * Eigen::Map<const VoigtMatrix<2>>(L.data() + 9 * cell);
    return M;
  }

  void write(const std::string &path) const
  {
    RveContent<2> content;
    content.digest   = "0123456789abcdef";
    content.grid     = grid;
    content.phases   = test_phases();
    content.phase_id = phase;
    content.reserved = {"KUBC"};
    reserve_concentration<2>(path, shape_of_cells(grid), content.reserved);
    Hdf5File file = Hdf5File::resume(path);
    file.write_row(concentration_dataset("KUBC"), 0, L);
    file.leave();
    write_rve_file<2>(path, content);
  }
};

/** One probe of a run. */
struct TestProbe
{
  std::string name;
  std::vector<double> position;
  std::vector<double> time;
  std::vector<double> strain;
  std::vector<double> stress;
};

/** Of a run that is steady from its start. */
inline RunConditions steady_conditions()
{
  return {{"analysis", "transient"}, {"pressure", 5e6}, {"steady_from", 0.}};
}

/** A dynamics.h5 as far as the localization reads it. */
inline void
write_run(const std::string &path,
          const UniformGrid<2> &grid,
          const std::vector<double> &times,
          const std::vector<std::vector<double>> &snapshots,
          const std::vector<TestProbe> &probes           = {},
          const std::string &rve_digest                  = "0123456789abcdef",
          const std::vector<std::uint8_t> &phase         = {},
          const std::optional<RunConditions> &conditions = steady_conditions())
{
  Hdf5File file = Hdf5File::create(path);
  file.write_header("mesoslip-dynamics", 1, 2, "fedcba9876543210");
  write_grid(file, grid);
  if (conditions)
    write_run_conditions(file, *conditions);
  // Without the phases of cells the body is of the first one alone.
  write_phases<2>(file, "/material", test_phases(), false);
  file.write_attribute("/material", "rve_digest", rve_digest);
  if (!phase.empty())
    file.write("/material/phase_id", {grid.cells[1], grid.cells[0]}, phase);
  if (!snapshots.empty())
    {
      std::vector<double> all;
      for (const auto &snapshot : snapshots)
        all.insert(all.end(), snapshot.begin(), snapshot.end());
      file.write("/snapshots/time", {times.size()}, times);
      file.write("/snapshots/displacement",
                 {snapshots.size(), std::size_t(grid.cells[1]) + 1,
                  std::size_t(grid.cells[0]) + 1, 2},
                 all);
    }
  for (const TestProbe &probe : probes)
    {
      const std::string group = "/probes/" + probe.name;
      write_series(file, group,
                   {{"time", "s", &probe.time},
                    {"strain", "-", &probe.strain, 3},
                    {"stress", "Pa", &probe.stress, 3}});
      file.write_attribute(group, "position", probe.position);
    }
  file.close();
}

/** Files and input of a localization on one rank. */
struct OpenedInput
{
  explicit OpenedInput(const LocalizationParameters &parameters)
    : files(parameters, true)
    , input(parameters, files)
  {
  }

  /** Localizes; what is told is in the input. */
  LocalizationResult localize()
  {
    return mesoslip::localize(input.parameters, files, input.plan, &input, MPI_COMM_SELF);
  }

  const LocalizationFiles<2> files;
  LocalizationInput<2> input;
};

/** The result; adds warnings and notes to @p told. */
inline LocalizationResult localize(const LocalizationParameters &parameters,
                                   std::string *told = nullptr)
{
  OpenedInput opened(parameters);
  const LocalizationResult result = opened.localize();
  for (const auto *sentences : {&opened.input.warnings, &opened.input.notes})
    for (const std::string &sentence : *sentences)
      if (told != nullptr)
        *told += sentence + "\n";
  return result;
}

/** A folder with an RVE and a homogeneous run of uniform strain. */
struct Case
{
  TemporaryFolder folder;
  TestRve rve;
  VoigtVector<2> strain = VoigtVector<2>(1e-4, -3e-4, 2e-4);

  Case()
  {
    rve.write(folder / "rve.h5");
    write_run(folder / "homogeneous.h5", make_grid(3, 2), {0.}, {state(make_grid(3, 2))},
              {probe("A", 1.)});
  }

  /** The tensors L of the RVE file are replaced by the identity. */
  void write_identity()
  {
    for (std::size_t k = 0; k < rve.L.size(); ++k)
      rve.L[k] = k % 9 % 4 == 0 ? 1. : 0.;
    rve.write(folder / "rve.h5");
  }

  /** The phases of cells that divide those of the volume. */
  std::vector<std::uint8_t> refined_phase(const UniformGrid<2> &fine) const
  {
    const unsigned int nx = fine.cells[0] / rve.grid.cells[0],
                       ny = fine.cells[1] / rve.grid.cells[1];
    std::vector<std::uint8_t> phase;
    for (unsigned int j = 0; j < fine.cells[1]; ++j)
      for (unsigned int i = 0; i < fine.cells[0]; ++i)
        phase.push_back(rve.phase[j / ny * rve.grid.cells[0] + i / nx]);
    return phase;
  }

  /** Displacement of the strain, times @p factor. */
  std::vector<double> state(const UniformGrid<2> &grid, const double factor = 1.) const
  {
    return uniform_strain(grid, factor * strain[0], factor * strain[1],
                          factor * strain[2]);
  }

  /** In the centre of cell 1, which is a fibre; two samples. */
  TestProbe probe(const std::string &name, const double factor) const
  {
    TestProbe p{name, {1.5e-3, 0.5e-3}, {0., 1.}, {}, {}};
    for (const double scale : {factor, 2. * factor})
      for (unsigned int c = 0; c < 3; ++c)
        {
          p.strain.push_back(scale * strain[c]);
          p.stress.push_back(scale * (rve.matrix(1) * strain)[c]);
        }
    return p;
  }

  /** Everything asked for, all of the time. */
  LocalizationParameters request() const
  {
    LocalizationParameters parameters;
    parameters.rve_file        = folder / "rve.h5";
    parameters.homogeneous_run = folder / "homogeneous.h5";
    parameters.from = parameters.to = std::numeric_limits<double>::quiet_NaN();
    return parameters;
  }
};
} // namespace mesoslip_tests

#endif
