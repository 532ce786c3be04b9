#include "exchange/rve_file.h"

#include "exchange/datasets.h"
#include "exchange/xdmf.h"

#include <filesystem>

namespace mesoslip
{
namespace
{
constexpr int newest_rve_version = 1;

const char rve_program[] = "rve_homogenization";

std::string concentration_name(const std::string &condition)
{
  return (condition == "SUBC" ? "/stress_concentration/" : "/concentration/") + condition;
}
} // namespace

void RveFile::write(const std::string &path, const RveContent &content)
{
  using Values      = XdmfField::Values;
  const Shape cells = {content.grid.cells[1], content.grid.cells[0]};
  Hdf5File file     = Hdf5File::create(path);
  file.write_header("mesoslip-rve", newest_rve_version, 2, content.digest);
  write_dataset(file, "/summary", {1}, std::vector<std::string>{content.summary});
  write_grid(file, content.grid);
  write_phases(file, "/phase", content.phases, true);
  write_dataset(file, "/phase/id", cells, content.phase_id);
  for (const auto &[of, D] : content.stiffness)
    write_dataset(file, "/stiffness/" + of, {3, 3},
                  std::vector<double>(D.data(), D.data() + D.size()), "Pa");
  std::vector<XdmfField> shown = {{"phase", "/phase/id", Values::phases}};
  for (const auto &[of, tensors] : content.concentration)
    {
      const std::string dataset = concentration_name(of);
      write_dataset(file, dataset, {cells[0], cells[1], 3, 3}, *tensors);
      shown.push_back({dataset.substr(1), dataset, Values::cells, {3, 3}});
    }
  file.close();
  write_xdmf(path.substr(0, path.rfind('.')) + ".xdmf",
             std::filesystem::path(path).filename(), content.grid, shown);
}

RveFile::RveFile(const std::string &path)
  : file(Hdf5File::open(path, "run rve_homogenization first"))
  , digest(file.check_header("mesoslip-rve", newest_rve_version, 2, rve_program))
  , grid(read_grid(file, rve_program))
  , phases(read_phases(file, "/phase", true, rve_program))
{
}

std::string RveFile::summary() const
{
  const auto texts = file.exists("/summary") ? file.read<std::string>("/summary")
                                             : std::vector<std::string>();
  return texts.size() == 1 ? texts[0] : "";
}

std::vector<std::uint8_t> RveFile::phase_id() const
{
  auto id = file.read<std::uint8_t>("/phase/id", {grid.cells[1], grid.cells[0]},
                                    "rve_homogenization writes it");
  require_phases(file, "/phase/id", id, phases.size(), rve_program);
  return id;
}

double RveFile::mean_density() const
{
  std::vector<std::size_t> count(phases.size());
  for (const std::uint8_t id : phase_id())
    ++count[id];
  double sum = 0.;
  for (std::size_t p = 0; p < count.size(); ++p)
    sum += phases[p].density * count[p];
  return sum / grid.n_cells();
}

VoigtMatrix<2> RveFile::stiffness(const std::string &name) const
{
  const std::string dataset = "/stiffness/" + name;
  const auto D              = file.read<double>(dataset, {3, 3},
                                   "run rve_homogenization with " + name +
                                     " among its boundary conditions");
  file.require_unit(dataset, "Pa");
  const VoigtMatrix<2> stiffness = Eigen::Map<const VoigtMatrix<2>>(D.data());
  require_stiffness(file, dataset, stiffness, rve_program);
  return stiffness;
}

std::vector<double> RveFile::concentration(const std::string &name) const
{
  return file.read<double>(
    concentration_name(name), {grid.cells[1], grid.cells[0], 3, 3},
    "run rve_homogenization with " + name +
      " among its boundary conditions and its concentration tensors written");
}
} // namespace mesoslip
