#ifndef mesoslip_eigenvalues_complex_shifted_inverse_h
#define mesoslip_eigenvalues_complex_shifted_inverse_h

#include "eigenvalues/complex/sliding_pencil.h"

namespace mesoslip
{
/** Applies (A - sigma B)^-1 B of the linear form A x = s B x, scaled; see nearest(). */
class ShiftedInverse
{
public:
  /**
   * @p factors of pencil(@p shift) and @p pencil must outlive this object. @p frequency
   * (1/s) scales v.
   */
  ShiftedInverse(const SlidingPencil &pencil,
                 const ComplexFactorization &factors,
                 const SlidingPencil::Complex shift,
                 const double frequency);

  /** dst = operator times src; vectors of length SlidingPencil::state_size(). */
  void vmult(ComplexVector &dst, const ComplexVector &src) const;

private:
  const SlidingPencil &pencil;
  const ComplexFactorization &factors;
  const SlidingPencil::Complex shift;
  const double of_v; ///< v = of_v times its scaled unknowns
  const double of_q; ///< q = of_q times its scaled unknowns
};
} // namespace mesoslip

#endif
