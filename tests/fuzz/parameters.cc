// .prm files of all programs: from the text to the checked parameters, and back to text.
#include "fuzzing.h"

#include "homogenization/ensemble.h"
#include "localization/localization_parameters.h"
#include "parameters/keys.h"
#include "sliding/contact_parameters.h"

#include <sstream>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
template <typename Parameters>
void apply(Keys &keys)
{
  Parameters().bind(keys);
  keys.apply();
  Parameters().bind(keys); // judges the conditions between keys
  if constexpr (std::is_same_v<Parameters, LocalizationParameters>)
    Parameters::check_keys(keys);
}

/** What was accepted is accepted again, and the same, when printed. */
template <typename Parameters>
void check_printed(const Keys &keys)
{
  std::ostringstream printed;
  print_parameters(keys, printed);
  try
    {
      Keys again(RawParameters::parse(printed.str(), "printed.prm"));
      apply<Parameters>(again);
      if (canonical_parameters(again) != canonical_parameters(keys))
        std::abort();
    }
  catch (const UserError &)
    {
      std::abort();
    }
}

template <typename Parameters>
void read_as(const RawParameters &raw, const bool print)
{
  Keys keys(raw);
  apply<Parameters>(keys);
  if (print)
    check_printed<Parameters>(keys);
  Parameters parameters;
  parameters.bind(keys);
  if constexpr (!std::is_same_v<Parameters, ContactParameters>)
    parameters.check();
}
} // namespace

// The first byte chooses the program, and whether what was accepted is printed and read
// again, which takes four times as long as reading: 1, 2, 3 with, a, b, c without.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  if (size == 0)
    return 0;
  const std::string text(data + 1, data + size);
  const bool print   = data[0] < 'a';
  const char program = static_cast<char>(print ? data[0] : data[0] - 'a' + '1');
  accepted_or_refused([&]() {
    const RawParameters raw = RawParameters::parse(text, "fuzz.prm");
    if (program == '1')
      read_as<RveParameters>(raw, print);
    else if (program == '2')
      read_as<ContactParameters>(raw, print);
    else if (program == '3')
      read_as<LocalizationParameters>(raw, print);
  });
  return 0;
}
