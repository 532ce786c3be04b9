#include "eigenvalues/complex/sliding_pencil.h"

#include "base/exchange.h"

#include <deal.II/base/mpi.h>

#include <cmath>

namespace mesoslip
{
namespace
{
using Complex = SlidingPencil::Complex;
using Triplet = Eigen::Triplet<double, std::int64_t>;

/** E: a one in the row of each friction force. */
RealMatrix distribution(const std::vector<Eigen::Index> &rows, const Eigen::Index n)
{
  std::vector<Triplet> ones;
  for (std::size_t k = 0; k < rows.size(); ++k)
    ones.emplace_back(rows[k], k, 1.);
  RealMatrix E(n, static_cast<Eigen::Index>(rows.size()));
  E.setFromTriplets(ones.begin(), ones.end());
  return E;
}

/** Number of the free degree of freedom for each one of the body, -1 for none. */
template <int dim>
std::vector<std::int64_t> free_numbers(const ElasticBody<dim> &body,
                                       const FreeDofs<dim> &dofs)
{
  typename FreeDofs<dim>::Vector numbers(dofs.size());
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

/** Row in @p all of component @p c of a node. */
template <int dim>
Eigen::Index
row_of(const ElasticBody<dim> &body, const NodeIndex &node, const unsigned int c)
{
  return static_cast<Eigen::Index>(
    dim * (static_cast<std::size_t>(node.j) * body.n_columns() + node.i) + c);
}

/** The friction forces, their targets and the drag. */
template <int dim>
void add_contact(const ElasticBody<dim> &body,
                 const RealMatrix &reactions,
                 const std::vector<std::int64_t> &number,
                 const SlidingNodesAtRest &contact,
                 SlidingPencil &pencil)
{
  const double speed = std::hypot(contact.velocity[0], contact.velocity[1]);
  const std::array<double, 2> direction = {
    {contact.velocity[0] / speed, contact.velocity[1] / speed}};
  std::vector<Triplet> target, drag;
  for (std::size_t k = 0; k < contact.nodes.size(); ++k)
    for (unsigned int c = 0; c + 1 < dim; ++c)
      {
        const std::int64_t row = number[row_of(body, contact.nodes[k], c)];
        if (row < 0)
          continue;
        const auto q = static_cast<std::int64_t>(pencil.rows.size());
        pencil.rows.push_back(row);
        pencil.contact_nodes.push_back(k);
        for (RealMatrix::InnerIterator entry(reactions, static_cast<Eigen::Index>(k));
             entry; ++entry)
          target.emplace_back(q, entry.row(),
                              contact.friction[k] * direction[c] * entry.value());
        for (unsigned int d = 0; d + 1 < dim; ++d)
          {
            const double across       = (c == d ? 1. : 0.) - direction[c] * direction[d];
            const std::int64_t column = number[row_of(body, contact.nodes[k], d)];
            if (dim == 3 && column >= 0)
              drag.emplace_back(q, column,
                                contact.friction[k] * contact.normal_force[k] / speed *
                                  across);
          }
      }
  const auto n_forces = static_cast<Eigen::Index>(pencil.rows.size());
  pencil.targets.resize(n_forces, pencil.size());
  pencil.targets.setFromTriplets(target.begin(), target.end());
  pencil.drag.resize(n_forces, pencil.size());
  pencil.drag.setFromTriplets(drag.begin(), drag.end());
  const RealMatrix E = distribution(pencil.rows, pencil.size());
  pencil.friction    = E * pencil.targets;
  pencil.resistance  = E * pencil.drag;
}

/** What @p matrix does with a complex vector. */
ComplexVector product(const RealMatrix &matrix, const ComplexVector &x)
{
  ComplexVector result(matrix.rows());
  const Eigen::VectorXd real = x.real(), imaginary = x.imag();
  result.real() = matrix * real;
  result.imag() = matrix * imaginary;
  return result;
}
} // namespace

ComplexMatrix SlidingPencil::operator()(const Complex s) const
{
  const Complex damped = 1. + law.beta * s, lag = 1. + law.delta * s;
  ComplexMatrix inertia(size(), size());
  inertia.reserve(Eigen::VectorXi::Constant(static_cast<int>(size()), 1));
  for (Eigen::Index k = 0; k < size(); ++k)
    inertia.insert(k, k) = s * s / damped * mass[k];
  return inertia + stiffness.cast<Complex>() + friction.cast<Complex>() * (-1. / lag) +
         resistance.cast<Complex>() * (s / (damped * lag));
}

ComplexVector SlidingPencil::friction_force(const Complex s, const ComplexVector &u) const
{
  return ((1. + law.beta * s) * product(targets, u) - s * product(drag, u)) /
         (1. + law.delta * s);
}

double SlidingPencil::residual(const Complex s, const ComplexVector &u) const
{
  const Complex damped        = 1. + law.beta * s;
  const ComplexVector inertia = s * s / damped * mass.cwiseProduct(u),
                      elastic = product(stiffness, u),
                      force   = friction_force(s, u) / damped;
  ComplexVector sum           = inertia + elastic;
  for (std::size_t k = 0; k < rows.size(); ++k)
    sum[rows[k]] -= force[static_cast<Eigen::Index>(k)];
  return sum.norm() / (inertia.norm() + elastic.norm() + force.norm());
}

template <int dim>
RealMatrix whole_stiffness(const ElasticBody<dim> &body, const MPI_Comm communicator)
{
  std::vector<MatrixEntry> entries = body.stiffness_entries();
  if (body.is_distributed())
    {
      const auto of_ranks = dealii::Utilities::MPI::all_gather(communicator, entries);
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
                                  const SlidingLaw &law)
{
  const std::vector<std::int64_t> number = free_numbers(body, dofs);
  // Of sliding nodes and their duplicates: normal reactions are sums over both.
  std::vector<std::int64_t> reaction(number.size(), -1);
  for (std::size_t k = 0; k < contact.nodes.size(); ++k)
    reaction[row_of(body, contact.nodes[k], dim - 1)] = static_cast<std::int64_t>(k);
  for (const auto &[duplicate, original] : body.duplicate_nodes())
    reaction[row_of(body, duplicate, dim - 1)] =
      reaction[row_of(body, original, dim - 1)];

  std::vector<Triplet> stiffness, reactions;
  for (Eigen::Index column = 0; column < all.outerSize(); ++column)
    for (RealMatrix::InnerIterator entry(all, column); entry; ++entry)
      {
        const std::int64_t to   = number[static_cast<std::size_t>(entry.col())],
                           from = number[static_cast<std::size_t>(entry.row())],
                           at   = reaction[static_cast<std::size_t>(entry.row())];
        if (to >= 0 && from >= 0)
          stiffness.emplace_back(from, to, entry.value());
        if (to >= 0 && at >= 0)
          reactions.emplace_back(to, at, entry.value()); // the transpose
      }
  SlidingPencil pencil;
  pencil.law   = law;
  const auto n = static_cast<Eigen::Index>(dofs.size());
  pencil.stiffness.resize(n, n);
  pencil.stiffness.setFromTriplets(stiffness.begin(), stiffness.end());
  typename FreeDofs<dim>::Vector one(dofs.size()), masses(dofs.size());
  one = 1.;
  dofs.vmult(masses, one);
  pencil.mass = Eigen::Map<const Eigen::VectorXd>(masses.begin(), n);
  RealMatrix of_nodes(n, static_cast<Eigen::Index>(contact.nodes.size()));
  of_nodes.setFromTriplets(reactions.begin(), reactions.end());
  add_contact(body, of_nodes, number, contact, pencil);
  return pencil;
}

ShiftedInverse::ShiftedInverse(const SlidingPencil &pencil,
                               const ComplexFactorization &factors,
                               const Complex shift,
                               const double frequency)
  : pencil(pencil)
  , factors(factors)
  , shift(shift)
  , of_v(frequency)
  , of_q(pencil.stiffness.diagonal().mean())
{
}

void ShiftedInverse::vmult(ComplexVector &dst, const ComplexVector &src) const
{
  const Eigen::Index n = pencil.size(), n_forces = pencil.targets.rows();
  const double beta = pencil.law.beta, delta = pencil.law.delta;
  const Complex damped = 1. + beta * shift, lag = 1. + delta * shift;
  const ComplexVector u = src.head(n), v = of_v * src.segment(n, n);
  ComplexVector old_force = ComplexVector::Zero(n_forces);
  if (delta > 0.)
    old_force = delta * of_q * src.tail(n_forces);

  ComplexVector right = -pencil.mass.cwiseProduct(v + shift * u);
  if (beta > 0.)
    right -= beta * product(pencil.stiffness, u);
  const ComplexVector force =
    (beta * product(pencil.targets, u) - product(pencil.drag, u) - old_force) / lag;
  for (std::size_t k = 0; k < pencil.rows.size(); ++k)
    right[pencil.rows[k]] += force[static_cast<Eigen::Index>(k)];

  ComplexVector new_u;
  factors.solve(new_u, right);
  new_u /= damped;
  const ComplexVector new_v = u + shift * new_u;
  dst.resize(src.size());
  dst.head(n)       = new_u;
  dst.segment(n, n) = new_v / of_v;
  if (delta > 0.)
    dst.tail(n_forces) = (product(pencil.targets, new_u + beta * new_v) -
                          product(pencil.drag, new_v) - old_force) /
                         (lag * of_q);
}

template RealMatrix whole_stiffness(const ElasticBody<2> &, const MPI_Comm);
template RealMatrix whole_stiffness(const ElasticBody<3> &, const MPI_Comm);
template SlidingPencil make_sliding_pencil(const ElasticBody<2> &,
                                           const RealMatrix &,
                                           const FreeDofs<2> &,
                                           const SlidingNodesAtRest &,
                                           const SlidingLaw &);
template SlidingPencil make_sliding_pencil(const ElasticBody<3> &,
                                           const RealMatrix &,
                                           const FreeDofs<3> &,
                                           const SlidingNodesAtRest &,
                                           const SlidingLaw &);
} // namespace mesoslip
