#include "dynamics/phase_damping.h"

#include "dynamics/stepper.h"

#include <cassert>

namespace mesoslip
{
void PhaseDamping::start_step(NodalField<double> &w)
{
  product(of_step, w);
  for (unsigned int c = 0; c < w.n_components(); ++c)
    for (unsigned int j = 0; j < w.n_rows(); ++j)
      {
        double *f              = of_step.row(c, j);
        const double *velocity = w.row(c, j), *drag = drags.row(0, j);
        for (unsigned int i = 0; i < w.n_columns(); ++i)
          f[i] += drag[i] * velocity[i];
      }
}

template <int dim>
std::vector<ElasticPhase<dim>> phases_of_damping(std::vector<ElasticPhase<dim>> phases,
                                                 const StepParameters &step)
{
  assert(step.beta_of_phases.size() == phases.size());
  assert(step.alpha_of_phases.size() == phases.size());
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      phases[p].stiffness *= step.beta_of_phases[p];
      phases[p].density *= step.alpha_of_phases[p];
    }
  return phases;
}

std::vector<double> inertia_row(const UniformMaterial &material,
                                const UniformMaterial *damping,
                                const StepParameters &step,
                                const unsigned int j)
{
  std::vector<double> inertia(material.n_columns()), drag(inertia.size(), 0.);
  material.mass_row(j, inertia.data());
  if (damping != nullptr)
    damping->mass_row(j, drag.data());
  for (std::size_t i = 0; i < inertia.size(); ++i)
    inertia[i] = inertia[i] * step.inertia() + 0.5 * step.dt * drag[i];
  return inertia;
}

template std::vector<ElasticPhase<2>> phases_of_damping(std::vector<ElasticPhase<2>>,
                                                        const StepParameters &);
template std::vector<ElasticPhase<3>> phases_of_damping(std::vector<ElasticPhase<3>>,
                                                        const StepParameters &);
} // namespace mesoslip
