#include "sliding/transient/result_file.h"

#include "exchange/datasets.h"

namespace mesoslip
{
void write_probe(Hdf5File &file,
                 const std::string &group,
                 const ProbeHistory &probe,
                 const unsigned int dim)
{
  const unsigned int n_voigt = dim * (dim + 1) / 2;
  write_series(file, group,
               {{"time", "s", &probe.time},
                {"displacement", "m", &probe.displacement, dim},
                {"velocity", "m/s", &probe.velocity, dim}});
  for (const Series &series : {Series{"strain", "-", &probe.strain, n_voigt},
                               Series{"stress", "Pa", &probe.stress, n_voigt},
                               Series{"traction", "Pa", &probe.traction, dim}})
    if (!series.values->empty())
      write_series(file, group, {series});
  file.write_attribute(
    group, "position",
    std::vector<double>(probe.position.begin(), probe.position.begin() + dim));
  file.write_attribute(group, "phase", probe.phase);
}
} // namespace mesoslip
