// Coupled forces of a pair, which affect the neighbours of a node.
#include "base/exchange.h"
#include "contact/pair/paired_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mesoslip
{
namespace
{
/**
 * Rows behind the components of trial forces: their distance from convergence, and the
 * contraction of each trial.
 */
constexpr unsigned int of_change = 0, of_contraction = 1;
} // namespace

/** Sets the accelerations of the nodes by the forces @p guess on other nodes. */
template <int dim>
void PairedContact<dim>::press_with(const Forces &guess)
{
  const SurfaceWeights &weights = meeting.weights;
  weights.template spread<dim>(guess, taken);
  for (unsigned int c = 0; c < dim; ++c)
    {
      const double *const inverse_below = of_partner.row(n_rows * c + one_over_mass);
      for (std::size_t j = 0; j < of_partner.n_nodes(); ++j)
        taken[dim * j + c] *= inverse_below[j];
    }
  std::array<double *, dim> to;
  std::array<const double *, dim> compliance, inertia, off;
  for (unsigned int c = 0; c < dim; ++c)
    {
      to[c]         = force.row(c, 0);
      compliance[c] = inverse_mass.row(c, 0);
      inertia[c]    = mass.row(c, 0);
      off[c]        = apart.row(c, 0);
    }
  nodes.for_each([&](const std::size_t i, const unsigned int k) {
    const std::array<double, dim> below =
      weights.rows.template times<dim>(taken.data(), k);
    for (unsigned int c = 0; c < dim; ++c)
      {
        const double pushed =
          below[c] + (above->inverse_mass[c][i] - compliance[c][i]) * guess[dim * k + c];
        to[c][i] = (off[c][i] - pushed) * inertia[c][i];
      }
  });
}

/**
 * Computes the response of the nodes, and its difference from @p guess where it moves
 * nodes by more than round-off.
 */
template <int dim>
void PairedContact<dim>::share_trial(const SurfaceView<dim> &relative,
                                     const Forces &guess,
                                     const bool first)
{
  constexpr double rounding = 4e-16;
  const double per_force    = (0.5 + step.beta2) * step.dt * step.dt;
  std::array<double *, dim> rows;
  for (unsigned int c = 0; c < dim; ++c)
    rows[c] = trial.row(c, 0);
  contact.try_forces(relative, rows, first);
  double *const change = trial.row(dim + of_change, 0), *const contraction = trial.row(
                                                          dim + of_contraction, 0);
  std::fill_n(change, nodes.n_owned, 0.);
  std::fill_n(contraction, nodes.n_owned, 0.);
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int i = 0; i < nodes.n_owned; ++i)
      {
        const double compliance = inverse_mass.row(c, 0)[i],
                     off    = std::fabs(rows[c][i] - guess[dim * nodes.number[i] + c]),
                     motion = std::fabs(relative.u[c][i]) +
                              step.dt * std::fabs(relative.w[c][i]);
        if (!(per_force * compliance * off <= rounding * motion))
          change[i] = std::max(change[i], off);
        if (compliance > 0.)
          contraction[i] =
            std::max(contraction[i], 1. - above->inverse_mass[c][i] * mass.row(c, 0)[i]);
      }
  for (unsigned int r = 0; r < dim + 2; ++r)
    forces.set(r, trial.row(r, 0));
  forces.share();
}

/** Largest shared absolute value in a row. */
template <int dim>
double PairedContact<dim>::largest_of(const unsigned int row) const
{
  const double *const values = forces.row(row);
  double largest             = 0.;
  for (std::size_t k = 0; k < forces.n_nodes(); ++k)
    largest = std::fmax(largest, std::fabs(values[k]));
  return largest;
}

/**
 * Iterates until the coupled forces in the step of @p relative agree with the response of
 * the nodes, starting from the forces of the last step. If friction jumps between two
 * values it may not converge: after some iterations the mean is taken, and the step is
 * counted as unsettled.
 */
template <int dim>
void PairedContact<dim>::settle(const SurfaceView<dim> &relative)
{
  constexpr unsigned int accelerated = 200, most = 1000;
  constexpr double exact = 1e-14;
  Forces guess(last), before(last);
  double omega = 1., rho = 0., force_then = 0.;
  for (unsigned int n = 1;; ++n)
    {
      press_with(guess);
      share_trial(relative, guess, n == 1);
      ++settled.trials;
      const double change = largest_of(dim + of_change);
      if (!(force_then > 0.))
        for (unsigned int c = 0; c < dim; ++c)
          force_then = std::max(force_then, largest_of(c));
      if (change <= exact * force_then)
        return;
      if (n == most)
        {
          ++settled.unsettled;
          settled.change = std::max(settled.change, change / force_then);
          return;
        }
      if (n == 1)
        rho = std::min(0.99, largest_of(dim + of_contraction));
      const bool from_before = n < accelerated;
      omega                  = n == 1         ? 1.
                               : n == 2       ? 1. / (1. - 0.5 * rho * rho)
                               : from_before  ? 1. / (1. - 0.25 * rho * rho * omega)
                               : n < most / 2 ? 1.
                                              : 0.5;
      for (unsigned int c = 0; c < dim; ++c)
        for (std::size_t k = 0; k < forces.n_nodes(); ++k)
          {
            double &now = guess[dim * k + c], &then = before[dim * k + c];
            const double origin = from_before ? then : now,
                         next   = origin + omega * (forces.row(c)[k] - origin);
            then                = now;
            now                 = next;
          }
    }
}

/**
 * Initial forces on resting nodes that prevent them from approaching the surface below.
 */
template <int dim>
std::vector<double> PairedContact<dim>::common_forces(const SurfaceValues &own,
                                                      const double *inverse_below) const
{
  const SurfaceWeights &weights = meeting.weights;
  const double *const inverse = own.row(0), *const off = own.row(1),
                      *const rests = own.row(2);
  const std::size_t n              = own.n_nodes();
  std::vector<double> f(n), pushed(share.size());
  for (unsigned int times = 0; times < 10000; ++times)
    {
      weights.template spread<1>(f, pushed);
      for (std::size_t j = 0; j < pushed.size(); ++j)
        pushed[j] *= inverse_below[j];
      double change = 0., largest = 0.;
      for (std::size_t k = 0; k < n; ++k)
        if (rests[k] > 0.)
          {
            const double softness = yielding(inverse_below, k);
            if (!(softness > 0.))
              continue;
            const double next = std::max(
              0., f[k] - (off[k] + inverse[k] * f[k] + weights.of(pushed.data(), k)) /
                           (inverse[k] + softness));
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
  std::vector<double> below(share.size());
  weights.template spread<1>(f, below);
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
