#ifndef mesoslip_sliding_mesh_mesh_body_h
#define mesoslip_sliding_mesh_mesh_body_h

#include "morphology/mesh_morphology.h"
#include "observation/mesh_probes.h"
#include "sliding/body_size.h"
#include "sliding/mesh/sliding_mesh.h"
#include "sliding/supports/mesh_side.h"

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
struct ContactParameters;
template <int dim>
class BodyMesh;

/** Key Dimension, sections Mesh and Phases of contact_dynamics, and the constraints of
 * section Supports. */
struct MeshBodyParameters
{
  std::string section;                          ///< prefix of its key names
  MeshParameters mesh;                          ///< mesh file
  std::string contact_boundary = "Contact";     ///< name of a physical group
  std::string top_boundary     = "Top";         ///< name of a physical group
  std::array<std::vector<std::string>, 3> held; ///< constrained groups per component

  /** For x and y: empty, or the two groups that are joined periodically. */
  std::array<std::vector<std::string>, 2> periodic;
  std::vector<PhaseParameters> phases; ///< empty without a mesh

  /** Whether there is a file. */
  bool is_given() const
  {
    return !mesh.files.empty();
  }

  /** Key that determines the size of the body. */
  const char *size_key() const
  {
    return is_given() ? "Mesh/Scale" : "Body/Size";
  }

  /** Whether the body is a grid in 2D. */
  bool is_plane_grid() const
  {
    return mesh.dim == 2 && !is_given();
  }

  /** Digest of the RVE file whose effective stiffness the whole body has; empty without
   * one. */
  std::string rve_digest;

  /** RveFile::content() of the RVE file that the phases come from. */
  std::string rve_content;

  /** RveFile::change_note() of the RVE file that the phases come from; empty:
   * unchanged. */
  std::string rve_note;

  /** Binds the keys. @throws UserError for several meshes */
  void bind(Keys &keys);

  /** Binds the keys of a counter body, in the current section. */
  void bind_below(Keys &keys);

  /** @throws UserError naming the invalid key of a phase */
  void check() const;

private:
  void bind_periodicity(Keys &keys);
  void require_one_mesh(const Keys &keys) const;
};

/**
 * The parameters with the phases of the body. If they do not come from section Phases,
 * they are the effective stiffness and mean density of the RVE file, its phases, or
 * Body/Stiffness. Collective.
 * @throws UserError
 */
template <int dim>
ContactParameters with_phases(ContactParameters parameters);

/** Description of a body on a mesh, replicated on all ranks. */
struct MeshBodyDescription
{
  MeshBoundary contact;         ///< boundary on the flat
  MeshBoundary top;             ///< loaded boundary
  std::vector<double> friction; ///< Coulomb coefficient per contact node

  /** For each phase its share of the tributary area of each contact node. */
  std::vector<std::vector<double>> shares;

  SideNodes top_nodes;         ///< impedance and position of TopSetup
  std::vector<MeshSide> sides; ///< per side of ContactParameters::loaded_sides()

  std::vector<HeldComponent> held; ///< constrained dofs
  std::uint64_t n_points = 0;      ///< points of the mesh
  std::uint64_t n_cells  = 0;      ///< cells of the mesh
  std::string digest;              ///< digest of the file
  std::vector<MeshPlace> probes;   ///< positions in the mesh
  ReferenceNode reference;         ///< a contact node

  BodyScales scales;         ///< without the highest frequency
  double shortest_side = 0.; ///< shortest side of the bounding box (m)

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<14>(archive, *this);
  }
};

/**
 * Contact, top, friction and constrained points of the mesh; without contact and top if
 * the modes need none. The coefficient of a contact node is
 * FrictionParameters::coefficient, or the mean over the phases behind it (see
 * mean_of_phases()), weighted with their stiffness along the normal if requested.
 * @throws UserError for a boundary that is missing or faces the wrong way, points in
 * both contact and top, a held platen, phases without density, a probe outside
 */
template <int dim>
MeshBodyDescription describe_body(const BodyMesh<dim> &morphology,
                                  const ContactParameters &given);
} // namespace mesoslip

#endif
