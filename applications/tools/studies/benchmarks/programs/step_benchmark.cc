/**
 * How fast is a whole explicit time step? The fused uniform-grid stepper (free bottom and
 * top, damping on) on the paper's grid and on one beyond the caches, and beside it the
 * loop a general code would run: Trilinos CSR product and vector updates, in the same
 * process.
 *
 *   [mpirun -np n] step_benchmark [repetitions] [fine|coarse]
 *
 * Million cell updates per second of wall-clock time: median [lowest, highest].
 */
#include "body/grid_body.h"
#include "body/mesh/mesh_body.h"
#include "body/mesh/mesh_discretization.h"
#include "body/mesh/mesh_share.h"
#include "dynamics/grid/explicit_stepper.h"
#include "grid/halo.h"
#include "grid/row_partition.h"
#include "measuring.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <string>
#include <vector>

using namespace mesoslip;

namespace
{
constexpr double dt = 5e-9, beta = 4.4e-9, beta2 = 0.5, spacing = 1e-4;

/**
 * Prints million cell updates per second for @p n_steps steps in @p seconds, which are
 * ascending; returns the median.
 */
double report(const std::string &what,
              const std::array<unsigned int, 2> cells,
              const unsigned int n_steps,
              const std::vector<double> &seconds)
{
  const auto rate = [&](const double time) {
    return 1e-6 * cells[0] * cells[1] * n_steps / time;
  };
  const double median = rate(seconds[(seconds.size() - 1) / 2]);
  if (rank() == 0)
    std::printf("%5u x %4u  %-62s %7.1f  [%.1f, %.1f]\n", cells[0], cells[1],
                what.c_str(), median, rate(seconds.back()), rate(seconds.front()));
  std::fflush(stdout);
  return median;
}

UniformMaterial make_material(const std::array<unsigned int, 2> cells,
                              const unsigned int n_classes)
{
  const UniformGrid<2> grid{cells, {{spacing, spacing}}};
  VoigtMatrix<2> D;
  D << 33.3e9, 8.3e9, 0, 8.3e9, 33.3e9, 0, 0, 0, 12.5e9;
  std::vector<ElasticPhase<2>> classes;
  for (unsigned int c = 0; c < n_classes; ++c)
    classes.push_back({(1. + 0.02 * c) * D, 1500.});
  std::vector<std::uint8_t> ids;
  std::mt19937 generator(1);
  std::uniform_int_distribution<unsigned int> random(0, n_classes - 1);
  if (n_classes > 1)
    for (std::size_t i = 0; i < grid.n_cells(); ++i)
      ids.push_back(random(generator));
  return UniformMaterial(grid, classes, ids);
}

double fused(const std::array<unsigned int, 2> cells,
             const unsigned int n_classes,
             const unsigned int repetitions,
             const SweepOptions &options)
{
  const UniformMaterial material = make_material(cells, n_classes);
  const NodeRows rows =
    partition_rows(material.n_columns(), material.n_rows(), MPI_COMM_WORLD, options);
  NodalField<double> u(material.n_columns(), rows.n_local()), w(u);
  for (unsigned int l = 0; l < rows.n_local(); ++l)
    for (unsigned int i = 0; i < material.n_columns(); ++i)
      u.row(1, l)[i] = 1e-9 * std::sin(0.1 * i + 0.05 * (rows.first() + l));
  MPIHalo halo(material.n_columns(), rows.ghosts, MPI_COMM_WORLD);
  StepParameters step;
  step.dt    = dt;
  step.beta2 = beta2;
  step.beta  = beta;
  ExplicitStepper stepper(
    {material, step, u, w, nullptr, nullptr, rows, &halo, MPI_COMM_WORLD}, {}, options);
  const double n_cells     = material.grid().n_cells();
  const unsigned int depth = stepper.steps_at_once();
  const unsigned int n_steps =
    static_cast<unsigned int>(std::max(1., std::round(3e7 / n_cells / depth))) * depth;
  return report(stepper.kernel_name() + ", steps at once " + std::to_string(depth), cells,
                n_steps, measure([&]() { stepper.advance(n_steps); }, repetitions));
}

/** The loop of a general code on the same grid. */
double baseline(const std::array<unsigned int, 2> cells, const unsigned int repetitions)
{
  const UniformMaterial material = make_material(cells, 1);
  const GridBody<2> layout(material);
  const MeshDiscretization<2> mesh(whole_share(mesh_of_grid(material), MPI_COMM_WORLD),
                                   layout);
  MeshDiscretization<2>::Vector u(mesh.lumped_mass());
  u = 0.;
  MeshDiscretization<2>::Vector w(u), z(u), f(u), factor(u);
  for (const auto i : factor.locally_owned_elements())
    {
      factor[i] = -1. / mesh.lumped_mass()[i];
      u[i]      = 1e-9 * std::sin(0.1 * i);
    }
  factor.compress(dealii::VectorOperation::insert);
  u.compress(dealii::VectorOperation::insert);
  constexpr unsigned int n_steps = 20;
  const auto run                 = [&]() {
    for (unsigned int k = 0; k < n_steps; ++k)
      {
        z = u;
        z.add(beta, w);
        mesh.stiffness().vmult(f, z);
        f.scale(factor);
        w.add(dt, f);
        u.add(dt, w);
      }
  };
  return report("baseline: Trilinos CSR product, vector updates", cells, n_steps,
                measure(run, repetitions));
}

std::string processor()
{
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0)
      return line.substr(line.find(':') + 2);
  return "unknown processor";
}

int run(const int argc, char **argv)
{
  int n_ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  const unsigned int repetitions = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  const bool coarse_only         = argc > 2 && std::strcmp(argv[2], "coarse") == 0;
  const bool fine_only           = argc > 2 && std::strcmp(argv[2], "fine") == 0;
  if (rank() == 0)
    std::printf(
      "%s, GCC %s, %d rank%s; million cell updates/s: median [lowest, highest] of %u\n",
      processor().c_str(), __VERSION__, n_ranks, n_ranks > 1 ? "s" : "", repetitions);

  if (!fine_only)
    {
      const std::array<unsigned int, 2> paper = {{560, 160}};
      const double slow                       = baseline(paper, repetitions);
      for (const InstructionSet isa : available_instruction_sets())
        for (const unsigned int n_classes : {1, 2, 6, 14, 40})
          {
            SweepOptions options;
            options.isa           = isa;
            options.steps_at_once = 1;
            const double plain    = fused(paper, n_classes, repetitions, options);
            options.steps_at_once = 0;
            const double chosen   = fused(paper, n_classes, repetitions, options);
            if (rank() == 0 && n_classes == 1)
              std::printf("%75s %7.1f times the baseline\n", "",
                          std::max(plain, chosen) / slow);
          }
    }
  if (!coarse_only)
    for (const unsigned int n_classes : {1, 2, 40})
      for (const unsigned int depth : {1, 0})
        {
          SweepOptions options;
          options.steps_at_once = depth;
          fused({{4480, 1280}}, n_classes, std::max(3u, repetitions / 3), options);
        }
  return 0;
}
} // namespace

int main(int argc, char **argv)
{
  return mesoslip::guarded_main(argc, argv, "step_benchmark", run);
}
