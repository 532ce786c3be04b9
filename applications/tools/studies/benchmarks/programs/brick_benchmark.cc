/**
 * Benchmark of a contact step on boxes of cubes. Alternates with a mesh of as many
 * shifted hexahedra, and with a program that uses a Trilinos CSR matrix in place of a
 * kernel.
 *
 *     [mpirun -np n] brick_benchmark <kind>:<cells along an edge>...
 *
 * Kinds: homogeneous, two (isotropic phases at random), anisotropic (the second phase
 * is). Mesh and matrix have at most 48 cells along an edge. Each argument gives one line
 * of CSV: wall-clock seconds of a step, median, lowest and highest, for rank 0 alone, for
 * all ranks together, and for all ranks with one body each.
 */
#include "verification/mesh_sliding/mesh_sliding.h"

#include "box_run.h"
#include "matrix_step.h"
#include "measuring.h"

#include <stdexcept>
#include <string>

using namespace verification;

namespace
{
constexpr unsigned int repetitions = 9, most_of_mesh = 48;

std::vector<ElasticPhase<3>> phases_of(const std::string &kind)
{
  std::vector<ElasticPhase<3>> phases = two_phases<3>();
  if (kind == "homogeneous")
    phases.pop_back();
  else if (kind == "anisotropic")
    phases[1].stiffness(0, 3) = phases[1].stiffness(3, 0) =
      0.01 * phases[1].stiffness(0, 0);
  else if (kind != "two")
    throw std::runtime_error("not a kind: " + kind);
  return phases;
}

/** Mesh of shifted hexahedra. */
MeshCase<3> shifted(const unsigned int n)
{
  MeshCase<3> c;
  c.mesh = brick<3>({{n, n, n}}, {{0.1, 0.1, 0.1}}, {false, 0.2});
  for (std::size_t k = 0; k < c.mesh.cells.size(); ++k)
    c.mesh.cells[k].material_id = k % 4 == 0;
  c.phases                      = two_phases<3>();
  c.friction                    = 0.3;
  c.setup.step.dt               = 1e-10;
  c.setup.top.pressure          = LoadHistory(1e6);
  c.setup.contact.flat_velocity = LoadHistory(1.);
  c.setup.history_interval      = 0;
  return c;
}

/** ",median,lowest,highest" for this number of cells. */
std::string rates(std::vector<double> seconds, const double cells)
{
  std::sort(seconds.begin(), seconds.end());
  char line[99];
  std::snprintf(line, sizeof line, ",%.6g,%.6g,%.6g",
                1e-6 * cells / seconds[seconds.size() / 2], 1e-6 * cells / seconds.back(),
                1e-6 * cells / seconds.front());
  return line;
}

void run_kind(const std::string &kind, const unsigned int n)
{
  const auto phases    = phases_of(kind);
  const unsigned int m = std::min(n, most_of_mesh), steps = n > 200   ? 2
                                                            : n > 100 ? 6
                                                                      : 40;
  const double cells = 1. * n * n * n, of_mesh = 1. * m * m * m;
  const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  std::unique_ptr<BoxRun> all;
  if (ranks > 1)
    all = std::make_unique<BoxRun>(cubes({{n, n, n}}), phases, MPI_COMM_WORLD);
  BoxRun own(cubes({{n, n, n}}), phases, MPI_COMM_SELF);
  std::unique_ptr<MeshRun<3>> mesh;
  std::unique_ptr<MatrixStep<3>> matrix;
  if (rank() == 0)
    {
      mesh   = std::make_unique<MeshRun<3>>(shifted(m), MPI_COMM_SELF);
      matrix = std::make_unique<MatrixStep<3>>(shifted(m));
    }
  const std::vector<std::function<void()>> turns = {
    [&]() { rank() == 0 ? own.body.stepper.advance(steps) : void(); },
    [&]() { mesh ? mesh->body.stepper.advance(steps) : void(); },
    [&]() {
      for (unsigned int k = 0; k < steps && matrix; ++k)
        matrix->advance();
    },
    [&]() { all ? all->body.stepper.advance(steps) : void(); },
    [&]() { own.body.stepper.advance(steps); }};
  std::vector<std::vector<double>> seconds(turns.size());
  for (unsigned int r = 0; r < repetitions; ++r)
    for (std::size_t k = 0; k < turns.size(); ++k)
      seconds[k].push_back(measure(turns[k], 1)[0] / steps);
  if (rank() == 0)
    std::printf("%s,%u,%u%s%s%s%s%s\n", kind.c_str(), n, ranks,
                rates(seconds[0], cells).c_str(), rates(seconds[1], of_mesh).c_str(),
                rates(seconds[2], of_mesh).c_str(), rates(seconds[3], cells).c_str(),
                rates(seconds[4], cells).c_str());
  std::fflush(stdout);
}

int run(int argc, char **argv)
{
  if (rank() == 0)
    {
      std::printf("kind,edge,ranks");
      for (const char *what : {"box", "mesh", "matrix", "all_ranks", "side_by_side"})
        std::printf(",%s,%s_low,%s_high", what, what, what);
      std::printf("\n");
    }
  for (int k = 1; k < argc; ++k)
    {
      const std::string argument = argv[k];
      const auto colon           = argument.find(':');
      if (colon == std::string::npos)
        throw std::runtime_error("not a kind and a number of cells: " + argument);
      run_kind(argument.substr(0, colon), std::stoi(argument.substr(colon + 1)));
    }
  return 0;
}
} // namespace

int main(int argc, char **argv)
{
  return mesoslip::guarded_main(argc, argv, "brick_benchmark", run);
}
