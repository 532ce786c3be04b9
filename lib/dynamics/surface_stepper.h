#ifndef mesoslip_dynamics_surface_stepper_h
#define mesoslip_dynamics_surface_stepper_h

#include "dynamics/mesh_surface.h"
#include "dynamics/shared_nodes.h"
#include "dynamics/stepper.h"
#include "dynamics/surface_condition.h"

#include <cassert>
#include <memory>
#include <utility>

namespace mesoslip
{
/** A constrained component of a point of a mesh; its acceleration is zero. */
struct HeldComponent
{
  unsigned int point     = 0; ///< index in the whole mesh, of a periodic master
  unsigned int component = 0; ///< component, 0: x

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &point &component;
  }
};

/** Points of @p components, possibly with repetitions. */
inline std::vector<unsigned int> points_of(const std::vector<HeldComponent> &components)
{
  std::vector<unsigned int> points;
  for (const HeldComponent &held : components)
    points.push_back(held.point);
  return points;
}

/**
 * A stepper of a part of a mesh. Fields have one row with a column for each point,
 * locally owned masters first; added surfaces advance the boundary nodes.
 */
template <int dim>
class SurfaceStepper : public Stepper
{
public:
  /**
   * Registers @p condition, which advances these nodes and must outlive the last step. No
   * point may belong to two surfaces. Collective.
   */
  virtual MeshSurface<dim> &add_surface(const SharedNodes &nodes,
                                        SurfaceCondition<dim> &condition) = 0;

  /** Adds a side other than bottom and top; call it after these. */
  virtual MeshSurface<dim> &add_side(const SharedNodes &nodes,
                                     SurfaceCondition<dim> &condition)
  {
    return add_surface(nodes, condition);
  }

protected:
  /** Stepper of @p part, whose points are the columns of the fields. */
  SurfaceStepper(const StepParameters &parameters,
                 NodalField<double> &u,
                 NodalField<double> &w,
                 const MeshPart<dim> &part,
                 const MPI_Comm communicator,
                 std::unique_ptr<PhaseDamping> by_phase = nullptr)
    : Stepper(parameters,
              u,
              w,
              NodeRows::all(1),
              part.n_distinct,
              communicator,
              std::move(by_phase))
  {
    assert(u.n_columns() == part.points.size());
    assert(w.n_columns() == part.points.size());
  }
};
} // namespace mesoslip

#endif
