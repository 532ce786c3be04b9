#ifndef mesoslip_sliding_sliding_setup_h
#define mesoslip_sliding_sliding_setup_h

#include "contact/contact_surface.h"
#include "dynamics/stepper.h"
#include "dynamics/top_surface.h"
#include "grid/row_partition.h"

#include <cstdint>
#include <vector>

namespace mesoslip
{
/** What a body on the flat is made of besides its material. */
struct SlidingSetup
{
  StepParameters step;   ///< time step, beta2, damping, body acceleration
  SideConstraints sides; ///< components constrained on the left and right side
  ContactSetup contact;  ///< the flat
  TopSetup top;          ///< the load
  SweepOptions sweep;    ///< instruction set, temporal blocking
  bool periodic = false; ///< in x

  /** Histories of contact and top have a sample every so many steps; 0: none. */
  unsigned int history_interval = 1;

  /** Contact nodes whose motion and tractions are kept with the histories. */
  std::vector<unsigned int> monitored_nodes;

  /** Steps in a block of the node statistics; 0: one block for the whole run. */
  std::uint64_t steps_per_block = 0;

  /** The energy balance has a sample every so many steps; 0: none. */
  unsigned int energy_interval = 0;
};
} // namespace mesoslip

#endif
