#ifndef mesoslip_tests_verification_box_body_h
#define mesoslip_tests_verification_box_body_h

#include "../mesh_sliding/mesh_sliding.h"
#include "sliding_body.h"

#include <type_traits>

namespace verification
{
/** What makes the body of a plane setup one in three dimensions. */
struct Depth
{
  ElasticPhase<3> phase;   ///< of all cells
  unsigned int n_deep = 1; ///< cells along y, as long as those along x
  double angle = 0.; ///< from x to y, along which the first component of the plane is
};

/** A box of bricks whose x and z are the axes of the plane @p setup; where that is periodic,
 * the box is so along x and y. */
inline MeshCase<3> box_case(const BodySetup &setup, const Depth &depth)
{
  const auto &n = setup.cells;
  const auto &h = setup.spacing;
  MeshCase<3> c = box_of_bricks({{n[0], depth.n_deep, n[1]}}, {{h[0], h[0], h[1]}});
  c.phases      = {depth.phase};
  c.friction    = setup.friction;
  c.setup       = setup;
  std::swap(c.setup.step.acceleration[1], c.setup.step.acceleration[2]);
  for (unsigned int axis = 0; axis < 2 && setup.periodic; ++axis)
    c.join(axis);
  c.setup.periodic = false; // so are the points
  return c;
}

/** Such a body on one rank, with what Body has; coordinates and components are those of the
 * plane. */
class BoxBody : BodyParts<3>, public SlidingMesh<3>
{
public:
  BoxBody(const BodySetup &setup, const Depth &depth)
    : BodyParts<3>(box_case(setup, depth), MPI_COMM_SELF)
    , SlidingMesh<3>(
        *distributed, contact_boundary, top_boundary, held, with_friction(setup.friction))
    , setup(setup)
    , direction{{std::cos(depth.angle), std::sin(depth.angle)}}
    , depth(depth.n_deep * setup.spacing[0])
    , nodes_deep(depth.n_deep + (setup.periodic ? 0 : 1))
    , n_nodes{{setup.cells[0] + 1, depth.n_deep + 1}}
    , column(distributed->part().points.size())
  {
    const auto &points = distributed->part().point_in_mesh;
    for (unsigned int k = 0; k < points.size(); ++k)
      column[points[k]] = k;
  }

  const BodySetup setup;
  const std::array<double, 2> direction; ///< in which the first component points
  const double depth;                    ///< along y (m)
  const unsigned int nodes_deep;         ///< different nodes along y

  /** A component of a field at a node of the plane. */
  double at(const NodalField<double> &field,
            const unsigned int c,
            const unsigned int i,
            const unsigned int j) const
  {
    const unsigned int k = column[n_nodes[0] * n_nodes[1] * j + i];
    return c == 1 ? field.row(2, 0)[k]
                  : direction[0] * field.row(0, 0)[k] + direction[1] * field.row(1, 0)[k];
  }

  void set_u(const std::function<double(double, double, unsigned int)> &f)
  {
    set(u, f);
  }

  void set_w(const std::function<double(double, double, unsigned int)> &f)
  {
    set(w, f);
  }

  void run(const std::uint64_t n_steps, StepObserver *other = nullptr)
  {
    run_steps(stepper, energy.get(), n_steps, other);
  }

private:
  void set(NodalField<double> &field,
           const std::function<double(double, double, unsigned int)> &f) const
  {
    const auto &points = distributed->part().points;
    for (std::size_t k = 0; k < points.size(); ++k)
      {
        for (unsigned int d = 0; d < 2; ++d)
          field.row(d, 0)[k] = direction[d] * f(points[k][0], points[k][2], 0);
        field.row(2, 0)[k] = f(points[k][0], points[k][2], 1);
      }
  }

  const std::array<unsigned int, 2> n_nodes; ///< of a plane across z, along x and y
  std::vector<unsigned int> column;          ///< of each node of the box in the fields
};

/** The body of a plane setup in the plane, or as a box. */
template <int dim>
using BodyIn = std::conditional_t<dim == 2, Body, BoxBody>;

/** Makes it; the @p depth is only for the box. */
template <int dim>
BodyIn<dim> make_body(const BodySetup &setup, const Depth &depth)
{
  if constexpr (dim == 2)
    return Body(setup);
  else
    return BoxBody(setup, depth);
}
} // namespace verification

#endif
