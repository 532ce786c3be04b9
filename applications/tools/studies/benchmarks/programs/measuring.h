#ifndef mesoslip_tests_benchmarks_measuring_h
#define mesoslip_tests_benchmarks_measuring_h

#include "base/flush_denormals.h"

#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <vector>

namespace mesoslip
{
/** Number of this process. */
inline int rank()
{
  int r = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r;
}

/** Seconds of @p run, ascending, after once without the clock; all ranks start together. */
inline std::vector<double> measure(const std::function<void()> &run,
                                   const unsigned int repetitions)
{
  const FlushDenormals flush; // as the time loop
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

/** main() of a benchmark: MPI around @p run; an exception is one line and status 2. */
inline int guarded_main(int argc, char **argv, const char *name, int (*run)(int, char **))
{
  MPI_Init(&argc, &argv);
  int status = 0;
  try
    {
      status = run(argc, argv);
    }
  catch (const std::exception &error)
    {
      std::fprintf(stderr, "%s: %s\n", name, error.what());
      status = 2;
    }
  MPI_Finalize();
  return status;
}
} // namespace mesoslip

#endif
