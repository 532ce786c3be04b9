#include "sliding/body_file.h"

#include "base/digest.h"
#include "exchange/rve_file.h"
#include "io/xdmf.h"

namespace mesoslip
{
namespace
{
std::string scene_digest(const Scene &scene)
{
  Digest digest;
  digest.add(scene.rve_digest);
  for (unsigned int d = 0; d < 2; ++d)
    digest.add(scene.grid.cells[d]).add(scene.grid.spacing[d]);
  for (const Phase<2> &phase : scene.phases)
    {
      for (int k = 0; k < phase.stiffness.size(); ++k)
        digest.add(phase.stiffness.data()[k]);
      digest.add(phase.density);
    }
  digest.add(std::string(scene.phase_id.begin(), scene.phase_id.end()));
  return digest.hex();
}

void write_material(Hdf5File &file, const Scene &scene)
{
  const std::size_t n = scene.phases.size();
  std::vector<double> stiffness, density;
  std::vector<std::string> names;
  for (const Phase<2> &phase : scene.phases)
    {
      stiffness.insert(stiffness.end(), phase.stiffness.data(),
                       phase.stiffness.data() + phase.stiffness.size());
      density.push_back(phase.density);
      names.push_back(phase.name);
    }
  file.write("/material/stiffness", {n, 3, 3}, stiffness);
  file.write("/material/density", {n}, density);
  file.write("/material/name", {n}, names);
  file.write_unit("/material/stiffness", "Pa");
  file.write_unit("/material/density", "kg/m^3");
  file.write_unit("/material/name", "-");
  file.write_attribute("/material", "rve_digest", scene.rve_digest);
  if (scene.phase_id.empty())
    return;
  file.write("/material/phase_id", {scene.grid.cells[1], scene.grid.cells[0]},
             scene.phase_id);
  file.write_unit("/material/phase_id", "-");
}
} // namespace

Hdf5File
create_body_file(const std::string &path, const std::string &format, const Scene &scene)
{
  Hdf5File file = Hdf5File::create(path);
  file.write_header(format, 1, 2, scene_digest(scene));
  write_grid(file, scene.grid);
  write_material(file, scene);
  return file;
}

std::vector<double> interleaved(const NodalField<double> &u)
{
  std::vector<double> values(2 * static_cast<std::size_t>(u.n_columns()) * u.n_rows());
  std::size_t k = 0;
  for (unsigned int j = 0; j < u.n_rows(); ++j)
    {
      const double *x = u.row(0, j), *y = u.row(1, j);
      for (unsigned int i = 0; i < u.n_columns(); ++i)
        {
          values[k++] = x[i];
          values[k++] = y[i];
        }
    }
  return values;
}

Shape snapshot_shape(const UniformGrid<2> &grid, const std::size_t n)
{
  return {n, grid.cells[1] + 1, grid.cells[0] + 1, 2};
}

void complete_snapshots(Hdf5File &file, const std::vector<double> &times)
{
  file.write("/snapshots/time", {times.size()}, times);
  file.write_unit("/snapshots/time", "s");
  file.write_unit("/snapshots/displacement", "m");
}

void write_body_xdmf(const std::string &path,
                     const Scene &scene,
                     const std::string &h5,
                     const std::vector<std::pair<std::string, std::string>> &series,
                     const std::vector<double> &times)
{
  XdmfGrid grid;
  grid.cells   = {{scene.grid.cells[0], scene.grid.cells[1], 1}};
  grid.spacing = {{scene.grid.spacing[0], scene.grid.spacing[1], 1.}};
  std::vector<XdmfField> fields;
  for (const auto &[name, dataset] : series)
    {
      XdmfField field;
      field.name        = name;
      field.file        = h5;
      field.dataset     = dataset;
      field.components  = 2;
      field.time_series = true;
      fields.push_back(field);
    }
  write_xdmf(path, grid, fields, times);
  if (scene.phase_id.empty())
    return;
  XdmfField phase;
  phase.name    = "phase";
  phase.file    = h5;
  phase.dataset = "/material/phase_id";
  phase.centre  = XdmfField::Centre::cell;
  phase.number  = XdmfField::Number::uint8;
  write_xdmf(path.substr(0, path.rfind('.')) + "-phases.xdmf", grid, {phase});
}
} // namespace mesoslip
