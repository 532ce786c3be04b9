#include "dynamics/energy_audit.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
// Sum of term(0) to term(n - 1) by eight partial sums, so that additions do not wait for
// one another.
template <typename Term>
double sum_of(const unsigned int n, const Term &term)
{
  double lanes[8] = {};
  unsigned int i  = 0;
  for (; i + 8 <= n; i += 8)
    for (unsigned int l = 0; l < 8; ++l)
      lanes[l] += term(i + l);
  for (unsigned int l = 0; i + l < n; ++l)
    lanes[l] += term(i + l);
  return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) +
         ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}
} // namespace

std::vector<double> EnergyHistory::residual() const
{
  std::vector<double> r(time.size());
  for (std::size_t k = 0; k < r.size(); ++k)
    r[k] = kinetic[k] + elastic[k] + potential[k] - initial - external_work[k] +
           friction[k] + impact[k] + damping[k] + scheme[k] + contact[k] + supports[k] +
           dashpots[k];
  return r;
}

EnergyHistory &EnergyHistory::operator+=(const EnergyHistory &other)
{
  const auto add = [](std::vector<double> &to, const std::vector<double> &from) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
  };
  add(kinetic, other.kinetic);
  add(elastic, other.elastic);
  add(potential, other.potential);
  add(external_work, other.external_work);
  add(friction, other.friction);
  add(impact, other.impact);
  add(damping, other.damping);
  add(scheme, other.scheme);
  add(contact, other.contact);
  add(supports, other.supports);
  add(dashpots, other.dashpots);
  initial += other.initial;
  return *this;
}

EnergyAudit::EnergyAudit(Stepper &stepper,
                         const std::uint64_t interval,
                         const std::function<BoundaryWork()> &boundary_work)
  : stepper(stepper)
  , step(stepper.parameters)
  , u(stepper.u)
  , w(stepper.w)
  , interval(interval)
  , boundary_work(boundary_work)
  , damped(step.beta > 0. || step.alpha > 0.)
  , dissipative(step.beta2 != 0.5)
  , heavy(step.is_heavy())
  , u_before(u.zeros_alike())
  , w_before(u_before)
  , u_now(u_before)
  , w_now(u_before)
  , stiff_u(u_before)
  , stiff_w(step.beta > 0. ? stiff_u : NodalField<double>())
{
  const NodeRows &rows = stepper.rows;
  const std::size_t n  = u.n_columns();
  mass.resize(n * (rows.end - rows.begin));
  for (unsigned int j = rows.begin; j < rows.end; ++j)
    {
      double *row = mass.data() + n * (j - rows.begin);
      stepper.mass_row(j, row);
      for (unsigned int i = 0; i < n && step.alpha > 0.; ++i)
        drag.push_back(stepper.alpha_of({i, rows.local(j)}, row[i]) * row[i]);
    }
}

std::uint64_t EnergyAudit::next_step(const std::uint64_t n) const
{
  const std::uint64_t sample = next_multiple(n, interval);
  const bool wants_earlier   = damped || dissipative; // u_(n-1), w_(n-1)
  return wants_earlier && sample > n && interval > 1 ? sample - 1 : sample;
}

// a_(-1) = 0: the body moved with w_0 before the start.
void EnergyAudit::initialize()
{
  u_before = u;
  w_before = w;
  for (std::size_t k = 0; k < u.size(); ++k)
    u_before.begin()[k] -= step.dt * w.begin()[k];
  u_now = u_before;
  w_now = w;
  multiply(u_now, w_now);
  Sums sums;
  add_products(sums);
  const Sums nodal = nodal_sums();
  samples.initial  = nodal.kinetic + nodal.potential + sums.elastic;
}

void EnergyAudit::before_step(const std::uint64_t n)
{
  if (n == 0)
    initialize();
  if (n % interval == 0)
    {
      if (interval == 1 && n > 0)
        {
          std::swap(u_before, u_now);
          std::swap(w_before, w_now);
        }
      multiply(u, w);
      if (heavy || (damped && interval == 1))
        u_now = u;
      if (dissipative || step.alpha > 0.)
        w_now = w;
    }
  else
    {
      if (damped)
        u_before = u;
      if (dissipative)
        w_before = w;
    }
}

void EnergyAudit::after_step(const std::uint64_t n)
{
  if (n % interval != 0)
    return;
  Sums sums = nodal_sums();
  add_products(sums);

  const bool first = samples.time.empty();
  if (interval == 1 || first)
    {
      sum_scheme += sums.scheme;
      sum_damping += sums.damping;
    }
  else
    {
      sum_scheme += 0.5 * interval * (sums.scheme + last_scheme);
      sum_damping += 0.5 * interval * (sums.damping + last_damping);
    }
  last_scheme  = sums.scheme;
  last_damping = sums.damping;

  const BoundaryWork boundary = boundary_work();
  if (first)
    samples.initial += boundary.pressed + boundary.supports.at_start;
  samples.time.push_back(n * step.dt);
  samples.kinetic.push_back(sums.kinetic);
  samples.elastic.push_back(sums.elastic);
  samples.potential.push_back(sums.potential);
  samples.external_work.push_back(boundary.external);
  samples.friction.push_back(boundary.friction);
  samples.impact.push_back(boundary.impact);
  samples.damping.push_back(sum_damping);
  samples.scheme.push_back(sum_scheme);
  samples.contact.push_back(boundary.stored);
  samples.supports.push_back(boundary.supports.stored);
  samples.dashpots.push_back(boundary.supports.lost);
}

EnergyAudit::Sums EnergyAudit::nodal_sums() const
{
  const NodeRows &rows          = stepper.rows;
  const unsigned int n          = u.n_columns();
  const unsigned int n_distinct = stepper.n_distinct;
  const double c                = (step.beta2 - 0.5) * step.dt * step.dt;
  const double c_now            = 0.25 * c / (step.dt * step.dt);

  Sums sums;
  for (unsigned int component = 0; component < u.n_components(); ++component)
    for (unsigned int j = rows.begin; j < rows.end; ++j)
      {
        const unsigned int l = rows.local(j);
        const double *m    = mass.data() + static_cast<std::size_t>(n) * (j - rows.begin);
        const double *w2   = w.row(component, l);
        const auto squares = [&](const double factor, const auto &value) {
          return factor * sum_of(n_distinct, [&](const unsigned int i) {
                   return m[i] * value(i) * value(i);
                 });
        };
        sums.kinetic += squares(0.5, [&](const unsigned int i) { return w2[i]; });
        if (dissipative)
          {
            const double *w0 = w_before.row(component, l), *w1 = w_now.row(component, l);
            sums.kinetic +=
              squares(c_now, [&](const unsigned int i) { return w2[i] - w1[i]; });
            sums.scheme +=
              squares(c_now, [&](const unsigned int i) { return w2[i] - w0[i]; });
          }
        if (step.alpha > 0.)
          {
            const double *w1 = w_now.row(component, l), *u0 = u_before.row(component, l),
                         *u2 = u.row(component, l);
            const double *d =
              drag.data() + static_cast<std::size_t>(n) * (j - rows.begin);
            sums.damping += 0.5 * sum_of(n_distinct, [&](const unsigned int i) {
                              return 0.5 * d[i] * (w1[i] + w2[i]) * (u2[i] - u0[i]);
                            });
          }
        if (heavy)
          {
            const double *u1 = u_now.row(component, l), *u2 = u.row(component, l);
            const auto moved = [&](const unsigned int i) {
              return m[i] * (u1[i] + u2[i]);
            };
            sums.potential -=
              0.5 * step.acceleration[component] * sum_of(n_distinct, moved);
          }
      }
  return sums;
}

void EnergyAudit::multiply(NodalField<double> &u_n, NodalField<double> &w_n)
{
  stepper.multiply(stiff_u, u_n);
  if (step.beta > 0. && !step.beta_of_phases.empty())
    stepper.phase_damping()->multiply(stiff_w, w_n);
  else if (step.beta > 0.)
    stepper.multiply(stiff_w, w_n);
}

// a.(u - c) over the owned rows without periodic copies.
double EnergyAudit::dot_difference(const NodalField<double> &a,
                                   const NodalField<double> *c) const
{
  const NodeRows &rows = stepper.rows;
  double sum           = 0.;
  for (unsigned int component = 0; component < u.n_components(); ++component)
    for (unsigned int j = rows.local(rows.begin); j < rows.local(rows.end); ++j)
      {
        const double *x = a.row(component, j), *y = u.row(component, j);
        const double *z = c != nullptr ? c->row(component, j) : nullptr;
        sum += sum_of(stepper.n_distinct, [&](const unsigned int i) {
          return x[i] * (z != nullptr ? y[i] - z[i] : y[i]);
        });
      }
  return sum;
}

// u_(n+1).K u_n / 2 and beta (u_(n+1) - u_(n-1)).K w_n / 2
void EnergyAudit::add_products(Sums &sums) const
{
  sums.elastic = 0.5 * dot_difference(stiff_u, nullptr);
  if (step.beta > 0.)
    sums.damping += 0.5 * (step.beta_of_phases.empty() ? step.beta : 1.) *
                    dot_difference(stiff_w, &u_before);
}

EnergyHistory EnergyAudit::reduce() const
{
  EnergyHistory all = samples;
  // All members by name, so that a new member does not compile unnoticed.
  auto &[time, kinetic, elastic, potential, external_work, friction, impact, damping,
         scheme, contact, supports, dashpots, initial] = all;
  for (auto *values : {&kinetic, &elastic, &potential, &external_work, &friction, &impact,
                       &damping, &scheme, &contact, &supports, &dashpots})
    MPI_Allreduce(MPI_IN_PLACE, values->data(), static_cast<int>(values->size()),
                  MPI_DOUBLE, MPI_SUM, stepper.communicator);
  MPI_Allreduce(MPI_IN_PLACE, &initial, 1, MPI_DOUBLE, MPI_SUM, stepper.communicator);
  return all;
}
} // namespace mesoslip
