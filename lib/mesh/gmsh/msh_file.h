#ifndef mesoslip_mesh_gmsh_msh_file_h
#define mesoslip_mesh_gmsh_msh_file_h

#include <array>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * What a file .msh of Gmsh says of points, elements and physical groups. It is read value by
 * value, so that nothing of the file but this is ever in memory.
 */
struct MshFile
{
  /** Elements of one kind in one part of the geometry, in the order of Gmsh's lists. */
  struct Block
  {
    int dim    = 0; ///< of the elements
    int group  = 0; ///< physical group, 0: none
    int entity = 0; ///< part of the geometry
    int type   = 0; ///< Gmsh's number of the kind

    /** In the order of the members. */
    bool operator<(const Block &other) const;
  };

  /** Corners of the elements, one element after the other, as indices of points. */
  std::map<Block, std::deque<unsigned int>> blocks;

  /** Of the physical groups that have one, by dimension and number. */
  std::map<std::array<int, 2>, std::string> names;

  std::vector<std::size_t> tags;   ///< of the points
  std::vector<double> coordinates; ///< three a point, in units of the file
};

/**
 * Reads a file of format 4.1 or 2.2, as text or binary, but for elements of fewer dimensions
 * than @p lowest_dim. See "MSH file format" in Gmsh's manual; sections that are not of use here
 * are skipped.
 * @throws UserError naming the file if it is of another format, ends too early, has elements
 * of other kinds than those above, or a part of its geometry in two groups
 */
MshFile read_msh(const std::string &file, const int lowest_dim);
} // namespace mesoslip

#endif
