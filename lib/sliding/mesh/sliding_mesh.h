#ifndef mesoslip_sliding_mesh_sliding_mesh_h
#define mesoslip_sliding_mesh_sliding_mesh_h

#include "mesh/boundary.h"
#include "sliding/mesh/distributed_body.h"
#include "sliding/sliding_body.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/** A boundary of a mesh that lies on the flat or is loaded, node by node in the order of
 * x, then y. */
struct MeshBoundary
{
  std::vector<unsigned int> points; ///< indices into the whole mesh, of originals

  /** Tributary area (m^2, in 2D m) as seen along the normal of the flat: positive where the
   * body is below it. */
  std::vector<double> area;

  std::vector<double> height; ///< above the lowest of the points (m)

  std::array<std::vector<double>, 2> position; ///< x and, in 3D, y (m)

  std::vector<SurfaceFacet> facets; ///< of a contact that meets another body

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<5>(archive, *this);
  }
};

/** The boundary of @p faces, of points that move together one. */
template <int dim>
MeshBoundary mesh_boundary(const Mesh<dim> &mesh,
                           const std::vector<BoundaryFace<dim>> &faces);

/**
 * What the points of a boundary have of a property of the phases, such as the coefficient
 * of friction: the mean over the cells behind the @p faces around a point, with the
 * tributary area in each face, as seen along the normal of the flat, times @p weight of its phase.
 */
template <int dim>
std::vector<double> mean_of_phases(const Mesh<dim> &mesh,
                                   const std::vector<BoundaryFace<dim>> &faces,
                                   const MeshBoundary &boundary,
                                   const std::vector<double> &property,
                                   const std::vector<double> &weight);

/** The @p faces seen along the normal, with numbers of the points of @p boundary, without those that stand on it. */
template <int dim>
std::vector<SurfaceFacet> facets_of(const Mesh<dim> &mesh,
                                    const std::vector<BoundaryFace<dim>> &faces,
                                    const MeshBoundary &boundary);

/** The largest property of the phases behind the @p faces around each point of the boundary, or the
 * smallest. */
template <int dim>
std::vector<double> extreme_of_phases(const Mesh<dim> &mesh,
                                      const std::vector<BoundaryFace<dim>> &faces,
                                      const MeshBoundary &boundary,
                                      const std::vector<double> &property,
                                      const bool largest);

/** The @p nodes of a contact of a rank. */
NodesOfContact nodes_of_contact(const SharedNodes &nodes);

/**
 * A body of any shape on the moving flat, as SlidingGrid on a grid. Each rank has the nodes
 * of contact and top that are in its part of the mesh, see SharedNodes.
 */
template <int dim>
class SlidingMesh : public SlidingBody<dim>
{
public:
  /**
   * At rest at u = 0. @p body must outlive it; @p setup speaks of the nodes of the whole
   * contact, top and loaded sides, whose points it has, and its held sides, sweep and periodicity are not used. A @p timer gets the
   * times of the parts of a step; the contact is that with @p counter, if there is one. A counter body, without a @p top, has
   * @p partner in the place of the contact. Collective.
   */
  SlidingMesh(const DistributedBody<dim> &body,
              const MeshBoundary &contact,
              const MeshBoundary &top,
              const std::vector<HeldComponent> &held,
              const SlidingSetup &setup,
              Timer *timer                 = nullptr,
              CounterMotion<dim> *counter  = nullptr,
              PartnerSurface<dim> *partner = nullptr);

  Stepper &time_integration() override
  {
    return stepper;
  }

  /** The velocities of the scheme, of beta2 dt before the start (see ExplicitStepper), of a
   * body that starts with @p velocity (m/s); zero where it is @p held, or by @p top. */
  void set_initial_velocity(const std::array<double, 3> &velocity,
                            const std::vector<HeldComponent> &held,
                            const MeshBoundary &top);

  const SharedNodes contact_nodes; ///< of this rank
  NodalField<double> u;            ///< displacement (m), a column for each point
  NodalField<double> w;            ///< velocity of the scheme (m/s)

private:
  /** Accelerations (m/s^2) at the start, of the damping with what acts on masses. */
  std::vector<std::array<double, dim>>
  start_acceleration(const std::array<double, 3> &velocity,
                     const std::vector<std::array<bool, dim>> &rests) const;

  const MeshPart<dim> &part;
  const SharedSurfaces surfaces; ///< of this rank
  const std::unique_ptr<SurfaceStepper<dim>> own_stepper;

public:
  SurfaceStepper<dim> &stepper; ///< the time integration

private:
  /** With the nodes of this rank. */
  SlidingMesh(const DistributedBody<dim> &body,
              const MeshBoundary &contact,
              const MeshBoundary &top,
              const SharedSurfaces &shared,
              const std::vector<HeldComponent> &held,
              const SlidingSetup &setup,
              Timer *timer,
              CounterMotion<dim> *counter,
              PartnerSurface<dim> *partner);

  void start_contact() override;
};
} // namespace mesoslip

#endif
