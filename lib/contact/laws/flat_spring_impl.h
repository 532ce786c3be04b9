#ifndef mesoslip_contact_laws_flat_spring_impl_h
#define mesoslip_contact_laws_flat_spring_impl_h

namespace mesoslip
{
/**
 * phi / 2 of ContactFunction: how much of the earlier of the two deformations, of which a step has the mean, counts in the
 * force of a spring with the inverse stiffness @p soft (0: rigid) at a node that a unit force moves by @p yields in the
 * step. Numbers or vectors of them.
 */
template <typename T>
inline __attribute__((always_inline)) T share_of_earlier(const T soft, const T yields)
{
  // Of held nodes on a rigid flat nothing yields: free of 0/0, of no weight elsewhere.
  constexpr double smallest = 2.2250738585072014e-308;
  const T squares           = soft * soft;
  return 0.5 * squares / (squares + 0.0625 * (yields * yields) + smallest);
}

/**
 * Normal force (N, in 2D N/m) on a node that would end a step at @p gap < 0 (m) over the flat
 * without it: of a spring between them, see ContactFunction, or of the flat itself. @p earlier is the
 * compression of the spring at the start of the step before (m), @p soft the inverse of its stiffness
 * (0: none) and @p yields what a unit force moves the node in the step (both m/N, in 2D m^2/N).
 * Numbers or vectors of them.
 */
template <typename T>
inline __attribute__((always_inline)) T
force_of_flat(const T gap, const T earlier, const T soft, const T yields)
{
  constexpr double smallest = 2.2250738585072014e-308; // as above
  const T share             = share_of_earlier(soft, yields);
  return ((share - 1.) * gap + share * earlier) /
         (soft + (1. - share) * yields + smallest);
}
} // namespace mesoslip

#endif
