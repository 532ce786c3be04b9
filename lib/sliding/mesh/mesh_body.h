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

/** Key Dimension and sections Mesh and Phases of contact_dynamics, and what Supports holds. */
struct MeshBodyParameters
{
  std::string section;                          ///< what is before the names of its keys
  MeshParameters mesh;                          ///< the file
  std::string contact_boundary = "Contact";     ///< name of a physical group
  std::string top_boundary     = "Top";         ///< name of a physical group
  std::array<std::vector<std::string>, 3> held; ///< groups, for each component

  /** For x and y: none, or two groups that are joined. */
  std::array<std::vector<std::string>, 2> periodic;
  std::vector<PhaseParameters> phases; ///< empty without a mesh

  /** Whether there is a file. */
  bool is_given() const
  {
    return !mesh.files.empty();
  }

  /** The key that the size of the body comes from. */
  const char *size_key() const
  {
    return is_given() ? "Mesh/Scale" : "Body/Size";
  }

  /** Whether the body is a grid in 2D. */
  bool is_plane_grid() const
  {
    return mesh.dim == 2 && !is_given();
  }

  /** Of the RVE file whose effective stiffness the whole body has; empty without one. */
  std::string rve_digest;

  /** RveFile::content() of the RVE file that the phases come from. */
  std::string rve_content;

  /** RveFile::change_note() of the RVE file that the phases come from; empty: as it was written. */
  std::string rve_note;

  /** Binds the keys. @throws UserError for several meshes */
  void bind(Keys &keys);

  /** The same of those of a counter body, in the current section. */
  void bind_below(Keys &keys);

  /** @throws UserError naming the key of a phase that makes no sense */
  void check() const;

private:
  void bind_periodicity(Keys &keys);
  void require_one_mesh(const Keys &keys) const;
};

/**
 * The parameters with the phases of the body, where these are not those of section Phases:
 * the effective stiffness and the mean density of the RVE file, its phases, or Body/Stiffness.
 * Collective. @throws UserError
 */
template <int dim>
ContactParameters with_phases(ContactParameters parameters);

/** What all ranks know of a body on a mesh. */
struct MeshBodyDescription
{
  MeshBoundary contact;         ///< on the flat
  MeshBoundary top;             ///< loaded
  std::vector<double> friction; ///< Coulomb's coefficient of the contact nodes

  /** Of each phase its share of the tributary area of the contact nodes. */
  std::vector<std::vector<double>> shares;

  SideNodes top_nodes;         ///< impedance and position of TopSetup
  std::vector<MeshSide> sides; ///< of ContactParameters::loaded_sides()

  std::vector<HeldComponent> held; ///< never moved
  std::uint64_t n_points = 0;      ///< of the mesh
  std::uint64_t n_cells  = 0;      ///< of the mesh
  std::string digest;              ///< of the file
  std::vector<MeshPlace> probes;   ///< where they are in the mesh
  ReferenceNode reference;         ///< of the contact

  BodyScales scales;         ///< without the highest frequency
  double shortest_side = 0.; ///< of the bounding box (m)

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<14>(archive, *this);
  }
};

/**
 * Contact, top, friction and held points of the mesh that was read; no contact and no top
 * where modes under these supports ask for none. The coefficient of a
 * contact node is that of FrictionParameters, or the mean over the phases behind it (see
 * mean_of_phases()), weighted with their stiffness along the normal if so wanted.
 * @throws UserError for a boundary that is not there or faces the wrong way, points that
 * are in contact and top, a platen that is held, phases without density, a probe outside
 */
template <int dim>
MeshBodyDescription describe_body(const BodyMesh<dim> &morphology,
                                  const ContactParameters &given);
} // namespace mesoslip

#endif
