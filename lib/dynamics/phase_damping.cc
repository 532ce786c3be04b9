#include "dynamics/phase_damping.h"

#include "dynamics/stepper.h"

#include <algorithm>
#include <cassert>

namespace mesoslip
{
PhaseDamping::PhaseDamping(const StepParameters &step,
                           Product multiply,
                           NodalField<double> drags,
                           const NodalField<double> &like)
  : product(step.beta_of_phases.empty() ? Product() : std::move(multiply))
  , drags(std::move(drags))
  , of_step(like.zeros_alike())
{
}

void PhaseDamping::start_step(NodalField<double> &w)
{
  if (product)
    product(of_step, w);
  else
    of_step.set_zero();
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
  const auto of_phase = [&](const std::vector<double> &values, const std::size_t p) {
    assert(values.empty() || values.size() == phases.size());
    return values.empty() ? 0. : values[p];
  };
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      phases[p].stiffness *= of_phase(step.beta_of_phases, p);
      phases[p].density *= of_phase(step.alpha_of_phases, p);
    }
  return phases;
}

std::unique_ptr<PhaseDamping> damping_of_points(const StepParameters &step,
                                                const std::vector<double> &drags,
                                                const PhaseDamping::Product &multiply,
                                                const NodalField<double> &like)
{
  auto of_points = NodalField<double>::of_points(like.n_columns(), 1);
  std::copy(drags.begin(), drags.end(), of_points.row(0, 0));
  return std::make_unique<PhaseDamping>(step, multiply, std::move(of_points), like);
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
