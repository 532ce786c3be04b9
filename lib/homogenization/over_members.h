#ifndef mesoslip_homogenization_over_members_h
#define mesoslip_homogenization_over_members_h

#include "base/errors.h"
#include "homogenization/ensemble.h"
#include "material/plausibility.h"

#include <algorithm>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace mesoslip
{
/** Residuals above this limit get a warning: the other programs and the pages rely on
 * five digits. */
constexpr double tell_above = 1e-5;

/** Residuals above this limit are errors: phase moduli are known to about one percent, so
 * a less certain result is useless. */
constexpr double refuse_above = 1e-2;

/** Mean of @p value, a vector or matrix of a response, over the @p responses of all
 * members under @p conditions; zero if there are none. */
template <int dim, typename Response, typename Value>
auto mean_over(const std::vector<EnsembleMember<dim>> &members,
               std::vector<Response> EnsembleMember<dim>::*responses,
               const Value &value,
               const std::vector<BoundaryCondition> &conditions)
{
  std::decay_t<std::invoke_result_t<Value, const Response &>> sum;
  sum.setZero();
  double n = 0.;
  for (const EnsembleMember<dim> &member : members)
    for (const Response &response : member.*responses)
      if (std::count(conditions.begin(), conditions.end(), response.condition) > 0)
        {
          sum += std::invoke(value, response);
          n += 1.;
        }
  if (n > 0.)
    sum /= n;
  return sum;
}

/** A warning for each of the @p responses whose @p residual exceeds tell_above; @p what
 * names the quantities that differ.
 * @throws NumericalFailure if the residual exceeds refuse_above or is not a number */
template <int dim, typename Response, typename Residual>
std::vector<std::string>
residual_warnings(const std::vector<EnsembleMember<dim>> &members,
                  std::vector<Response> EnsembleMember<dim>::*responses,
                  const Residual &residual,
                  const std::string &what,
                  const double tolerance)
{
  std::vector<std::string> sentences;
  for (const EnsembleMember<dim> &member : members)
    for (const Response &response : member.*responses)
      {
        const double error = std::invoke(residual, response);
        if (error <= tell_above)
          continue;
        const std::string sentence =
          to_string(response.condition) +
          brief_text(2, ": ", what, " differ by ", error,
                     "; lower Homogenization/Tolerance (now ", tolerance, ")") +
          (members.size() > 1 ? " (" + member.origin + ")" : "");
        if (!(error <= refuse_above))
          throw NumericalFailure(sentence);
        sentences.push_back(sentence);
      }
  return sentences;
}
} // namespace mesoslip

#endif
