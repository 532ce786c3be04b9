#include "valid_files.h"

#include "homogenization/rve_file.h"
#include "io/files.h"
#include "material/stiffness.h"
#include "observation/run_conditions.h"

namespace mesoslip_tests
{
using namespace mesoslip;

namespace
{
constexpr unsigned int nx = 4, ny = 3;
const std::string rve_digest             = "0123456789abcdef";
const std::vector<std::uint8_t> phase_id = {0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0};

void write_body_grid(Hdf5File &file)
{
  UniformGrid<2> grid;
  grid.cells   = {{nx, ny}};
  grid.spacing = {{1e-4, 1e-4}};
  write_grid(file, grid);
}

std::vector<double> stiffnesses(const std::vector<double> &young_moduli)
{
  std::vector<double> D;
  for (const double E : young_moduli)
    {
      const VoigtMatrix<2> one = isotropic_stiffness<2>(E, 0.2);
      D.insert(D.end(), one.data(), one.data() + 9);
    }
  return D;
}
} // namespace

void write_rve(const std::string &path)
{
  Hdf5File file = Hdf5File::create(path);
  file.write_header("mesoslip-rve", 1, 2, rve_digest);
  write_body_grid(file);
  file.write("/phase/id", {ny, nx}, phase_id);
  file.write("/phase/stiffness", {2, 3, 3}, stiffnesses({30e9, 240e9}));
  file.write<double>("/phase/density", {2}, {2000., 2500.});
  file.write<double>("/phase/friction_coefficient", {2}, {0.2, 0.3});
  file.write_strings("/phase/name", {"matrix", "fibre"});
  for (const char *name : {"KUBC", "SUBC", "PBC", "effective"})
    file.write(std::string("/stiffness/") + name, {3, 3}, stiffnesses({40e9}));
  std::vector<double> L;
  for (unsigned int cell = 0; cell < nx * ny; ++cell)
    for (unsigned int k = 0; k < 9; ++k)
      L.push_back(k % 4 == 0 ? 1. : 0.);
  file.write("/concentration/KUBC", {ny, nx, 3, 3}, L);
  file.close();
}

void write_dynamics(const std::string &folder, const bool heterogeneous)
{
  Hdf5File file = Hdf5File::create(folder + "/dynamics.h5");
  file.write_header("mesoslip-dynamics", 1, 2, "fedcba9876543210");
  write_body_grid(file);
  const std::size_t n = heterogeneous ? 2 : 1;
  file.write("/material/stiffness", {n, 3, 3},
             heterogeneous ? stiffnesses({30e9, 240e9}) : stiffnesses({40e9}));
  file.write("/material/density", {n}, std::vector<double>(n, 2000.));
  file.write_strings("/material/name", heterogeneous
                                         ? std::vector<std::string>{"matrix", "fibre"}
                                         : std::vector<std::string>{"effective"});
  file.write_attribute("/material", "rve_digest", rve_digest);
  RunConditions conditions;
  conditions.words   = {{"analysis", "transient"}, {"coefficient_from", "phases"}};
  conditions.numbers = {
    {"pressure", 1e6}, {"regularization_time", 1e-6}, {"steady_from", 1e-6}};
  write_run_conditions(file, conditions);
  if (heterogeneous)
    file.write("/material/phase_id", {ny, nx}, phase_id);

  const std::vector<double> times = {1e-6, 2e-6, 3e-6};
  std::vector<double> u(3 * (ny + 1) * (nx + 1) * 2);
  for (std::size_t k = 0; k < u.size(); ++k)
    u[k] = 1e-8 * static_cast<double>(k % 7);
  file.create_extendable<double>("/snapshots/time", {});
  file.create_extendable<double>("/snapshots/displacement", {ny + 1, nx + 1, 2});
  file.append("/snapshots/time", times.data(), 3);
  file.append("/snapshots/displacement", u.data(), 3);
  file.write("/probes/A/time", {3}, times);
  for (const char *quantity : {"strain", "stress"})
    file.write(std::string("/probes/A/") + quantity, {3, 3},
               std::vector<double>(9, 1e-6));
  file.write_attribute("/probes/A", "position", std::vector<double>{1.5e-4, 1e-4});
  file.write("/contact/friction_coefficient", {nx + 1}, std::vector<double>(nx + 1, 0.2));
  file.close();
  write_file(folder + "/summary.json",
             R"({"analysis": "transient", "global_interface_friction_coefficient": 0.18,
 "mean_contact_duration": 1e-5})");
}

void write_static_contact(const std::string &folder)
{
  Hdf5File file = Hdf5File::create(folder + "/dynamics.h5");
  file.write("/static_contact/pressure", {nx + 1}, std::vector<double>(nx + 1, 1e6));
  file.close();
  write_file(folder + "/summary.json",
             R"({"analysis": "static contact", "rve_digest": ")" + rve_digest + R"(",
 "phase_contact_pressures": {"matrix": 1e6, "fibre": 3e6}})");
}
} // namespace mesoslip_tests
