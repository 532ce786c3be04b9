#include "sliding/pair/pair_body.h"

#include "sliding/pair/dof_vector.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

namespace mesoslip
{
namespace
{
using Triplet = Eigen::Triplet<double, std::int64_t>;

template <int dim>
std::vector<ElasticPhase<dim>> phases_of(const ElasticBody<dim> &above,
                                         const ElasticBody<dim> &below)
{
  std::vector<ElasticPhase<dim>> all = above.phases();
  all.insert(all.end(), below.phases().begin(), below.phases().end());
  return all;
}

} // namespace

RealMatrix blocks_of(const std::array<RealMatrix, 2> &matrices)
{
  std::vector<Triplet> entries;
  Eigen::Index first = 0;
  for (const RealMatrix &matrix : matrices)
    {
      for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
        for (RealMatrix::InnerIterator entry(matrix, column); entry; ++entry)
          entries.emplace_back(first + entry.row(), first + entry.col(), entry.value());
      first += matrix.rows();
    }
  RealMatrix all(first, first);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

template <int dim>
PairBody<dim>::PairBody(const PointBody<dim> &above,
                        const PointBody<dim> &below,
                        const MeetingNodes &given,
                        const std::array<RealMatrix, 2> &stiffness,
                        const Motion motion)
  : ElasticBody<dim>(above.n_columns() + below.n_columns(),
                     1,
                     phases_of(above, below),
                     above.periodicity())
  , above(above)
  , below(below)
  , n_above(above.n_columns())
  , motion(motion)
  , meeting(given)
  , follows(this->n_columns())
{
  for (NodeIndex &node : meeting.below)
    node = below_node(node);
  for (unsigned int d = 0; d < dim; ++d)
    this->extents[d] = above.extent(d);
  this->total_volume    = above.volume() + below.volume();
  this->mass            = above.total_mass() + below.total_mass();
  this->number_of_cells = above.n_cells() + below.n_cells();
  for (const unsigned int id : {ElasticBody<dim>::bottom, ElasticBody<dim>::top})
    this->sides[id] = above.surface(id);
  this->copies = above.periodic_copies();
  for (const auto &[copy, master] : below.periodic_copies())
    this->copies.push_back({{below_node(copy), below_node(master)}});
  std::iota(follows.begin(), follows.end(), 0U);
  for (const auto &[copy, master] : this->copies)
    follows[copy.i] = follows[master.i];
  if (motion == Motion::relative)
    this->n_counted = n_above;
  masses                          = above.lumped_mass();
  const std::vector<double> other = below.lumped_mass();
  masses.insert(masses.end(), other.begin(), other.end());
  T                   = transformation();
  RealMatrix of_cells = blocks_of(stiffness);
  std::vector<Triplet> held;
  for (const SpringEntry &spring : springs_of_above(true))
    held.emplace_back(dof_of<dim>(spring.node.i, spring.c),
                      dof_of<dim>(spring.node.i, spring.d), spring.stiffness);
  RealMatrix of_springs(of_cells.rows(), of_cells.cols());
  of_springs.setFromTriplets(held.begin(), held.end());
  of_cells += of_springs;
  K = T.transpose() * (of_cells * T).eval();
  take_foundations();
}

/** Rows of periodic copies equal the rows of their masters. */
template <int dim>
RealMatrix PairBody<dim>::transformation() const
{
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> row_of(this->n_columns(), none);
  const std::vector<NodeIndex> &contact = this->surface(ElasticBody<dim>::bottom).nodes;
  for (std::size_t k = 0; k < contact.size() && motion == Motion::relative; ++k)
    row_of[contact[k].i] = k;
  const SparseRows &rows = meeting.weights.rows;
  std::vector<Triplet> entries;
  for (unsigned int k = 0; k < follows.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      {
        const unsigned int node = follows[k];
        entries.emplace_back(dof_of<dim>(k, c), dof_of<dim>(node, c), 1.);
        if (const std::size_t row = row_of[node]; row != none)
          for (std::size_t e = rows.start[row]; e < rows.start[row + 1]; ++e)
            entries.emplace_back(dof_of<dim>(k, c),
                                 dof_of<dim>(meeting.below[rows.entries[e].column].i, c),
                                 rows.entries[e].weight);
      }
  const auto n = static_cast<Eigen::Index>(dim * follows.size());
  RealMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/** Springs of the upper body at nodes with relative displacements, or at all other
 * nodes. */
template <int dim>
std::vector<SpringEntry> PairBody<dim>::springs_of_above(const bool at_relative) const
{
  std::set<unsigned int> relative;
  for (const NodeIndex &node : this->surface(ElasticBody<dim>::bottom).nodes)
    if (motion == Motion::relative)
      relative.insert(node.i);
  std::vector<SpringEntry> found;
  for (const SpringEntry &spring : above.foundation().springs)
    if ((relative.count(follows[spring.node.i]) > 0) == at_relative)
      found.push_back(spring);
  return found;
}

/** Takes the foundations of both bodies, except springs that are in K and masses. */
template <int dim>
void PairBody<dim>::take_foundations()
{
  Foundation both;
  both.springs      = springs_of_above(false);
  both.dashpots     = above.foundation().dashpots;
  const auto append = [this](std::vector<SpringEntry> &to,
                             const std::vector<SpringEntry> &from) {
    for (SpringEntry entry : from)
      {
        entry.node = below_node(entry.node);
        to.push_back(entry);
      }
  };
  append(both.springs, below.foundation().springs);
  append(both.dashpots, below.foundation().dashpots);
  this->stand_on(both);
}

template <int dim>
std::array<NodalField<double>, 2> PairBody<dim>::parts(const NodalField<double> &u) const
{
  const Eigen::VectorXd absolute         = T * vector_of<dim>(u);
  std::array<NodalField<double>, 2> both = {{above.zero_field(), below.zero_field()}};
  take<dim>(both[0], absolute, 0);
  take<dim>(both[1], absolute, n_above);
  return both;
}

template <int dim>
std::vector<WeightedNode> PairBody<dim>::meets(const std::size_t k) const
{
  const SparseRows &rows = meeting.weights.rows;
  std::vector<WeightedNode> met;
  for (std::size_t e = rows.start[k]; e < rows.start[k + 1]; ++e)
    met.push_back({meeting.below[rows.entries[e].column], rows.entries[e].weight});
  return met;
}

template <int dim>
std::vector<bool> PairBody<dim>::counted_masters() const
{
  std::vector<bool> counted(this->n_columns());
  for (unsigned int k = 0; k < follows.size(); ++k)
    counted[k] = follows[k] == k;
  return counted;
}

template <int dim>
void PairBody<dim>::act_on_displacements(NodalField<double> &force) const
{
  const std::vector<NodeIndex> &contact = this->surface(ElasticBody<dim>::bottom).nodes;
  const SparseRows &rows                = meeting.weights.rows;
  for (std::size_t k = 0; k < contact.size() && motion == Motion::relative; ++k)
    for (std::size_t e = rows.start[k]; e < rows.start[k + 1]; ++e)
      for (unsigned int c = 0; c < dim; ++c)
        force(c, meeting.below[rows.entries[e].column]) +=
          rows.entries[e].weight * force(c, contact[k]);
}

template <int dim>
std::array<double, dim> PairBody<dim>::point(const NodeIndex &node) const
{
  return node.i < n_above ? above.point(node) : below.point({node.i - n_above, 0});
}

template <int dim>
std::size_t PairBody<dim>::n_cell_groups() const
{
  return above.n_cell_groups() + below.n_cell_groups();
}

template <int dim>
void PairBody<dim>::evaluate(const NodalField<double> &u,
                             const std::size_t group,
                             Cells &cells) const
{
  const auto both = parts(u);
  if (group < above.n_cell_groups())
    return above.evaluate(both[0], group, cells);
  below.evaluate(both[1], group - above.n_cell_groups(), cells);
  for (unsigned int &phase : cells.phase)
    phase += static_cast<unsigned int>(above.phases().size());
}

template <int dim>
std::vector<VoigtMatrix<dim>>
PairBody<dim>::strain_products(const NodalField<double> &u) const
{
  const auto both                      = parts(u);
  std::vector<VoigtMatrix<dim>> result = above.strain_products(both[0]);
  const auto of_below                  = below.strain_products(both[1]);
  result.insert(result.end(), of_below.begin(), of_below.end());
  return result;
}

template <int dim>
void PairBody<dim>::multiply(NodalField<double> &Ku, const NodalField<double> &u) const
{
  take<dim>(Ku, K * vector_of<dim>(u), 0);
  this->update_copies(Ku);
}

template <int dim>
std::vector<MatrixEntry> PairBody<dim>::stiffness_entries() const
{
  std::vector<MatrixEntry> entries;
  for (Eigen::Index column = 0; column < K.outerSize(); ++column)
    for (RealMatrix::InnerIterator entry(K, column); entry; ++entry)
      entries.push_back({static_cast<std::uint64_t>(entry.row()),
                         static_cast<std::uint64_t>(entry.col()), entry.value()});
  return entries;
}

template <int dim>
std::unique_ptr<StaticSolver> PairBody<dim>::make_solver() const
{
  return std::make_unique<CondensedSolver<dim>>(*this, condensed);
}

template <int dim>
std::unique_ptr<ElasticBody<dim>> PairBody<dim>::make_periodic() const
{
  throw std::invalid_argument("a pair of bodies is not periodic along all axes");
}

template class PairBody<2>;
template class PairBody<3>;
} // namespace mesoslip
