// In programs and tests with sanitizers: what Open MPI and hwloc set up at the start, in the thread in which Open MPI makes progress, and
// on the way to the end is no leak of ours. It is said in advance, by MPI's profiling interface: LeakSanitizer would otherwise name every
// function on the stacks of some thirty allocations at the end of each process, which takes as long as the process itself, and would need
// stacks through libraries without frame pointers, which take as long again.
#include <dlfcn.h>
#include <mpi.h>
#include <sanitizer/lsan_interface.h>

int MPI_Init(int *argc, char ***argv)
{
  __lsan::ScopedDisabler no_leaks;
  return PMPI_Init(argc, argv);
}

int MPI_Init_thread(int *argc, char ***argv, int required, int *provided)
{
  __lsan::ScopedDisabler no_leaks;
  return PMPI_Init_thread(argc, argv, required, provided);
}

int MPI_Finalize()
{
  __lsan::ScopedDisabler no_leaks;
  return PMPI_Finalize();
}

// Of libevent; the linker exports it, so that the library of MPI calls this one.
extern "C" int event_base_loop(void *base, int flags)
{
  using Loop             = int (*)(void *, int);
  static const Loop loop = reinterpret_cast<Loop>(dlsym(RTLD_NEXT, "event_base_loop"));
  __lsan::ScopedDisabler no_leaks;
  return loop(base, flags);
}
