#ifndef mesoslip_contact_flat_profile_h
#define mesoslip_contact_flat_profile_h

#include "parameters/expression.h"

#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
/**
 * Height of the flat over its plane (m) as a function of position (m), in the coordinates
 * of the body at the start.
 */
class FlatProfile
{
public:
  virtual ~FlatProfile() = default;

  /** The height (m) at @p x and, in 3D, @p y (m). */
  virtual double operator()(const double x, const double y) const = 0;

  /** Whether the height varies along y. */
  virtual bool varies_along_y() const = 0;

  /** Description for logs and comparisons of runs. */
  virtual std::string text() const = 0;
};

/** Profile given by a formula in x and, in 3D, y. */
class ProfileExpression final : public FlatProfile
{
public:
  /** Parses @p text. @throws std::invalid_argument for an invalid formula */
  ProfileExpression(const std::string &text, const unsigned int dim);

  double operator()(const double x, const double y) const override
  {
    return expression({x, y});
  }

  bool varies_along_y() const override
  {
    return in_space && expression.has(1);
  }

  std::string text() const override
  {
    return expression.text();
  }

private:
  const Expression expression;
  const bool in_space;
};

/** Ascending grid points with linear interpolation in between. */
struct ProfileAxis
{
  std::vector<double> at; ///< grid points (m), at least one

  /**
   * Index of the grid point at or before @p x, and the fraction of the interval behind
   * it. Beyond the ends it is the end or, if the axis @p repeats, the equivalent point of
   * the period.
   */
  std::pair<std::size_t, double> locate(double x, const bool repeats) const;
};

/** Profile given by a table or picture of heights. */
class ProfileTable final : public FlatProfile
{
public:
  /** Data of the profile. */
  struct Points
  {
    ProfileAxis x;              ///< grid points along x
    ProfileAxis y;              ///< along y; a single point: no variation along y
    std::vector<double> height; ///< heights (m), [y][x]
    bool repeats = false;       ///< periodic; else constant beyond its ends
    std::string source;         ///< description, returned by text()
  };

  /** Requires one height per pair of grid points. */
  explicit ProfileTable(const Points &points);

  double operator()(const double x, const double y) const override;

  bool varies_along_y() const override
  {
    return points.y.at.size() > 1;
  }

  std::string text() const override
  {
    return points.source;
  }

private:
  const Points points;
};
} // namespace mesoslip

#endif
