#include "eigenvalues/complex/sliding_pencil.h"

#include "eigenvalues/complex/pencil_contact.h"

#include "base/exchange.h"
#include "eigenvalues/complex/pencil_damping.h"
#include "eigenvalues/free_dofs.h"

#include <cmath>

namespace mesoslip
{
namespace
{
using Complex = SlidingPencil::Complex;
using Triplet = Eigen::Triplet<double, std::int64_t>;

/** Number of the free degree of freedom for each one of the body, -1 for none. */
template <int dim>
std::vector<std::int64_t> free_numbers(const ElasticBody<dim> &body,
                                       const FreeDofs<dim> &dofs)
{
  typename FreeDofs<dim>::Vector numbers = dofs.zero();
  for (std::size_t k = 0; k < dofs.size(); ++k)
    numbers[k] = static_cast<double>(k) + 1.;
  NodalField<double> field = body.zero_field();
  dofs.scatter(field, numbers);
  std::vector<std::int64_t> result;
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        result.push_back(static_cast<std::int64_t>(field(c, {i, j})) - 1);
  return result;
}

/** The springs below the nodes, foundation and alpha, which does not act on a platen. */
template <int dim>
void add_supports(const ElasticBody<dim> &body,
                  const FreeDofs<dim> &dofs,
                  const std::vector<std::int64_t> &number,
                  const SlidingNodesAtRest &contact,
                  SlidingPencil &pencil)
{
  std::vector<Triplet> between;
  for (std::size_t k = 0; k < contact.stiffness.size(); ++k)
    for (const auto &[row, sign] : relative(body, number, contact, k, dim - 1))
      for (const auto &[column, other] : relative(body, number, contact, k, dim - 1))
        between.emplace_back(row, column, sign * other * contact.stiffness[k]);
  const auto gather = [&](const std::vector<SpringEntry> &from,
                          std::vector<Triplet> entries) {
    for (const SpringEntry &spring : from)
      {
        const std::int64_t row    = number[row_of(body, spring.node, spring.c)],
                           column = number[row_of(body, spring.node, spring.d)];
        if (row >= 0 && column >= 0 && spring.stiffness != 0.)
          entries.emplace_back(row, column, spring.stiffness);
      }
    RealMatrix matrix(pencil.size(), pencil.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  };
  pencil.springs = gather(body.foundation().springs, between);
  std::vector<Triplet> of_mass;
  for (Eigen::Index k = 0; k < pencil.size() && pencil.law.alpha > 0.; ++k)
    of_mass.emplace_back(k, k, pencil.law.alpha * pencil.mass[k]);
  for (const PlatenDof &dof : dofs.of_platens())
    of_mass.emplace_back(dof.place, dof.place, -pencil.law.alpha * dof.mass);
  pencil.resistances = gather(body.foundation().dashpots, of_mass);
}

/** These entries as a matrix of the whole body. */
template <int dim>
RealMatrix whole_matrix(const ElasticBody<dim> &body,
                        const std::vector<SpringEntry> &entries)
{
  std::vector<Triplet> triplets;
  for (const SpringEntry &entry : entries)
    triplets.emplace_back(row_of(body, entry.node, entry.c),
                          row_of(body, entry.node, entry.d), entry.stiffness);
  const auto n =
    static_cast<Eigen::Index>(dim * std::size_t{body.n_columns()} * body.n_rows());
  RealMatrix matrix(n, n);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

/** The same of drags (kg/s, in 2D kg/m/s), one for each node. */
template <int dim>
std::vector<SpringEntry> entries_of(const ElasticBody<dim> &body,
                                    const std::vector<double> &drags)
{
  std::vector<SpringEntry> entries;
  for (std::size_t k = 0; k < drags.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      entries.push_back({{static_cast<unsigned int>(k % body.n_columns()),
                          static_cast<unsigned int>(k / body.n_columns())},
                         c,
                         c,
                         drags[k]});
  return entries;
}

} // namespace

ComplexVector product(const RealMatrix &matrix, const ComplexVector &x)
{
  ComplexVector result(matrix.rows());
  const Eigen::VectorXd real = x.real(), imaginary = x.imag();
  result.real() = matrix * real;
  result.imag() = matrix * imaginary;
  return result;
}

ComplexMatrix SlidingPencil::operator()(const Complex s) const
{
  const Complex damped = 1. + law.beta * s, lag = 1. + law.delta * s;
  ComplexMatrix inertia(size(), size());
  inertia.reserve(Eigen::VectorXi::Constant(static_cast<int>(size()), 1));
  for (Eigen::Index k = 0; k < size(); ++k)
    inertia.insert(k, k) = s * s / damped * mass[k];
  return inertia + resistances.cast<Complex>() * (s / damped) +
         springs.cast<Complex>() * (1. / damped) + stiffness.cast<Complex>() +
         friction.cast<Complex>() * (-1. / lag) +
         spring_friction.cast<Complex>() * (-1. / (lag * damped)) +
         (resistance - damped_friction).cast<Complex>() * (s / (damped * lag)) +
         late_resistance.cast<Complex>() *
           (s / (damped * lag * (1. + law.state_time * s)));
}

ComplexVector SlidingPencil::friction_force(const Complex s, const ComplexVector &u) const
{
  return ((1. + law.beta * s) * product(targets, u) + product(spring_targets, u) +
          s * product(damped_targets, u) - s * product(drag, u) -
          s / (1. + law.state_time * s) * product(late_drag, u)) /
         (1. + law.delta * s);
}

RealMatrix SlidingPencil::whole_stiffness() const
{
  RealMatrix whole = stiffness;
  if (on_springs())
    whole += springs;
  return whole;
}

double SlidingPencil::residual(const Complex s, const ComplexVector &u) const
{
  const Complex damped = 1. + law.beta * s;
  const ComplexVector inertia =
                        s / damped * (s * mass.cwiseProduct(u) + product(resistances, u)),
                      force = friction_force(s, u) / damped;
  ComplexVector elastic     = product(stiffness, u);
  if (on_springs())
    elastic += product(springs, u) / damped;
  ComplexVector sum = inertia + elastic;
  sum -= product(distribution, force);
  return sum.norm() / (inertia.norm() + elastic.norm() + force.norm());
}

template <int dim>
RealMatrix whole_stiffness(const ElasticBody<dim> &body, const MPI_Comm communicator)
{
  std::vector<MatrixEntry> entries = body.stiffness_entries();
  if (body.is_distributed())
    {
      const auto of_ranks = mpi::all_gather(entries, communicator);
      entries.clear();
      for (const std::vector<MatrixEntry> &of_rank : of_ranks)
        entries.insert(entries.end(), of_rank.begin(), of_rank.end());
    }
  std::vector<Triplet> triplets;
  triplets.reserve(entries.size());
  for (const MatrixEntry &entry : entries)
    triplets.emplace_back(entry.row, entry.column, entry.value);
  const auto n = static_cast<Eigen::Index>(static_cast<std::size_t>(body.n_columns()) *
                                           body.n_rows() * dim);
  RealMatrix all(n, n);
  all.setFromTriplets(triplets.begin(), triplets.end());
  return all;
}

template <int dim>
SlidingPencil make_sliding_pencil(const ElasticBody<dim> &body,
                                  const RealMatrix &all,
                                  const FreeDofs<dim> &dofs,
                                  const SlidingNodesAtRest &contact,
                                  const SlidingLaw &law,
                                  const DampingByPhase &damping)
{
  const std::vector<std::int64_t> number = free_numbers(body, dofs);
  const std::vector<Share> shares        = reaction_shares(body, number, contact);

  SlidingPencil pencil;
  pencil.law   = law;
  const auto n = static_cast<Eigen::Index>(dofs.size());
  const auto m = static_cast<Eigen::Index>(contact.nodes.size());
  // What a matrix of the whole body is among the free ones, and the transpose of its rows of reactions.
  const auto split = [&](const RealMatrix &whole) {
    std::vector<Triplet> among, reactions;
    for (Eigen::Index column = 0; column < whole.outerSize(); ++column)
      for (RealMatrix::InnerIterator entry(whole, column); entry; ++entry)
        {
          const std::int64_t to   = number[static_cast<std::size_t>(entry.col())],
                             from = number[static_cast<std::size_t>(entry.row())];
          const Share &share      = shares[static_cast<std::size_t>(entry.row())];
          if (to >= 0 && from >= 0)
            among.emplace_back(from, to, entry.value());
          if (to >= 0 && share.node >= 0)
            reactions.emplace_back(to, share.node, share.weight * entry.value());
        }
    auto parts = std::make_pair(RealMatrix(n, n), RealMatrix(n, m));
    parts.first.setFromTriplets(among.begin(), among.end());
    parts.second.setFromTriplets(reactions.begin(), reactions.end());
    return parts;
  };
  const auto elastic = split(all), damped = split(damping.stiffness);
  pencil.stiffness                   = elastic.first;
  typename FreeDofs<dim>::Vector one = dofs.zero(), masses = dofs.zero();
  one.add(1.);
  dofs.vmult(masses, one);
  pencil.mass = Eigen::Map<const Eigen::VectorXd>(masses.begin(), n);
  add_supports(body, dofs, number, contact, pencil);
  if (damping.stiffness.size() > 0)
    {
      pencil.resistances += damped.first + drags_of(body, dofs, damping.drags);
      pencil.beta_besides = mean_beta(pencil.whole_stiffness(), damped.first);
    }
  // Where contact nodes move along the normal, what else acts on them takes part in their reactions.
  std::array<RealMatrix, 3> reactions = {
    {elastic.second, damped.second, RealMatrix(n, m)}};
  if (!contact.partners.empty())
    {
      const auto of = [&](const std::vector<SpringEntry> &entries) {
        return split(whole_matrix(body, entries)).second;
      };
      reactions[1] += of(body.foundation().dashpots);
      reactions[1] += of(entries_of(body, damping.drags));
      reactions[2] = of(body.foundation().springs);
    }
  add_contact(body, reactions, number, contact, pencil);
  return pencil;
}

template RealMatrix whole_stiffness(const ElasticBody<2> &, const MPI_Comm);
template RealMatrix whole_stiffness(const ElasticBody<3> &, const MPI_Comm);
template SlidingPencil make_sliding_pencil(const ElasticBody<2> &,
                                           const RealMatrix &,
                                           const FreeDofs<2> &,
                                           const SlidingNodesAtRest &,
                                           const SlidingLaw &,
                                           const DampingByPhase &);
template SlidingPencil make_sliding_pencil(const ElasticBody<3> &,
                                           const RealMatrix &,
                                           const FreeDofs<3> &,
                                           const SlidingNodesAtRest &,
                                           const SlidingLaw &,
                                           const DampingByPhase &);
} // namespace mesoslip
