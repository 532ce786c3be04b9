#include "eigenvalues/complex/sliding_pencil.h"

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

/** Row in @p all of component @p c of a node. */
template <int dim>
Eigen::Index
row_of(const ElasticBody<dim> &body, const NodeIndex &node, const unsigned int c)
{
  return static_cast<Eigen::Index>(
    dim * (static_cast<std::size_t>(node.j) * body.n_columns() + node.i) + c);
}

/** The row @p q of targets, of a force at contact node @p node: @p reactions holds the normal
 * ones of the nodes. */
void add_target(const std::size_t node,
                const double coupling,
                const RealMatrix &reactions,
                const std::int64_t q,
                std::vector<Triplet> &target)
{
  for (RealMatrix::InnerIterator entry(reactions, static_cast<Eigen::Index>(node)); entry;
       ++entry)
    target.emplace_back(q, entry.row(), coupling * entry.value());
}

/** The springs below the nodes, foundation and alpha, which does not act on a platen. */
template <int dim>
void add_supports(const ElasticBody<dim> &body,
                  const FreeDofs<dim> &dofs,
                  const std::vector<std::int64_t> &number,
                  const SlidingNodesAtRest &contact,
                  SlidingPencil &pencil)
{
  std::vector<SpringEntry> springs = body.foundation().springs;
  for (std::size_t k = 0; k < contact.stiffness.size(); ++k)
    springs.push_back({contact.nodes[k], dim - 1, dim - 1, contact.stiffness[k]});
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
  pencil.springs = gather(springs, {});
  std::vector<Triplet> of_mass;
  for (Eigen::Index k = 0; k < pencil.size() && pencil.law.alpha > 0.; ++k)
    of_mass.emplace_back(k, k, pencil.law.alpha * pencil.mass[k]);
  for (const PlatenDof &dof : dofs.of_platens())
    of_mass.emplace_back(dof.place, dof.place, -pencil.law.alpha * dof.mass);
  pencil.resistances = gather(body.foundation().dashpots, of_mass);
}

/** The friction forces, their targets and the drag. */
template <int dim>
void add_contact(const ElasticBody<dim> &body,
                 const RealMatrix &reactions,
                 const RealMatrix &damped_reactions,
                 const std::vector<std::int64_t> &number,
                 const SlidingNodesAtRest &contact,
                 SlidingPencil &pencil)
{
  const double speed = std::hypot(contact.velocity[0], contact.velocity[1]);
  const std::array<double, 2> direction = {
    {contact.velocity[0] / speed, contact.velocity[1] / speed}};
  std::vector<Triplet> target, damped_target, spring_target, drag, late_drag;
  for (std::size_t k = 0; k < contact.nodes.size(); ++k)
    for (unsigned int c = 0; c + 1 < dim; ++c)
      {
        const std::int64_t row = number[row_of(body, contact.nodes[k], c)];
        if (row < 0)
          continue;
        const auto q = static_cast<std::int64_t>(pencil.rows.size());
        pencil.rows.push_back(row);
        pencil.contact_nodes.push_back(k);
        const FrictionSlopes slopes =
          contact.slopes.empty() ? FrictionSlopes() : contact.slopes[k];
        const double coupling = (contact.friction[k] + slopes.pressure) * direction[c];
        if (contact.stiffness.empty())
          {
            add_target(k, coupling, reactions, q, target);
            add_target(k, coupling, damped_reactions, q, damped_target);
          }
        else
          spring_target.emplace_back(q, number[row_of(body, contact.nodes[k], dim - 1)],
                                     -coupling * contact.stiffness[k]);
        if (contact.normal_force.empty())
          continue;
        const double force = contact.normal_force[k];
        for (unsigned int d = 0; d + 1 < dim; ++d)
          {
            const double along        = direction[c] * direction[d],
                         across       = (c == d ? 1. : 0.) - along;
            const std::int64_t column = number[row_of(body, contact.nodes[k], d)];
            if (column < 0)
              continue;
            drag.emplace_back(q, column,
                              force *
                                (slopes.rate * along +
                                 (dim == 3 ? contact.friction[k] / speed * across : 0.)));
            late_drag.emplace_back(q, column, force * slopes.state * along);
          }
      }
  const auto n_forces = static_cast<Eigen::Index>(pencil.rows.size());
  const auto gather   = [&](RealMatrix &matrix, const std::vector<Triplet> &entries) {
    matrix.resize(n_forces, pencil.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    matrix.prune(0., 0.);
  };
  gather(pencil.targets, target);
  gather(pencil.damped_targets, damped_target);
  gather(pencil.spring_targets, spring_target);
  gather(pencil.drag, drag);
  gather(pencil.late_drag, late_drag);
  const RealMatrix E     = distribution(pencil.rows, pencil.size());
  pencil.friction        = E * pencil.targets;
  pencil.spring_friction = E * pencil.spring_targets;
  pencil.damped_friction = E * pencil.damped_targets;
  pencil.resistance      = E * pencil.drag;
  pencil.late_resistance = E * pencil.late_drag;
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
  // Of sliding nodes and their duplicates: normal reactions are sums over both.
  std::vector<std::int64_t> reaction(number.size(), -1);
  for (std::size_t k = 0; k < contact.nodes.size(); ++k)
    reaction[row_of(body, contact.nodes[k], dim - 1)] = static_cast<std::int64_t>(k);
  for (const auto &[duplicate, original] : body.duplicate_nodes())
    reaction[row_of(body, duplicate, dim - 1)] =
      reaction[row_of(body, original, dim - 1)];

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
                             from = number[static_cast<std::size_t>(entry.row())],
                             at   = reaction[static_cast<std::size_t>(entry.row())];
          if (to >= 0 && from >= 0)
            among.emplace_back(from, to, entry.value());
          if (to >= 0 && at >= 0)
            reactions.emplace_back(to, at, entry.value());
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
  add_contact(body, elastic.second, damped.second, number, contact, pencil);
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
