#ifndef mesoslip_eigenvalues_vibration_modes_h
#define mesoslip_eigenvalues_vibration_modes_h

#include "eigenvalues/free_dofs.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace mesoslip
{
/** Options of vibration_modes(). */
struct VibrationModesOptions
{
  unsigned int n_modes = 4; ///< number of modes

  std::vector<Platen> platens; ///< platens; the constraints hold their displacements

  /** Relative residual of each static solve; eigenvalues have about this accuracy. */
  double tolerance = 1e-10;

  /**
   * Called before each static solve with the number of solves so far; may throw to stop.
   */
  std::function<void(unsigned int)> before_solve;
};

/** A free vibration u(x, t) = shape(x) cos(2 pi f t). */
template <int dim>
struct VibrationMode
{
  double frequency = 0.; ///< Hz

  /**
   * Mode shape: the largest displacement vector has length one, and its larger component
   * is positive.
   */
  NodalField<double> shape;

  double modal_mass = 0.; ///< shape.M shape (kg/m), including the platen

  /**
   * Effective mass fraction for a rigid acceleration along each axis: relative to the
   * body mass, along the last axis including the platen.
   */
  std::array<double, dim> effective_mass = {};

  /** |K u - omega^2 M u| / |K u| over the free degrees of freedom. */
  double residual = 0.;
};

/** Lowest modes in ascending order, and the cost of the computation. */
template <int dim>
struct VibrationModes
{
  std::vector<VibrationMode<dim>> modes; ///< lowest first

  /**
   * Number of unconstrained rigid motions; they have 0 Hz and are not among the modes.
   */
  unsigned int n_rigid_motions = 0;

  unsigned int n_solves          = 0; ///< number of solves with K
  unsigned int solver_iterations = 0; ///< iterations of all solves
};

/**
 * Builds a mode, except frequency and residual, from its shape in the free degrees of
 * freedom and the @p momentum, mass times shape. Collective.
 */
template <int dim>
VibrationMode<dim> make_mode(const typename FreeDofs<dim>::Vector &shape,
                             const typename FreeDofs<dim>::Vector &momentum,
                             const FreeDofs<dim> &dofs,
                             const ElasticBody<dim> &body);

/**
 * @throws std::invalid_argument if @p n_free degrees of freedom (FreeDofs::size()) have
 * fewer modes than @p options requires.
 */
void check_number_of_modes(const std::size_t n_free,
                           const VibrationModesOptions &options);

/**
 * Solves K u = omega^2 M u (lumped mass) by shift-and-invert Lanczos around zero
 * (ARPACK); rigid motions are projected out, so that a free body needs no shift. @throws
 * std::invalid_argument if there are not enough modes; NotConverged; UserError if fields
 * are distributed and a rank has no free degree of freedom
 */
template <int dim>
VibrationModes<dim> vibration_modes(const ElasticBody<dim> &body,
                                    const DofMask &mask,
                                    const VibrationModesOptions &options);
} // namespace mesoslip

#endif
