#ifndef mesoslip_homogenization_loads_load_members_h
#define mesoslip_homogenization_loads_load_members_h

#include "homogenization/loads/load_evaluation.h"
#include "homogenization/rve_program.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace mesoslip
{
/** Local quantities of a run. */
template <int dim>
LocalFields<dim> fields_of(const RveParameters &parameters)
{
  return LocalFields<dim>(loaded_phases<dim>(parameters.microstructure.phases));
}

/** Statistics of a quantity in a phase. @p phase equal to the number of phases: the whole
 * volume. */
template <int dim>
Moments
moments_in(const LoadResult<dim> &result, const std::size_t phase, const std::size_t q)
{
  return phase < result.phases.size() ? result.phases[phase].quantities[q]
                                      : result.whole(q);
}

/** Name of the whole volume in lists of phase names. */
inline constexpr char whole_volume[] = "all";

/** Names of the phases and of the whole volume. */
template <int dim>
std::vector<std::string> parts_of(const RveResults<dim> &results)
{
  std::vector<std::string> names;
  for (const Phase<dim> &phase : results.first.phases)
    names.push_back(phase.name);
  names.emplace_back(whole_volume);
  return names;
}

/** Mean and standard deviation of a number over the members. */
template <typename Number>
std::array<double, 2> over_members(const std::size_t n, const Number &number)
{
  Moments all;
  for (std::size_t m = 0; m < n; ++m)
    all.add(moments_of_cell(number(m), 1., {}));
  return {
    {all.mean, n > 1 ? std::sqrt(all.squares / (static_cast<double>(n) - 1.)) : 0.}};
}

} // namespace mesoslip

#endif
