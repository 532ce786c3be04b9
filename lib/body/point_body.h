#ifndef mesoslip_body_point_body_h
#define mesoslip_body_point_body_h

#include "body/elastic_body.h"

#include <optional>
#include <vector>

namespace mesoslip
{
/** A body in whose files and descriptions nodes are numbered points: of a mesh, or of a box with x
 * fastest. Fields have them in one row. */
template <int dim>
class PointBody : public ElasticBody<dim>
{
public:
  /** The node of point @p number, on the ranks that have it. */
  virtual std::optional<NodeIndex> find(const unsigned int number) const = 0;

  /** Numbers of the points that are the first nodes of divided fields: each point is such a node on
   * one rank. */
  std::vector<std::uint64_t> owned_points() const;

  /** Numbers of the points of all nodes of the contact side, in the order of surface(). */
  const std::vector<unsigned int> &contact_points() const
  {
    return of_contact;
  }

  /** Components of @p field at the points with these @p numbers, on all ranks; those of a point
   * together. Collective. */
  std::vector<double> values_at(const std::vector<unsigned int> &numbers,
                                const NodalField<double> &field) const;

protected:
  using ElasticBody<dim>::ElasticBody;

  std::size_t n_owned = 0;              ///< see owned_points()
  std::vector<unsigned int> of_contact; ///< see contact_points()
};
} // namespace mesoslip

#endif
