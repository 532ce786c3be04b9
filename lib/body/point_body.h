#ifndef mesoslip_body_point_body_h
#define mesoslip_body_point_body_h

#include "body/elastic_body.h"

#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * A body whose nodes are numbered points in files and descriptions: points of a mesh, or
 * of a box with x fastest. Fields have a single row.
 */
template <int dim>
class PointBody : public ElasticBody<dim>
{
public:
  /** The node of point @p number; empty if this rank does not have it. */
  virtual std::optional<NodeIndex> find(const unsigned int number) const = 0;

  /**
   * Numbers of the locally owned points, the first nodes of distributed fields. Each
   * point is owned by one rank.
   */
  std::vector<std::uint64_t> owned_points() const;

  /** Numbers of the points of all contact nodes, in the order of surface(). */
  const std::vector<unsigned int> &contact_points() const
  {
    return of_contact;
  }

  /**
   * Components of @p field at the points @p numbers, point after point, on all ranks.
   * Collective.
   */
  std::vector<double> values_at(const std::vector<unsigned int> &numbers,
                                const NodalField<double> &field) const;

protected:
  using ElasticBody<dim>::ElasticBody;

  std::size_t n_owned = 0;              ///< see owned_points()
  std::vector<unsigned int> of_contact; ///< see contact_points()
};
} // namespace mesoslip

#endif
