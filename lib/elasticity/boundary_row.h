#ifndef mesoslip_elasticity_boundary_row_h
#define mesoslip_elasticity_boundary_row_h

#include "elasticity/step_parameters.h"

#include <cstdint>

namespace mesoslip
{
/**
 * One boundary row of nodes, at the moment when its forces of step n are complete. All
 * arrays have n_columns entries; with a periodic grid the last one duplicates the first
 * and has to be given the same values.
 */
struct RowView
{
  /** State before the step, to be advanced in place: u_n and w_n. */
  double *ux = nullptr;
  double *uy = nullptr; ///< m
  double *wx = nullptr; ///< m/s
  double *wy = nullptr; ///< m/s

  /** K (u_n + beta w_n) minus body forces (N/m): the acceleration is
   *  inverse_mass * (boundary force - f). */
  const double *fx = nullptr;
  const double *fy = nullptr; ///< N/m

  /** One over the lumped mass (m/kg), zero where a side holds the component: such a
   *  component keeps its w. */
  const double *inverse_mass_x = nullptr;
  const double *inverse_mass_y = nullptr; ///< m/kg

  unsigned int n_columns = 0; ///< entries of the arrays

  /** n, counted from the first step of the stepper (or from set_step_number()). */
  std::uint64_t step = 0;

  /** n dt (s), the time of u_n. */
  double time = 0.;
};

/**
 * What happens on the bottom or top row: turns forces into motion,
 *
 *     a = inverse_mass (boundary force - f)
 *     w += dt a,   u += dt w + (beta2 - 1/2) dt^2 a      (w: the new one)
 *
 * Called once each step, in order of time. Within advance() the bottom row may be several
 * steps ahead of the top row, so the two must not talk to each other during advance(),
 * and neither may look at other rows of the field.
 */
struct BoundaryRow
{
  virtual ~BoundaryRow() = default;

  /** One step of the row, on the rank that owns it. */
  virtual void advance(const RowView &row) = 0;
};

/** No boundary force: the row moves freely (sides held as inverse_mass says). */
class FreeRow : public BoundaryRow
{
public:
  /** Time step and beta2 are taken from @p parameters. */
  explicit FreeRow(const StepParameters &parameters);

  /** w_(n+1) from the internal forces alone. */
  void advance(const RowView &row) override;

private:
  double dt;
  double c_new;
  double c_old;
};
} // namespace mesoslip

#endif
