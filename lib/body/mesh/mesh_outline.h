#ifndef mesoslip_body_mesh_mesh_outline_h
#define mesoslip_body_mesh_mesh_outline_h

#include "base/serialize_members.h"
#include "body/mesh/mesh_body.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/** Global data of a mesh that all ranks have: sums and surface. */
template <int dim>
struct MeshOutline
{
  /** Points of one side of the body. */
  struct Side
  {
    std::vector<unsigned int> points; ///< numbers in the whole mesh, in 2D along the side

    /** SurfaceNodes::normal_area of each point (2D: m, 3D: m^2). */
    std::vector<std::array<double, dim>> normal_area;

    /** Saves or restores all members (Boost.Serialization). */
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &points &normal_area;
    }
  };

  std::array<double, dim> lower   = {}; ///< lower corner of the bounding box (m)
  std::array<double, dim> extents = {}; ///< lengths of the bounding box (m)
  double volume                   = 0.; ///< volume of the body (2D: area, m^2; 3D: m^3)
  double mass                     = 0.; ///< mass of the body (kg, in 2D kg/m)
  std::uint64_t n_cells           = 0;  ///< number of cells of the whole mesh

  /** The 2 dim sides of the body, numbered as in ElasticBody::surface(). */
  std::vector<Side> sides;

  /**
   * Numbers in the whole mesh of periodic copies and their periodic masters, pair after
   * pair, axis after axis.
   */
  std::vector<unsigned int> copies;

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<7>(archive, *this);
  }
};

/**
 * Outline of @p mesh with phases, boundaries and periodicity of @p input. @throws
 * UserError if a cell is flat or inside out, the body is in pieces, a boundary has no
 * face, or the sides of a periodic mesh do not match
 */
template <int dim>
MeshOutline<dim> outline_of(const Mesh<dim> &mesh, const MeshBodyInput<dim> &input);
} // namespace mesoslip

#endif
