#ifndef mesoslip_observation_mesh_probes_h
#define mesoslip_observation_mesh_probes_h

#include "contact/contact_surface.h"
#include "dynamics/shared_nodes.h"
#include "elasticity/uniform_material.h"
#include "mesh/mesh_part.h"
#include "observation/probe_recorder.h"

#include <optional>

namespace mesoslip
{
/** A probe in a mesh. */
struct MeshPlace
{
  ProbePoint point;                  ///< moved to a node if so wanted
  unsigned int cell     = 0;         ///< of the whole mesh, in which it lies
  unsigned int phase    = 0;         ///< of this cell
  unsigned int material = 0;         ///< the same, or this in one of its orientations
  std::vector<unsigned int> corners; ///< of this cell, originals of the whole mesh
  std::vector<double> shape;         ///< of the corners at the point [-]
  std::vector<double> gradient;      ///< of the shapes, [corner][d] (1/m)
  std::vector<double> mean_gradient; ///< of these in the cell (1/m)

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &point.name &point.position &point.nearest_node &cell &phase;
    archive &material &corners &shape &gradient &mean_gradient;
  }
};

/**
 * Where @p points lie in the mesh; a point between cells belongs to that with the largest
 * number. @throws UserError naming the key of a point outside
 */
template <int dim>
std::vector<MeshPlace> locate_probes(const Mesh<dim> &mesh,
                                     const std::vector<ProbePoint> &points);

/** The same where only these @p cells may hold the points. */
template <int dim>
std::vector<MeshPlace> locate_probes(const Mesh<dim> &mesh,
                                     const std::vector<ProbePoint> &points,
                                     const std::vector<unsigned int> &cells);

/** Probes in a mesh: interpolation by the shape functions of the cell. */
template <int dim>
class MeshProbes : public ProbeRecorder
{
public:
  /** The contact boundary: points of the whole mesh and their areas (m^2, in 2D m). */
  struct Contact
  {
    const ContactSurface<dim> &surface;      ///< forces on the nodes of this rank
    const SharedNodes &nodes;                ///< of this rank
    const std::vector<unsigned int> &points; ///< of the whole contact and mesh
    const std::vector<double> &area; ///< along the normal, negative as it faces down
  };

  /** References are kept. Without @p contact, as of a counter body, there are no tractions. */
  MeshProbes(const std::vector<MeshPlace> &places,
             const MeshPart<dim> &part,
             const std::vector<ElasticPhase<dim>> &phases,
             const Stepper &stepper,
             const std::optional<Contact> &contact,
             const std::uint64_t interval);

private:
  /** Nothing to do: each rank has all points of its cells. */
  void update_ghosts(NodalField<double> &) const override
  {
  }
  Vector interpolate(const NodalField<double> &field, const std::size_t k) const override;
  void sample_strain(const std::size_t k, ProbeHistory &history) const override;
  void sample_contact(const std::size_t k, ProbeHistory &history) const override;

  const std::vector<MeshPlace> &places;
  const std::vector<ElasticPhase<dim>> &phases;
  const std::optional<Contact> contact;
  std::vector<std::vector<unsigned int>> corners; ///< of the places, points of the part

  /** Of the places: the nearest contact node, if they are on the contact. */
  std::vector<std::optional<unsigned int>> contact_node;
};
} // namespace mesoslip

#endif
