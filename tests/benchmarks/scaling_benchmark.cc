/**
 * What a model of the run time needs, and what it has to predict. One line of CSV each.
 *
 *   scaling_benchmark stream <bytes>...
 *     updates in place: GB/s by working set
 *
 *   scaling_benchmark copy <bytes>...
 *     from one array of that size to another
 *
 *   mpirun -np 2 scaling_benchmark message <bytes>...
 *     half a round trip between two ranks
 *
 *   mpirun -np 2 scaling_benchmark halo <columns>:<rows>...
 *     two ranks exchange as many node rows, as between blocks of steps
 *
 *   [mpirun -np n] scaling_benchmark step <cells x>:<cells y>:<steps in flight>...
 *     0 steps in flight: automatic
 *
 * A step is that of a body on the flat with contact, friction and damping, without
 * observers. Times are wall-clock: median, lowest and highest of the repetitions.
 */
#include "../verification/sliding_body.h"
#include "guarded_main.h"

#include "grid/halo.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace verification;

namespace
{
// Many and short: on a machine that others use some of them run undisturbed.
constexpr unsigned int repetitions = 41;

int rank()
{
  int r = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r;
}

/** Seconds of @p run, ascending; all ranks start together. */
std::vector<double> measure(const std::function<void()> &run)
{
  run();
  std::vector<double> seconds;
  for (unsigned int r = 0; r < repetitions; ++r)
    {
      MPI_Barrier(MPI_COMM_WORLD);
      const double begin = MPI_Wtime();
      run();
      MPI_Barrier(MPI_COMM_WORLD);
      seconds.push_back(MPI_Wtime() - begin);
    }
  std::sort(seconds.begin(), seconds.end());
  return seconds;
}

/** Median, lowest, highest, each times @p factor. */
void print_times(const std::vector<double> &seconds, const double factor)
{
  std::printf("%.6g,%.6g,%.6g\n", factor * seconds[seconds.size() / 2],
              factor * seconds.front(), factor * seconds.back());
  std::fflush(stdout);
}

/** Reads and writes every number once, four arrays at a time, as the stepper does. */
void stream(const std::size_t bytes)
{
  // Not a power of two apart, as no rows of a grid should be.
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
  if (rank() == 0)
    {
      std::printf("%zu,", bytes);
      print_times(seconds, 1. / sweeps);
    }
}

void copy(const std::size_t bytes)
{
  const std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes);
  const unsigned int sweeps = std::max<std::size_t>(1, 20000000 / bytes);
  const auto seconds        = measure([&]() {
    for (unsigned int s = 0; s < sweeps; ++s)
      std::memcpy(to.data(), from.data(), bytes);
  });
  if (to[bytes / 2] != 1)
    throw std::runtime_error("copy lost its numbers");
  if (rank() == 0)
    {
      std::printf("%zu,", bytes);
      print_times(seconds, 1. / sweeps);
    }
}

/** One message to the other rank and one back, twenty times. */
void message(const std::size_t bytes)
{
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
  if (rank() == 0)
    {
      std::printf("%zu,", bytes);
      print_times(seconds, 0.5 / trips);
    }
}

void exchange(const unsigned int n_columns, const unsigned int n_rows)
{
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
  if (rank() == 0)
    {
      std::printf("%lu,", 4 * sizeof(double) * n_columns * n_rows);
      print_times(seconds, 1. / trips);
    }
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
  setup.top.kind              = TopSetup::Kind::platen;
  setup.top.pressure          = LoadHistory(5e6);
  setup.step.beta             = 4.4e-9;
  setup.step.dt               = 1e-8;
  setup.sweep.steps_at_once   = in_flight;
  return setup;
}

void step(const unsigned int nx, const unsigned int ny, const unsigned int in_flight)
{
  {
    // What any run brings along does not count as memory of the grid.
    Body small(sliding_body(16, 16, 1), MPI_COMM_WORLD);
    small.run(10);
  }
  const double before = resident_bytes();
  Body body(sliding_body(nx, ny, in_flight), MPI_COMM_WORLD);
  const double n_cells       = double(nx) * ny;
  const unsigned int depth   = body.stepper.steps_at_once();
  const unsigned int n_steps = std::max(1., std::round(1.5e6 / n_cells / depth)) * depth;
  const auto seconds         = measure([&]() { body.run(n_steps); });
  double bytes = resident_bytes() - before, all = 0.;
  MPI_Reduce(&bytes, &all, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  if (rank() == 0)
    {
      int ranks = 1;
      MPI_Comm_size(MPI_COMM_WORLD, &ranks);
      std::printf("%u,%u,%u,%d,%.0f,", nx, ny, depth, ranks, all);
      print_times(seconds, 1. / n_steps);
    }
}

void header(const char *columns)
{
  if (rank() == 0)
    std::printf("%s,seconds,seconds_low,seconds_high\n", columns);
}

int run(const int argc, char **argv)
{
  const std::string what = argc > 2 ? argv[1] : "";
  if (what == "stream")
    {
      header("bytes");
      for (int k = 2; k < argc; ++k)
        stream(std::stoul(argv[k]));
    }
  else if (what == "copy")
    {
      header("bytes");
      for (int k = 2; k < argc; ++k)
        copy(std::stoul(argv[k]));
    }
  else if (what == "message")
    {
      header("bytes");
      for (int k = 2; k < argc; ++k)
        message(std::stoul(argv[k]));
    }
  else if (what == "halo")
    {
      header("bytes");
      for (int k = 2; k < argc; ++k)
        {
          unsigned int n_columns = 0, n_rows = 0;
          if (std::sscanf(argv[k], "%u:%u", &n_columns, &n_rows) != 2)
            throw std::runtime_error(std::string("not columns:rows: ") + argv[k]);
          exchange(n_columns, n_rows);
        }
    }
  else if (what == "step")
    {
      header("nx,ny,in_flight,ranks,bytes");
      for (int k = 2; k < argc; ++k)
        {
          unsigned int nx = 0, ny = 0, depth = 0;
          if (std::sscanf(argv[k], "%u:%u:%u", &nx, &ny, &depth) != 3)
            throw std::runtime_error(std::string("not cells:cells:steps: ") + argv[k]);
          step(nx, ny, depth);
        }
    }
  else
    throw std::runtime_error("what? stream, copy, message, halo or step");
  return 0;
}
} // namespace

int main(int argc, char **argv)
{
  return mesoslip::guarded_main(argc, argv, "scaling_benchmark", run);
}
