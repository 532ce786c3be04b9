#ifndef mesoslip_mesh_gmsh_content_h
#define mesoslip_mesh_gmsh_content_h

#include <cstddef>
#include <string>
#include <vector>

namespace mesoslip
{
/** Cells of one kind and physical group. */
struct GmshCells
{
  unsigned int group    = 0; ///< number of its name
  std::size_t n_corners = 0; ///< number of corners of each cell
  std::vector<unsigned int>
    tags; ///< of the nodes of all cells: corners as deal.II orders them, then middles

  /** Of a quadratic cell the corners of each edge, face or cell that a further node is in the middle of. */
  std::vector<std::vector<unsigned int>> middles;

  /** Number of nodes of each cell: corners and middles. */
  std::size_t n_nodes() const
  {
    return n_corners + middles.size();
  }
};

/**
 * What a .msh file holds, in as little memory as it takes, without the library's own copy,
 * which is several times as large.
 */
class GmshContent
{
public:
  /**
   * Reads @p file with the Gmsh library: cells of dimension @p dim and an order up to @p max_order, 1 or 2, which all
   * have to be in a physical group, and faces that are in one.
   *
   * @throws UserError
   */
  GmshContent(const std::string &file, unsigned int dim, int max_order);

  /** Of the point with a tag among all points. */
  unsigned int place_of(unsigned int tag) const;

  std::string file;                    ///< its name
  std::vector<std::size_t> point_tags; ///< of all points
  std::vector<double> coordinates;     ///< three a point, in units of the file
  std::vector<GmshCells> cells;        ///< of dimension dim
  std::vector<GmshCells> faces;        ///< of dimension dim - 1
  std::vector<std::string> phases;     ///< names of the groups of cells
  std::vector<std::string> boundaries; ///< names of the groups of faces

private:
  std::vector<unsigned int> by_tag; ///< places of the points, sorted by their tags
};

/** How many there are. */
std::size_t count(const std::vector<GmshCells> &cells);
} // namespace mesoslip

#endif
