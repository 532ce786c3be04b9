#ifndef mesoslip_contact_flat_profile_h
#define mesoslip_contact_flat_profile_h

#include "parameters/expression.h"

#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
/** Height of the flat over its plane (m) at places on it (m), in the coordinates that the body has at the start. */
class FlatProfile
{
public:
  virtual ~FlatProfile() = default;

  /** The height (m) at @p x and, in 3D, @p y (m). */
  virtual double operator()(const double x, const double y) const = 0;

  /** Whether the height has more than one value along y. */
  virtual bool varies_along_y() const = 0;

  /** For logs and comparisons of runs. */
  virtual std::string text() const = 0;
};

/** A formula in x and, in 3D, y. */
class ProfileExpression final : public FlatProfile
{
public:
  /** @throws std::invalid_argument for a text that is no such formula */
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

/** Places in ascending order between which heights are linear. */
struct ProfileAxis
{
  std::vector<double> at; ///< m; one or more

  /** The first of the two places around @p x, and the share of the way to the second. Beyond the ends it is an end,
   * or, where the axis @p repeats, what is as far from the first in one of the copies of the axis. */
  std::pair<std::size_t, double> locate(double x, const bool repeats) const;
};

/** Heights of a table or picture. */
class ProfileTable final : public FlatProfile
{
public:
  /** What it is made of. */
  struct Points
  {
    ProfileAxis x;              ///< places along x
    ProfileAxis y;              ///< along y; a single one: the height does not vary there
    std::vector<double> height; ///< m, [y][x]
    bool repeats = false;       ///< beyond its ends; else the height there goes on
    std::string source;         ///< its text()
  };

  /** As many heights as there are pairs of places. */
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
