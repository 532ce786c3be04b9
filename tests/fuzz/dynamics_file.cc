// dynamics.h5, as stress_localization and the homogenization of friction read it.
#include "fuzzing.h"
#include "hdf5_edits.h"
#include "valid_files.h"

#include "io/files.h"
#include "localization/localize.h"
#include "simulation/friction_homogenization.h"

#include <cmath>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
std::string valid_dynamics(const InputFile &file)
{
  write_rve(file.folder + "/rve.h5");
  for (const char *folder : {"/homogeneous", "/static"})
    std::filesystem::create_directory(file.folder + folder);
  write_static_contact(file.folder + "/static");
  write_dynamics(file.folder + "/homogeneous", false);
  write_dynamics(file.folder, true);
  return read_file(file.path);
}
LocalizationParameters localization_of(const InputFile &file)
{
  LocalizationParameters parameters;
  parameters.rve_file = file.folder + "/rve.h5";
  parameters.from = parameters.to = std::nan("");
  return parameters;
}

void localize_run(const InputFile &file)
{
  LocalizationParameters parameters = localization_of(file);
  parameters.homogeneous_run        = file.path;
  localize(parameters);
}

void compare_with_run(const InputFile &file)
{
  LocalizationParameters parameters = localization_of(file);
  parameters.homogeneous_run        = file.folder + "/homogeneous/dynamics.h5";
  parameters.direct_run             = file.path;
  localize(parameters);
}

void homogenize_friction(const InputFile &file)
{
  FrictionHomogenizationParameters friction;
  friction.heterogeneous_run = file.folder;
  friction.static_contact    = file.folder + "/static";
  friction_estimates(read_friction_homogenization(friction, file.folder + "/rve.h5"));
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static InputFile file("dynamics.h5");
  static const std::string valid = valid_dynamics(file);
  static const std::string homogeneous =
    read_file(file.folder + "/homogeneous/dynamics.h5");
  // The first reader takes no heterogeneous run.
  file.fill(edited(chosen_reader(3, data, size) == 1 ? homogeneous : valid, data, size));
  read_with({[]() { localize_run(file); }, []() { compare_with_run(file); },
             []() { homogenize_friction(file); }},
            data, size);
  return 0;
}
