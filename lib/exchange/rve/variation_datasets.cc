#include "exchange/rve/variation_datasets.h"

#include "base/errors.h"
#include "exchange/datasets.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
constexpr char variation[] = "/variation";

std::string dataset(const std::string &name)
{
  return std::string(variation) + "/" + name;
}
} // namespace

template <int dim>
void write_variations(Hdf5File &file, const std::vector<VariedConstant<dim>> &constants)
{
  if (constants.empty())
    return;
  const std::size_t n = constants.size();
  std::vector<std::uint64_t> phases;
  std::vector<std::string> names;
  std::vector<double> values, deviations, of_phases;
  std::map<std::string, std::vector<double>> of_volume;
  const auto append = [](std::vector<double> &to, const VoigtMatrix<dim> &D) {
    to.insert(to.end(), D.data(), D.data() + D.size());
  };
  for (const VariedConstant<dim> &constant : constants)
    {
      phases.push_back(constant.phase);
      names.push_back(constant.name);
      values.push_back(constant.value);
      deviations.push_back(constant.deviation);
      append(of_phases, constant.of_phase);
      for (const auto &[name, D] : constant.of_volume)
        append(of_volume[name], D);
    }
  const Shape matrices = {n, n_voigt<dim>, n_voigt<dim>};
  write_dataset(file, dataset("phase"), {n}, phases);
  write_dataset(file, dataset("constant"), {n}, names);
  write_dataset(file, dataset("value"), {n}, values, "unit of the constant");
  write_dataset(file, dataset("deviation"), {n}, deviations, "unit of the constant");
  write_dataset(file, dataset("phase_stiffness"), matrices, of_phases, "Pa/unit");
  for (const auto &[name, D] : of_volume)
    write_dataset(file, dataset("stiffness/" + name), matrices, D, "Pa/unit");
}

template <int dim>
std::vector<VariedConstant<dim>>
read_variations(const Hdf5File &file, const std::string &name, const std::size_t n_phases)
{
  if (!file.exists(variation))
    return {};
  const std::string hint     = "rve_homogenization writes it";
  const auto phases          = file.read<std::uint64_t>(dataset("phase"), {}, hint);
  const std::size_t n        = phases.size();
  const Shape matrices       = {n, n_voigt<dim>, n_voigt<dim>};
  const std::string of_whole = dataset("stiffness/" + name);
  const auto names           = file.read<std::string>(dataset("constant"), {n}, hint);
  const auto values          = file.read<double>(dataset("value"), {n}, hint),
             deviations      = file.read<double>(dataset("deviation"), {n}, hint),
             of_phases = file.read<double>(dataset("phase_stiffness"), matrices, hint),
             of_volume = file.read<double>(of_whole, matrices, hint);
  std::vector<VariedConstant<dim>> constants(n);
  for (std::size_t k = 0; k < n; ++k)
    {
      if (phases[k] >= n_phases || !(deviations[k] >= 0.))
        throw UserError(file.path() + ": " + variation + " has a constant of phase " +
                        std::to_string(phases[k]) + " of " + std::to_string(n_phases) +
                        " with the standard deviation " + std::to_string(deviations[k]) +
                        "; run rve_homogenization again");
      const auto matrix = [k](const std::vector<double> &of_all) -> VoigtMatrix<dim> {
        constexpr std::size_t size = n_voigt<dim> * n_voigt<dim>;
        return Eigen::Map<const VoigtMatrix<dim>>(of_all.data() + k * size);
      };
      constants[k] = {phases[k],     names[k],          values[k],
                      deviations[k], matrix(of_phases), {{name, matrix(of_volume)}}};
    }
  return constants;
}

#define MESOSLIP_INSTANTIATE(dim)                                                       \
  template void write_variations(Hdf5File &, const std::vector<VariedConstant<dim>> &); \
  template std::vector<VariedConstant<dim>> read_variations(                            \
    const Hdf5File &, const std::string &, const std::size_t);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
