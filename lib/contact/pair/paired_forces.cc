// Forces of a pair that reach the neighbours of a node.
#include "base/exchange.h"
#include "contact/pair/paired_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Rows behind the components of the forces. */
constexpr unsigned int of_change = 0, of_contraction = 1;
} // namespace

/** What accelerates the nodes besides a force on themselves, under the forces of a @p guess. */
template <int dim>
void PairedContact<dim>::press_with(const Forces &guess)
{
  const SurfaceWeights &weights = meeting.weights;
  for (unsigned int c = 0; c < dim; ++c)
    {
      weights.spread(guess[c].data(), taken[c]);
      const double *const inverse_below = of_partner.row(n_rows * c + one_over_mass);
      for (std::size_t j = 0; j < taken[c].size(); ++j)
        taken[c][j] *= inverse_below[j];
      nodes.for_each([&](const std::size_t i, const unsigned int k) {
        const double compliance = inverse_mass.row(c, 0)[i],
                     pushed     = weights.of(taken[c].data(), k) +
                              (above->inverse_mass[c][i] - compliance) * guess[c][k];
        force.row(c, 0)[i] =
          compliance > 0. ? (apart.row(c, 0)[i] - pushed) / compliance : 0.;
      });
    }
}

/** What the nodes answer, and how far that is from the @p guess where it moves them by more than rounding does. */
template <int dim>
void PairedContact<dim>::share_trial(const SurfaceView<dim> &relative,
                                     const Forces &guess)
{
  constexpr double rounding = 4e-16;
  const double per_force    = (0.5 + step.beta2) * step.dt * step.dt;
  std::array<double *, dim> rows;
  for (unsigned int c = 0; c < dim; ++c)
    rows[c] = trial.row(c, 0);
  contact.try_forces(relative, rows);
  std::vector<double> change(nodes.n_owned), contraction(nodes.n_owned);
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int i = 0; i < nodes.n_owned; ++i)
      {
        const double compliance = inverse_mass.row(c, 0)[i],
                     off        = std::fabs(rows[c][i] - guess[c][nodes.number[i]]),
                     motion     = std::fabs(relative.u[c][i]) +
                              step.dt * std::fabs(relative.w[c][i]);
        if (!(per_force * compliance * off <= rounding * motion))
          change[i] = std::max(change[i], off);
        if (compliance > 0.)
          contraction[i] =
            std::max(contraction[i], 1. - above->inverse_mass[c][i] / compliance);
      }
  for (unsigned int c = 0; c < dim; ++c)
    forces.set(c, rows[c]);
  forces.set(dim + of_change, change.data());
  forces.set(dim + of_contraction, contraction.data());
  forces.share();
}

/** By how much of the largest force a force changed. */
template <int dim>
double PairedContact<dim>::change_over_force() const
{
  const std::size_t n        = forces.n_nodes();
  const double *const change = forces.row(dim + of_change);
  double largest             = 0.;
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t k = 0; k < n; ++k)
      largest = std::max(largest, std::fabs(forces.row(c)[k]));
  const double most = n > 0 ? *std::max_element(change, change + n) : 0.;
  return most > 0. ? most / largest : 0.;
}

/** By which the distance from the solution shrinks at least, each time. */
template <int dim>
double PairedContact<dim>::contraction() const
{
  const double *const found = forces.row(dim + of_contraction);
  return forces.n_nodes() > 0 ? *std::max_element(found, found + forces.n_nodes()) : 0.;
}

template <int dim>
typename PairedContact<dim>::Forces PairedContact<dim>::shared_forces() const
{
  Forces result;
  for (unsigned int c = 0; c < dim; ++c)
    result.emplace_back(forces.row(c), forces.row(c) + forces.n_nodes());
  return result;
}

/** Until the forces of neighbours in the step of @p relative are those that the nodes answer with; begins with those of the step
 * before. Where friction jumps between two values it may never be: after some time the mean of them is taken, and the step counted. */
template <int dim>
void PairedContact<dim>::settle(const SurfaceView<dim> &relative)
{
  constexpr unsigned int accelerated = 200, most = 1000;
  constexpr double exact = 1e-14;
  share_forces();
  Forces guess = shared_forces(), before = guess;
  double omega = 1.;
  for (unsigned int n = 1;; ++n)
    {
      press_with(guess);
      share_trial(relative, guess);
      ++settled.trials;
      const double change = change_over_force();
      if (change <= exact)
        return;
      if (n == most)
        {
          ++settled.unsettled;
          settled.change = std::max(settled.change, change);
          return;
        }
      const double rho       = std::min(0.99, contraction());
      omega                  = n == 1            ? 1.
                               : n == 2          ? 1. / (1. - 0.5 * rho * rho)
                               : n < accelerated ? 1. / (1. - 0.25 * rho * rho * omega)
                               : n < most / 2    ? 1.
                                                 : 0.5;
      const bool from_before = n < accelerated;
      for (unsigned int c = 0; c < dim; ++c)
        for (std::size_t k = 0; k < forces.n_nodes(); ++k)
          {
            const double origin = from_before ? before[c][k] : guess[c][k],
                         next   = origin + omega * (forces.row(c)[k] - origin);
            before[c][k]        = guess[c][k];
            guess[c][k]         = next;
          }
    }
}

/** Forces at the start on nodes that rest, with which none of them comes nearer to what is below it. */
template <int dim>
std::vector<double> PairedContact<dim>::common_forces(const SurfaceValues &own,
                                                      const double *inverse_below) const
{
  const SurfaceWeights &weights = meeting.weights;
  const double *const inverse = own.row(0), *const off = own.row(1),
                      *const rests = own.row(2);
  const std::size_t n              = own.n_nodes();
  std::vector<double> f(n), pushed(reach.size());
  const bool partners = weights.are_partners();
  for (unsigned int times = 0; times < 10000; ++times)
    {
      weights.spread(f.data(), pushed);
      for (std::size_t j = 0; j < pushed.size(); ++j)
        pushed[j] *= inverse_below[j];
      double change = 0., largest = 0.;
      for (std::size_t k = 0; k < n; ++k)
        if (rests[k] > 0.)
          {
            double yields = 0.;
            for (std::size_t e = weights.start[k]; e < weights.start[k + 1]; ++e)
              yields += std::fabs(weights.weight[e]) * inverse_below[weights.node[e]] *
                        (partners ? 1. : 0.5 * reach[weights.node[e]]);
            if (!(yields > 0.))
              continue;
            const double next = std::max(
              0., f[k] - (off[k] + inverse[k] * f[k] + weights.of(pushed.data(), k)) /
                           (inverse[k] + yields));
            change  = std::max(change, std::fabs(next - f[k]));
            largest = std::max(largest, next);
            f[k]    = next;
          }
      if (!(change > 1e-15 * largest))
        break;
    }
  return f;
}

template <int dim>
void PairedContact<dim>::start_as_one(NormalStart &own, NormalStart &other)
{
  const double s              = partner.normal;
  const MPI_Comm communicator = of_partner.ranks();
  SurfaceValues of_other(partner.nodes, 2, communicator), of_own(nodes, 3, communicator);
  of_other.set(0, other.inverse_inertia.data());
  of_other.set(1, other.acceleration.data());
  of_other.share();
  const SurfaceWeights &weights = meeting.weights;
  std::vector<double> off(nodes.number.size()), rest(off);
  nodes.for_each([&](const std::size_t i, const unsigned int k) {
    off[i]  = own.acceleration[i] - s * weights.of(of_other.row(1), k);
    rest[i] = own.velocity == s * other.velocity && own.inverse_inertia[i] > 0. &&
                  contact.rests(static_cast<unsigned int>(i), off[i])
                ? 1.
                : 0.;
  });
  of_own.set(0, own.inverse_inertia.data());
  of_own.set(1, off.data());
  of_own.set(2, rest.data());
  of_own.share();
  const std::vector<double> f = common_forces(of_own, of_other.row(0));
  std::vector<double> below(reach.size());
  weights.spread(f.data(), below);
  nodes.for_each([&](const std::size_t i, const unsigned int k) {
    own.acceleration[i] += own.inverse_inertia[i] * f[k];
  });
  partner.nodes.for_each([&](const std::size_t i, const unsigned int j) {
    other.acceleration[i] -= s * other.inverse_inertia[i] * below[j];
  });
}

#define MESOSLIP_INSTANTIATE(dim)                                     \
  template void PairedContact<dim>::settle(const SurfaceView<dim> &); \
  template void PairedContact<dim>::start_as_one(NormalStart &, NormalStart &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
