#include "homogenization/ensemble.h"

#include "base/errors.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mesoslip
{
EntryStatistics entry_statistics(const std::vector<double> &values,
                                 const double confidence)
{
  EntryStatistics s;
  const double n = values.size();
  for (const double value : values)
    s.mean += value / n;
  if (values.size() < 2)
    return s;
  double square = 0.;
  for (const double value : values)
    square += (value - s.mean) * (value - s.mean);
  s.standard_deviation = std::sqrt(square / (n - 1.));
  const boost::math::students_t student(n - 1.);
  s.half_width = boost::math::quantile(student, 0.5 * (1. + confidence)) *
                 s.standard_deviation / std::sqrt(n);
  if (s.mean != 0.)
    s.relative_error = 2. * s.standard_deviation / (std::sqrt(n) * std::fabs(s.mean));
  return s;
}

StiffnessStatistics stiffness_statistics(const std::vector<EnsembleMember> &members,
                                         const std::size_t condition,
                                         const double confidence)
{
  StiffnessStatistics statistics;
  std::vector<double> values(members.size());
  for (unsigned int e = 0; e < 9; ++e)
    {
      for (std::size_t m = 0; m < members.size(); ++m)
        values[m] = members[m].responses[condition].stiffness.data()[e];
      const EntryStatistics s                 = entry_statistics(values, confidence);
      statistics.mean.data()[e]               = s.mean;
      statistics.standard_deviation.data()[e] = s.standard_deviation;
      statistics.half_width.data()[e]         = s.half_width;
      statistics.relative_error.data()[e]     = s.relative_error;
    }
  return statistics;
}

std::vector<std::string> morphology_warnings(const std::vector<EnsembleMember> &members)
{
  std::vector<std::string> sentences;
  std::map<std::string, std::vector<std::uint64_t>> seeds;
  for (const EnsembleMember &member : members)
    for (const std::string &sentence : member.warnings)
      {
        std::vector<std::uint64_t> &of = seeds[sentence];
        if (of.empty())
          sentences.push_back(sentence);
        of.push_back(member.seed);
      }
  for (std::string &sentence : sentences)
    {
      const std::vector<std::uint64_t> of = seeds[sentence];
      std::string list;
      for (const std::uint64_t seed : of)
        list += (list.empty() ? "" : ", ") + std::to_string(seed);
      if (of.size() < members.size())
        sentence += of.size() == 1 ? " (seed " + list + ")" : " (seeds " + list + ")";
    }
  return sentences;
}

UniformMaterial make_material(const Microstructure &microstructure)
{
  std::vector<ElasticPhase<2>> classes;
  // Statics need no density; a phase may come without one.
  for (const Phase<2> &phase : microstructure.phases)
    classes.push_back({phase.stiffness, phase.density > 0. ? phase.density : 1.});
  try
    {
      return UniformMaterial(microstructure.map.grid, classes, microstructure.map.id);
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(std::string("Phases: ") + e.what());
    }
}

VoigtMatrix<2> mean_stiffness(const std::vector<EnsembleMember> &members,
                              const std::vector<BoundaryCondition> &conditions)
{
  VoigtMatrix<2> sum = VoigtMatrix<2>::Zero();
  double n           = 0.;
  for (const EnsembleMember &member : members)
    for (const HomogenizedResponse &response : member.responses)
      if (std::count(conditions.begin(), conditions.end(), response.condition) > 0)
        {
          sum += response.stiffness;
          n += 1.;
        }
  return n > 0. ? VoigtMatrix<2>(sum / n) : sum;
}

std::vector<BoundaryCondition> effective_conditions(const RveParameters &parameters)
{
  if (parameters.effective != "mean")
    return {boundary_condition(parameters.effective)};
  const std::vector<BoundaryCondition> both = {BoundaryCondition::KUBC,
                                               BoundaryCondition::SUBC};
  for (const BoundaryCondition condition : both)
    if (std::count(parameters.conditions.begin(), parameters.conditions.end(),
                   condition) == 0)
      return parameters.conditions;
  return both;
}
} // namespace mesoslip
