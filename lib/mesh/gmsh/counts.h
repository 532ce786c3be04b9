#ifndef mesoslip_mesh_gmsh_counts_h
#define mesoslip_mesh_gmsh_counts_h

#include <string>

namespace mesoslip
{
/**
 * Compares the counts of points and cells stated in the sections $Nodes and $Elements of
 * a file of format 2 or 4 with their content. If the counts are too small, Gmsh's
 * library writes beyond its memory; it also drops cells silently and truncates point
 * numbers to 32 bits. Other files pass.
 * @throws UserError beginning with @p file
 */
void require_gmsh_counts(const std::string &file);
} // namespace mesoslip

#endif
