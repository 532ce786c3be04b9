#ifndef mesoslip_dynamics_brick_stepper_h
#define mesoslip_dynamics_brick_stepper_h

#include "dynamics/mesh_surface.h"
#include "dynamics/surface_stepper.h"
#include "elasticity/brick/brick_operator.h"

#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * Explicit time integration of a box of equal bricks by the beta2 scheme, see
 * MeshStepper. Forces and update of a row of nodes are one sweep, in place; bottom, top
 * and other loaded sides are advanced after it. Results have the same bits on any number
 * of ranks.
 */
class BrickStepper : public SurfaceStepper<3>
{
public:
  /** @p op and the fields must outlive the stepper; see MeshStepper. */
  BrickStepper(const BrickOperator &op,
               const std::vector<HeldComponent> &held,
               const StepParameters &parameters,
               NodalField<double> &u,
               NodalField<double> &w,
               const std::shared_ptr<const BrickOperator> &damping = nullptr);

  /** @p nodes must be the whole bottom or the whole top. @throws std::invalid_argument */
  MeshSurface<3> &add_surface(const SharedNodes &nodes,
                              SurfaceCondition<3> &condition) override;

  /**
   * Adds a lateral side: the sweep advances its nodes without loads, then they are
   * advanced again with the loads.
   */
  MeshSurface<3> &add_side(const SharedNodes &nodes,
                           SurfaceCondition<3> &condition) override;
  void advance(const std::uint64_t n_steps) override;
  void multiply(NodalField<double> &Kx, NodalField<double> &x) const override;
  double elastic_energy() const override;
  void mass_row(const unsigned int j, double *mass) const override;
  Deformation deformation() const override;
  std::string kernel_name() const override;

private:
  /** A surface and the storage of its nodal forces. */
  struct Side
  {
    std::unique_ptr<MeshSurface<3>> surface;
    LineVector<double> force;             ///< see BrickStep::surface_force
    std::vector<std::size_t> force_place; ///< first force component of each point
  };

  std::unique_ptr<MeshSurface<3>> make_surface(const SharedNodes &nodes,
                                               SurfaceCondition<3> &condition) const;
  void set_inverse_mass();
  double inverse_inertia(const unsigned int point) const;
  void damp_by_phase();
  double nodal_force(const unsigned int point, const unsigned int c) const;
  void set_held(const std::vector<HeldComponent> &components);
  kernels::BrickStep brick_step();
  bool is_held(const unsigned int point, const unsigned int component) const;

  const BrickOperator &op;
  std::vector<double> mass_rows;                        ///< inverse, distinct rows
  std::vector<const double *> inverse_mass;             ///< inverse, of each row
  std::vector<std::uint32_t> held_begin;                ///< begin of each row, end
  std::vector<kernels::HeldNode> held;                  ///< constrained, by row
  Side sides[2];                                        ///< bottom and top
  std::vector<std::unique_ptr<MeshSurface<3>>> lateral; ///< loaded lateral sides
  NodalField<double>
    mobility; ///< for damp_by_phase(): 1/kg, 0 where constrained or at bottom and top
};
} // namespace mesoslip

#endif
