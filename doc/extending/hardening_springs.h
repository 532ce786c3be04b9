#ifndef hardening_springs_h
#define hardening_springs_h

#include <dynamics/surface_condition.h>

/** Springs below the top of a plane grid, which harden: along the normal they push with k u + k3 u^3 (Pa). */
class HardeningSprings : public mesoslip::SurfaceCondition<2>
{
public:
  /** k in Pa/m, k3 in Pa/m^3; each node has a width of a cell (m), the first and the last half of it. */
  HardeningSprings(const double k,
                   const double k3,
                   const double cell,
                   const mesoslip::StepParameters &step)
    : k(k)
    , k3(k3)
    , cell(cell)
    , step(step)
  {
  }

  void advance(const mesoslip::SurfaceView<2> &top) override
  {
    stored = 0.;
    for (std::size_t i = 0; i < top.n; ++i)
      {
        const double width   = i == 0 || i + 1 == top.n ? 0.5 * cell : cell,
                     u       = top.u[1][i];
        const double push[2] = {0., -width * (k + k3 * u * u) * u};
        stored += width * (k / 2. + k3 / 4. * u * u) * u * u;
        for (unsigned int c = 0; c < 2; ++c)
          {
            const double a = top.inverse_mass[c][i] * (push[c] - top.force[c][i]);
            top.w[c][i] += step.dt * a;
            top.u[c][i] += step.dt * (top.w[c][i] + (step.beta2 - 0.5) * step.dt * a);
          }
      }
  }

  /** Energy of the springs at the last step (J/m). */
  double energy() const
  {
    return stored;
  }

private:
  const double k, k3, cell;
  const mesoslip::StepParameters step;
  double stored = 0.;
};

#endif
