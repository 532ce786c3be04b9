// .prm files of all programs: from the text to the checked parameters, and back to text.
#include "fuzzing.h"

#include "homogenization/rve_parameters.h"
#include "io/parameters.h"
#include "io/raw_parameters.h"
#include "localization/localization_parameters.h"
#include "simulation/contact_parameters.h"

#include <deal.II/base/parameter_handler.h>

#include <sstream>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
template <typename Parameters>
void apply(const RawParameters &raw, dealii::ParameterHandler &prm)
{
  Parameters::declare(prm, raw);
  raw.apply(prm);
}

/** What was accepted is accepted again, and the same, when printed. */
template <typename Parameters>
void check_printed(const dealii::ParameterHandler &prm)
{
  std::ostringstream printed;
  print_parameters(prm, printed);
  dealii::ParameterHandler again;
  try
    {
      apply<Parameters>(RawParameters::parse(printed.str(), "printed.prm"), again);
    }
  catch (const UserError &)
    {
      std::abort();
    }
  if (canonical_parameters(again) != canonical_parameters(prm))
    std::abort();
}

template <typename Parameters>
void read_as(const RawParameters &raw)
{
  dealii::ParameterHandler prm;
  apply<Parameters>(raw, prm);
  check_printed<Parameters>(prm);
  Parameters::parse(prm);
}
} // namespace

// The first byte chooses the program.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  if (size == 0)
    return 0;
  const std::string text(data + 1, data + size);
  accepted_or_refused([&]() {
    const RawParameters raw = RawParameters::parse(text, "fuzz.prm");
    if (data[0] == '1')
      read_as<RveParameters>(raw);
    else if (data[0] == '2')
      read_as<ContactParameters>(raw);
    else if (data[0] == '3')
      read_as<LocalizationParameters>(raw);
  });
  return 0;
}
