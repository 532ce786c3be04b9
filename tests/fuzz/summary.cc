// summary.json of an earlier run.
#include "fuzzing.h"

#include "sliding/analyses/friction_homogenization.h"

using namespace mesoslip;
using namespace mesoslip_tests;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static InputFile file("summary.json");
  file.fill(data, size);
  accepted_or_refused([&]() {
    const RunSummary summary("Friction homogenization/Heterogeneous run", file.folder);
    summary.find_number("steady_from");
    summary.find_number("fibre", "phase_contact_pressures");
    summary.require_analysis("transient");
  });
  return 0;
}
