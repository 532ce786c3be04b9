#ifndef mesoslip_microstructure_image_map_h
#define mesoslip_microstructure_image_map_h

#include "grid/phase_map.h"
#include "io/image.h"

#include <string>
#include <vector>

namespace mesoslip
{
/**
 * The morphology drawn in an image; the top row of the picture is the top of the box.
 *
 * `values[p]` is the image value of phase p; with an empty list the distinct values of
 * the image in ascending order are the phases. Along each direction the pixels are the
 * cells, or one number is an integer multiple of the other: a pixel becomes a block of
 * cells, or a cell takes the pixel at its centre (of the middle two the right or upper
 * one). Throws UserError, beginning with @p source, when sizes do not fit, a value
 * belongs to no phase or there are more than @p n_phases values.
 */
PhaseMap<2> map_from_image(const UniformGrid<2> &grid,
                           const Image &image,
                           const std::vector<long> &values,
                           const unsigned int n_phases,
                           const std::string &source);

/** map_from_image() of a file: PNG or plain text, see read_image(). */
PhaseMap<2> read_phase_map(const UniformGrid<2> &grid,
                           const std::string &file,
                           const std::vector<long> &values,
                           const unsigned int n_phases);
} // namespace mesoslip

#endif
