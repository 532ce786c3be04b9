#ifndef mesoslip_sliding_body_grid_h
#define mesoslip_sliding_body_grid_h

#include "exchange/rve_file.h"
#include "sliding/contact_parameters.h"

#include <cstdint>
#include <vector>

namespace mesoslip
{
/** The phase of Body/Stiffness and Density. @throws UserError */
template <int dim>
Phase<dim> given_phase(const BodyParameters &body);

/**
 * The cells of the body: Body/Cells and Size or, if these are empty, the cells of @p rve
 * (null without a file).
 * @throws UserError if the body is not the volume of the file, unless it is homogeneous
 * and larger
 */
template <int dim>
UniformGrid<dim> make_grid(const BodyParameters &body, const RveFile<dim> *rve);

/** Constituent number of each cell of @p block of @p grid, x fastest; each cell lies in
 * one cell of the volume. @p section is the .prm section of the body.
 * @throws UserError unless the numbers of cells are multiples of those of the volume, or
 * if the file cannot be read */
template <int dim>
std::vector<std::uint16_t> constituents_in(const std::string &section,
                                           const RveFile<dim> &rve,
                                           const UniformGrid<dim> &grid,
                                           const CellBlock<dim> &block);

/** @throws UserError naming a phase without density */
template <int dim>
void require_densities(const RveFile<dim> &rve);
} // namespace mesoslip

#endif
