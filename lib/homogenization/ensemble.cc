#include "homogenization/ensemble.h"

#include "base/errors.h"
#include "base/text.h"
#include "homogenization/over_members.h"
#include "material/symmetric_eigenvalues.h"

#include <Eigen/Cholesky>

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** The means over two phases follow from the stiffness and the difference of the phases,
 * which magnifies the error. */
constexpr double refuse_phase_means_above = 0.1;

/** Limits of dropped entries and of differences between conditions for a warning. */
constexpr double largest_dropped = 0.01, largest_factor = 2.;

template <int dim>
bool is_positive_definite(const VoigtMatrix<dim> &D)
{
  // Scaled by the diagonal, as moduli may differ by more than double precision resolves.
  const VoigtVector<dim> scale  = D.diagonal().cwiseSqrt().cwiseInverse();
  const VoigtMatrix<dim> scaled = scale.asDiagonal() * D * scale.asDiagonal();
  return scaled.allFinite() &&
         Eigen::LLT<VoigtMatrix<dim>>(scaled).info() == Eigen::Success;
}

/** Below this a smaller tolerance does not make the solution more accurate. */
constexpr double smallest_tolerance = 1e-12;

/** Remedy for large residuals. Mean strains follow from the sides for any solution, so
 * their residual is independent of the tolerance. */
template <int dim>
std::string remedy(const HomogenizedResponse<dim> &r, const double tolerance)
{
  if (r.condition != BoundaryCondition::SUBC &&
      !(r.mean_residual <= std::max(tell_above, r.hill_mandel_residual)))
    return "; this is no matter of Homogenization/Tolerance: cells and sides of the "
           "volume "
           "do not fit together";
  if (tolerance <= smallest_tolerance)
    return "; this is round-off, as moduli differ too much";
  return "; lower Homogenization/Tolerance (now " + to_text(tolerance) + ")";
}

std::string gigapascals(const double modulus)
{
  std::ostringstream text;
  text.precision(4);
  text << modulus * 1e-9 << " GPa";
  return text.str();
}

template <int dim>
std::string dropped_entries(const VoigtMatrix<dim> &D)
{
  std::ostringstream text;
  text.precision(3);
  for (const auto &entry : stiffness_entries<dim>())
    {
      const unsigned int i = entry.row, j = entry.column;
      const double share = std::fabs(D(i, j)) / std::sqrt(D(i, i) * D(j, j));
      if (!entry.couples_shear(dim) || !(share > largest_dropped))
        continue;
      const auto diagonal = [](const unsigned int k) {
        return "D" + std::to_string(11 * (k + 1));
      };
      text << (text.tellp() > 0 ? " and " : "") << entry.name << " = "
           << gigapascals(D(i, j)) << " (" << 100. * share << " % of the root of "
           << diagonal(i) << " " << diagonal(j) << ")";
    }
  return text.str().empty() ? std::string()
                            : "The effective stiffness lacks " + text.str() +
                                ", which Homogenization/Effective symmetry = orthotropic "
                                "drops: set it to full, or turn the morphology so that " +
                                (dim == 2 ? "x and y" : "x, y and z") + " are its axes";
}

/** Warning on stress couplings that MUBC neglect if the axes are not axes of
 * orthotropy. */
template <int dim>
std::string mixed_coupling(const std::vector<EnsembleMember<dim>> &members)
{
  double largest = 0.;
  for (const EnsembleMember<dim> &member : members)
    for (const HomogenizedResponse<dim> &response : member.responses)
      largest = std::max(largest, response.coupling);
  if (largest <= largest_dropped)
    return {};
  std::ostringstream text;
  text.precision(3);
  text
    << "MUBC: shear is coupled to other components by mean stresses of up to "
    << 100. * largest
    << " % of the root of the diagonal entries, which its stiffness lacks: MUBC are for "
       "volumes with the axes of orthotropy along "
    << (dim == 2 ? "x and y" : "x, y and z")
    << "; set Homogenization/Boundary conditions to PBC, or turn the morphology; "
       "in grains that free sides cut MUBC localize better all the same";
  return text.str();
}

template <int dim>
std::string conditions_apart(const VoigtMatrix<dim> &kubc, const VoigtMatrix<dim> &subc)
{
  // Eigenvalues: stationary values of the ratio of the two energies over all strains.
  const Eigen::VectorXd ratios = symmetric_eigenvalues(kubc, subc);
  const double factor          = std::max(ratios[n_voigt<dim> - 1], 1. / ratios[0]);
  if (factor <= largest_factor)
    return {};
  std::ostringstream text;
  text.precision(3);
  text << "The effective stiffness is the mean of KUBC and SUBC, of which the energies "
          "differ by up to the factor "
       << factor << " (";
  for (unsigned int i = 0; i < n_voigt<dim>; ++i)
    text << (i > 0 ? "; " : "") << "D" << i + 1 << i + 1 << " = "
         << gigapascals(kubc(i, i)) << " and " << gigapascals(subc(i, i));
  text << "): it says little about the composite; set Homogenization/Effective to one "
          "condition, such as PBC, or "
          "take a larger volume";
  return text.str();
}
} // namespace

template <int dim>
StiffnessStatistics<dim>
stiffness_statistics(const std::vector<EnsembleMember<dim>> &members,
                     const std::size_t condition,
                     const double confidence)
{
  StiffnessStatistics<dim> s;
  const double n = members.size();
  for (const EnsembleMember<dim> &member : members)
    s.mean += member.responses[condition].stiffness / n;
  if (members.size() < 2)
    return s;
  VoigtMatrix<dim> squares = VoigtMatrix<dim>::Zero();
  for (const EnsembleMember<dim> &member : members)
    squares += (member.responses[condition].stiffness - s.mean).cwiseAbs2();
  s.standard_deviation = (squares / (n - 1.)).cwiseSqrt();
  const boost::math::students_t student(n - 1.);
  s.half_width = boost::math::quantile(student, 0.5 * (1. + confidence)) *
                 s.standard_deviation / std::sqrt(n);
  for (unsigned int e = 0; e < n_voigt<dim> * n_voigt<dim>; ++e)
    if (const double mean = std::fabs(s.mean.data()[e]); mean != 0.)
      s.relative_error.data()[e] =
        2. * s.standard_deviation.data()[e] / (std::sqrt(n) * mean);
  return s;
}

template <int dim>
std::vector<std::string>
morphology_warnings(const std::vector<EnsembleMember<dim>> &members)
{
  std::vector<std::string> sentences;
  std::map<std::string, std::vector<std::string>> origins;
  for (const EnsembleMember<dim> &member : members)
    for (const std::string &sentence : member.warnings)
      {
        std::vector<std::string> &of = origins[sentence];
        if (of.empty())
          sentences.push_back(sentence);
        of.push_back(member.origin);
      }
  for (std::string &sentence : sentences)
    if (const std::vector<std::string> of = origins[sentence]; of.size() < members.size())
      sentence += " (" + to_text(of) + ")";
  return sentences;
}

UniformMaterial make_material(const PhaseMap<2> &map, std::vector<ElasticPhase<2>> phases)
{
  for (ElasticPhase<2> &phase : phases)
    phase.density = 1.; // statics do not use it
  try
    {
      return UniformMaterial(map.grid, phases, map.id);
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(std::string("Phases: ") + e.what());
    }
}

template <int dim>
VoigtMatrix<dim> mean_stiffness(const std::vector<EnsembleMember<dim>> &members,
                                const std::vector<BoundaryCondition> &conditions)
{
  return mean_over(members, &EnsembleMember<dim>::responses,
                   &HomogenizedResponse<dim>::stiffness, conditions);
}

double largest_loss_factor(const RveParameters &parameters)
{
  double largest = 0.;
  for (const PhaseParameters &phase : parameters.microstructure.phases)
    largest = std::max(largest, phase.loss_factor);
  return largest;
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

template <int dim>
std::string check_response(const HomogenizedResponse<dim> &r, const double tolerance)
{
  const bool stresses         = r.condition == BoundaryCondition::SUBC;
  const char *const tensor    = stresses ? "B" : "L";
  const std::string condition = to_string(r.condition);
  const auto refuse           = [&](const std::string &what) {
    throw NumericalFailure(condition + ": " + what + remedy(r, tolerance));
  };
  std::ostringstream text;
  text.precision(1);
  text << std::scientific;
  if (!is_positive_definite<dim>(r.stiffness))
    refuse("the stiffness is not positive definite");
  if (r.two_phase_residual && !(*r.two_phase_residual <= refuse_phase_means_above))
    {
      text << "the means over the two phases contradict the stiffness by "
           << *r.two_phase_residual << ", more than " << refuse_phase_means_above;
      refuse(text.str());
    }
  text << "the stiffness from the energy and the one from the mean "
       << (stresses ? "strain" : "stress") << " differ by " << r.hill_mandel_residual
       << ", <" << tensor << "> from I by " << r.mean_residual;
  if (!(r.hill_mandel_residual <= refuse_above) || !(r.mean_residual <= refuse_above))
    {
      text << ", more than " << refuse_above;
      refuse(text.str());
    }
  const double error = std::max(r.hill_mandel_residual, r.mean_residual);
  if (error <= tell_above)
    return {};
  // In a test with 3000 random solutions, one had an error 35 times its residual.
  text << ", so about " << static_cast<int>(-std::log10(error)) - 1
       << " digits hold, in the tensors " << tensor << " as well" << remedy(r, tolerance);
  return condition + ": " + text.str();
}

template <int dim>
std::vector<std::string> result_warnings(const std::vector<EnsembleMember<dim>> &members,
                                         const RveParameters &parameters)
{
  std::vector<std::string> sentences;
  for (const EnsembleMember<dim> &member : members)
    for (const HomogenizedResponse<dim> &response : member.responses)
      {
        const std::string sentence = check_response(response, parameters.tolerance);
        if (!sentence.empty())
          sentences.push_back(sentence +
                              (members.size() > 1 ? " (" + member.origin + ")" : ""));
      }
  if (const std::string sentence = mixed_coupling(members); !sentence.empty())
    sentences.push_back(sentence);
  const VoigtMatrix<dim> kubc = mean_stiffness(members, {BoundaryCondition::KUBC}),
                         subc = mean_stiffness(members, {BoundaryCondition::SUBC});
  if (!parameters.effective_full)
    sentences.push_back(
      dropped_entries<dim>(mean_stiffness(members, effective_conditions(parameters))));
  if (parameters.effective == "mean" && kubc(0, 0) > 0. && subc(0, 0) > 0.)
    sentences.push_back(conditions_apart<dim>(kubc, subc));
  sentences.erase(std::remove(sentences.begin(), sentences.end(), ""), sentences.end());
  return sentences;
}

template StiffnessStatistics<2> stiffness_statistics<2>(
  const std::vector<EnsembleMember<2>> &, const std::size_t, const double);
template std::vector<std::string>
morphology_warnings<2>(const std::vector<EnsembleMember<2>> &);
template VoigtMatrix<2> mean_stiffness<2>(const std::vector<EnsembleMember<2>> &,
                                          const std::vector<BoundaryCondition> &);
template std::string check_response<2>(const HomogenizedResponse<2> &, const double);
template std::vector<std::string>
result_warnings<2>(const std::vector<EnsembleMember<2>> &, const RveParameters &);

template StiffnessStatistics<3> stiffness_statistics<3>(
  const std::vector<EnsembleMember<3>> &, const std::size_t, const double);
template std::vector<std::string>
morphology_warnings<3>(const std::vector<EnsembleMember<3>> &);
template VoigtMatrix<3> mean_stiffness<3>(const std::vector<EnsembleMember<3>> &,
                                          const std::vector<BoundaryCondition> &);
template std::string check_response<3>(const HomogenizedResponse<3> &, const double);
template std::vector<std::string>
result_warnings<3>(const std::vector<EnsembleMember<3>> &, const RveParameters &);
} // namespace mesoslip
