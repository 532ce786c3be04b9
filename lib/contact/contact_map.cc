#include "contact/contact_map.h"

#include <algorithm>
#include <utility>

namespace mesoslip
{
std::vector<std::string> map_field_names()
{
  return {"pressure",      "traction",  "slip velocity",       "state",
          "friction work", "law state", "remembered pressure", "gap"};
}

bool ContactMapSetup::has(const MapQuantity quantity) const
{
  return std::find(quantities.begin(), quantities.end(), quantity) != quantities.end();
}

std::vector<MapField> ContactMapSetup::fields(const unsigned int dim) const
{
  const unsigned int vector = dim - 1;
  const MapField all[]      = {
         {MapQuantity::pressure, "pressure", "Pa", 1, true},
         {MapQuantity::traction, "traction", "Pa", vector, true},
         {MapQuantity::slip_velocity, "slip_velocity", "m/s", vector, false},
         {MapQuantity::state, "state", "-", 1, false},
         {MapQuantity::friction_work, "friction_work", "J/m^2", 1, true},
         {MapQuantity::law_state, "law_state", law_state.unit, 1, false},
         {MapQuantity::remembered_pressure, "remembered_pressure", "Pa", 1, true},
         {MapQuantity::gap, "gap", "m", 1, false}};
  std::vector<MapField> fields;
  for (const MapQuantity quantity : quantities)
    fields.push_back(all[static_cast<unsigned int>(quantity)]);
  return fields;
}

double ContactMapSetup::bytes_per_node(const unsigned int dim) const
{
  double bytes = 0.;
  for (const MapField &field : fields(dim))
    bytes +=
      field.quantity == MapQuantity::state ? 1. : sizeof(double) * field.components;
  return bytes;
}

template <int dim>
void ContactMapSampler<dim>::after(const SurfaceView<dim> &surface,
                                   ContactSurface<dim> &contact)
{
  slip.after(surface.time);
  const double dt  = contact.time_step();
  const auto value = [&](const MapQuantity quantity, const unsigned int i,
                         const unsigned int component) {
    switch (quantity)
      {
      case MapQuantity::pressure:
        return contact.normal_force()[i];
      case MapQuantity::traction:
        return component == 0 ? contact.tangential_force()[i]
                              : contact.lateral_force()[i];
      case MapQuantity::slip_velocity:
        return slip(component, i) / dt;
      case MapQuantity::state:
        return 2. * contact.touching()[i] - contact.sticking()[i];
      case MapQuantity::friction_work:
        return loads.loads().friction_energy[i];
      case MapQuantity::law_state:
        return contact.law_state()[i];
      case MapQuantity::remembered_pressure:
        return contact.variable_friction()->remembered_normal_force()[i];
      case MapQuantity::gap:
        return contact.gap_before(surface, i);
      }
    return 0.;
  };
  const std::vector<MapField> fields = setup.fields(dim);
  for (std::size_t f = 0; f < fields.size(); ++f)
    for (unsigned int i = 0; i < contact.n_distinct_nodes(); ++i)
      for (unsigned int c = 0; c < fields[f].components; ++c)
        samples[f].push_back(value(fields[f].quantity, i, c));
}

template <int dim>
std::vector<std::vector<double>> ContactMapSampler<dim>::take()
{
  std::vector<std::vector<double>> taken(samples.size());
  std::swap(taken, samples);
  return taken;
}

template class ContactMapSampler<2>;
template class ContactMapSampler<3>;
} // namespace mesoslip
