#include "localization/mesh/memory_need.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
constexpr double of_number    = 8.;    ///< bytes of a double
constexpr double of_libraries = 160e6; ///< bytes of a program that holds nothing

/** Of a list on the heap, with what the allocator keeps beside its @p bytes. */
double block(const double bytes)
{
  return sizeof(std::vector<unsigned int>) + bytes + 16.;
}

/** Of a mesh, which rank 0 has; of a grid nothing. */
template <int dim>
double bytes_of(const CellSet<dim> &cells)
{
  const Mesh<dim> &mesh = cells.mesh;
  if (mesh.cells.empty())
    return 0.;
  const double corners = 4. * static_cast<double>(mesh.cells[0].vertices.size());
  return static_cast<double>(mesh.points.size()) * of_number * dim +
         static_cast<double>(mesh.cells.size()) * (block(corners) + 8.);
}

/** Of the statistics of a cell that are asked for. */
template <int dim>
double bytes_of_fields(const FieldSelection &fields)
{
  const double means   = fields.mean || fields.deviation ? n_voigt<dim> : 0.,
               squares = fields.deviation ? n_voigt<dim> : 0.;
  return of_number * ((fields.von_mises ? 1. : 0.) + means + squares);
}

/** Of the strains of one cell of a body, and the displacement at hand. */
template <int dim>
double bytes_of_strain(const CellSet<dim> &body, const bool at_centroids)
{
  constexpr double v = n_voigt<dim>, vector = of_number * dim;
  if (body.is_grid)
    return of_number * v + vector;
  const double n_corners = static_cast<double>(body.mesh.cells[0].vertices.size());
  const double gradients =
    n_corners * (of_number + vector) + of_number * (v + 1.) + 2. * vector;
  // Slopes and their neighbours across faces, in lists that grow.
  const double slopes =
    vector * (1. + v) + of_number + 1.5 * (n_corners + 2. * dim) * (of_number + vector);
  return gradients + (at_centroids ? 0. : slopes);
}
} // namespace

template <int dim>
RankMemory memory_need(const MeshLocalizationInput<dim> &input,
                       const unsigned int n_ranks)
{
  constexpr double v = n_voigt<dim>, vector = of_number * dim;
  const LocalizationParameters &p = input.parameters;
  const bool is_body = input.plan.is_body, with_direct = input.files.direct != nullptr;
  const double n_cells    = static_cast<double>(input.volume.n_cells()),
               n_body     = static_cast<double>(input.body.n_cells()),
               n_points   = static_cast<double>(p.points.size()),
               n_variants = !is_body                          ? 0.
                            : p.local_strain && p.mean_strain ? 2.
                                                              : 1.;
  const double statistics = bytes_of_fields<dim>(p.fields);
  const double tensor     = of_number * (v * v + 1.) + sizeof(std::uint16_t);
  const double place      = (is_body ? vector + 2. * sizeof(unsigned int) : 0.) +
                       (input.volume.is_grid ? 0. : of_number);
  const bool at_centroids = n_cells == n_body && p.points.empty();
  const double strain =
    is_body ? bytes_of_strain(input.body, at_centroids) * n_body / n_cells : 0.;
  // The fields are taken from the statistics, of points from all at once.
  const double homogeneous =
    tensor + strain + (n_points + n_variants + std::max(1., n_points)) * statistics;
  const double direct = with_direct ? tensor + bytes_of_strain(input.direct_body, true) +
                                        (n_variants + 2.) * statistics
                                    : 0.;
  // Fields, differences and lists of the cells of regions.
  const double comparison =
    with_direct ? (2. * n_variants + 1.) * statistics + vector + 5. * of_number : 0.;
  const double meshes =
    bytes_of(input.volume) + bytes_of(input.body) + bytes_of(input.direct_body) +
    sizeof(unsigned int) * static_cast<double>(input.body_cell.size());
  // Whole rows of the first axis.
  const double n_own = std::ceil(static_cast<double>(input.files.shape()[0]) / n_ranks) *
                       static_cast<double>(input.files.cells_in_row());
  const double share = n_own * (place + std::max({homogeneous, direct, comparison}));
  return {of_libraries + meshes + share, n_ranks > 1 ? of_libraries + share : 0.};
}

template RankMemory memory_need(const MeshLocalizationInput<2> &, const unsigned int);
template RankMemory memory_need(const MeshLocalizationInput<3> &, const unsigned int);
} // namespace mesoslip
