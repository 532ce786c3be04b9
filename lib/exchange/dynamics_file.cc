#include "exchange/dynamics_file.h"

#include "base/digest.h"
#include "base/errors.h"
#include "exchange/datasets.h"

namespace mesoslip
{
namespace
{
constexpr int newest_dynamics_version = 1;

const char dynamics_program[] = "contact_dynamics";
const char phases_name[]      = "/material/phase_id";

const char file_hint[] = "contact_dynamics writes such a file";

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

DynamicsFile DynamicsFile::create(const std::string &path,
                                  const BodyDescription &body,
                                  const std::string &format)
{
  DynamicsFile file(Hdf5File::create(path));
  file.grid = body.grid;
  file.write_header(format, newest_dynamics_version, 2, digest_of(body));
  write_grid(file, body.grid);
  write_phases(file, "/material", body.phases, false);
  file.write_attribute("/material", "rve_digest", body.rve_digest);
  if (!body.phase_id.empty())
    write_dataset(file, phases_name, {body.grid.cells[1], body.grid.cells[0]},
                  body.phase_id);
  return file;
}

DynamicsFile DynamicsFile::open(const std::string &path, const std::string &hint)
{
  DynamicsFile file(Hdf5File::open(path, hint));
  file.digest =
    file.check_header("mesoslip-dynamics", newest_dynamics_version, 2, file_hint);
  file.grid       = read_grid<2>(file, dynamics_program);
  file.conditions = read_run_conditions(file);
  return file;
}

std::string DynamicsFile::rve_digest() const
{
  return has_attribute("/material", "rve_digest")
           ? read_attribute<std::string>("/material", "rve_digest")
           : "";
}

std::vector<std::uint8_t> DynamicsFile::phase_id() const
{
  return exists(phases_name)
           ? read<std::uint8_t>(phases_name, {grid.cells[1], grid.cells[0]})
           : std::vector<std::uint8_t>();
}

BodyDescription DynamicsFile::heterogeneous_body() const
{
  BodyDescription body;
  body.grid     = grid;
  body.phases   = read_phases<2>(*this, "/material", false, dynamics_program);
  body.phase_id = phase_id();
  if (body.phase_id.empty())
    throw UserError(path() + " has no " + phases_name +
                    ", as its body is homogeneous; name the run of a heterogeneous one");
  require_phases(*this, phases_name, body.phase_id, body.phases.size(), dynamics_program);
  body.node_friction = read<double>("/contact/friction_coefficient",
                                    {grid.cells[0] + std::size_t(1)}, file_hint);
  body.rve_digest    = rve_digest();
  return body;
}
} // namespace mesoslip
