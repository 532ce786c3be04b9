#ifndef mesoslip_sliding_profile_parameters_h
#define mesoslip_sliding_profile_parameters_h

#include "contact/flat/flat_profile.h"

#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** The height of the flat over its plane, in section Flat. */
struct ProfileParameters
{
  std::string expression;           ///< in x and, in 3D, y (m); may be empty
  std::string file;                 ///< a table or picture; may be empty
  std::vector<double> picture_size; ///< extents of a picture (m)
  double picture_height = 0.;       ///< height of white above black (m)
  bool repeats          = false;    ///< table or picture, beyond its ends

  /** Binds the keys in the current section; @p dim is the dimension of the body. */
  void bind(Keys &keys, const unsigned int dim);

  /** Makes the profile; null: the flat is even. Collective.
   * @throws UserError for a file that cannot be read */
  std::shared_ptr<const FlatProfile> make(const unsigned int dim) const;
};

/** The profile in the table at @p path: heights over x and, in 3D, y. @throws UserError */
ProfileTable::Points
read_profile_table(const std::string &path, const unsigned int dim, const bool repeats);

/** The profile in a picture: black is 0, white is @p given.picture_height; in 2D the
 * lowest row of pixels.
 * @throws UserError */
ProfileTable::Points read_profile_picture(const ProfileParameters &given,
                                          const unsigned int dim);
} // namespace mesoslip

#endif
