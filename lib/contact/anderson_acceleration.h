#ifndef mesoslip_contact_anderson_acceleration_h
#define mesoslip_contact_anderson_acceleration_h

#include <Eigen/Dense>

#include <deque>

namespace mesoslip
{
/**
 * Anderson's acceleration of a fixed-point iteration x = g(x) (D. G. Anderson, J. ACM 12,
 * 1965): the next x is the combination of the last few g(x) for which the same
 * combination of residuals is smallest. For a linear g it is equivalent to GMRES.
 */
class AndersonAcceleration
{
public:
  /** Clears the history; call it after g has changed. */
  void reset()
  {
    residuals.clear();
    images.clear();
  }

  /** The next x from @p x and @p g = g(x). */
  Eigen::VectorXd next(const Eigen::VectorXd &x, const Eigen::VectorXd &g)
  {
    residuals.emplace_back(g - x);
    images.push_back(g);
    if (images.size() > depth + 1)
      {
        residuals.pop_front();
        images.pop_front();
      }
    const Eigen::Index m = static_cast<Eigen::Index>(images.size()) - 1;
    if (m == 0)
      return g;
    Eigen::MatrixXd dr(x.size(), m), dg(x.size(), m);
    for (Eigen::Index k = 0; k < m; ++k)
      {
        dr.col(k) = residuals[k + 1] - residuals[k];
        dg.col(k) = images[k + 1] - images[k];
      }
    // The decomposition of a zero matrix yields NaN.
    if (dr.isZero(0.))
      return g;
    return g - dg * dr.colPivHouseholderQr().solve(residuals.back());
  }

private:
  static constexpr std::size_t depth = 10; ///< number of former iterates
  std::deque<Eigen::VectorXd> residuals, images;
};
} // namespace mesoslip

#endif
