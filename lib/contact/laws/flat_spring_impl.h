#ifndef mesoslip_contact_laws_flat_spring_impl_h
#define mesoslip_contact_laws_flat_spring_impl_h

namespace mesoslip
{
/**
 * phi / 2 of ContactFunction: the weight of the earlier deformation in the force of a
 * spring with compliance @p soft (0: rigid), at a node that a unit force moves by
 * @p yields in the step. For numbers or vectors.
 */
template <typename T>
inline __attribute__((always_inline)) T share_of_earlier(const T soft, const T yields)
{
  // Avoids 0/0 for constrained nodes on a rigid flat; negligible otherwise.
  constexpr double smallest = 2.2250738585072014e-308;
  const T squares           = soft * soft;
  return 0.5 * squares / (squares + 0.0625 * (yields * yields) + smallest);
}

/**
 * Normal force (N, in 2D N/m) on a node that would end a step at @p gap < 0 (m) without
 * this force; it is the force of a spring, see ContactFunction, or of the flat.
 * @p earlier is the compression of the spring at the start of the previous step (m),
 * @p soft its compliance (0: no spring) and @p yields the displacement of the node by a
 * unit force in the step (both m/N, in 2D m^2/N). For numbers or vectors.
 */
template <typename T>
inline __attribute__((always_inline)) T
force_of_flat(const T gap, const T earlier, const T soft, const T yields)
{
  constexpr double smallest = 2.2250738585072014e-308; // avoids 0/0, see above
  const T share             = share_of_earlier(soft, yields);
  return ((share - 1.) * gap + share * earlier) /
         (soft + (1. - share) * yields + smallest);
}
} // namespace mesoslip

#endif
