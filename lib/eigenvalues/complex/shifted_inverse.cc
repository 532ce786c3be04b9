#include "eigenvalues/complex/shifted_inverse.h"

namespace mesoslip
{
ShiftedInverse::ShiftedInverse(const SlidingPencil &pencil,
                               const ComplexFactorization &factors,
                               const SlidingPencil::Complex shift,
                               const double frequency)
  : pencil(pencil)
  , factors(factors)
  , shift(shift)
  , of_v(frequency)
  , of_q(pencil.stiffness.diagonal().mean())
{
}

void ShiftedInverse::vmult(ComplexVector &dst, const ComplexVector &src) const
{
  const Eigen::Index n = pencil.size(), n_forces = pencil.targets.rows();
  const double beta = pencil.law.beta, tau = pencil.law.state_time;
  const SlidingPencil::Complex damped = 1. + beta * shift, late = 1. + tau * shift;
  const ComplexVector lag        = pencil.lag(shift);
  const Eigen::ArrayXcd at_once  = pencil.lag_at_once().cast<std::complex<double>>(),
                        late_lag = pencil.late_lag().cast<std::complex<double>>();
  const ComplexVector u = src.head(n), v = of_v * src.segment(n, n);
  ComplexVector old_force = ComplexVector::Zero(n_forces), old_late = old_force;
  if (tau > 0.)
    old_late = tau * of_q * src.tail(n_forces);
  if (pencil.remembers())
    {
      const ComplexVector q = of_q * src.segment(2 * n, n_forces);
      old_force             = at_once * q.array();
      old_late.array() += late_lag * q.array();
    }

  // Known part of (D_0 - G_d) v - z.
  const auto drag = [&](const ComplexVector &velocity) -> ComplexVector {
    return product(pencil.drag, velocity) - product(pencil.damped_targets, velocity) +
           (product(pencil.late_drag, velocity) + old_late) / late;
  };
  ComplexVector right =
    -product(pencil.mass, v + shift * u) - product(pencil.resistances, u);
  if (beta > 0.)
    right -= beta * product(pencil.stiffness, u);
  const ComplexVector force =
    (beta * product(pencil.targets, u) - drag(u) - old_force).cwiseQuotient(lag);
  right += product(pencil.distribution, force);

  ComplexVector new_u;
  factors.solve(new_u, right);
  new_u /= damped;
  const ComplexVector new_v = u + shift * new_u;
  dst.resize(src.size());
  dst.head(n)             = new_u;
  dst.segment(n, n)       = new_v / of_v;
  ComplexVector new_force = ComplexVector::Zero(n_forces);
  if (pencil.remembers())
    {
      new_force = (product(pencil.targets, new_u + beta * new_v) +
                   product(pencil.spring_targets, new_u) - drag(new_v) - old_force)
                    .cwiseQuotient(lag);
      dst.segment(2 * n, n_forces) = new_force / of_q;
    }
  if (tau > 0.)
    dst.tail(n_forces) = -(product(pencil.late_drag, new_v) + old_late +
                           shift * ComplexVector(late_lag * new_force.array())) /
                         (late * of_q);
}
} // namespace mesoslip
