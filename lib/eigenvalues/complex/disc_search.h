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
/**
 * Range of eigenvalues s = a + i w (1/s) to be found: frequencies from bottom to top, and
 * growth rates from left(w), which is negative, to right, the bound of growth.
 */
struct SearchRange
{
  const GrowthRegion &region; ///< region of possible growth
  double bottom = 0.;         ///< 1/s
  double top    = 0.;         ///< 1/s
  double decay  = 0.;         ///< largest decay rate (1/s), positive
  double share  = 1.;         ///< growth is searched up to this share of the frequency
  double steep  = 1.;         ///< no decay is faster than this share of the frequency
  double most   = std::numeric_limits<double>::infinity(); ///< growth rate (1/s)

  /** Whether @p s vibrates below the top and decays slowly relative to its frequency. */
  bool is_light(const SlidingPencil::Complex s) const
  {
    return s.imag() < top && -s.real() < steep * s.imag();
  }

  /** Smallest growth rate (1/s) for circular frequencies up to @p high. */
  double left(const double high) const
  {
    return -std::min(decay, steep * high);
  }

  /**
   * Largest growth rate (1/s) for circular frequencies from @p low to @p high, with a
   * margin that includes neutral modes.
   */
  double right(const double low, const double high) const
  {
    return std::min({region.width(low, high) + 1e-3 * top, share * high, most});
  }
};

/** An eigenvalue and its eigenvector. */
struct FoundMode
{
  SlidingPencil::Complex s; ///< 1/s
  ComplexVector u;          ///< normalized to u^H M u = 1
};

/** Searches a range disc by disc, and stores all eigenvalues of the upper half plane. */
class DiscSearch
{
public:
  /** All arguments must outlive this object; shifts are counted in @p report. */
  DiscSearch(const SlidingPencil &pencil,
             ComplexFactorization &factors,
             const ComplexModesOptions &options,
             ComplexModes &report);

  /**
   * Covers @p range; Arnoldi iterations start from random vectors with this @p seed.
   * @throws NotConverged
   */
  void cover(const SearchRange &range, const unsigned int seed);

  /** Eigenvalues found so far; multiple eigenvalues have independent vectors. */
  const std::vector<FoundMode> &found() const
  {
    return modes;
  }

private:
  /** A disc around centre in which all eigenvalues are known. */
  struct Disc
  {
    SlidingPencil::Complex centre; ///< the shift (1/s)
    double radius = 0.;            ///< 1/s
  };

  /**
   * Rates of relaxing below the circular frequency @p bottom, and exact ones if
   * requested.
   */
  std::vector<double> left_out(const double bottom) const;

  /**
   * Disc in which everything with a circular frequency of at least @p edge and a growth
   * rate of at least @p left is known. Eigenvalues near -r, with r of left_out(), are
   * numerous and clustered, and Arnoldi iterations do not converge for them. Therefore
   * the operator T with eigenvalues 1 / (s - centre) is multiplied by T - 1 / (-r -
   * centre). The product has the size |s + r| / |s - centre|^2 / |centre + r|: close to
   * zero for the cluster, while for wanted eigenvalues |s + r| is at least edge and at
   * least r + left.
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
  const std::vector<double> relaxing; ///< rates (1/s) of clustered eigenvalues
  const std::size_t n_exact;          ///< the first ones, of friction and states
  std::vector<FoundMode> modes;
  bool leaves_out_exact = false; ///< an iteration did not converge with them
};
} // namespace mesoslip

#endif
