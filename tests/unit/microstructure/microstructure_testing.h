#ifndef mesoslip_tests_microstructure_testing_h
#define mesoslip_tests_microstructure_testing_h

#include "../io/io_testing.h"

#include "morphology/microstructure_parameters.h"
#include "parameters/keys.h"

#include <string>
#include <vector>

namespace mesoslip_tests
{
using namespace mesoslip;

using Settings = std::vector<std::string>;

/** Phases of the paper's table 1. */
inline const std::string table_1 = R"(
subsection Phases
  subsection matrix
    set Young modulus = 30e9
    set Density       = 1770
  end
  subsection fibre
    set Young modulus = 240e9
    set Density       = 1770
  end
end
)";

inline UniformGrid<2>
make_grid(const unsigned int n_x, const unsigned int n_y, const double h)
{
  return {{{n_x, n_y}}, {{h, h}}};
}

inline const UniformGrid<2> paper_grid = make_grid(560, 160, 1e-4);

/** A 20 x 10 grid of 0.1 mm: 2 mm by 1 mm. */
inline const UniformGrid<2> small_grid = make_grid(20, 10, 1e-4);

/** What a program does with a .prm and --set options, up to check(). */
inline MicrostructureParameters checked(const Settings &settings,
                                        const std::string &text = table_1)
{
  RawParameters raw = RawParameters::parse(text, "run.prm");
  for (const std::string &setting : settings)
    raw.override_with(setting);
  Keys keys(raw);
  MicrostructureParameters().bind(keys);
  keys.apply();
  MicrostructureParameters parameters;
  parameters.bind(keys);
  parameters.check();
  return parameters;
}

inline std::string error_of(const Settings &settings, const std::string &text = table_1)
{
  return user_error([&] { checked(settings, text); });
}

/** 64-bit FNV-1a of the numbers of cells and the phase indices. */
inline std::uint64_t morphology_digest(const PhaseMap<2> &map)
{
  std::uint64_t state = 0xcbf29ce484222325u;
  const auto add      = [&](const std::uint8_t byte) {
    state = (state ^ byte) * 0x100000001b3u;
  };
  for (const unsigned int n : map.grid.cells)
    for (unsigned int shift = 0; shift < 32; shift += 8)
      add(static_cast<std::uint8_t>(n >> shift));
  for (const std::uint8_t phase : map.id)
    add(phase);
  return state;
}

/** A key of the random fibres with its value. */
inline std::string fibres(const std::string &assignment)
{
  return "Microstructure/Random fibres/" + assignment;
}

} // namespace mesoslip_tests

#endif
