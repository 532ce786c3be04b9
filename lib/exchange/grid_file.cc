#include "exchange/grid_file.h"

#include "base/digest.h"
#include "exchange/datasets.h"

namespace mesoslip
{
namespace
{
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

std::string check_dynamics_header(const Hdf5File &file, const unsigned int dim)
{
  constexpr int newest_version = 2; // version of files of boxes with orientations; else 1
  const std::string format     = dynamics_format;
  return file.check_header(file.exists("/mesh") ? format + "-mesh" : format,
                           newest_version, dim, "contact_dynamics writes such a file");
}

std::string body_rve_digest(const Hdf5File &file)
{
  return file.has_attribute("/material", "rve_digest")
           ? file.read_attribute<std::string>("/material", "rve_digest")
           : "";
}

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
    cells = {{"phase", body_phases_dataset, XdmfField::Values::phases}};
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
  file.write_header(format, 1, 2, digest_of(body));
  write_grid(file, body.grid);
  write_phases(file, "/material", body.phases, false);
  file.write_attribute("/material", "rve_digest", body.rve_digest);
  if (!body.phase_id.empty())
    write_dataset(file, body_phases_dataset, {body.grid.cells[1], body.grid.cells[0]},
                  body.phase_id);
  return file;
}
} // namespace mesoslip
