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
/** A boundary of a mesh on the flat or under load; nodes are sorted by x, then y. */
struct MeshBoundary
{
  std::vector<unsigned int> points; ///< in the whole mesh, masters only

  /** Tributary area (m^2, in 2D m) projected along the normal of the flat: positive where
   * the body is below it. */
  std::vector<double> area;

  std::vector<double> height; ///< above the lowest of the points (m)

  std::array<std::vector<double>, 2> position; ///< x and, in 3D, y (m)

  std::vector<SurfaceFacet> facets; ///< faces of a contact with a counter body

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<5>(archive, *this);
  }
};

/** The boundary of @p faces; periodic copies are represented by their master. */
template <int dim>
MeshBoundary mesh_boundary(const Mesh<dim> &mesh,
                           const std::vector<BoundaryFace<dim>> &faces);

/**
 * Nodal values of a phase @p property, such as the coefficient of friction: mean over
 * the cells behind the @p faces around a point, weighted with the projected tributary
 * area in each face times @p weight of its phase.
 */
template <int dim>
std::vector<double> mean_of_phases(const Mesh<dim> &mesh,
                                   const std::vector<BoundaryFace<dim>> &faces,
                                   const MeshBoundary &boundary,
                                   const std::vector<double> &property,
                                   const std::vector<double> &weight);

/** The @p faces projected along the normal, with numbers of the points of @p boundary;
 * faces that stand on it are left out. */
template <int dim>
std::vector<SurfaceFacet> facets_of(const Mesh<dim> &mesh,
                                    const std::vector<BoundaryFace<dim>> &faces,
                                    const MeshBoundary &boundary);

/** Largest (or smallest) property of the phases behind the @p faces around each point of
 * the boundary. */
template <int dim>
std::vector<double> extreme_of_phases(const Mesh<dim> &mesh,
                                      const std::vector<BoundaryFace<dim>> &faces,
                                      const MeshBoundary &boundary,
                                      const std::vector<double> &property,
                                      const bool largest);

/** Contact nodes in the form that NodesOfContact needs. */
NodesOfContact nodes_of_contact(const SharedNodes &nodes);

/**
 * A body of any shape on the moving flat; the counterpart of SlidingGrid for meshes.
 * Each rank has the contact and top nodes in its part of the mesh, see SharedNodes.
 */
template <int dim>
class SlidingMesh : public SlidingBody<dim>
{
public:
  /**
   * Initial state: at rest, u = 0. @p body must outlive it. @p setup describes the nodes
   * of the whole contact, top and loaded sides; its held sides, sweep and periodicity
   * are not used. A @p timer gets the times of the parts of a step. The contact is with
   * @p counter, if there is one. A counter body has no @p top and has @p partner in
   * place of the contact. Collective.
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

  /** Sets the velocities of the scheme at beta2 dt before the start (see
   * ExplicitStepper), for a body that starts with @p velocity (m/s); zero where it is
   * @p held, or held by @p top. */
  void set_initial_velocity(const std::array<double, 3> &velocity,
                            const std::vector<HeldComponent> &held,
                            const MeshBoundary &top);

  const SharedNodes contact_nodes; ///< locally stored contact nodes
  NodalField<double> u;            ///< displacement (m), a column for each point
  NodalField<double> w;            ///< velocity of the scheme (m/s)

private:
  /** Initial accelerations (m/s^2) by weight, loads and damping proportional to mass. */
  std::vector<std::array<double, dim>>
  start_acceleration(const std::array<double, 3> &velocity,
                     const std::vector<std::array<bool, dim>> &rests) const;

  const MeshPart<dim> &part;
  const SharedSurfaces surfaces; ///< locally stored surfaces
  const std::unique_ptr<SurfaceStepper<dim>> own_stepper;

public:
  SurfaceStepper<dim> &stepper; ///< the time integration

private:
  /** Constructor with the locally stored nodes @p shared. */
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
