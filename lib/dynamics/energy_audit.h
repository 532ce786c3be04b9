#ifndef mesoslip_dynamics_energy_audit_h
#define mesoslip_dynamics_energy_audit_h

#include "base/serialize_members.h"
#include "dynamics/stepper.h"
#include "dynamics/supports/suspension.h"
#include "grid/row_partition.h"


#include <functional>
#include <vector>

namespace mesoslip
{
/**
 * Work done on and energy dissipated at the boundary since the start (J, in 2D J/m), for
 * one rank.
 */
struct BoundaryWork
{
  double external = 0.; ///< work of the load at the top and of the moving flat
  double friction = 0.; ///< dissipated by sliding on the flat
  double impact   = 0.; ///< dissipated by landing nodes
  double load     = 0.; ///< integral of F_N |V|: normal force times speed of the flat
  double stored   = 0.; ///< current energy of springs between surface and flat
  double pressed  = 0.; ///< energy of these springs at the start
  SuspensionEnergies supports; ///< springs, dashpots and masses at the top (J, in 2D J/m)
};

/** Sampled energies (J/m); values of one rank until reduce() is called. */
struct EnergyHistory
{
  std::vector<double> time;          ///< s
  std::vector<double> kinetic;       ///< 1/2 v.M v
  std::vector<double> elastic;       ///< 1/2 u.K u
  std::vector<double> potential;     ///< potential of the body acceleration
  std::vector<double> external_work; ///< since the start, as all values below
  std::vector<double> friction;      ///< dissipated by sliding
  std::vector<double> impact;        ///< dissipated by landing nodes
  std::vector<double> damping;       ///< dissipated by C = alpha M + beta K
  std::vector<double> scheme;        ///< dissipated by beta2 > 1/2
  std::vector<double> contact;       ///< stored in springs between surface and flat
  std::vector<double> supports;      ///< stored in springs and masses of supports
  std::vector<double> dashpots;      ///< dissipated by dashpots of supports

  /** kinetic + elastic + potential + contact + supports at the start. */
  double initial = 0.;

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<13>(archive, *this);
  }

  /** Residual of the energy balance at each sample; zero in exact arithmetic. */
  std::vector<double> residual() const;

  /** Adds the energies of another body at the same times. */
  EnergyHistory &operator+=(const EnergyHistory &other);
};

/**
 * The energy balance of the beta2 scheme. With c = (b - 1/2) dt^2, the scheme satisfies
 * exactly, for M a_n = f_n - K (u_n + beta w_n) - alpha M (w_n + w_(n+1)) / 2,
 *
 *     H_(n+1/2) - H_(n-1/2) = f_n.(u_(n+1) - u_(n-1)) / 2 - D_beta - D_b
 *     H_(n+1/2) = w_(n+1).M w_(n+1) / 2 + c/4 a_n.M a_n + u_(n+1).K u_n / 2
 *     D_beta    = (u_(n+1) - u_(n-1)).(alpha M (w_n + w_(n+1)) / 2 + beta K w_n) / 2
 *     D_b       = c/4 (a_n + a_(n-1)).M (a_n + a_(n-1))
 *
 * so with interval 1 the residual is round-off. With a longer interval the two
 * dissipations are integrated by the trapezoidal rule; boundary work stays exact.
 */
class EnergyAudit : public StepObserver
{
public:
  /**
   * Keeps a reference to @p stepper. @p boundary_work returns the work from the start to
   * the end of the last step.
   */
  EnergyAudit(Stepper &stepper,
              const std::uint64_t interval,
              const std::function<BoundaryWork()> &boundary_work);

  std::uint64_t next_step(const std::uint64_t n) const override;
  void before_step(const std::uint64_t n) override;
  void after_step(const std::uint64_t n) override;

  /** Samples of this rank so far. */
  const EnergyHistory &local_history() const
  {
    return samples;
  }

  /** Sums over the ranks, on all ranks. */
  EnergyHistory reduce() const;

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    // u_(n-1) of the next sample.
    serialize_own_rows(archive, interval == 1 ? u_now : u_before, stepper.rows);
    serialize_own_rows(archive, interval == 1 ? w_now : w_before, stepper.rows);
    archive &last_scheme &last_damping &sum_scheme &sum_damping &samples;
  }

private:
  /** Sums of this rank for one sample. */
  struct Sums
  {
    double kinetic   = 0.;
    double scheme    = 0.; ///< D_b of the step
    double potential = 0.;
    double elastic   = 0.;
    double damping   = 0.; ///< D_beta of the step
  };

  Sums nodal_sums() const;
  void multiply(NodalField<double> &u_n, NodalField<double> &w_n);
  double dot_difference(const NodalField<double> &a, const NodalField<double> *c) const;
  void add_products(Sums &sums) const;
  void initialize();

  Stepper &stepper;
  const StepParameters &step;
  NodalField<double> &u;
  NodalField<double> &w;
  const std::uint64_t interval;
  const std::function<BoundaryWork()> boundary_work;
  // Terms of the balance; vanishing terms need no computation and no fields.
  const bool damped, dissipative, heavy;

  NodalField<double> u_before, w_before; ///< u_(n-1), w_(n-1)
  NodalField<double> u_now, w_now;       ///< u_n, w_n
  NodalField<double> stiff_u, stiff_w;   ///< K u_n, K w_n
  std::vector<double> mass;              ///< masses of the owned nodes, row by row
  std::vector<double> drag;              ///< alpha m; empty without alpha
  double last_scheme = 0., last_damping = 0.;
  double sum_scheme = 0., sum_damping = 0.;
  EnergyHistory samples;
};
} // namespace mesoslip

#endif
