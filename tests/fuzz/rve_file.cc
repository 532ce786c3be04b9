// rve.h5, as contact_dynamics and stress_localization read it.
#include "fuzzing.h"
#include "hdf5_edits.h"
#include "valid_files.h"

#include "homogenization/rve_file.h"
#include "io/files.h"
#include "localization/localize.h"
#include "simulation/contact_parameters.h"
#include "simulation/scene.h"

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
void read_as_body(const std::string &path, const bool heterogeneous)
{
  ContactParameters parameters;
  parameters.body.rve_file                 = path;
  parameters.body.stiffness_name           = "effective";
  parameters.body.heterogeneous            = heterogeneous;
  parameters.friction.coefficient_by_phase = heterogeneous;
  parameters.friction.node_rule            = "stiffness";
  make_scene(parameters).make_material(false);
}

std::string valid_rve(const InputFile &file)
{
  write_dynamics(file.folder, false);
  write_rve(file.path);
  return read_file(file.path);
}
void localize_with(const InputFile &file)
{
  LocalizationParameters parameters;
  parameters.rve_file        = file.path;
  parameters.homogeneous_run = file.folder + "/dynamics.h5";
  parameters.from            = 0.;
  parameters.to              = 1.;
  localize(parameters);
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static InputFile file("rve.h5");
  static const std::string valid = valid_rve(file);
  file.fill(edited(valid, data, size));
  read_with({[]() { read_as_body(file.path, false); },
             []() { read_as_body(file.path, true); }, []() { localize_with(file); }},
            data, size);
  return 0;
}
