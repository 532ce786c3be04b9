/**
 * Measurements for a model of the run time, and times to be predicted by it. One line of
 * CSV each.
 *
 *     scaling_benchmark stream <bytes>...
 *       updates in place: GB/s by working set
 *
 *     scaling_benchmark copy <bytes>...
 *       from one array of this size to another
 *
 *     mpirun -np 2 scaling_benchmark message <bytes>...
 *       half a round trip between two ranks
 *
 *     mpirun -np 2 scaling_benchmark halo <columns>:<rows>...
 *       two ranks exchange as many node rows, as between blocks of steps
 *
 *     [mpirun -np n] scaling_benchmark step <cells x>:<cells y>:<steps in flight>...
 *       0 steps in flight: automatic
 *
 *     [mpirun -np n] scaling_benchmark box <cells x>:<cells y>:<cells z>:<phases>...
 *       cubes in 3D, of one or two phases
 *
 *     scaling_benchmark units fma|add|mixed|load|store|cycle...
 *       instructions on vectors of 512 bits per nanosecond
 *
 * A step advances a body on the flat with contact, friction and damping, without
 * observers. Times are wall-clock: median, lowest and highest of the repetitions; cpu_s
 * is the least processor time of rank 0.
 */
#include "box_run.h"
#include "measuring.h"
#include "vector_units.h"
#include "verification/mesh_sliding/mesh_sliding.h"

#include "grid/halo.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace verification;

namespace
{
// Many short repetitions: some of them run undisturbed on a shared machine.
constexpr unsigned int repetitions = 41;

std::vector<double> measure(const std::function<void()> &run)
{
  return mesoslip::measure(run, repetitions);
}

/**
 * Prints a line: description; median, lowest, highest time, each multiplied by @p factor.
 */
void print(const std::string &what,
           const std::vector<double> &seconds,
           const double factor)
{
  if (rank() == 0)
    std::printf("%s,%.6g,%.6g,%.6g\n", what.c_str(), factor * seconds[seconds.size() / 2],
                factor * seconds.front(), factor * seconds.back());
  std::fflush(stdout);
}

/** Numbers of an argument, separated by colons. */
using Sizes = std::vector<unsigned long>;

/** Reads and writes every number once, four arrays at a time, like the stepper. */
void stream(const Sizes &sizes)
{
  const std::size_t bytes = sizes[0];
  // Distance not a power of two, as for rows of a grid.
  const std::size_t n = bytes / sizeof(double) / 4, apart = n + 72;
  std::vector<double> values(4 * apart, 1.);
  const unsigned int sweeps = std::max<std::size_t>(1, 20000000 / bytes);
  const auto seconds        = measure([&]() {
    for (unsigned int s = 0; s < sweeps; ++s)
      {
        double *v = values.data();
        for (std::size_t k = 0; k < n; ++k)
          for (std::size_t array = 0; array < 4; ++array)
            v[k + array * apart] = 0.5 * v[k + array * apart] + 0.5;
      }
  });
  if (values[values.size() / 2] != 1.)
    throw std::runtime_error("stream lost its numbers");
  print(std::to_string(bytes), seconds, 1. / sweeps);
}

void copy(const Sizes &sizes)
{
  const std::size_t bytes = sizes[0];
  const std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes);
  const unsigned int sweeps = std::max<std::size_t>(1, 20000000 / bytes);
  const auto seconds        = measure([&]() {
    for (unsigned int s = 0; s < sweeps; ++s)
      std::memcpy(to.data(), from.data(), bytes);
  });
  if (to[bytes / 2] != 1)
    throw std::runtime_error("copy lost its numbers");
  print(std::to_string(bytes), seconds, 1. / sweeps);
}

/** Twenty round trips of a message between two ranks. */
void message(const Sizes &sizes)
{
  const std::size_t bytes = sizes[0];
  std::vector<char> buffer(bytes);
  constexpr unsigned int trips = 20;
  const int other              = 1 - rank();
  const auto seconds           = measure([&]() {
    for (unsigned int k = 0; k < trips; ++k)
      for (const int sender : {0, 1})
        if (rank() == sender)
          MPI_Send(buffer.data(), bytes, MPI_BYTE, other, 0, MPI_COMM_WORLD);
        else
          MPI_Recv(buffer.data(), bytes, MPI_BYTE, other, 0, MPI_COMM_WORLD,
                             MPI_STATUS_IGNORE);
  });
  print(std::to_string(bytes), seconds, 0.5 / trips);
}

void exchange(const Sizes &sizes)
{
  const unsigned int n_columns = sizes[0], n_rows = sizes[1];
  NodalField<double> u(n_columns, 2 * n_rows), w(n_columns, 2 * n_rows);
  MPIHalo halo(n_columns, n_rows, MPI_COMM_WORLD);
  const auto block = [&](const unsigned int first) {
    return RowBlock{u.row(0, first), u.row(1, first), w.row(0, first),
                    w.row(1, first), u.stride(),      n_rows};
  };
  const Halo::Side side        = rank() == 0 ? Halo::upper : Halo::lower;
  constexpr unsigned int trips = 100;
  const auto seconds           = measure([&]() {
    for (unsigned int k = 0; k < trips; ++k)
      {
        halo.send(side, block(0));
        halo.receive(side, block(n_rows));
      }
  });
  print(std::to_string(4 * sizeof(double) * n_columns * n_rows), seconds, 1. / trips);
}

/** Resident memory of this process (bytes); Linux. */
double resident_bytes()
{
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("VmRSS:", 0) == 0)
      return 1024. * std::stod(line.substr(6));
  return 0.;
}

BodySetup
sliding_body(const unsigned int nx, const unsigned int ny, const unsigned int in_flight)
{
  BodySetup setup;
  setup.cells                 = {{nx, ny}};
  setup.spacing               = {{1e-4, 1e-4}};
  setup.classes               = {resin()};
  setup.friction              = 0.25;
  setup.contact.law.time      = 1.5e-6;
  setup.contact.flat_velocity = LoadHistory(2.);
  setup.top.is_platen         = true;
  setup.top.pressure          = LoadHistory(5e6);
  setup.step.beta             = 4.4e-9;
  setup.step.dt               = 1e-8;
  setup.sweep.steps_at_once   = in_flight;
  return setup;
}

void step(const Sizes &sizes)
{
  {
    // The memory of a small run is subtracted.
    Body small(sliding_body(16, 16, 1), MPI_COMM_WORLD);
    small.run(10);
  }
  const double before = resident_bytes();
  Body body(sliding_body(sizes[0], sizes[1], sizes[2]), MPI_COMM_WORLD);
  const double n_cells       = double(sizes[0]) * sizes[1];
  const unsigned int depth   = body.stepper.steps_at_once();
  const unsigned int n_steps = std::max(1., std::round(1.5e6 / n_cells / depth)) * depth;
  const auto seconds         = measure([&]() { body.run(n_steps); });
  double bytes = resident_bytes() - before, all = 0.;
  MPI_Reduce(&bytes, &all, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::ostringstream what;
  what << sizes[0] << ',' << sizes[1] << ',' << depth << ',' << ranks << ','
       << std::lround(all);
  print(what.str(), seconds, 1. / n_steps);
}

/** Memory of all ranks, minus the memory of a small box. */
void box(const Sizes &sizes)
{
  std::vector<ElasticPhase<3>> phases = two_phases<3>();
  phases.resize(sizes[3]);
  const auto make = [&](const std::array<unsigned int, 3> &n) {
    return std::make_unique<BoxRun>(cubes(n), phases, MPI_COMM_WORLD);
  };
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  make({{8, 8, 8}})->body.stepper.advance(2);
  const double before = resident_bytes();
  const auto run =
    make({{static_cast<unsigned int>(sizes[0]), static_cast<unsigned int>(sizes[1]),
           static_cast<unsigned int>(sizes[2])}});
  const double n_cells       = double(sizes[0]) * sizes[1] * sizes[2];
  const unsigned int n_steps = std::max(1., std::round(1e6 / n_cells));
  double cpu                 = std::numeric_limits<double>::infinity();
  const auto seconds         = mesoslip::measure(
    [&]() {
      const std::clock_t begin = std::clock();
      run->body.stepper.advance(n_steps);
      cpu = std::min(cpu, double(std::clock() - begin) / CLOCKS_PER_SEC / n_steps);
    },
    n_cells > 4e6 ? 9 : repetitions);
  double bytes = resident_bytes() - before, all = 0.;
  MPI_Reduce(&bytes, &all, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  std::ostringstream what;
  what << sizes[0] << ',' << sizes[1] << ',' << sizes[2] << ',' << sizes[3] << ','
       << ranks << ',' << std::lround(all) << ',' << cpu;
  print(what.str(), seconds, 1. / n_steps);
}

Sizes sizes_of(std::string text)
{
  std::replace(text.begin(), text.end(), ':', ' ');
  std::istringstream words(text);
  Sizes sizes;
  for (unsigned long n = 0; words >> n;)
    sizes.push_back(n);
  return sizes;
}

struct Benchmark
{
  const char *columns; ///< columns before the times
  std::size_t n_sizes; ///< number of sizes in an argument
  void (*run)(const Sizes &);
};

int run(const int argc, char **argv)
{
  const std::map<std::string, Benchmark> benchmarks = {
    {"stream", {"bytes", 1, stream}},
    {"copy", {"bytes", 1, copy}},
    {"message", {"bytes", 1, message}},
    {"halo", {"bytes", 2, exchange}},
    {"step", {"nx,ny,in_flight,ranks,bytes", 3, step}},
    {"box", {"nx,ny,nz,phases,ranks,bytes,cpu_s", 4, box}}};
  if (argc > 2 && std::string(argv[1]) == "units")
    {
      std::printf("kind,per_ns\n");
      for (int k = 2; k < argc; ++k)
        std::printf("%s,%.6g\n", argv[k], instructions_per_ns(argv[k]));
      return 0;
    }
  const auto chosen = benchmarks.find(argc > 2 ? argv[1] : "");
  if (chosen == benchmarks.end())
    throw std::runtime_error("what? stream, copy, message, halo, step, box or units");
  const Benchmark &benchmark = chosen->second;
  if (rank() == 0)
    std::printf("%s,seconds,seconds_low,seconds_high\n", benchmark.columns);
  for (int k = 2; k < argc; ++k)
    {
      const Sizes sizes = sizes_of(argv[k]);
      if (sizes.size() != benchmark.n_sizes)
        throw std::runtime_error(std::string("not as many sizes as needed: ") + argv[k]);
      benchmark.run(sizes);
    }
  return 0;
}
} // namespace

int main(int argc, char **argv)
{
  return mesoslip::guarded_main(argc, argv, "scaling_benchmark", run);
}
