#include "localization/mesh/memory_need.h"

#include <algorithm>

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

template <int dim>
double bytes_of(const Mesh<dim> &mesh)
{
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

/** Of CellStrain for one cell of @p n_corners of a body. */
template <int dim>
double bytes_of_strain(const double n_corners, const bool at_centroids)
{
  constexpr double v = n_voigt<dim>, vector = of_number * dim;
  const double gradients =
    n_corners * (of_number + vector) + of_number * (v + 1.) + vector;
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
  const double n_cells            = static_cast<double>(input.volume.cells.size()),
               n_points           = static_cast<double>(p.points.size()),
               n_variants         = !input.is_body()                  ? 0.
                                    : p.local_strain && p.mean_strain ? 2.
                                                                      : 1.,
               n_fields           = n_points + n_variants + (input.direct ? 1. : 0.);
  const double statistics         = bytes_of_fields<dim>(p.fields);
  const double tensor             = of_number * (v * v + 2.) + 4.;
  const double place = input.is_body() || input.direct ? 2. * vector + 16. : 0.;
  const double n_strained =
    input.direct      ? n_cells
    : input.is_body() ? std::min(n_cells, static_cast<double>(input.body.cells.size()))
                      : 0.;
  const double strain = bytes_of_strain<dim>(
    static_cast<double>(input.body.cells[0].vertices.size()),
    input.volume.cells.size() == input.body.cells.size() && p.points.empty());
  // The fields are taken from the statistics, of points from all at once.
  const double pass = tensor + place + (n_fields + std::max(1., n_points)) * statistics;

  const double meshes = bytes_of(input.volume) + bytes_of(input.body) +
                        bytes_of(input.direct_body) +
                        n_cells * (vector + of_number + 4.) +
                        vector * static_cast<double>(input.body.points.size());
  // Texts of the ranks, results from them, and the fields of the whole volume.
  const double output = 2.5 * n_fields * statistics * n_cells;
  // What a rank reads, its mean strain, and what it needs of all.
  const double snapshot = 3. * vector * static_cast<double>(input.body.points.size());
  const double share    = (n_cells * pass + n_strained * strain + snapshot) / n_ranks;
  return {of_libraries + meshes + std::max(share, output),
          n_ranks > 1 ? of_libraries + share : 0.};
}

template RankMemory memory_need(const MeshLocalizationInput<2> &, const unsigned int);
template RankMemory memory_need(const MeshLocalizationInput<3> &, const unsigned int);
} // namespace mesoslip
