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
  ProbePoint point;                  ///< moved to a node if requested
  unsigned int cell     = 0;         ///< cell of the whole mesh that holds it
  unsigned int phase    = 0;         ///< phase of the cell
  unsigned int material = 0;         ///< material of the cell: phase, or oriented phase
  std::vector<unsigned int> corners; ///< its corners, periodic masters
  std::vector<double> shape;         ///< shape functions of the corners at the point [-]
  std::vector<double> gradient;      ///< shape gradients, [corner][d] (1/m)
  std::vector<double> mean_gradient; ///< cell means of the gradients (1/m)

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &point.name &point.position &point.nearest_node &cell &phase;
    archive &material &corners &shape &gradient &mean_gradient;
  }
};

/**
 * Locates @p points in the mesh; a point between cells belongs to the cell with the
 * largest number.
 * @throws UserError naming the key of a point outside
 */
template <int dim>
std::vector<MeshPlace> locate_probes(const Mesh<dim> &mesh,
                                     const std::vector<ProbePoint> &points);

/** locate_probes() restricted to the given @p cells. */
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
    const SharedNodes &nodes;                ///< nodes of this rank
    const std::vector<unsigned int> &points; ///< whole contact, numbers in the whole mesh
    const std::vector<double> &area; ///< along the normal, negative as it faces down
  };

  /** References are kept. Without @p contact, as for a counter body, there are no
   * tractions. */
  MeshProbes(const std::vector<MeshPlace> &places,
             const MeshPart<dim> &part,
             const std::vector<ElasticPhase<dim>> &phases,
             const Stepper &stepper,
             const std::optional<Contact> &contact,
             const std::uint64_t interval);

private:
  /** Does nothing: each rank has all points of its cells. */
  void update_ghosts(NodalField<double> &) const override
  {
  }
  Vector interpolate(const NodalField<double> &field, const std::size_t k) const override;
  void sample_strain(const std::size_t k, ProbeHistory &history) const override;
  void sample_contact(const std::size_t k, ProbeHistory &history) const override;

  const std::vector<MeshPlace> &places;
  const std::vector<ElasticPhase<dim>> &phases;
  const std::optional<Contact> contact;
  std::vector<std::vector<unsigned int>> corners; ///< per place, points of the part

  /** Per place: the nearest contact node, if it is on the contact. */
  std::vector<std::optional<unsigned int>> contact_node;
};
} // namespace mesoslip

#endif
