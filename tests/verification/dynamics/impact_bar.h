#ifndef mesoslip_tests_verification_impact_bar_h
#define mesoslip_tests_verification_impact_bar_h

#include "../sliding/box_body.h"

namespace verification
{
namespace impact_bar
{
// Doyen, Ern, Piperno, SIAM J. Sci. Comput. 33 (2011): E = 900, rho = 1, c = 30.
constexpr double length = 10., c = 30., v = 10., exact_duration = 2. * length / c;

template <int dim>
ElasticPhase<dim> bar_material()
{
  return {isotropic_stiffness<dim>(900., 0.), 1.};
}

/** The bar as one column of cells without lateral contraction. */
inline BodySetup bar(const unsigned int n_cells, const double beta2, const double courant)
{
  BodySetup s;
  s.cells           = {{1, n_cells}};
  s.spacing         = {{length / n_cells, length / n_cells}};
  s.classes         = {bar_material<2>()};
  s.step.beta2      = beta2;
  s.step.dt         = courant * s.spacing[1] / c;
  s.contact.gap     = 5.;
  s.monitored_nodes = {0, 1};
  s.top.is_platen   = false;
  s.energy_interval = 1;
  return s;
}

/** The bar in the plane, or in space, then two columns of cells deep. */
template <int dim>
BodyIn<dim> bar_in(const BodySetup &setup)
{
  return make_body<dim>(setup, {bar_material<3>(), 2});
}

template <class AnyBody>
void throw_down(AnyBody &body)
{
  body.set_w([](double, double, const unsigned int k) { return k == 1 ? -v : 0.; });
}

inline double mechanical(const EnergyHistory &e, const std::size_t n)
{
  return e.kinetic[n] + e.elastic[n] + e.potential[n];
}

/** Times (s) of the first and the last force. */
inline std::array<double, 2> contact_span(const ContactHistory &h)
{
  std::array<double, 2> span = {};
  for (std::size_t k = 0; k < h.time.size(); ++k)
    if (h.normal_force[k] > 0.)
      span = {{span[0] == 0. ? h.time[k] : span[0], h.time[k]}};
  return span;
}

/** What is left after the impact; energies as shares of those before it. */
struct Impact
{
  double balanced; ///< H of the energy audit, which the scheme keeps exactly
  double natural;  ///< 1/2 v_n.M v_n + 1/2 u_n.K u_n
  double residual; ///< of the audit, the largest
  double duration; ///< of the contact, from its first to its last force (s)
  bool separated;  ///< at the end
};

/** 1/2 v.M v of the velocity at the instant of u, @p before being w of the step before. */
template <class AnyBody>
double kinetic_energy(const AnyBody &body, const NodalField<double> &before)
{
  const double beta2 = body.setup.step.beta2;
  double energy      = 0.;
  std::vector<double> mass(before.n_columns());
  for (unsigned int j = 0; j < before.n_rows(); ++j)
    {
      body.stepper.mass_row(j, mass.data());
      for (unsigned int c = 0; c < before.n_components(); ++c)
        for (unsigned int i = 0; i < before.n_columns(); ++i)
          {
            const double velocity =
              (1. - beta2) * before.row(c, j)[i] + beta2 * body.w.row(c, j)[i];
            energy += 0.5 * mass[i] * velocity * velocity;
          }
    }
  return energy;
}

/** Two seconds of @p setup, a bar() with an audit in each step. */
template <int dim = 2>
Impact impact(const BodySetup &setup)
{
  BodyIn<dim> body = bar_in<dim>(setup);
  throw_down(body);
  body.run(std::lround(2. / body.setup.step.dt));
  const EnergyHistory e           = body.energy->reduce();
  const ContactHistory &h         = body.contact_recorder.history();
  const auto [first, last]        = contact_span(h);
  const NodalField<double> before = body.w;
  double natural                  = body.stepper.elastic_energy();
  body.stepper.step();
  natural += kinetic_energy(body, before);
  return {mechanical(e, e.time.size() - 1) / e.initial, natural / e.initial,
          largest(e.residual()) / e.initial, last - first,
          h.separated.back() == 2. * body.nodes_deep};
}
} // namespace impact_bar
} // namespace verification

#endif
