#ifndef mesoslip_eigenvalues_complex_disc_search_h
#define mesoslip_eigenvalues_complex_disc_search_h

#include "eigenvalues/complex/complex_modes.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** The eigenvalues s = a + i w (1/s) that are wanted: from the frequency bottom up to top, and
 * from left(w), which is negative, to right of all that can grow. */
struct SearchRange
{
  const GrowthRegion &region; ///< where growth can be
  double bottom = 0.;         ///< 1/s
  double top    = 0.;         ///< 1/s
  double decay  = 0.;         ///< of the fastest decaying ones (1/s), positive
  double share  = 1.;         ///< of the frequency, in which growth is looked for
  double steep  = 1.;         ///< no decay is faster than this share of the frequency
  double most   = std::numeric_limits<double>::infinity(); ///< growth rate (1/s)

  /** Whether @p s vibrates below the top, and decays slowly for its frequency. */
  bool is_light(const SlidingPencil::Complex s) const
  {
    return s.imag() < top && -s.real() < steep * s.imag();
  }

  /** Least growth rate of circular frequencies up to @p high. */
  double left(const double high) const
  {
    return -std::min(decay, steep * high);
  }

  /** Largest growth rate (1/s) of circular frequencies from @p low to @p high, and a little
   * more, so that neutral modes are in the range. */
  double right(const double low, const double high) const
  {
    return std::min({region.width(low, high) + 1e-3 * top, share * high, most});
  }
};

/** An eigenvalue and its vector. */
struct FoundMode
{
  SlidingPencil::Complex s; ///< 1/s
  ComplexVector u;          ///< u^H M u is one
};

/** Searches a range disc by disc, and remembers all eigenvalues of the upper half plane. */
class DiscSearch
{
public:
  /** All arguments have to outlive this object; shifts are counted in @p report. */
  DiscSearch(const SlidingPencil &pencil,
             ComplexFactorization &factors,
             const ComplexModesOptions &options,
             ComplexModes &report);

  /** Covers @p range, starting Arnoldi iterations from random vectors of this @p seed.
   * @throws NotConverged */
  void cover(const SearchRange &range, const unsigned int seed);

  /** Eigenvalues found so far, of multiple ones with independent vectors. */
  const std::vector<FoundMode> &found() const
  {
    return modes;
  }

private:
  /** All eigenvalues nearer to centre than radius are known. */
  struct Disc
  {
    SlidingPencil::Complex centre; ///< the shift (1/s)
    double radius = 0.;            ///< 1/s
  };

  /** Those of relaxing that lie below the circular frequency @p bottom, and exact ones if wanted. */
  std::vector<double> left_out(const double bottom) const;

  /**
   * Of the disc whatever has a circular frequency of @p edge and a growth rate of @p left at least.
   * Eigenvalues near -r, r being one of left_out(), are many and alike, which Arnoldi iterations do
   * not get through. So the operator T, with the eigenvalues 1 / (s - centre), is multiplied by T -
   * 1 / (-r - centre), which makes the product |s + r| / |s - centre|^2 / |centre + r| in size:
   * next to nothing for these, and for what is wanted at least that with |s + r| no less than edge
   * and than r + left.
   */
  std::optional<Disc> nearest(const SlidingPencil::Complex centre,
                              const int count,
                              const unsigned int seed,
                              const SearchRange &range,
                              const double edge,
                              const double left);
  void keep(const SlidingPencil::Complex s, ComplexVector u);

  const SlidingPencil &pencil;
  ComplexFactorization &factors;
  const ComplexModesOptions &options;
  ComplexModes &report;
  const std::vector<double> relaxing; ///< 1/s; eigenvalues near their negative are many
  const std::size_t n_exact; ///< of these, the first, which are 1/delta and 1/tau
  std::vector<FoundMode> modes;
  bool leaves_out_exact = false; ///< as an iteration has not converged with them
};
} // namespace mesoslip

#endif
