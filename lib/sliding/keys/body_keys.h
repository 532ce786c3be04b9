#ifndef mesoslip_sliding_keys_body_keys_h
#define mesoslip_sliding_keys_body_keys_h

#include "sliding/contact_parameters.h"

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** Two components, in 3D three; what is left out is zero. */
void bind_vector(Keys &keys,
                 const std::string &key,
                 std::array<double, 3> &vector,
                 const unsigned int dim,
                 const std::string &meaning);

/** The constants that are given for all phases or one by one, and the largest; @p of_phases is empty where all are
 * alike. Returns how many are given. */
std::size_t bind_damping(Keys &keys,
                         const std::string &key,
                         double &largest,
                         std::vector<double> &of_phases,
                         const std::string &meaning);

/** Material, size and cells of a body, in the current section, of which there is none without a size if it @p
 * may_be_absent. @throws UserError */
void bind_material(Keys &keys,
                   BodyParameters &body,
                   MeshBodyParameters &mesh,
                   const bool may_be_absent = false);
/** Points that are observed, their names in the key Probes and their places in subsections of the open section, which is
 * @p section_of_probes. */
std::vector<ProbePoint>
bind_probes(Keys &keys, const std::string &section_of_probes, const unsigned int dim);
} // namespace mesoslip

#endif
