#ifndef mesoslip_morphology_inclusion_bins_h
#define mesoslip_morphology_inclusion_bins_h

#include "morphology/inclusion.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mesoslip
{
/**
 * Inclusions sorted into bins by their centres. A bin is as wide as two of the largest
 * inclusions, so neighbours of a new inclusion lie in the adjacent bins.
 */
class InclusionBins
{
public:
  /** For a box of @p extents (m), @p periodic or not; inclusions may touch if their
   * centres are within @p distance (m) along each axis. */
  InclusionBins(const Vector3 &extents, const bool periodic, const Vector3 &distance)
    : lengths(extents)
    , is_periodic(periodic)
  {
    constexpr double most = 128.;
    std::size_t all       = 1;
    for (unsigned int d = 0; d < 3; ++d)
      {
        n[d] = static_cast<long>(std::clamp(extents[d] / distance[d], 1., most));
        all *= static_cast<std::size_t>(n[d]);
      }
    members.resize(all);
  }

  /** Adds an inclusion. */
  void add(const Inclusion &inclusion)
  {
    members[index(bin_of(inclusion.centre))].push_back({inclusion, inclusion.reach()});
  }

  /** Whether an inclusion is closer than @p gap (m) to @p inclusion. */
  bool any_too_close(const Inclusion &inclusion, const double gap) const
  {
    const std::array<long, 3> bin         = bin_of(inclusion.centre);
    const Member candidate                = {inclusion, inclusion.reach()};
    const std::array<Few<long>, 3> around = {
      {around_of(bin, 0), around_of(bin, 1), around_of(bin, 2)}};
    for (const long k : around[2])
      for (const long j : around[1])
        for (const long i : around[0])
          for (const Member &other : members[index({{i, j, k}})])
            if (images_too_close(candidate, other, gap))
              return true;
    return false;
  }

private:
  /** An inclusion with its reach() (m). */
  struct Member
  {
    Inclusion inclusion;
    Vector3 reach;
  };

  std::array<long, 3> bin_of(const Vector3 &place) const
  {
    std::array<long, 3> bin;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const double x = place[d] / lengths[d] * static_cast<double>(n[d]);
        bin[d]         = std::clamp(static_cast<long>(std::floor(x)), 0L, n[d] - 1);
      }
    return bin;
  }

  std::size_t index(const std::array<long, 3> &bin) const
  {
    return static_cast<std::size_t>((bin[2] * n[1] + bin[1]) * n[0] + bin[0]);
  }

  /** Up to three numbers or lengths. */
  template <typename T>
  struct Few
  {
    std::array<T, 3> items = {};
    unsigned int n         = 0;

    void push_back(const T item)
    {
      items[n++] = item;
    }
    const T *begin() const
    {
      return items.data();
    }
    const T *end() const
    {
      return items.data() + n;
    }
  };

  /** Indices along axis @p d of the bins around @p bin, each once. */
  Few<long> around_of(const std::array<long, 3> &bin, const unsigned int d) const
  {
    Few<long> found;
    for (long k = bin[d] - 1; k <= bin[d] + 1; ++k)
      {
        const long wrapped = is_periodic ? (k + n[d]) % n[d] : k;
        if (wrapped >= 0 && wrapped < n[d] &&
            std::find(found.begin(), found.end(), wrapped) == found.end())
          found.push_back(wrapped);
      }
    return found;
  }

  /** Whether @p b or a periodic image of it is too close to @p a. */
  bool images_too_close(const Member &a, const Member &b, const double gap) const
  {
    const int n_images = is_periodic ? 1 : 0;
    std::array<Few<double>, 3> offsets; // at which bounding boxes touch
    for (unsigned int c = 0; c < 3; ++c)
      {
        const double d = b.inclusion.centre[c] - a.inclusion.centre[c];
        for (int image = -n_images; image <= n_images; ++image)
          if (const double offset = d + image * lengths[c];
              std::fabs(offset) < a.reach[c] + b.reach[c] + gap)
            offsets[c].push_back(offset);
        if (offsets[c].n == 0)
          return false;
      }
    for (const double z : offsets[2])
      for (const double y : offsets[1])
        for (const double x : offsets[0])
          if (too_close(a.inclusion, b.inclusion, {{x, y, z}}, gap))
            return true;
    return false;
  }

  Vector3 lengths;
  bool is_periodic;
  std::array<long, 3> n = {};
  std::vector<std::vector<Member>> members;
};
} // namespace mesoslip

#endif
