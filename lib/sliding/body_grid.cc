#include "sliding/body_grid.h"

#include "base/errors.h"
#include "base/text.h"
#include "material/stiffness.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** "560 x 160" or "10 x 20 x 30". */
template <typename Numbers>
std::string extents_text(const Numbers &numbers, const unsigned int dim)
{
  std::string text;
  for (unsigned int d = 0; d < dim; ++d)
    text += (d == 0 ? "" : " x ") + to_text(numbers[d]);
  return text;
}

/** Checks that a body unlike the @p volume of its RVE file is homogeneous and larger. */
template <int dim>
void check_size(const BodyParameters &body, const std::array<double, dim> &volume)
{
  bool equal = true, smaller = false;
  for (unsigned int d = 0; d < dim; ++d)
    {
      equal   = equal && std::fabs(body.size[d] - volume[d]) <= 1e-9 * volume[d];
      smaller = smaller || body.size[d] < (1. - 1e-9) * volume[d];
    }
  const std::string sizes = body.section + "/Size is " + extents_text(body.size, dim) +
                            " m, but the volume in " + body.rve_file + " measures " +
                            extents_text(volume, dim) + " m; ";
  if (!equal && (smaller || body.heterogeneous))
    throw UserError(sizes + "leave Size empty to take it from there" +
                    (smaller ? "" : ", a homogeneous body may be larger"));
  if (!equal && body.cells[0] == 0)
    throw UserError(sizes + "leave Size empty to take it from there, or set " +
                    body.section + "/Cells to the numbers of cells of the larger body");
}

/** Cells of @p grid per cell of the volume, along each axis.
 * @throws UserError */
template <int dim>
std::array<unsigned int, dim> refinement(const std::string &section,
                                         const RveFile<dim> &rve,
                                         const UniformGrid<dim> &grid)
{
  rve.require_grid("a heterogeneous body on a grid takes nothing");
  const std::array<unsigned int, dim> coarse = rve.grid.cells, fine = grid.cells;
  std::array<unsigned int, dim> ratio;
  bool fits = true;
  for (unsigned int d = 0; d < dim; ++d)
    {
      ratio[d] = fine[d] / coarse[d];
      fits     = fits && ratio[d] > 0 && fine[d] % coarse[d] == 0;
    }
  if (!fits)
    throw UserError(section + "/Cells: " + extents_text(fine, dim) +
                    " is no multiple of the " + extents_text(coarse, dim) + " cells of " +
                    rve.path() + ", whose morphology a heterogeneous body takes");
  return ratio;
}
} // namespace

template <int dim>
Phase<dim> given_phase(const BodyParameters &body)
{
  try
    {
      return {"typed in", stiffness_from_coefficients<dim>(body.stiffness), body.density,
              0.};
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(
        body.section + "/Stiffness is " + to_text(body.stiffness) + ": " + e.what() +
        (dim == 2 ? "; D11 D22 has to be larger than D12^2, and D33 positive"
                  : "; give 9 numbers of an orthotropic material or all 21"));
    }
}

template <int dim>
UniformGrid<dim> make_grid(const BodyParameters &body, const RveFile<dim> *rve)
{
  UniformGrid<dim> grid;
  std::array<double, dim> size = {};
  if constexpr (dim == 2)
    {
      size       = {{56e-3, 16e-3}};
      grid.cells = {{560, 160}};
    }
  if (rve != nullptr)
    {
      for (unsigned int d = 0; d < dim; ++d)
        size[d] = rve->grid.extent(d);
      grid.cells = rve->grid.cells;
    }
  if (rve != nullptr && body.size[0] > 0.)
    check_size<dim>(body, size);
  if (body.size[0] > 0.)
    std::copy_n(body.size.begin(), dim, size.begin());
  if (body.cells[0] > 0)
    std::copy_n(body.cells.begin(), dim, grid.cells.begin());
  else if (rve != nullptr && rve->is_mesh())
    throw UserError(body.section + "/Cells is empty, and " + body.rve_file +
                    " holds a mesh, which has no rows and columns; set it to the "
                    "numbers of cells of the body along " +
                    (dim == 2 ? "x and y" : "x, y and z"));
  if (!(size[0] > 0.) || grid.cells[0] == 0)
    throw UserError(
      body.section + "/" + (size[0] > 0. ? "Cells" : "Size") +
      " is empty, and without an RVE file a body in 3D has to be given by Size, in "
      "m, and "
      "Cells, each three numbers along x, y, z; or name a mesh in Mesh/File");
  for (unsigned int d = 0; d < dim; ++d)
    grid.spacing[d] = size[d] / grid.cells[d];
  std::copy_n(body.position.begin(), dim - 1, grid.origin.begin());
  return grid;
}

template <int dim>
std::vector<std::uint16_t> constituents_in(const std::string &section,
                                           const RveFile<dim> &rve,
                                           const UniformGrid<dim> &grid,
                                           const CellBlock<dim> &block)
{
  const auto ratio                    = refinement(section, rve, grid);
  std::array<unsigned int, dim> lower = {}, upper = {};
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = block.first[d] / ratio[d];
      upper[d] = (block.first[d] + block.cells[d] - 1) / ratio[d];
    }
  const CellBlock<dim> coarse = block_around<dim>(rve.grid, lower, upper, 0);
  const std::vector<std::uint16_t> of_coarse = rve.constituent_ids(coarse);
  if (coarse.cells == block.cells)
    return of_coarse;
  // Contribution of the position along each axis to the number of the volume's cell.
  std::array<std::vector<std::size_t>, 3> part = {{{0}, {0}, {0}}};
  std::size_t stride                           = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      part[d].clear();
      for (unsigned int i = block.first[d]; i < block.first[d] + block.cells[d]; ++i)
        part[d].push_back((i / ratio[d] - lower[d]) * stride);
      stride *= coarse.cells[d];
    }
  std::vector<std::uint16_t> id;
  id.reserve(block.n_cells());
  for (const std::size_t k : part[2])
    for (const std::size_t j : part[1])
      for (const std::size_t i : part[0])
        id.push_back(of_coarse[k + j + i]);
  return id;
}

template <int dim>
void require_densities(const RveFile<dim> &rve)
{
  for (const Phase<dim> &phase : rve.phases)
    if (!(phase.density > 0.))
      throw UserError(rve.path() + ": phase '" + phase.name +
                      "' has no density; set Phases/" + phase.name +
                      "/Density and run rve_homogenization again");
}

#define MESOSLIP_INSTANTIATE(dim)                                                    \
  template Phase<dim> given_phase<dim>(const BodyParameters &);                      \
  template UniformGrid<dim> make_grid(const BodyParameters &, const RveFile<dim> *); \
  template std::vector<std::uint16_t> constituents_in(                               \
    const std::string &, const RveFile<dim> &, const UniformGrid<dim> &,             \
    const CellBlock<dim> &);                                                         \
  template void require_densities(const RveFile<dim> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
