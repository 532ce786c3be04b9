#include "morphology/random_inclusions.h"

#include "base/exchange.h"
#include "morphology/inclusion_bins.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mesoslip
{
namespace
{
/** Failed draws in a row after which placement ends. */
constexpr std::size_t max_vain_places = 300000;

/** State of one placement. */
class InclusionPlacer
{
public:
  InclusionPlacer(const UniformGrid<3> &g,
                  const InclusionPlacement &placement,
                  const std::uint8_t phase_of_inclusions,
                  const MPI_Comm of_ranks)
    : grid(g)
    , rules(placement)
    , phase(phase_of_inclusions)
    , communicator(of_ranks)
    , planes(own_planes(g.cells[2], of_ranks))
    , random(placement.seed)
    , lengths({{g.extent(0), g.extent(1), g.extent(2)}})
    , bins(lengths, placement.sides == InclusionSides::periodic, largest_distance())
    , n_target(rules.volume_fraction * static_cast<double>(grid.n_cells()))
  {
    result.map.grid = grid;
    result.map.id.assign(planes.count * grid.cells_in_layer(), 0);
  }

  InclusionMorphology run()
  {
    while (!result.target_reached && result.vain_draws < max_vain_places)
      {
        const Inclusion inclusion = draw();
        if (!rules.allow_overlap && bins.any_too_close(inclusion, rules.minimum_gap))
          ++result.vain_draws;
        else
          take(inclusion);
      }
    const auto n            = static_cast<double>(grid.n_cells());
    result.actual_fraction  = n_actual / n;
    result.nominal_fraction = n_nominal / n;
    return std::move(result);
  }

private:
  /** Largest distance (m) along each axis between the centres of touching inclusions. */
  Vector3 largest_distance() const
  {
    Inclusion largest = shaped(rules.max_diameter, rules.max_length);
    Vector3 distance  = largest.reach();
    if (rules.turned)
      distance.fill(*std::max_element(largest.half.begin(), largest.half.end()));
    for (double &d : distance)
      d = 2. * d + rules.minimum_gap;
    return distance;
  }

  /** An inclusion of a size (m) along the coordinate axes. */
  Inclusion shaped(const double diameter, const double length) const
  {
    Inclusion inclusion;
    inclusion.shape = rules.shape;
    inclusion.half.fill(0.5 * diameter);
    if (rules.shape == InclusionShape::ellipsoid)
      for (unsigned int k = 0; k < 3; ++k)
        inclusion.half[k] *= rules.axis_ratios[k];
    if (rules.has_length())
      {
        inclusion.along   = rules.axis;
        inclusion.through = rules.max_length == 0.;
        inclusion.half[rules.axis] =
          0.5 * (inclusion.through ? grid.extent(rules.axis) : length);
      }
    return inclusion;
  }

  /** Axes of a uniformly distributed orientation, from a random unit quaternion. */
  std::array<Vector3, 3> random_axes()
  {
    double w, x, y, z, square;
    do // square roots, unlike other functions, are the same on every machine
      {
        w      = random.between(-1., 1.);
        x      = random.between(-1., 1.);
        y      = random.between(-1., 1.);
        z      = random.between(-1., 1.);
        square = w * w + x * x + y * y + z * z;
      }
    while (!(square <= 1. && square > 1e-4));
    const double s = 2. / square;
    return {{{{1. - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)}},
             {{s * (x * y - w * z), 1. - s * (x * x + z * z), s * (y * z + w * x)}},
             {{s * (x * z + w * y), s * (y * z - w * x), 1. - s * (x * x + y * y)}}}};
  }

  Inclusion draw()
  {
    const double diameter = random.between(rules.min_diameter, rules.max_diameter);
    const double length =
      rules.has_length() ? random.between(rules.min_length, rules.max_length) : 0.;
    Inclusion inclusion = shaped(diameter, length);
    if (rules.turned)
      inclusion.axes = random_axes();
    const Vector3 reach = inclusion.reach();
    for (unsigned int c = 0; c < 3; ++c)
      {
        const double outside = rules.sides == InclusionSides::periodic ? 0.
                               : rules.sides == InclusionSides::cut    ? reach[c]
                                                                       : -reach[c];
        inclusion.centre[c]  = inclusion.through && c == inclusion.along
                                 ? 0.5 * lengths[c]
                                 : random.between(-outside, lengths[c] + outside);
      }
    return inclusion;
  }

  /** First and last cell along axis @p c whose centre may lie inside; indices continue
   * beyond the box. */
  std::array<long, 2>
  range_of(const Inclusion &inclusion, const unsigned int c, const double reach) const
  {
    const long n = grid.cells[c];
    if (inclusion.through && c == inclusion.along)
      return {{0, n - 1}};
    const double h = grid.spacing[c], centre = inclusion.centre[c];
    long first = std::lround(std::ceil((centre - reach) / h - 0.5));
    long last  = std::lround(std::floor((centre + reach) / h - 0.5));
    if (rules.sides == InclusionSides::periodic)
      last = std::min(last, first + n - 1);
    else
      {
        first = std::max(first, 0L);
        last  = std::min(last, n - 1);
      }
    return {{first, last}};
  }

  /** Fills `covered` with the numbers of the cells of @p inclusion in the planes of this rank. */
  void find_cells(const Inclusion &inclusion)
  {
    covered.clear();
    const Vector3 reach = inclusion.reach();
    std::array<std::array<long, 2>, 3> range;
    for (unsigned int c = 0; c < 3; ++c)
      range[c] = range_of(inclusion, c, reach[c]);
    const auto wrapped = [&](const long at, const unsigned int c) {
      const long n = grid.cells[c];
      return static_cast<std::size_t>((at % n + n) % n);
    };
    const auto distance = [&](const long at, const unsigned int c) {
      return (static_cast<double>(at) + 0.5) * grid.spacing[c] - inclusion.centre[c];
    };
    Vector3 d;
    for (long k = range[2][0]; k <= range[2][1]; ++k)
      for (long j = range[1][0]; j <= range[1][1]; ++j)
        {
          const std::size_t plane = wrapped(k, 2) - planes.first; // huge if it is below
          if (plane >= planes.count)
            break;
          d[1]                  = distance(j, 1);
          d[2]                  = distance(k, 2);
          const std::size_t row = (plane * grid.cells[1] + wrapped(j, 1)) * grid.cells[0];
          for (long i = range[0][0]; i <= range[0][1]; ++i)
            {
              d[0] = distance(i, 0);
              if (inclusion.contains(d))
                covered.push_back(row + wrapped(i, 0));
            }
        }
  }

  /** Places the inclusion, unless it adds nothing or overshoots by more than the
   * remaining deficit. */
  void take(const Inclusion &inclusion)
  {
    find_cells(inclusion);
    std::vector<double> sums = {0., static_cast<double>(covered.size())};
    for (const std::size_t cell : covered)
      sums[0] += result.map.id[cell] == 0 ? 1. : 0.;
    sum_over_ranks(sums, communicator);
    const double gain = sums[0], all = sums[1];
    if (gain == 0.)
      {
        ++result.vain_draws;
        return;
      }
    const bool actual      = rules.fraction_rule == FractionRule::actual;
    const double more      = actual ? gain : all;
    const double remaining = n_target - (actual ? n_actual : n_nominal);
    result.target_reached  = more >= remaining;
    if (more - remaining > remaining && !result.inclusions.empty())
      return;
    for (const std::size_t cell : covered)
      result.map.id[cell] = phase;
    n_actual += gain;
    n_nominal += all;
    if (!rules.allow_overlap)
      bins.add(inclusion);
    result.inclusions.push_back(inclusion);
    result.vain_draws = 0;
  }

  const UniformGrid<3> &grid;
  const InclusionPlacement &rules;
  const std::uint8_t phase;
  const MPI_Comm communicator;
  const PlaneRange planes; ///< planes of cells that this rank fills
  RandomNumbers random;    ///< the same on all ranks
  const Vector3 lengths;   ///< m, of the box
  InclusionBins bins;      ///< placed inclusions
  InclusionMorphology result;
  std::vector<std::size_t> covered; ///< cells of the inclusion that is tried

  /** Numbers of cells: wanted, reached, and reached with overlaps counted for each
   * inclusion. */
  const double n_target;
  double n_actual = 0., n_nominal = 0.;
};
} // namespace

InclusionMorphology place_random_inclusions(const UniformGrid<3> &grid,
                                            const InclusionPlacement &rules,
                                            const std::uint8_t phase,
                                            const MPI_Comm communicator)
{
  return InclusionPlacer(grid, rules, phase, communicator).run();
}
} // namespace mesoslip
