// A block thrown along a resting flat, slowed by a friction law of our own.
#include "steel_block.h"
#include "velocity_weakening.h"

#include <dynamics/critical_time_step.h>
#include <sliding/sliding_body.h>

#include <deal.II/base/mpi.h>

#include <cstdio>
#include <numeric>

using namespace mesoslip;

namespace
{
constexpr double mu_rest = 0.6, mu_fast = 0.2, critical_velocity = 0.3; // -, -, m/s
constexpr double thrown = 1., gravity = 1e5;                            // m/s, m/s^2

/** When a rigid block stops: dv/dt = -g mu(v), solved for y = exp(v / V_c). */
double exact_stop()
{
  const double ratio = (mu_rest - mu_fast) / mu_fast;
  return critical_velocity / (gravity * mu_fast) *
         std::log((std::exp(thrown / critical_velocity) + ratio) / (1. + ratio));
}

double mean_velocity(const NodalField<double> &w)
{
  double sum = 0.;
  for (unsigned int j = 0; j < w.n_rows(); ++j)
    sum += std::accumulate(w.row(0, j), w.row(0, j) + w.n_columns(), 0.);
  return sum / (w.n_rows() * w.n_columns());
}
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const UniformMaterial material = block();
  SlidingSetup setup;
  setup.step.beta = 2e-8; // s, so that the landing does not ring on
  setup.step.dt   = 0.5 * critical_time_step(material, setup.step.beta2, setup.step.beta);
  setup.step.acceleration = {{0., -gravity}};
  setup.top.is_platen     = false; // of 0 Pa
  setup.contact.law.time  = 0.;    // plain Coulomb with our coefficient
  setup.contact.law.node_law =
    std::make_shared<VelocityWeakening>(mu_rest, mu_fast, critical_velocity);
  setup.contact.friction_coefficient = std::vector<double>(material.n_columns(), mu_rest);
  setup.contact.flat_velocity        = LoadHistory(0.);

  SlidingGrid body(material, setup);
  for (unsigned int j = 0; j < body.w.n_rows(); ++j)
    std::fill_n(body.w.row(0, j), body.w.n_columns(), thrown);
  while (mean_velocity(body.w) > 0.)
    body.stepper.advance(10);
  const double stopped = setup.step.dt * body.stepper.step_number();
  std::printf("stops after %.3f microseconds, exact for a rigid block %.3f\n",
              1e6 * stopped, 1e6 * exact_stop());
}
