#include "sliding/pair/condensed_solver.h"

#include "sliding/pair/dof_vector.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
using Triplet = Eigen::Triplet<double, std::int64_t>;

/** Index of each degree of freedom in a list, or -1. */
std::vector<std::int64_t> numbers_in(const std::vector<std::int64_t> &list,
                                     const std::size_t n)
{
  std::vector<std::int64_t> numbers(n, -1);
  for (std::size_t k = 0; k < list.size(); ++k)
    numbers[static_cast<std::size_t>(list[k])] = static_cast<std::int64_t>(k);
  return numbers;
}

/** Extracts the block of these rows and columns. */
template <typename Matrix>
Matrix block_of(const Matrix &whole,
                const std::vector<std::int64_t> &rows,
                const std::vector<std::int64_t> &columns)
{
  const auto n                           = static_cast<std::size_t>(whole.rows());
  const std::vector<std::int64_t> row    = numbers_in(rows, n),
                                  column = numbers_in(columns, n);
  std::vector<Triplet> entries;
  for (const std::int64_t from : columns)
    for (typename Matrix::InnerIterator entry(whole, from); entry; ++entry)
      if (const std::int64_t to = row[static_cast<std::size_t>(entry.row())]; to >= 0)
        entries.emplace_back(to, column[static_cast<std::size_t>(from)], entry.value());
  Matrix block(static_cast<Eigen::Index>(rows.size()),
               static_cast<Eigen::Index>(columns.size()));
  block.setFromTriplets(entries.begin(), entries.end());
  return block;
}

Eigen::VectorXd entries_of(const Eigen::VectorXd &x,
                           const std::vector<std::int64_t> &places)
{
  Eigen::VectorXd part(static_cast<Eigen::Index>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k)
    part[static_cast<Eigen::Index>(k)] = x[places[k]];
  return part;
}
} // namespace

template <int dim>
CondensedStiffness<dim>::CondensedStiffness(const ElasticBody<dim> &body,
                                            const DofMask &mask)
  : body(body)
{
  const std::size_t n = std::size_t{dim} * body.n_columns();
  is_contact.assign(n, false);
  is_held.assign(n, false);
  for (const NodeIndex &node : body.surface(ElasticBody<dim>::bottom).nodes)
    for (unsigned int c = 0; c < dim; ++c)
      {
        at_contact.push_back(dof_of<dim>(node.i, c));
        is_contact[static_cast<std::size_t>(at_contact.back())] = true;
      }
  std::vector<bool> is_copy(body.n_columns());
  for (const auto &[copy, master] : body.periodic_copies())
    is_copy[copy.i] = true;
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      if (const std::size_t dof = std::size_t{dim} * i + c; !is_contact[dof])
        {
          is_held[dof] = mask.is_constrained(c, {i, 0});
          if (!is_held[dof] && !is_copy[i])
            inner.push_back(static_cast<std::int64_t>(dof));
        }
  std::vector<Triplet> entries;
  for (const MatrixEntry &entry : body.stiffness_entries())
    entries.emplace_back(entry.row, entry.column, entry.value);
  for (const SpringEntry &spring : body.foundation().springs)
    entries.emplace_back(dof_of<dim>(spring.node.i, spring.c),
                         dof_of<dim>(spring.node.i, spring.d), spring.stiffness);
  whole.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  whole.setFromTriplets(entries.begin(), entries.end());
  condense();
}

template <int dim>
void CondensedStiffness<dim>::condense()
{
  coupling = block_of(whole, inner, at_contact);
  at_nodes = Eigen::MatrixXd(block_of(whole, at_contact, at_contact));
  if (inner.empty())
    return;
  factors.compute(block_of(whole, inner, inner));
  if (factors.info() != Eigen::Success)
    throw NotConverged("the stiffness of the bodies could not be factorized",
                       NotConverged::Reason::broke_down);
  // Columns solved at once; they take as much memory as some fields.
  constexpr Eigen::Index at_once = 64;
  for (Eigen::Index first = 0; first < coupling.cols(); first += at_once)
    {
      const Eigen::Index n          = std::min(at_once, coupling.cols() - first);
      const Eigen::MatrixXd columns = coupling.middleCols(first, n),
                            x       = factors.solve(columns);
      at_nodes.middleCols(first, n) -= coupling.transpose() * x;
    }
}

template <int dim>
bool CondensedStiffness<dim>::is_of(const DofMask &mask) const
{
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      if (const std::size_t dof = std::size_t{dim} * i + c;
          !is_contact[dof] && is_held[dof] != mask.is_constrained(c, {i, 0}))
        return false;
  return true;
}

template <int dim>
Eigen::VectorXd CondensedStiffness<dim>::solve(const Eigen::VectorXd &x) const
{
  return inner.empty() ? x : Eigen::VectorXd(factors.solve(x));
}

template <int dim>
CondensedSolver<dim>::CondensedSolver(const ElasticBody<dim> &body,
                                      std::unique_ptr<CondensedStiffness<dim>> &shared)
  : body(body)
  , stiffness(shared)
{
}

template <int dim>
void CondensedSolver<dim>::set_constrained_on_springs(const DofMask &mask,
                                                      const std::vector<SpringEntry> &on)
{
  if (!stiffness || !stiffness->is_of(mask))
    stiffness = std::make_unique<CondensedStiffness<dim>>(body, mask);
  springs = on;
  free.clear();
  const std::vector<NodeIndex> &nodes = body.surface(ElasticBody<dim>::bottom).nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      if (!mask.is_constrained(c, nodes[k]))
        free.push_back(static_cast<Eigen::Index>(dim * k + c));
  Eigen::MatrixXd S = stiffness->at_nodes;
  const auto number =
    numbers_in(stiffness->at_contact, static_cast<std::size_t>(stiffness->whole.rows()));
  for (const SpringEntry &spring : springs)
    S(number[static_cast<std::size_t>(dof_of<dim>(spring.node.i, spring.c))],
      number[static_cast<std::size_t>(dof_of<dim>(spring.node.i, spring.d))]) +=
      spring.stiffness;
  factors.compute(S(free, free));
  // A rigid motion leaves a pivot of the size of round-off.
  const double largest = S.diagonal().maxCoeff();
  moves = !free.empty() && !(factors.vectorD().minCoeff() > 1e-12 * largest);
}

template <int dim>
SolverReport CondensedSolver<dim>::solve(NodalField<double> &u,
                                         const NodalField<double> &force,
                                         const double /*tolerance*/)
{
  if (moves)
    throw NotConverged("the body can move as a whole", NotConverged::Reason::broke_down);
  Eigen::VectorXd x = vector_of<dim>(u), left = vector_of<dim>(force);
  left -= stiffness->whole * x;
  for (const SpringEntry &spring : springs)
    left[dof_of<dim>(spring.node.i, spring.c)] -=
      spring.stiffness * x[dof_of<dim>(spring.node.i, spring.d)];
  // Solves first for the inner degrees of freedom as if the contact was held, then for
  // the contact.
  const Eigen::VectorXd of_inner   = stiffness->solve(entries_of(left, stiffness->inner)),
                        of_contact = entries_of(left, stiffness->at_contact) -
                                     stiffness->coupling.transpose() * of_inner;
  Eigen::VectorXd at_contact = Eigen::VectorXd::Zero(of_contact.size());
  if (!free.empty())
    {
      const Eigen::VectorXd of_free = of_contact(free), moved = factors.solve(of_free);
      at_contact(free) = moved;
    }
  const Eigen::VectorXd inner =
    of_inner - stiffness->solve(stiffness->coupling * at_contact);
  for (std::size_t k = 0; k < stiffness->inner.size(); ++k)
    x[stiffness->inner[k]] += inner[static_cast<Eigen::Index>(k)];
  for (std::size_t k = 0; k < stiffness->at_contact.size(); ++k)
    x[stiffness->at_contact[k]] += at_contact[static_cast<Eigen::Index>(k)];
  take<dim>(u, x);
  body.update_copies(u);
  return {1, 0.};
}

template class CondensedStiffness<2>;
template class CondensedStiffness<3>;
template class CondensedSolver<2>;
template class CondensedSolver<3>;
} // namespace mesoslip
