#include "homogenization/derivatives/loss_output.h"

#include "io/table.h"
#include "material/engineering_constants.h"
#include "material/plausibility.h"
#include "parameters/parameters.h"

#include <Eigen/LU>

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Results of the mean complex stiffness: entries, Young's and shear moduli. */
template <int dim>
std::vector<ComplexResult> complex_moduli(const RveParameters &parameters,
                                          const RveResults<dim> &results)
{
  VoigtMatrix<dim> real = VoigtMatrix<dim>::Zero(), imaginary = real;
  double n              = 0.;
  const auto conditions = effective_conditions(parameters);
  for (const EnsembleMember<dim> &member : results.members)
    for (std::size_t c = 0; c < member.complex.size(); ++c)
      if (std::count(conditions.begin(), conditions.end(), parameters.conditions[c]) > 0)
        {
          real += member.complex[c].real;
          imaginary += member.complex[c].imaginary;
          n += 1.;
        }
  if (!parameters.effective_full)
    {
      real      = orthotropic_part<dim>(real);
      imaginary = orthotropic_part<dim>(imaginary);
    }
  const std::complex<double> i(0., 1.);
  const Eigen::Matrix<std::complex<double>, n_voigt<dim>, n_voigt<dim>> D =
    (real.template cast<std::complex<double>>() + i * imaginary) / n;
  std::vector<ComplexResult> list;
  for (const StiffnessEntry &entry : stiffness_entries<dim>())
    list.push_back({entry.name, "Pa", D(entry.row, entry.column)});
  const auto S = D.inverse().eval();
  for (int k = 0; k < n_voigt<dim>; ++k)
    {
      const std::string axes = voigt_names<dim>[static_cast<std::size_t>(k)];
      list.push_back(
        {k < dim ? "E_" + axes.substr(0, 1) : "G_" + axes, "Pa", 1. / S(k, k)});
    }
  return list;
}
} // namespace

template <int dim>
std::vector<ComplexResult> lossy_results(const RveParameters &parameters,
                                         const RveResults<dim> &results,
                                         const std::vector<VariedResult> &varied)
{
  if (parameters.complex_loss)
    return complex_moduli<dim>(parameters, results);
  std::vector<ComplexResult> list;
  for (const VariedResult &result : varied)
    list.push_back({result.name, result.unit, {result.value, result.derivatives.back()}});
  return list;
}

void write_loss(const std::vector<ComplexResult> &lossy, const std::string &path)
{
  TableWriter table(path, {"result", "real", "imaginary", "unit", "loss_factor [-]"});
  for (const auto &[name, unit, value] : lossy)
    table.add_row({name, to_text(value.real()), to_text(value.imag()), unit,
                   value.real() != 0. ? to_text(value.imag() / value.real()) : ""});
  table.flush();
}

template <int dim>
std::vector<std::string> loss_warnings(const RveParameters &parameters,
                                       const std::vector<EnsembleMember<dim>> &members)
{
  constexpr double largest_first_order = 0.1, largest_error = 1e-3;
  const double loss = largest_loss_factor(parameters);
  if (!parameters.complex_loss && loss > largest_first_order)
    return {
      brief_text(2,
                 "The loss factors of the composite are those of first order, which may "
                 "be off by about ",
                 100. * loss * loss, " %, as a phase has one of ", loss,
                 "; set Homogenization/Loss = complex")};
  double error = 0.;
  for (const EnsembleMember<dim> &member : members)
    for (const ComplexStiffness<dim> &one : member.complex)
      error = std::max(error, one.error);
  if (error > largest_error)
    return {brief_text(2, "The complex stiffness may be off by ", 100. * error,
                       " %, as a phase has a Loss factor of ", loss)};
  return {};
}

#define MESOSLIP_INSTANTIATE(dim)                                                       \
  template std::vector<ComplexResult> lossy_results<dim>(                               \
    const RveParameters &, const RveResults<dim> &, const std::vector<VariedResult> &); \
  template std::vector<std::string> loss_warnings<dim>(                                 \
    const RveParameters &, const std::vector<EnsembleMember<dim>> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
