#include "program/other_program.h"

#include "base/errors.h"
#include "parameters/raw_parameters.h"

#include <algorithm>
#include <vector>

namespace mesoslip
{
namespace
{
struct OwnSections
{
  const char *program;
  std::vector<std::string> sections; ///< top-level sections of no other program
};

/** tests/system/programs/bad_input.py compares them with the keys of the programs. */
const std::vector<OwnSections> &own_sections()
{
  static const std::vector<OwnSections> all = {
    {"rve_homogenization",
     {"Grid", "Microstructure", "Homogenization", "Loads", "Ensemble"}},
    {"contact_dynamics",
     {"Body", "Time", "Flat", "Supports", "Sweep", "Sides", "Friction", "Observation",
      "Contact map", "Counter body", "Snapshots", "Checkpoints", "Performance", "Modal",
      "Static contact", "Complex modes", "Friction homogenization"}},
    {"stress_localization",
     {"Input", "Localization", "Window", "Probes", "Volume element", "Comparison"}}};
  return all;
}

bool has(const std::vector<std::string> &sections, const std::string &name)
{
  return std::find(sections.begin(), sections.end(), name) != sections.end();
}
} // namespace

void refuse_file_of_other_program(const RawParameters &raw, const std::string &program)
{
  const auto &known = own_sections();
  if (std::none_of(known.begin(), known.end(),
                   [&](const OwnSections &own) { return own.program == program; }))
    return; // a program whose sections are not listed
  const OwnSections *other          = nullptr;
  const RawParameters::Entry *where = nullptr;
  for (const RawParameters::Entry &section : raw.subsections())
    for (const OwnSections &own : known)
      if (has(own.sections, section.path))
        {
          if (own.program == program || (other != nullptr && other != &own))
            return;
          if (other == nullptr)
            where = &section;
          other = &own;
        }
  if (other != nullptr)
    throw UserError(RawParameters::origin(*where) + ": this is a file of " +
                    other->program + ", the program with the subsection '" + where->path +
                    "'; run " + other->program + ", or name a file of " + program);
}
} // namespace mesoslip
