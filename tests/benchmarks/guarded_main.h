#ifndef mesoslip_tests_benchmarks_guarded_main_h
#define mesoslip_tests_benchmarks_guarded_main_h

#include <mpi.h>

#include <cstdio>
#include <exception>

namespace mesoslip
{
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
