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
    tags; ///< nodes of all cells: corners in deal.II's order, then middles

  /** For a quadratic cell: for each further node the corners of the edge, face or cell
   * whose middle it is. */
  std::vector<std::vector<unsigned int>> middles;

  /** Nodes per cell: corners and middles. */
  std::size_t n_nodes() const
  {
    return n_corners + middles.size();
  }
};

/**
 * Content of a .msh file in compact form; the library's own copy is several times as
 * large.
 */
class GmshContent
{
public:
  /**
   * Reads @p file with the Gmsh library: cells of dimension @p dim up to order
   * @p max_order (1 or 2), which all have to be in a physical group, and the faces in
   * groups.
   * @throws UserError
   */
  GmshContent(const std::string &file, unsigned int dim, int max_order);

  /** Index of the point with a tag. */
  unsigned int place_of(unsigned int tag) const;

  std::string file;                    ///< path of the file
  std::vector<std::size_t> point_tags; ///< tag of each point
  std::vector<double> coordinates;     ///< three per point, in units of the file
  std::vector<GmshCells> cells;        ///< dimension dim
  std::vector<GmshCells> faces;        ///< dimension dim - 1
  std::vector<std::string> phases;     ///< names of the cell groups
  std::vector<std::string> boundaries; ///< names of the face groups

private:
  std::vector<unsigned int> by_tag; ///< indices of the points, sorted by tag
};

/** Total number of cells. */
std::size_t count(const std::vector<GmshCells> &cells);
} // namespace mesoslip

#endif
