#ifndef mesoslip_body_mesh_mesh_outline_h
#define mesoslip_body_mesh_mesh_outline_h

#include "base/serialize_members.h"
#include "body/mesh/mesh_body.h"

#include <boost/serialization/array.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/** What all ranks know of a whole mesh: sums over it, and its surface. */
template <int dim>
struct MeshOutline
{
  /** Points of a side of the body. */
  struct Side
  {
    std::vector<unsigned int> points;                 ///< in 2D along the side
    std::vector<std::array<double, dim>> normal_area; ///< see SurfaceNodes

    /** Of boost::serialization. */
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &points &normal_area;
    }
  };

  std::array<double, dim> lower   = {}; ///< corner of the bounding box (m)
  std::array<double, dim> extents = {}; ///< of the bounding box (m)
  double volume                   = 0.; ///< m^2, m^3
  double mass                     = 0.; ///< kg, in 2D kg/m
  std::uint64_t n_cells           = 0;  ///< of the mesh
  std::vector<Side> sides;              ///< as ElasticBody has them

  /** Duplicates and their originals, axis after axis, one pair after the other. */
  std::vector<unsigned int> duplicates;

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<7>(archive, *this);
  }
};

/**
 * Of @p mesh with phases, boundaries and periodicity of @p input. @throws UserError if a
 * cell is flat or inside out, the body is in pieces, a boundary has no face, or the sides of
 * a periodic mesh do not match
 */
template <int dim>
MeshOutline<dim> outline_of(const Mesh<dim> &mesh, const MeshBodyInput<dim> &input);
} // namespace mesoslip

#endif
