#ifndef mesoslip_sliding_keys_body_keys_h
#define mesoslip_sliding_keys_body_keys_h

#include "sliding/contact_parameters.h"

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** Binds a vector of two, in 3D three components; omitted components are zero. */
void bind_vector(Keys &keys,
                 const std::string &key,
                 std::array<double, 3> &vector,
                 const unsigned int dim,
                 const std::string &meaning);

/** Binds constants given for all phases or one by one; @p largest is their maximum,
 * @p of_phases is empty if all are equal.
 * @return the number of values given */
std::size_t bind_damping(Keys &keys,
                         const std::string &key,
                         double &largest,
                         std::vector<double> &of_phases,
                         const std::string &meaning);

/** Binds material, size and cells of a body in the current section. If it
 * @p may_be_absent, there is no body without a size.
 * @throws UserError */
void bind_material(Keys &keys,
                   BodyParameters &body,
                   MeshBodyParameters &mesh,
                   const bool may_be_absent = false);
/** Binds the probes: their names in the key Probes, their places in subsections of the
 * open section @p section_of_probes. */
std::vector<ProbePoint>
bind_probes(Keys &keys, const std::string &section_of_probes, const unsigned int dim);
} // namespace mesoslip

#endif
