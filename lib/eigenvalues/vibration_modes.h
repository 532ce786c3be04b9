#ifndef mesoslip_eigenvalues_vibration_modes_h
#define mesoslip_eigenvalues_vibration_modes_h

#include "eigenvalues/free_dofs.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace mesoslip
{
/** What is wanted of the modes of vibration, and how they are computed. */
struct VibrationModesOptions
{
  unsigned int n_modes = 4; ///< wanted

  std::vector<Platen> platens; ///< whose displacements the constraints hold

  /** Relative residual of each static solve; eigenvalues are accurate to about this. */
  double tolerance = 1e-10;

  /** Called before each static solve with their number so far; may throw to stop. */
  std::function<void(unsigned int)> before_solve;
};

/** A free vibration u(x, t) = shape(x) cos(2 pi f t). */
template <int dim>
struct VibrationMode
{
  double frequency = 0.; ///< Hz

  /** The largest displacement vector has length one and its larger component is positive.
   */
  NodalField<double> shape;

  double modal_mass = 0.; ///< shape.M shape (kg/m), with the platen's

  /**
   * Share of the mass that takes part in a rigid acceleration along each axis: of
   * the body's, and along the last axis of the platen's as well.
   */
  std::array<double, dim> effective_mass = {};

  /** |K u - omega^2 M u| / |K u| at the free degrees of freedom. */
  double residual = 0.;
};

/** The lowest modes in ascending order, and what they took. */
template <int dim>
struct VibrationModes
{
  std::vector<VibrationMode<dim>> modes; ///< lowest first

  /** Rigid motions that nothing holds; they vibrate at 0 Hz and are not among the modes.
   */
  unsigned int n_rigid_motions = 0;

  unsigned int n_solves          = 0; ///< with K
  unsigned int solver_iterations = 0; ///< of all solves
};

/** A mode without its frequency and residual, from its shape in the free degrees of freedom and the mass times that. Collective. */
template <int dim>
VibrationMode<dim> make_mode(const typename FreeDofs<dim>::Vector &shape,
                             const typename FreeDofs<dim>::Vector &momentum,
                             const FreeDofs<dim> &dofs,
                             const ElasticBody<dim> &body);

/** @throws std::invalid_argument if @p n_free degrees of freedom (FreeDofs::size()) have
 * not as many modes as @p options wants. */
void check_number_of_modes(const std::size_t n_free,
                           const VibrationModesOptions &options);

/**
 * Solves K u = omega^2 M u (lumped mass) by shift-and-invert Lanczos
 * around zero (ARPACK); rigid motions are projected out, so a free body needs no shift.
 * @throws std::invalid_argument if there are not that many modes; NotConverged; UserError
 * where fields are divided and a rank has no free degree of freedom
 */
template <int dim>
VibrationModes<dim> vibration_modes(const ElasticBody<dim> &body,
                                    const DofMask &mask,
                                    const VibrationModesOptions &options);
} // namespace mesoslip

#endif
