#ifndef mesoslip_contact_laws_friction_table_h
#define mesoslip_contact_laws_friction_table_h

#include "contact/laws/nodewise_law.h"

#include <vector>

namespace mesoslip
{
/**
 * mu(V, p) from a table: bilinear interpolation, constant beyond the table in each
 * direction.
 */
class FrictionTable final : public NodewiseLaw<FrictionTable>
{
public:
  /** Points of the table. */
  struct Points
  {
    std::vector<double> slip_rate; ///< m/s, ascending, one or more
    std::vector<double> pressure;  ///< Pa, ascending, one or more

    /** mu at [i * pressure.size() + j]. */
    std::vector<double> coefficient;
  };

  /** Law that interpolates @p points. */
  explicit FrictionTable(Points points);

  double coefficient(const SlipPoint &at) const override;
  double slope(const SlipPoint &at) const override;
  double largest(const double fastest) const override;
  double steepest_fall() const override;

  bool looks_around() const override
  {
    return points.pressure.size() > 1;
  }

private:
  /** mu in row i at the pressure of @p at. */
  double on_row(const std::size_t i, const SlipPoint &at) const;

  const Points points;
};
} // namespace mesoslip

#endif
