// Expressions of loads in the time t.
#include "fuzzing.h"

#include "parameters/load_history.h"

#include <stdexcept>

using namespace mesoslip;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  try
    {
      LoadHistory(1., std::string(data, data + size))(1e-3);
    }
  catch (const std::invalid_argument &)
    {
    }
  return 0;
}
