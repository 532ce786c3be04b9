#ifndef mesoslip_dynamics_mesh_stepper_h
#define mesoslip_dynamics_mesh_stepper_h

#include "dynamics/mesh_surface.h"
#include "dynamics/surface_stepper.h"
#include "elasticity/mesh_operator.h"

#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * Explicit time integration of a mesh by the beta2 scheme, see ExplicitStepper:
 *
 *     a = M^-1 (boundary forces + M g - K (u + beta w))
 *     w += dt a,   u += dt w + (beta2 - 1/2) dt^2 a
 *
 * Shared points are advanced on all their ranks, periodic copies like their masters, with
 * the same bits. u and w have one row with a column for each point of the part, owned
 * points first.
 */
template <int dim>
class MeshStepper : public SurfaceStepper<dim>
{
public:
  /**
   * @p op and the fields must outlive the stepper; @p damping is an operator with the
   * phases of phases_of_damping() if damping differs by phase. Collective.
   */
  MeshStepper(const MeshOperator<dim> &op,
              const std::vector<HeldComponent> &held,
              const StepParameters &parameters,
              NodalField<double> &u,
              NodalField<double> &w,
              const std::shared_ptr<const MeshOperator<dim>> &damping = nullptr);

  MeshSurface<dim> &add_surface(const SharedNodes &nodes,
                                SurfaceCondition<dim> &condition) override;

  void advance(const std::uint64_t n_steps) override;
  void multiply(NodalField<double> &Kx, NodalField<double> &x) const override;
  double elastic_energy() const override;
  void mass_row(const unsigned int j, double *mass) const override;
  Deformation deformation() const override;
  std::string kernel_name() const override;

private:
  using Stepper::communicator;
  using Stepper::n_distinct;
  using Stepper::n_done;
  using Stepper::parameters;
  using Stepper::u;
  using Stepper::w;

  void load_state();
  void step_once();
  void add_damping();
  kernels::NodeStep
  node_step(const double dt, const double c_new, const double c_old) const;

  const MeshOperator<dim> &op;
  NodalField<double> inverse_mass; ///< m/kg, 0 where constrained
  NodalField<double> own_mass;     ///< mass of locally owned points, 0 for others
  LineVector<double> z;            ///< u + beta w
  LineVector<double> force;
  const kernels::NodeArrays arrays;
  std::vector<std::unique_ptr<MeshSurface<dim>>> surfaces;
};
} // namespace mesoslip

#endif
