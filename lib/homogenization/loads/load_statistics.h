#ifndef mesoslip_homogenization_loads_load_statistics_h
#define mesoslip_homogenization_loads_load_statistics_h

#include "base/serialize_members.h"

#include <array>
#include <vector>

namespace mesoslip
{
/** Mean, deviation and extremes of a quantity over cells, weighted with their volumes. */
struct Moments
{
  double volume  = 0.; ///< in any unit
  double mean    = 0.; ///< in the unit of the quantity
  double squares = 0.; ///< integral of (value - mean)^2
  double minimum = 0.; ///< smallest cell value
  double maximum = 0.; ///< largest cell value

  std::array<double, 3> minimum_at = {}; ///< centre of the cell of the minimum (m)
  std::array<double, 3> maximum_at = {}; ///< centre of the cell of the maximum (m)

  /** Merges the statistics of @p other (Chan et al. 1983). Among extremes that agree to
   * 1e-6 the place with the least x, then y, then z is kept, so round-off does not
   * decide. */
  void add(const Moments &other);

  /** Root mean square deviation from the mean. */
  double standard_deviation() const;

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<7>(archive, *this);
  }
};

/** Statistics of a single cell: value, volume and centre (m). */
Moments moments_of_cell(const double value,
                        const double volume,
                        const std::array<double, 3> &centre);

/** Equal intervals from the least to the largest value of a quantity. If the value is the
 * same everywhere to 1e-6, the intervals reach 1e-6 of it to both sides. */
class Bins
{
public:
  /** @p n bins over the range of @p moments. */
  Bins(const Moments &moments, const unsigned int n);

  /** The interval of a value; the last one includes its end. */
  unsigned int operator()(const double value) const;

  /** The n + 1 ends, in the unit of the quantity. */
  std::vector<double> edges() const;

private:
  unsigned int n;
  double lower, upper;
};
} // namespace mesoslip

#endif
