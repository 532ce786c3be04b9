// A block thrown against springs of our own, on which it swings.
#include "hardening_springs.h"
#include "steel_block.h"

#include <dynamics/critical_time_step.h>
#include <dynamics/grid/explicit_stepper.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstdio>

using namespace mesoslip;

namespace
{
constexpr double thrown = 1., mass = 7800. * 5e-4; // m/s, kg/m^2
constexpr double k = 2e11, amplitude = 1e-4, k3 = 4. * k / (amplitude * amplitude);

/** Half a period of a rigid block, m u'' = -k u - k3 u^3: by the energy v(u), with u = A sin(angle). */
double exact_swing()
{
  const double energy      = 0.5 * mass * thrown * thrown;
  const double A2          = (std::sqrt(k * k + 4. * k3 * energy) - k) / k3;
  constexpr unsigned int n = 1000;
  double time              = 0.;
  for (unsigned int j = 0; j < n; ++j)
    {
      const double sine = std::sin((j + 0.5) / n * M_PI_2);
      time += M_PI_2 / n / std::sqrt((k + 0.5 * k3 * A2 * (1. + sine * sine)) / mass);
    }
  return 2. * time;
}
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const UniformMaterial material = block();
  StepParameters step;
  step.dt = 0.5 * critical_time_step(material, step.beta2, step.beta);
  NodalField<double> u(material.n_columns(), material.n_rows()), w = u;
  for (unsigned int j = 0; j < w.n_rows(); ++j)
    std::fill_n(w.row(1, j), w.n_columns(), thrown);

  HardeningSprings springs(k, k3, material.grid().spacing[0], step);
  ExplicitStepper stepper({material, step, u, w, nullptr, &springs});
  double before = 0., swung = 0.;
  while (swung == 0.)
    {
      stepper.step();
      const double now = u.row(1, 0)[5];
      if (now <= 0. && before > 0.)
        swung = step.dt * (stepper.step_number() - now / (now - before));
      before = now;
    }
  std::printf("swings back after %.4f microseconds, exact for a rigid block %.4f\n",
              1e6 * swung, 1e6 * exact_swing());
}
