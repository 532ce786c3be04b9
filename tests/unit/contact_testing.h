#ifndef mesoslip_tests_unit_contact_testing_h
#define mesoslip_tests_unit_contact_testing_h

#include "contact/contact_row.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace contact_testing
{
using namespace mesoslip;

/** Point masses on the flat: a contact row without a body, its forces set by hand. */
class Points
{
public:
  Points(const ContactSetup &setup,
         const StepParameters &step,
         const std::vector<double> &masses)
    : contact(setup, step)
    , n(masses.size())
    , step(step)
    , u(n, 1)
    , w(n, 1)
    , force(n, 1)
    , inverse_mass(n, 1)
  {
    for (unsigned int i = 0; i < n; ++i)
      inverse_mass.row(0, 0)[i] = inverse_mass.row(1, 0)[i] = 1. / masses[i];
  }

  /** Force on node @p i from above (N/m): @p down presses it on the flat. */
  void load(const unsigned int i, const double right, const double down)
  {
    force.row(0, 0)[i] = -right;
    force.row(1, 0)[i] = down;
  }

  void hold_x(const unsigned int i)
  {
    inverse_mass.row(0, 0)[i] = 0.;
  }

  void advance()
  {
    RowView row;
    row.ux             = u.row(0, 0);
    row.uy             = u.row(1, 0);
    row.wx             = w.row(0, 0);
    row.wy             = w.row(1, 0);
    row.fx             = force.row(0, 0);
    row.fy             = force.row(1, 0);
    row.inverse_mass_x = inverse_mass.row(0, 0);
    row.inverse_mass_y = inverse_mass.row(1, 0);
    row.n_columns      = n;
    row.step           = n_done;
    row.time           = n_done * step.dt;
    contact.advance(row);
    ++n_done;
  }

  double time() const
  {
    return n_done * step.dt;
  }

  double friction(const unsigned int i = 0) const
  {
    return contact.tangential_force()[i];
  }

  double pressing(const unsigned int i = 0) const
  {
    return contact.normal_force()[i];
  }

  ContactRow contact;
  const unsigned int n;
  const StepParameters step;
  NodalField<double> u, w, force, inverse_mass;
  unsigned int n_done = 0;
};

inline ContactSetup contact_setup(const unsigned int n,
                                  const double mu,
                                  const double flat_velocity,
                                  const double delta)
{
  ContactSetup setup;
  setup.law.time             = delta;
  setup.friction_coefficient = std::vector<double>(n, mu);
  setup.flat_velocity        = LoadHistory(flat_velocity);
  return setup;
}

inline StepParameters step_of(const double dt, const double beta2 = 0.5)
{
  StepParameters step;
  step.dt    = dt;
  step.beta2 = beta2;
  return step;
}
} // namespace contact_testing

#endif
