#include "eigenvalues/complex/contact_motion.h"

#include "eigenvalues/free_dofs.h"
#include "statics/static_solver.h"

#include <Eigen/SparseCholesky>

#include <cmath>

namespace mesoslip
{
RealMatrix matrix_of(const Eigen::Index n_rows,
                     const Eigen::Index n_columns,
                     const std::vector<Eigen::Triplet<double, std::int64_t>> &entries)
{
  RealMatrix matrix(n_rows, n_columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

namespace
{
using Triplet = Eigen::Triplet<double, std::int64_t>;

/** Number of displacements of all nodes. */
template <int dim>
Eigen::Index n_displacements(const ElasticBody<dim> &body)
{
  return static_cast<Eigen::Index>(dim * std::size_t{body.n_columns()} * body.n_rows());
}

/** Matrix from free degrees of freedom to all displacements. */
template <int dim>
RealMatrix scattering(const ElasticBody<dim> &body, const FreeDofs<dim> &dofs)
{
  typename FreeDofs<dim>::Vector numbers = dofs.zero();
  for (std::size_t k = 0; k < dofs.size(); ++k)
    numbers[k] = static_cast<double>(k) + 1.;
  NodalField<double> field = body.zero_field();
  dofs.scatter(field, numbers);
  std::vector<Triplet> entries;
  std::int64_t row = 0;
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int i = 0; i < body.n_columns(); ++i)
      for (unsigned int c = 0; c < dim; ++c, ++row)
        if (const double number = field(c, {i, j}); number > 0.)
          entries.emplace_back(row, static_cast<std::int64_t>(number) - 1, 1.);
  return matrix_of(row, static_cast<Eigen::Index>(dofs.size()), entries);
}

/**
 * Matrix from all displacements to component @p c of the motion of contact nodes relative
 * to their opposite surface.
 */
template <int dim>
RealMatrix against(const ElasticBody<dim> &body,
                   const SlidingNodesAtRest &contact,
                   const unsigned int c)
{
  std::vector<Triplet> entries;
  for (std::size_t k = 0; k < contact.nodes.size(); ++k)
    {
      entries.emplace_back(k, row_of(body, contact.nodes[k], c), 1.);
      if (!contact.meets.empty())
        for (const WeightedNode &met : contact.meets[k])
          entries.emplace_back(k, row_of(body, met.node, c), -met.weight);
    }
  return matrix_of(static_cast<Eigen::Index>(contact.nodes.size()), n_displacements(body),
                   entries);
}

/** Whether contact nodes follow the opposite surface along the normal. */
bool is_followed(const SlidingNodesAtRest &contact)
{
  return contact.stiffness.empty() && !contact.meets.empty();
}

/** Normal reactions of a flat, including those of periodic copies. */
template <int dim>
RealMatrix reactions_of_flat(const ElasticBody<dim> &body, const RealMatrix &normal)
{
  std::vector<Triplet> entries;
  for (Eigen::Index column = 0; column < normal.cols(); ++column)
    entries.emplace_back(column, column, 1.);
  for (const auto &[copy, master] : body.periodic_copies())
    entries.emplace_back(row_of(body, master, dim - 1), row_of(body, copy, dim - 1), 1.);
  return normal * matrix_of(normal.cols(), normal.cols(), entries);
}

/**
 * (S M^-1 S^T)^-1 S M^-1 for the free degrees of freedom. The inverse is full, but its
 * entries decay from node to node; entries below round-off are dropped.
 */
RealMatrix reactions_of_pair(const RealMatrix &S, const Eigen::VectorXd &mass)
{
  constexpr double hidden      = 1e-17; // relative to the largest entry of a column
  const RealMatrix S_over_mass = S * mass.cwiseInverse().asDiagonal(),
                   compliance  = S_over_mass * S.transpose();
  const Eigen::SimplicialLDLT<RealMatrix> factors(compliance);
  std::vector<Triplet> entries;
  for (Eigen::Index k = 0; k < S.rows(); ++k)
    {
      const Eigen::VectorXd column = factors.solve(Eigen::VectorXd::Unit(S.rows(), k));
      const double least           = hidden * column.cwiseAbs().maxCoeff();
      for (Eigen::Index l = 0; l < S.rows(); ++l)
        if (std::fabs(column[l]) > least)
          entries.emplace_back(l, k, column[l]);
    }
  return matrix_of(S.rows(), S.rows(), entries) * S_over_mass;
}

/**
 * The unknowns are all of @p n free degrees of freedom except @p following; the latter
 * follow from rows of @p S being zero.
 */
template <int dim>
void set_unknowns(const RealMatrix &S,
                  const std::vector<std::int64_t> &following,
                  const Eigen::Index n,
                  ContactMotion<dim> &motion)
{
  std::vector<std::int64_t> number(static_cast<std::size_t>(n), 0);
  for (const std::int64_t dof : following)
    number[static_cast<std::size_t>(dof)] = -1;
  std::vector<Triplet> entries;
  for (Eigen::Index dof = 0; dof < n; ++dof)
    if (std::int64_t &own = number[static_cast<std::size_t>(dof)]; own == 0)
      {
        own = static_cast<std::int64_t>(motion.of_unknowns.size());
        entries.emplace_back(dof, own, 1.);
        motion.of_unknowns.push_back(dof);
      }
  const RealMatrix by_nodes = S.transpose();
  for (std::size_t k = 0; k < following.size(); ++k)
    for (RealMatrix::InnerIterator entry(by_nodes, static_cast<Eigen::Index>(k)); entry;
         ++entry)
      if (const std::int64_t column = number[static_cast<std::size_t>(entry.row())];
          column >= 0)
        entries.emplace_back(following[k], column, -entry.value());
  motion.free =
    matrix_of(n, static_cast<Eigen::Index>(motion.of_unknowns.size()), entries);
}
} // namespace

template <int dim>
RealMatrix whole_matrix(const ElasticBody<dim> &body,
                        const std::vector<SpringEntry> &entries)
{
  std::vector<Triplet> triplets;
  for (const SpringEntry &entry : entries)
    triplets.emplace_back(row_of(body, entry.node, entry.c),
                          row_of(body, entry.node, entry.d), entry.stiffness);
  const Eigen::Index n = n_displacements(body);
  return matrix_of(n, n, triplets);
}

template <int dim>
ContactMotion<dim> make_contact_motion(const ElasticBody<dim> &body,
                                       const FreeDofs<dim> &dofs,
                                       const SlidingNodesAtRest &contact)
{
  const RealMatrix Z = scattering(body, dofs), by_rows = Z.transpose(),
                   S = against(body, contact, dim - 1) * Z;
  std::vector<std::int64_t> following;
  if (is_followed(contact))
    for (const NodeIndex &node : contact.nodes)
      following.push_back(
        RealMatrix::InnerIterator(by_rows, row_of(body, node, dim - 1)).row());
  ContactMotion<dim> motion;
  set_unknowns(S, following, Z.cols(), motion);
  motion.whole = Z * motion.free;
  for (unsigned int c = 0; c < dim; ++c)
    motion.relative[c] = against(body, contact, c) * motion.whole;
  return motion;
}

template <int dim>
Eigen::VectorXd masses_of(const FreeDofs<dim> &dofs)
{
  typename FreeDofs<dim>::Vector one = dofs.zero(), masses = dofs.zero();
  one.add(1.);
  dofs.vmult(masses, one);
  return Eigen::Map<const Eigen::VectorXd>(masses.begin(),
                                           static_cast<Eigen::Index>(dofs.size()));
}

template <int dim>
RealMatrix normal_reactions(const ElasticBody<dim> &body,
                            const FreeDofs<dim> &dofs,
                            const SlidingNodesAtRest &contact)
{
  const RealMatrix normal = against(body, contact, dim - 1);
  if (!contact.stiffness.empty())
    return {0, normal.cols()};
  if (!is_followed(contact))
    return reactions_of_flat(body, normal);
  const RealMatrix Z = scattering(body, dofs);
  return reactions_of_pair(normal * Z, masses_of(dofs)) * RealMatrix(Z.transpose());
}

#define MESOSLIP_INSTANTIATE(dim)                                                       \
  template ContactMotion<dim> make_contact_motion(                                      \
    const ElasticBody<dim> &, const FreeDofs<dim> &, const SlidingNodesAtRest &);       \
  template RealMatrix whole_matrix(const ElasticBody<dim> &,                            \
                                   const std::vector<SpringEntry> &);                   \
  template Eigen::VectorXd masses_of(const FreeDofs<dim> &);                            \
  template RealMatrix normal_reactions(const ElasticBody<dim> &, const FreeDofs<dim> &, \
                                       const SlidingNodesAtRest &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
