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
/** A component of a point of a mesh whose acceleration is kept at zero. */
struct HeldComponent
{
  unsigned int point     = 0; ///< index into the whole mesh, of an original
  unsigned int component = 0; ///< 0: x

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &point &component;
  }
};

/** The points of @p components, some of them more than once. */
inline std::vector<unsigned int> points_of(const std::vector<HeldComponent> &components)
{
  std::vector<unsigned int> points;
  for (const HeldComponent &held : components)
    points.push_back(held.point);
  return points;
}

/** A stepper of a part of a mesh, whose fields are one row with a column for each point, the
 * ones that count first; boundary surfaces are moved by what is added. */
template <int dim>
class SurfaceStepper : public Stepper
{
public:
  /** From now on @p condition moves these nodes and must outlive the last step. No point
   * may be in two surfaces. Collective. */
  virtual MeshSurface<dim> &add_surface(const SharedNodes &nodes,
                                        SurfaceCondition<dim> &condition) = 0;

  /** The same of a side besides bottom and top, after these. */
  virtual MeshSurface<dim> &add_side(const SharedNodes &nodes,
                                     SurfaceCondition<dim> &condition)
  {
    return add_surface(nodes, condition);
  }

protected:
  /** Of @p part, whose points have the columns of the fields. */
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
