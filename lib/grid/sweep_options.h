#ifndef mesoslip_grid_sweep_options_h
#define mesoslip_grid_sweep_options_h

#include "grid/instruction_set.h"

namespace mesoslip
{
/** How a sweep is run; never changes a bit of the result. */
struct SweepOptions
{
  InstructionSet isa = InstructionSet::automatic; ///< of the row kernels

  /** Time steps in one sweep of advance() (temporal blocking): 0 chooses by cache size, 1
   *  is the plain sweep. On a slab it is the number of ghost rows that counts, see
   *  partition_rows(). */
  unsigned int steps_at_once = 0;
};

/**
 * Time steps in one sweep for a grid of @p n_columns x @p n_rows nodes over @p n_ranks
 * ranks:
 * @p requested or, if that is 0, what the size of the second-level cache suggests. A slab
 * needs as many ghost rows, and computes some rows twice: at most 3 % of them if chosen
 * here.
 */
unsigned int choose_steps_at_once(const unsigned int n_columns,
                                  const unsigned int n_rows,
                                  const unsigned int n_ranks,
                                  const unsigned int requested);
} // namespace mesoslip

#endif
