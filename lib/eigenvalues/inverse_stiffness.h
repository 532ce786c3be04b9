#ifndef mesoslip_eigenvalues_inverse_stiffness_h
#define mesoslip_eigenvalues_inverse_stiffness_h

#include "eigenvalues/free_dofs.h"
#include "eigenvalues/vibration_modes.h"

#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * K^-1 on loads without resultant; solutions have no rigid motion (in the mass' sense).
 * Under a platen the body is solved for with the top held, u = K_hh^-1 f, and moves with
 * the platen on top of that: u + s z, where z is the response to a unit displacement of
 * the platen and s = z.f / z.K z, as z.K u = 0.
 */
template <int dim>
class InverseStiffness
{
public:
  /** Vectors of FreeDofs. */
  using Vector = typename FreeDofs<dim>::Vector;

  /** Of what @p mask leaves free; all arguments must outlive it. Collective. */
  InverseStiffness(const ElasticBody<dim> &body,
                   const DofMask &mask,
                   const FreeDofs<dim> &dofs,
                   const VibrationModesOptions &options);

  /** dst = K^-1 src. Collective. @throws NotConverged */
  void vmult(Vector &dst, const Vector &src) const;

  /** Takes the rigid motions that nothing holds out of @p x. Collective. */
  void remove_rigid(Vector &x) const;

  /** Number of these. */
  unsigned int n_rigid() const
  {
    return rigid.size();
  }

  mutable unsigned int n_solves   = 0; ///< number of solves with K so far
  mutable unsigned int iterations = 0; ///< of the iterative solver in all these solves

private:
  void solve() const;
  bool platen_moves_freely() const;
  void push_platen(const ElasticBody<dim> &body);

  const FreeDofs<dim> &dofs;
  const VibrationModesOptions &options;
  const std::vector<Vector> rigid;
  std::unique_ptr<StaticSolver> solver;
  mutable NodalField<double> force, u;
  Vector response;              ///< z; empty without a platen or when nothing resists it
  double platen_stiffness = 0.; ///< z.K z (N/m^2)
};
} // namespace mesoslip

#endif
