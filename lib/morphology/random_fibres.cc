#include "morphology/random_fibres.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace mesoslip
{
namespace
{
/** Failed draws in a row after which the remaining places are enumerated. */
constexpr unsigned int max_vain_draws = 2000;

/** Limit of failed draws if overlaps are allowed; a draw fails if it adds no cell. */
constexpr unsigned int max_hidden_draws = 100000;

/**
 * Failed draws among n enumerated places before all of them are tried: n over the first
 * number, plus the second. Smaller limits would try all of them for too many fibres.
 */
constexpr std::size_t vain_candidates_part = 64;

/** State of one placement. */
class Placer
{
public:
  Placer(const UniformGrid<2> &g, const FibrePlacement &placement)
    : grid(g)
    , rules(placement)
    , random(placement.seed)
    , width(whole_cells(placement.width, g.spacing[0]))
    , min_height(whole_cells(placement.min_height, g.spacing[1]))
    , max_height(std::max(min_height, whole_cells(placement.max_height, g.spacing[1])))
    , occupancy(g.cells[0], g.cells[1])
  {
    if (!rules.cut_by_border)
      max_height = std::min(max_height, static_cast<long>(grid.cells[1]));
    const auto gap_cells = [&](const double h) {
      return static_cast<unsigned int>(
        std::ceil(std::max(0., rules.minimum_gap / h - 1e-6)));
    };
    x_gap        = gap_cells(grid.spacing[0]);
    y_gap        = gap_cells(grid.spacing[1]);
    const auto n = static_cast<double>(grid.n_cells());
    target_cells = static_cast<std::size_t>(std::llround(rules.area_fraction * n));
    target_area  = rules.area_fraction * grid.extent(0) * grid.extent(1);
    result.map   = homogeneous_map(grid);
  }

  FibreMorphology run()
  {
    if (target_cells == 0 && rules.fraction_rule == FractionRule::actual)
      result.target_reached = true;
    else if (possible())
      {
        place_at_random();
        if (!result.target_reached && !rules.allow_overlap)
          place_systematically();
      }
    result.actual_fraction =
      static_cast<double>(occupancy.n_taken()) / static_cast<double>(grid.n_cells());
    result.nominal_fraction = nominal_area / (grid.extent(0) * grid.extent(1));
    return std::move(result);
  }

private:
  enum class Outcome
  {
    vain,
    placed,
    finished
  };

  /** Lower left cell of a fibre that lies inside. */
  struct Place
  {
    unsigned int x, y;
  };

  static long whole_cells(const double length, const double h)
  {
    return std::max(1L, std::lround(length / h));
  }

  /** Whether any fibre satisfies the rules. */
  bool possible() const
  {
    return rules.cut_by_border ||
           (width <= static_cast<long>(grid.cells[0]) && min_height <= max_height &&
            rules.width <= grid.extent(0) * (1. + 1e-9) &&
            rules.min_height <= grid.extent(1) * (1. + 1e-9));
  }

  /** The fibre that covers @p height rows, its lower left cell being (@p x, @p y). */
  Rectangle aligned(const long x, const long y, const long height) const
  {
    const auto [h_x, h_y] = grid.spacing;
    return {grid.origin[0] + static_cast<double>(x) * h_x,
            grid.origin[1] + static_cast<double>(y) * h_y,
            static_cast<double>(width) * h_x, static_cast<double>(height) * h_y,
            rules.phase};
  }

  /** A fibre of random height at a random place. */
  Rectangle draw()
  {
    const bool cut = rules.cut_by_border;
    if (rules.align_to_grid)
      {
        const long n_x = grid.cells[0], n_y = grid.cells[1];
        const long height = random.whole(min_height, max_height);
        const long x =
          cut ? random.whole(1 - width, n_x - 1) : random.whole(0, n_x - width);
        const long y =
          cut ? random.whole(1 - height, n_y - 1) : random.whole(0, n_y - height);
        return aligned(x, y, height);
      }
    const double limit =
      cut ? rules.max_height : std::min(rules.max_height, grid.extent(1));
    const double height = random.between(rules.min_height, limit);
    const double x      = cut ? random.between(-rules.width, grid.extent(0))
                              : random.between(0., grid.extent(0) - rules.width);
    const double y      = cut ? random.between(-height, grid.extent(1))
                              : random.between(0., grid.extent(1) - height);
    return {grid.origin[0] + x, grid.origin[1] + y, rules.width, height, rules.phase};
  }

  bool fits(const CellBox &box) const
  {
    return !box.empty() && (rules.allow_overlap ||
                            occupancy.is_free(occupancy.widened(box, x_gap, y_gap)));
  }

  bool fits(const Place &corner, const long height) const
  {
    const auto x_end = static_cast<unsigned int>(corner.x + width);
    const auto y_end = static_cast<unsigned int>(corner.y + height);
    return x_end <= grid.cells[0] && y_end <= grid.cells[1] &&
           fits(CellBox{corner.x, x_end, corner.y, y_end});
  }

  std::size_t random_index(const std::size_t size)
  {
    return static_cast<std::size_t>(random.whole(0, static_cast<long>(size) - 1));
  }

  double area_inside(const Rectangle &fibre) const
  {
    const auto overlap = [&](const unsigned int d, const double begin,
                             const double length) {
      const double low  = std::max(begin, grid.origin[d]);
      const double high = std::min(begin + length, grid.origin[d] + grid.extent(d));
      return std::max(0., high - low);
    };
    return overlap(0, fibre.x_left, fibre.width) *
           overlap(1, fibre.y_bottom, fibre.height);
  }

  void place(const Rectangle &fibre, const CellBox &box)
  {
    occupancy.mark(box);
    fill_box(result.map, box, rules.phase);
    result.fibres.push_back(fibre);
    nominal_area += area_inside(fibre);
  }

  Outcome try_to_place(const Rectangle &fibre)
  {
    const CellBox box = covered_cells(grid, fibre);
    if (!fits(box))
      return Outcome::vain;
    if (rules.fraction_rule == FractionRule::nominal)
      {
        place(fibre, box);
        return nominal_area >= target_area * (1. - 1e-9) ? Outcome::finished
                                                         : Outcome::placed;
      }
    const std::size_t gain      = occupancy.n_free(box);
    const std::size_t remaining = target_cells - occupancy.n_taken();
    if (gain > remaining)
      return place_last(fibre, box, remaining);
    if (gain == 0)
      return Outcome::vain;
    place(fibre, box);
    return gain == remaining ? Outcome::finished : Outcome::placed;
  }

  /** Handles the fibre that would exceed the target: shortened, whole, or left out. */
  Outcome place_last(Rectangle fibre, const CellBox &box, const std::size_t remaining)
  {
    const auto error = [&](const CellBox &b) {
      const std::size_t gain = occupancy.n_free(b);
      return gain > remaining ? gain - remaining : remaining - gain;
    };
    CellBox best = {box.x_begin, box.x_end, box.y_begin, box.y_begin};
    if (!rules.trim_last)
      best = error(box) < remaining ? box : best;
    else
      for (CellBox lower = best; lower.y_end < box.y_end;)
        {
          ++lower.y_end;
          if (error(lower) < error(best))
            best = lower;
        }
    if (best.y_end < box.y_end)
      fibre.height = grid.origin[1] + best.y_end * grid.spacing[1] - fibre.y_bottom;
    if (!best.empty())
      place(fibre, best);
    return Outcome::finished;
  }

  /** Draws until the target is reached or draws fail too often. */
  void place_at_random()
  {
    const unsigned int patience = rules.allow_overlap ? max_hidden_draws : max_vain_draws;
    for (unsigned int vain = 0; vain < patience;)
      switch (try_to_place(draw()))
        {
        case Outcome::finished:
          result.target_reached = true;
          return;
        case Outcome::placed:
          vain = 0;
          break;
        case Outcome::vain:
          ++vain;
        }
  }

  /** Places where the shortest fibre fits; taller fibres fit nowhere else. */
  std::vector<Place> all_places() const
  {
    std::vector<Place> places;
    for (unsigned int x = 0; x < grid.cells[0]; ++x)
      for (unsigned int y = 0; y < grid.cells[1]; ++y)
        if (fits(Place{x, y}, min_height))
          places.push_back({x, y});
    return places;
  }

  /** Places a fibre of @p height rows; fails if none fits. Drops exhausted places. */
  Outcome place_among(std::vector<Place> &places, const long height)
  {
    const auto place_at = [&](const Place &corner) {
      return try_to_place(aligned(corner.x, corner.y, height));
    };
    const auto is_dead = [&](const Place &corner) { return !fits(corner, min_height); };
    const std::size_t patience =
      vain_candidates_part + places.size() / vain_candidates_part;
    for (std::size_t vain = 0; vain < patience && !places.empty();)
      {
        const std::size_t i = random_index(places.size());
        if (fits(places[i], height))
          return place_at(places[i]);
        if (is_dead(places[i]))
          {
            places[i] = places.back();
            places.pop_back();
          }
        else
          ++vain;
      }
    places.erase(std::remove_if(places.begin(), places.end(), is_dead), places.end());

    std::vector<Place> suitable;
    std::copy_if(places.begin(), places.end(), std::back_inserter(suitable),
                 [&](const Place &corner) { return fits(corner, height); });
    return suitable.empty() ? Outcome::vain
                            : place_at(suitable[random_index(suitable.size())]);
  }

  /** Fills the remaining places; ends because each turn adds a fibre or excludes a
   * height. */
  void place_systematically()
  {
    std::vector<Place> places = all_places();
    long tallest              = std::min(max_height, static_cast<long>(grid.cells[1]));
    while (min_height <= tallest)
      {
        const long height     = random.whole(min_height, tallest);
        const Outcome outcome = place_among(places, height);
        if (outcome == Outcome::vain)
          tallest = height - 1;
        result.target_reached = outcome == Outcome::finished;
        if (result.target_reached)
          return;
      }
  }

  const UniformGrid<2> &grid;
  const FibrePlacement &rules;
  RandomNumbers random;

  /** Sizes of a fibre in cells, at least one. */
  long width, min_height, max_height;

  Occupancy occupancy;
  FibreMorphology result;

  /** Gaps in cells. */
  unsigned int x_gap, y_gap;
  std::size_t target_cells;

  /** m^2 */
  double target_area;
  double nominal_area = 0.;
};
} // namespace

FibreMorphology place_random_fibres(const UniformGrid<2> &grid,
                                    const FibrePlacement &placement)
{
  return Placer(grid, placement).run();
}
} // namespace mesoslip
