#ifndef mesoslip_mesh_gmsh_counts_h
#define mesoslip_mesh_gmsh_counts_h

#include <string>

namespace mesoslip
{
/**
 * Compares the numbers of points and cells that the sections $Nodes and $Elements of a file of format
 * 2 or 4 tell of with what they hold. Gmsh's library writes beyond its memory where they are
 * too small, leaves cells out without a word, and cuts numbers of points to 32 bits. Other files
 * pass. @throws UserError beginning with @p file
 */
void require_gmsh_counts(const std::string &file);
} // namespace mesoslip

#endif
