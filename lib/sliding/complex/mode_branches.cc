#include "sliding/complex/mode_branches.h"

#include <algorithm>
#include <complex>
#include <numeric>

namespace mesoslip
{
namespace
{
/** Similarity of two shapes, whose samples have length one. */
double likeness(const std::vector<std::complex<float>> &a,
                const std::vector<std::complex<float>> &b)
{
  std::complex<double> sum = 0.;
  for (std::size_t k = 0; k < a.size(); ++k)
    sum += std::conj(std::complex<double>(a[k])) * std::complex<double>(b[k]);
  return std::norm(sum);
}

struct Pair
{
  double likeness;
  std::size_t before, after;
};

/** Partner of each mode in the case before; their number if there is none. */
std::vector<std::size_t> partners(const ComplexCase &before, const ComplexCase &after)
{
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < before.samples.size(); ++i)
    for (std::size_t j = 0; j < after.samples.size(); ++j)
      {
        const double like = likeness(before.samples[i], after.samples[j]);
        if (like >= 0.5)
          pairs.push_back({like, i, j});
      }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair &a, const Pair &b) { return a.likeness > b.likeness; });
  std::vector<bool> taken(before.samples.size(), false);
  std::vector<std::size_t> result(after.samples.size(), before.samples.size());
  for (const Pair &pair : pairs)
    if (!taken[pair.before] && result[pair.after] == before.samples.size())
      {
        taken[pair.before] = true;
        result[pair.after] = pair.before;
      }
  return result;
}
} // namespace

std::vector<std::vector<unsigned int>>
mode_branches(const std::vector<ComplexCase> &cases)
{
  std::vector<std::vector<unsigned int>> branches(cases.size());
  unsigned int n_branches = 0;
  for (std::size_t k = 0; k < cases.size(); ++k)
    {
      const std::vector<std::size_t> partner =
        k == 0 ? std::vector<std::size_t>(cases[0].modes.size(), 0)
               : partners(cases[k - 1], cases[k]);
      for (const std::size_t before : partner)
        branches[k].push_back(k > 0 && before < branches[k - 1].size()
                                ? branches[k - 1][before]
                                : ++n_branches);
    }
  return branches;
}
} // namespace mesoslip
