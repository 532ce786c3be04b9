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
  double minimum = 0.; ///< of the cells
  double maximum = 0.; ///< of the cells

  std::array<double, 3> minimum_at = {}; ///< centre of that cell (m)
  std::array<double, 3> maximum_at = {}; ///< centre of that cell (m)

  /** Takes in what @p other has seen (Chan et al. 1983). Of places whose values agree to
   * 1e-6 the one with the least x, then y, then z is kept, so that it does not hang on the
   * last digits. */
  void add(const Moments &other);

  /** Root of the mean squared distance from the mean. */
  double standard_deviation() const;

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<7>(archive, *this);
  }
};

/** A cell alone: its value, its volume and its centre (m). */
Moments moments_of_cell(const double value,
                        const double volume,
                        const std::array<double, 3> &centre);

/** Equal intervals from the least to the largest value of a quantity; around a value that
 * is the same everywhere to 1e-6 they reach 1e-6 of it to both sides. */
class Bins
{
public:
  /** @p n of them for what @p moments have seen. */
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
