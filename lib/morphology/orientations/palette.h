#ifndef mesoslip_morphology_orientations_palette_h
#define mesoslip_morphology_orientations_palette_h

#include "material/orientations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace mesoslip
{
/** Bunge's phi1, Phi, phi2 (degrees). */
using Angles = std::array<double, 3>;

/** Numbers the distinct pairs of phase and orientation. */
class Palette
{
public:
  static constexpr std::size_t most_seen = 1000000; ///< beyond, pairs are merged

  /** Angles are rounded to multiples of @p the_step (degrees), unless it is zero. */
  explicit Palette(const double the_step)
    : step(the_step)
  {
  }

  /** The number of this pair, added if it is new. */
  std::size_t add(const unsigned int phase, const Angles &given)
  {
    Angles angles = given;
    if (step > 0.)
      {
        for (double &angle : angles)
          angle = std::round(angle / step) * step;
        // Reduces angles to one turn of 360 degrees.
        for (const unsigned int a : {0U, 2U})
          angles[a] -= 360. * std::floor(angles[a] / 360.);
        largest = std::max(largest, angle_between(given, angles));
      }
    for (double &angle : angles)
      angle += 0.; // removes -0
    if (numbers.size() >= most_seen)
      return 0;
    return numbers.emplace(std::make_pair(phase, angles), numbers.size()).first->second;
  }

  /** Number of pairs. */
  std::size_t size() const
  {
    return numbers.size();
  }

  /** Largest rotation (degrees) caused by rounding. */
  double deviation() const
  {
    return largest;
  }

  /** The pairs in the order of their numbers. */
  std::vector<OrientedPhase> materials() const
  {
    std::vector<OrientedPhase> result(numbers.size());
    for (const auto &[material, number] : numbers)
      result[number] = {material.first, material.second};
    return result;
  }

private:
  static Eigen::Matrix3d rotation_of(const Angles &angles)
  {
    const double degree = M_PI / 180.;
    return bunge_rotation(degree * angles[0], degree * angles[1], degree * angles[2]);
  }

  /** Angle (degrees) between two orientations; accurate for small angles, too. */
  static double angle_between(const Angles &a, const Angles &b)
  {
    const double chord = (rotation_of(a) - rotation_of(b)).norm() / std::sqrt(8.);
    return 360. / M_PI * std::asin(std::min(1., chord));
  }

  double step;
  double largest = 0.;
  std::map<std::pair<unsigned int, Angles>, std::size_t> numbers;
};
} // namespace mesoslip

#endif
