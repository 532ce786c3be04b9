#include "localization/localization_needs.h"

#include "exchange/mesh_datasets.h"
#include "localization/strain/strain_source.h"
#include "localization/stress_statistics.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
constexpr double of_number    = 8.;    ///< bytes of a double
constexpr double of_libraries = 160e6; ///< memory of an idle program (bytes)

/** Bytes of a list on the heap with a content of @p bytes, including the overhead of the
 * allocator. */
double block(const double bytes)
{
  return sizeof(std::vector<unsigned int>) + bytes + 16.;
}

/** Bytes of a mesh, which rank 0 has; 0 for a grid. */
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

/** Bytes per cell of the volume for @p n_numbers in CellRows. */
template <int dim>
double bytes_of_rows(const CellSet<dim> &volume, const unsigned int n_numbers)
{
  const double n = volume.is_grid ? volume.grid.cells[0] : 1.;
  const double padded =
    volume.is_grid ? static_cast<double>(CellRows::padded(volume.grid.cells[0])) : 1.;
  return of_number * n_numbers * padded / n;
}

/** Bytes per cell of a body on a mesh: its strain operators, and the current
 * displacement. */
template <int dim>
double bytes_of_strain(const CellSet<dim> &body, const bool at_centroids)
{
  constexpr double v = n_voigt<dim>, vector = of_number * dim;
  const double n_corners = static_cast<double>(body.mesh.cells[0].vertices.size());
  const double gradients =
    n_corners * (of_number + vector) + of_number * (v + 1.) + 3. * vector;
  // Slopes and their neighbours across faces, in lists that grow.
  const double slopes =
    vector * (1. + v) + of_number + 1.5 * (n_corners + 2. * dim) * (of_number + vector);
  return gradients + (at_centroids ? 0. : slopes);
}

/** Bytes of a rank's share of the strains in @p n_snapshots, if a body is divided evenly
 * among @p n_ranks. */
template <int dim>
double bytes_of_share(const CellSet<dim> &body,
                      const CellSet<dim> &volume,
                      const bool has_points,
                      const std::size_t n_snapshots,
                      const unsigned int n_ranks)
{
  const double n_cells = static_cast<double>(body.n_cells()) / n_ranks,
               vector  = of_number * dim;
  if (!body.is_grid)
    return n_cells *
           bytes_of_strain(body, body.n_cells() == volume.n_cells() && !has_points);
  if (volume.is_grid)
    return bytes_of_displacements(n_cells * vector, n_snapshots);
  return n_cells * (2. * vector + of_number * n_voigt<dim> + sizeof(std::size_t));
}
} // namespace

template <int dim>
RankMemory memory_need(const LocalizationInput<dim> &input, const unsigned int n_ranks)
{
  using Map                       = StressMap<dim>;
  constexpr double vector         = of_number * dim;
  const LocalizationParameters &p = input.parameters;
  const bool is_body = input.plan.is_body, with_direct = input.files.direct != nullptr;
  const double n_points   = static_cast<double>(p.points.size()),
               n_variants = !is_body                          ? 0.
                            : p.local_strain && p.mean_strain ? 2.
                                                              : 1.;
  const double statistics =
    p.fields.any()
      ? bytes_of_rows(input.volume, StressStatistics<dim>::n_numbers(p.fields))
      : 0.;
  const double tensor =
    bytes_of_rows(input.volume, Map::n_numbers + (p.heating != 0. ? Map::n_thermal : 0)) +
    sizeof(std::uint16_t);
  const double place =
    (is_body && !input.files.are_grids() ? vector + 2. * sizeof(unsigned int) : 0.) +
    (input.volume.is_grid ? 0. : of_number);
  const double fields_of_direct = with_direct ? statistics : 0.;
  // Fields are derived from the statistics; for points all at once.
  const double homogeneous =
    tensor + fields_of_direct +
    (n_points + n_variants + std::max(1., n_points)) * statistics;
  const double direct = with_direct ? tensor + 2. * statistics : 0.;
  // Fields, differences and lists of the cells of regions.
  const double comparison =
    with_direct ? (2. * n_variants + 1.) * statistics + vector + 5. * of_number : 0.;
  const double meshes =
    bytes_of(input.volume) + bytes_of(input.body) + bytes_of(input.direct_body) +
    sizeof(unsigned int) * static_cast<double>(input.body_cell.size());
  // A rank has whole layers of the first axis.
  const double n_own = std::ceil(static_cast<double>(input.files.shape()[0]) / n_ranks) *
                       static_cast<double>(input.files.cells_in_layer());
  const bool has_points = !p.points.empty();
  const double strain   = is_body ? bytes_of_share(input.body, input.volume, has_points,
                                                   input.plan.snapshots.count, n_ranks)
                                  : 0.;
  const double direct_strain =
    with_direct ? bytes_of_share(input.direct_body, input.volume, false,
                                 input.plan.direct_snapshots.count, n_ranks)
                : 0.;
  const double share =
    n_own * place + std::max({n_own * homogeneous + strain,
                              n_own * direct + direct_strain, n_own * comparison});
  return {of_libraries + meshes + share, n_ranks > 1 ? of_libraries + share : 0.};
}

template <int dim>
ResourceNeed disk_need(const LocalizationInput<dim> &input)
{
  // Names, units and headers of the file, of a set of fields and of a probe; as measured.
  constexpr double of_file = 5e3, of_set = 1.5e3, of_series = 3e3;
  const LocalizationParameters &p = input.parameters;
  const double with_direct        = input.files.direct ? 1. : 0.;
  double n_field_sets = with_direct + static_cast<double>(input.plan.points.size()),
         n_series = 0., n_numbers = 0.;
  for (const bool of_place : {true, false})
    if (input.plan.is_body && (of_place ? p.local_strain : p.mean_strain))
      {
        n_field_sets += 1. + with_direct;
        n_series += static_cast<double>(input.probes.size());
        for (const PlannedProbe &probe : input.probes)
          {
            const bool compared =
              probe.recorded ? !probe.direct.time.empty() : with_direct > 0.;
            const std::size_t n = probe.recorded && of_place ? probe.strain.time.size()
                                                             : input.plan.snapshots.count;
            n_numbers +=
              (1. + n_voigt<dim> * (compared ? 2. : 1.)) * static_cast<double>(n);
          }
      }
  double mesh_bytes = 0.; // points and cells; 0 for a grid
  if (!input.volume.is_grid)
    mesh_bytes =
      static_cast<double>(sizeof(double) * dim * input.volume.n_points() +
                          sizeof(unsigned int) * topology_size(input.volume.mesh));
  const double in_cell =
    (p.fields.von_mises ? 1. : 0.) +
    n_voigt<dim> * ((p.fields.mean ? 1. : 0.) + (p.fields.deviation ? 1. : 0.));
  return {of_file + mesh_bytes + of_set * n_field_sets + of_series * n_series +
            of_number * (n_numbers + in_cell * n_field_sets *
                                       static_cast<double>(input.volume.n_cells())),
          "name fewer Localization/Fields or Volume element/Points"};
}

template RankMemory memory_need(const LocalizationInput<2> &, const unsigned int);
template RankMemory memory_need(const LocalizationInput<3> &, const unsigned int);
template ResourceNeed disk_need(const LocalizationInput<2> &);
template ResourceNeed disk_need(const LocalizationInput<3> &);
} // namespace mesoslip
