#include "sliding/complex/contact_parts.h"

namespace mesoslip
{
std::vector<double> ContactParts::of_contact(const SlidingState &state) const
{
  std::vector<double> result(names.size(), 0.);
  double whole = 0.;
  for (const double area : state.area)
    whole += area;
  for (std::size_t p = 0; p < names.size(); ++p)
    for (std::size_t k = 0; k < state.place.size(); ++k)
      result[p] += shares[p][state.place[k]] * state.area[k] / whole;
  return result;
}

std::vector<PartOfMode> ContactParts::of_mode(const ComplexMode &mode,
                                              const SlidingState &state) const
{
  if (!differ())
    return {};
  std::vector<PartOfMode> result(names.size());
  // Nodes held along the flat are beyond the last entry, or have zeros.
  const auto n = static_cast<std::size_t>(mode.motion_of_contact.size());
  double whole = 0.;
  for (std::size_t k = 0; k < n; ++k)
    whole += state.area[k] * mode.motion_of_contact[static_cast<Eigen::Index>(k)];
  for (std::size_t p = 0; p < names.size(); ++p)
    for (std::size_t k = 0; k < n; ++k)
      {
        const auto node    = static_cast<Eigen::Index>(k);
        const double share = shares[p][state.place[k]];
        result[p].growth_by_friction += share * mode.growth_by_friction[node];
        if (whole > 0.)
          result[p].motion +=
            share * state.area[k] * mode.motion_of_contact[node] / whole;
      }
  return result;
}
} // namespace mesoslip
