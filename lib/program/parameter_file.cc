#include "program/parameter_file.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "base/files.h"
#include "base/text.h"

namespace mesoslip
{
RawParameters read_parameter_file(const CommandLine &line,
                                  const MPI_Comm communicator,
                                  std::string &text)
{
  RawParameters raw;
  if (!line.prm_file.empty())
    {
      const auto read = [&](const std::string &file) {
        std::string found;
        on_root(communicator, [&]() {
          found = read_file(file);
          if (trimmed(found).empty())
            throw UserError(file +
                            " is empty; --print-parameters shows what it may contain");
        });
        broadcast(communicator, found);
        return found;
      };
      text = read(line.prm_file);
      raw  = RawParameters::parse(text, line.prm_file, read);
      if (raw.files().size() > 1)
        text = raw.text();
    }
  for (const std::string &assignment : line.assignments)
    raw.override_with(assignment);
  if (line.ignore_unused)
    raw.ignore_unused();
  if (!line.prm_file.empty() && raw.entries().empty())
    throw UserError(line.prm_file +
                    " sets no key: there is no line 'set Key = value' in it; "
                    "--print-parameters shows the keys");
  return raw;
}
} // namespace mesoslip
