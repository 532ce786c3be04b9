#ifndef mesoslip_tests_unit_contact_testing_h
#define mesoslip_tests_unit_contact_testing_h

#include "contact/contact_recorder.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace contact_testing
{
using namespace mesoslip;

/** Point masses on the flat: a contact surface without a body, its forces set by hand. */
class Points
{
public:
  Points(const ContactSetup &setup,
         const StepParameters &step,
         const std::vector<double> &masses)
    : contact(setup, step)
    , recorder(1, {0}, step)
    , statistics(0)
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
    SurfaceView<2> surface;
    surface.n            = n;
    surface.u            = {{u.row(0, 0), u.row(1, 0)}};
    surface.w            = {{w.row(0, 0), w.row(1, 0)}};
    surface.force        = {{force.row(0, 0), force.row(1, 0)}};
    surface.inverse_mass = {{inverse_mass.row(0, 0), inverse_mass.row(1, 0)}};
    surface.step         = n_done;
    surface.time         = n_done * step.dt;
    recorder.before(surface);
    contact.advance(surface);
    recorder.after(surface, contact);
    statistics.after(surface, contact);
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

  /** Of the whole time. */
  NodeCounts counts()
  {
    statistics.finish(contact);
    return statistics.blocks()[0];
  }

  /** Resultants, and motion and forces of node 0. */
  const ContactHistory &history() const
  {
    return recorder.history();
  }

  ContactSurface<2> contact;
  ContactRecorder<2> recorder;
  NodeStatistics<2> statistics;
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
