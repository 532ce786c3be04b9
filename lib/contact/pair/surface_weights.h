#ifndef mesoslip_contact_pair_surface_weights_h
#define mesoslip_contact_pair_surface_weights_h

#include <cstddef>
#include <vector>

namespace mesoslip
{
/** What each node of a contact meets of the nodes of the surface below it: a sparse matrix W with rows of the sum one, so that W u is
 * what the surface below moves by under the nodes, and W^T f what forces f on the nodes are on that surface. */
struct SurfaceWeights
{
  std::vector<std::size_t> start = {0}; ///< of each row and, last, of none
  std::vector<unsigned int> node;       ///< of the surface below
  std::vector<double> weight;           ///< of this node

  /** Adds a row in which one node has all the weight. */
  void add_partner(const unsigned int below)
  {
    node.push_back(below);
    weight.push_back(1.);
    start.push_back(node.size());
  }

  /** Number of rows. */
  std::size_t n_rows() const
  {
    return start.size() - 1;
  }

  /** Whether each node has one partner of its own, so that no force reaches the nodes beside it. */
  bool are_partners() const
  {
    return node.size() == n_rows();
  }

  /** Row @p k of W times @p values of the surface below. */
  double of(const double *values, const std::size_t k) const
  {
    double sum = 0.;
    for (std::size_t e = start[k]; e < start[k + 1]; ++e)
      sum += weight[e] * values[node[e]];
    return sum;
  }

  /** W^T times @p forces, into @p below. */
  void spread(const double *forces, std::vector<double> &below) const
  {
    below.assign(below.size(), 0.);
    for (std::size_t k = 0; k < n_rows(); ++k)
      for (std::size_t e = start[k]; e < start[k + 1]; ++e)
        below[node[e]] += weight[e] * forces[k];
  }
};
} // namespace mesoslip

#endif
