#include "exchange/rve_file.h"

#include "base/errors.h"
#include "exchange/cell_datasets.h"
#include "exchange/datasets.h"
#include "exchange/mesh_datasets.h"
#include "exchange/xdmf.h"
#include "io/drafts.h"

#include <deal.II/base/bounding_box.h>

#include <filesystem>
#include <limits>

namespace mesoslip
{
std::string concentration_dataset(const std::string &condition)
{
  return (condition == "SUBC" ? "/stress_concentration/" : "/concentration/") + condition;
}

std::string thermal_stress_dataset(const std::string &condition)
{
  return "/thermal_stress/" + condition;
}

std::string conduction_dataset(const std::string &condition)
{
  return (condition == "SUBC" ? "/conduction/flux/" : "/conduction/gradient/") +
         condition;
}

std::string transverse_thermal_stress_dataset(const std::string &condition)
{
  return "/thermal_stress_zz/" + condition;
}

namespace
{
const char rve_program[] = "rve_homogenization";

/**
 * Hint for missing tensors: how to create them, and the conditions for which @p file has
 * tensors.
 */
std::string concentration_hint(const Hdf5File &file, const std::string &condition)
{
  std::string others;
  for (const std::string other : {"KUBC", "PBC", "MUBC"})
    if (file.exists(concentration_dataset(other)))
      others += (others.empty() ? "; it has those of " : ", ") + other;
  return "run rve_homogenization with " + condition +
         " among its boundary conditions and its concentration tensors written" + others;
}

/** Grid of the file, or the bounding box of a mesh as one cell. */
template <int dim>
UniformGrid<dim> read_extent(const Hdf5File &file)
{
  if (!file.exists("/mesh"))
    return read_grid<dim>(file, rve_program);
  UniformGrid<dim> box;
  const std::string again = std::string("run ") + rve_program + " again";
  const auto origin = file.read_attribute<std::vector<double>>("/mesh", "origin", again),
             size   = file.read_attribute<std::vector<double>>("/mesh", "size", again);
  if (origin.size() != dim || size.size() != dim)
    throw UserError(file.path() + ": origin and size of /mesh are not " +
                    std::to_string(dim) + " numbers each; " + again);
  for (unsigned int d = 0; d < dim; ++d)
    {
      box.cells[d]   = 1;
      box.origin[d]  = origin[d];
      box.spacing[d] = size[d];
    }
  return box;
}

} // namespace

template <int dim>
void reserve_concentration(const std::string &path,
                           const Shape &cells,
                           const std::vector<std::string> &conditions,
                           const FurtherFields &further)
{
  Hdf5File file      = Hdf5File::create(path);
  const auto reserve = [&](const std::string &dataset, const Shape &of_cell,
                           const char *unit) {
    Shape shape = cells;
    shape.insert(shape.end(), of_cell.begin(), of_cell.end());
    file.reserve_rows(dataset, shape, rows_together(cells));
    file.write_unit(dataset, unit);
  };
  for (const std::string &condition : conditions)
    {
      reserve(concentration_dataset(condition), {n_voigt<dim>, n_voigt<dim>}, "-");
      if (further.thermal_stress)
        reserve(thermal_stress_dataset(condition), {n_voigt<dim>}, "Pa/K");
      if (further.transverse_thermal_stress)
        reserve(transverse_thermal_stress_dataset(condition), {}, "Pa/K");
      if (further.conduction)
        reserve(conduction_dataset(condition), {dim, dim}, "-");
    }
  file.leave();
}

template <int dim>
void write_rve_file(const std::string &path, const RveContent<dim> &content)
{
  using Values            = XdmfField::Values;
  constexpr std::size_t v = n_voigt<dim>;
  const bool is_new       = content.reserved.empty() && !content.phase_id.empty();
  Hdf5File file           = is_new ? Hdf5File::create(path) : Hdf5File::resume(path);
  file.write_header(rve_format, content.orientations.empty() ? 1 : newest_rve_version,
                    dim, content.digest);
  write_dataset(file, "/summary", {1}, std::vector<std::string>{content.summary});
  Shape cells = {content.n_cells()};
  if (content.mesh != nullptr)
    {
      write_mesh(file, *content.mesh);
      const dealii::BoundingBox<dim> box(content.mesh->points);
      std::vector<double> lower, size;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower.push_back(box.lower_bound(d));
          size.push_back(box.side_length(d));
        }
      file.write_attribute("/mesh", "origin", lower);
      file.write_attribute("/mesh", "size", size);
    }
  else
    {
      cells = shape_of_cells(content.grid);
      write_grid(file, content.grid);
    }
  write_phases(file, "/phase", content.phases, true);
  if (content.mesh != nullptr)
    write_dataset(file, "/phase/volume_fraction", {content.fractions.size()},
                  content.fractions);
  if (!content.phase_id.empty())
    write_dataset(file, phases_dataset, cells, content.phase_id);
  write_orientations(file, content.orientations, cells);
  for (const auto &[of, D] : content.stiffness)
    write_dataset(file, "/stiffness/" + of, {v, v},
                  std::vector<double>(D.data(), D.data() + D.size()), "Pa");
  for (const auto &[of, expansion] : content.expansion)
    write_dataset(file, "/expansion/" + of, {v},
                  std::vector<double>(expansion.begin(), expansion.end()), "1/K");
  for (const auto &[of, k] : content.conductivity)
    write_dataset(file, "/conductivity/" + of, {dim, dim}, k, "unit of the phases");
  write_variations(file, content.variations);
  std::vector<XdmfField> shown = {{"phase", phases_dataset, Values::phases}};
  for (const std::string &of : content.reserved)
    {
      const std::string dataset = concentration_dataset(of);
      shown.push_back({dataset.substr(1), dataset, Values::cells, {v, v}});
    }
  file.close();
  const std::string xdmf = path.substr(0, path.rfind('.')) + ".xdmf",
                    name = std::filesystem::path(path).filename();
  if (content.mesh != nullptr)
    write_xdmf(xdmf, name, *content.mesh, shown);
  else
    write_xdmf(xdmf, name, content.grid, shown);
}

unsigned int dimension_of_file(const std::string &path, const std::string &hint)
{
  const Hdf5File file = Hdf5File::open(path, hint);
  const int dim       = file.read_attribute<int>("/", "dim", hint);
  if (dim != 2 && dim != 3)
    throw UserError(path + " states " + std::to_string(dim) +
                    " dimensions, there are only 2 and 3; " + hint);
  return static_cast<unsigned int>(dim);
}

template <int dim>
RveFile<dim>::RveFile(Hdf5File &&opened)
  : file(std::move(opened))
  , digest(file.check_header(rve_format,
                             newest_rve_version,
                             dim,
                             std::string(rve_program) + " writes such a file"))
  , grid(read_extent<dim>(file))
  , phases(read_phases<dim>(file, "/phase", true, rve_program))
  , materials(file, phases_dataset, phases.size(), rve_program)
{
  if (!is_mesh() && !materials.shape.empty() && materials.shape != shape_of_cells(grid))
    throw UserError(path() + ": /phase/id does not have the cells of /grid; run " +
                    rve_program + " again");
}

std::string read_rve_summary(const std::string &path)
{
  const Hdf5File file = Hdf5File::open(path);
  const auto texts    = file.exists("/summary") ? file.read<std::string>("/summary")
                                                : std::vector<std::string>();
  return texts.size() == 1 ? texts[0] : "";
}

template <int dim>
void RveFile<dim>::require_grid(const std::string &nothing) const
{
  if (is_mesh())
    throw UserError(path() + " holds a volume on a mesh, of which " + nothing +
                    "; run rve_homogenization on a grid");
}

template <int dim>
std::pair<std::vector<Phase<dim>>, std::vector<double>>
RveContent<dim>::constituents() const
{
  if (orientations.empty())
    return {phases, fractions};
  return {oriented_phases(phases, orientations.materials), orientations.fractions};
}

template <int dim>
std::string RveFile<dim>::change_note() const
{
  return file.change_note(rve_program) +
         (digest == draft_digest
            ? ": its stiffness is Hill's mean of the phases (the mean "
              "of Voigt's and Reuss' bounds)"
            : "");
}

template <int dim>
double RveFile<dim>::mean_density() const
{
  if (is_mesh())
    {
      const auto fractions = file.read<double>("/phase/volume_fraction", {phases.size()});
      double mean          = 0.;
      for (std::size_t p = 0; p < phases.size(); ++p)
        mean += phases[p].density * fractions[p];
      return mean;
    }
  std::vector<std::size_t> count(phases.size());
  for_each_piece(whole_block(grid), [&](const CellBlock<dim> &block) {
    for (const std::uint16_t id : constituent_ids(block))
      ++count[materials.phase_of(id)];
  });
  double sum = 0.;
  for (std::size_t p = 0; p < count.size(); ++p)
    sum += phases[p].density * count[p];
  return sum / grid.n_cells();
}

template <int dim>
VoigtMatrix<dim> RveFile<dim>::stiffness(const std::string &name) const
{
  const std::string dataset = "/stiffness/" + name;
  const auto D =
    file.read<double>(dataset, {n_voigt<dim>, n_voigt<dim>},
                      name == "effective" ? "run rve_homogenization"
                                          : "run rve_homogenization with " + name +
                                              " among its boundary conditions");
  file.require_unit(dataset, "Pa");
  const VoigtMatrix<dim> stiffness = Eigen::Map<const VoigtMatrix<dim>>(D.data());
  require_stiffness<dim>(file, dataset, stiffness, rve_program);
  return stiffness;
}

template <int dim>
std::vector<double> RveFile<dim>::concentration(const std::string &name) const
{
  Shape shape = is_mesh() ? Shape{any_extent} : shape_of_cells(grid);
  shape.insert(shape.end(), {n_voigt<dim>, n_voigt<dim>});
  return file.read<double>(concentration_dataset(name), shape,
                           concentration_hint(file, name));
}

template <int dim>
std::vector<double> RveFile<dim>::concentration(const std::string &name,
                                                const std::size_t first,
                                                const std::size_t count) const
{
  const std::string dataset = concentration_dataset(name);
  Shape extent              = materials.shape;
  extent.insert(extent.end(), {n_voigt<dim>, n_voigt<dim>});
  if (file.shape(dataset, concentration_hint(file, name)) != extent)
    throw UserError(path() + ": concentration tensors and cells differ in number; run "
                             "rve_homogenization again");
  return read_cells<double>(file, dataset, first, count, concentration_hint(file, name),
                            2);
}

template <int dim>
std::vector<Eigen::Matrix<double, n_voigt<dim> + 1, 1>> RveFile<dim>::thermal_stress(
  const std::string &name, const std::size_t first, const std::size_t count) const
{
  constexpr std::size_t n = n_voigt<dim>;
  const std::string hint =
    "give phases a Thermal expansion and run rve_homogenization with " + name +
    " among its boundary conditions";
  const auto stress =
    read_cells<double>(file, thermal_stress_dataset(name), first, count, hint, 1);
  const std::string transverse = transverse_thermal_stress_dataset(name);
  const auto zz =
    file.exists(transverse)
      ? read_cells<double>(file, transverse, first, count, hint)
      : std::vector<double>(count, std::numeric_limits<double>::quiet_NaN());
  if (stress.size() != n * count || zz.size() != count)
    throw UserError(path() + ": thermal stresses and cells differ in number; " + hint);
  std::vector<Eigen::Matrix<double, n + 1, 1>> result(count);
  for (std::size_t k = 0; k < count; ++k)
    result[k] << Eigen::Map<const VoigtVector<dim>>(&stress[n * k]), zz[k];
  return result;
}

template <int dim>
VoigtVector<dim> RveFile<dim>::expansion(const std::string &name) const
{
  const auto values =
    file.read<double>("/expansion/" + name, {n_voigt<dim>},
                      "give phases a Thermal expansion and run rve_homogenization again");
  return Eigen::Map<const VoigtVector<dim>>(values.data());
}

template <int dim>
Mesh<dim> RveFile<dim>::mesh() const
{
  Mesh<dim> mesh = read_mesh_cells<dim>(file, rve_program);
  if (materials.shape != Shape{mesh.cells.size()})
    throw UserError(path() + ": /phase/id and /mesh have different numbers of cells; run "
                             "rve_homogenization again");
  return mesh;
}

template struct RveContent<2>;
template struct RveContent<3>;
template class RveFile<2>;
template class RveFile<3>;
template void reserve_concentration<2>(const std::string &,
                                       const Shape &,
                                       const std::vector<std::string> &,
                                       const FurtherFields &);
template void reserve_concentration<3>(const std::string &,
                                       const Shape &,
                                       const std::vector<std::string> &,
                                       const FurtherFields &);
template void write_rve_file(const std::string &, const RveContent<2> &);
template void write_rve_file(const std::string &, const RveContent<3> &);
} // namespace mesoslip
