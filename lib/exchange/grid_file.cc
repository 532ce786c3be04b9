#include "exchange/grid_file.h"

#include "base/digest.h"
#include "exchange/datasets.h"

namespace mesoslip
{
namespace
{
constexpr int newest_dynamics_version = 1;

const char phases_name[] = "/material/phase_id";

std::string digest_of(const BodyDescription &body)
{
  Digest digest;
  digest.add(body.rve_digest);
  for (unsigned int d = 0; d < 2; ++d)
    digest.add(body.grid.cells[d]).add(body.grid.spacing[d]);
  for (const Phase<2> &phase : body.phases)
    {
      for (int k = 0; k < phase.stiffness.size(); ++k)
        digest.add(phase.stiffness.data()[k]);
      digest.add(phase.density);
    }
  digest.add(std::string(body.phase_id.begin(), body.phase_id.end()));
  return digest.hex();
}
} // namespace

Shape nodes_shape(const UniformGrid<2> &grid)
{
  return {std::size_t(grid.cells[1]) + 1, std::size_t(grid.cells[0]) + 1, 2};
}

void show_grid(const std::string &path,
               const UniformGrid<2> &grid,
               const bool has_phases,
               const std::vector<XdmfField> &series,
               const std::vector<double> &times)
{
  std::vector<XdmfField> cells;
  if (has_phases)
    cells = {{"phase", phases_name, XdmfField::Values::phases}};
  show_file(path, grid, series, times, cells);
}

std::vector<double>
interleaved(const NodalField<double> &u, const unsigned int begin, const unsigned int end)
{
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(u.n_components()) * u.n_columns() *
                 (end - begin));
  for (unsigned int j = begin; j < end; ++j)
    for (unsigned int i = 0; i < u.n_columns(); ++i)
      for (unsigned int c = 0; c < u.n_components(); ++c)
        values.push_back(u.row(c, j)[i]);
  return values;
}

Hdf5File create_grid_file(const std::string &path,
                          const BodyDescription &body,
                          const std::string &format)
{
  Hdf5File file = Hdf5File::create(path);
  file.write_header(format, newest_dynamics_version, 2, digest_of(body));
  write_grid(file, body.grid);
  write_phases(file, "/material", body.phases, false);
  file.write_attribute("/material", "rve_digest", body.rve_digest);
  if (!body.phase_id.empty())
    write_dataset(file, phases_name, {body.grid.cells[1], body.grid.cells[0]},
                  body.phase_id);
  return file;
}
} // namespace mesoslip
