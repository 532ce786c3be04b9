/**
 * Benchmark of load cases for a volume of voxels with overlapping spheres, 30 %.
 *
 *     mpirun -np [ranks] voxel_benchmark [cells] [contrast] [KUBC|SUBC|PBC] [load cases]
 *       [nu of the matrix] [h_z / h_x]
 *
 * Prints a line of CSV: iterations of each load case; wall-clock seconds of set-up and of
 * everything; processor seconds of all ranks; memory of the largest rank. The stiffness
 * (GPa) is added after six load cases.
 */
#include "material/stiffness.h"
#include "measuring.h"
#include "statics/voxel/solver.h"

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <random>
#include <string>

using namespace mesoslip;

namespace
{
/** Overlapping spheres in a periodic box of @p cells that fill 30 %. */
PhaseMap<3> spheres(const std::array<unsigned int, 3> cells, const double aspect)
{
  PhaseMap<3> map{{cells, {{1e-6, 1e-6, 1e-6 * aspect}}, {}}, {}};
  map.id.assign(map.grid.n_cells(), 0);
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform;
  std::size_t filled = 0;
  while (filled < 0.3 * map.id.size())
    {
      const double centre[3] = {uniform(generator), uniform(generator),
                                uniform(generator)};
      std::size_t cell       = 0;
      for (unsigned int k = 0; k < cells[2]; ++k)
        for (unsigned int j = 0; j < cells[1]; ++j)
          for (unsigned int i = 0; i < cells[0]; ++i, ++cell)
            {
              const unsigned int place[3] = {i, j, k};
              double square               = 0.;
              for (unsigned int d = 0; d < 3; ++d)
                {
                  const double x = std::abs((place[d] + 0.5) / cells[d] - centre[d]);
                  square += std::pow(std::min(x, 1. - x), 2);
                }
              if (square < 0.16 * 0.16 && map.id[cell] == 0)
                {
                  map.id[cell] = 1;
                  ++filled;
                }
            }
    }
  return map;
}

double cpu_seconds()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

/** Peak resident memory (MB). */
double memory()
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0)
      return std::atof(line.c_str() + 6) / 1024.;
  return 0.;
}

int run(const int argc, char **argv)
{
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const auto n            = static_cast<unsigned int>(argc > 1 ? std::atoi(argv[1]) : 64);
  const double contrast   = argc > 2 ? std::atof(argv[2]) : 8.;
  const std::string sides = argc > 3 ? argv[3] : "PBC";
  const auto n_cases      = static_cast<unsigned int>(argc > 4 ? std::atoi(argv[4]) : 6);
  const double nu         = argc > 5 ? std::atof(argv[5]) : 0.3;
  const double aspect     = argc > 6 ? std::atof(argv[6]) : 1.;
  const PhaseMap<3> map   = spheres({{n, n, n}}, aspect);
  const double before     = cpu_seconds();
  const auto start        = std::chrono::steady_clock::now();
  const auto seconds      = [&]() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
  };
  voxel::Solver solver(
    map, {isotropic_stiffness<3>(1e9, nu), isotropic_stiffness<3>(contrast * 1e9, 0.2)},
    sides == "KUBC"   ? voxel::Sides::held
    : sides == "SUBC" ? voxel::Sides::free
                      : voxel::Sides::periodic,
    MPI_COMM_WORLD);
  const double set_up = seconds();
  std::string iterations;
  for (unsigned int k = 0; k < n_cases; ++k)
    iterations += (k > 0 ? " " : "") + std::to_string(solver.solve(k, 1e-8).iterations);
  double C11 = std::nan(""), C44 = C11;
  if (n_cases == 6)
    {
      const VoigtMatrix<3> effective = solver.effective_stiffness();
      C11                            = 1e-9 * effective(0, 0);
      C44                            = 1e-9 * effective(3, 3);
    }
  using dealii::Utilities::MPI::max;
  using dealii::Utilities::MPI::sum;
  const double all = seconds(), cpu = sum(cpu_seconds() - before, MPI_COMM_WORLD),
               most = max(memory(), MPI_COMM_WORLD);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::printf("ranks,n,contrast,sides,load_cases,nu,aspect,iterations,set_up_s,seconds,"
                "cpu_s,memory_MB,C11,C44\n%u,%u,%g,%s,%u,%g,%g,%s,%.4g,%.4g,%.4g,%.0f,"
                "%.8g,%.8g\n",
                n_ranks, n, contrast, sides.c_str(), n_cases, nu, aspect,
                iterations.c_str(), set_up, all, cpu, most, C11, C44);
  return 0;
}
} // namespace

int main(int argc, char **argv)
{
  return mesoslip::guarded_main(argc, argv, "voxel_benchmark", run);
}
