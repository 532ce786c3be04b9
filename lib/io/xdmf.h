#ifndef mesoslip_io_xdmf_h
#define mesoslip_io_xdmf_h

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
/** The uniform grid of an XDMF file. Entries beyond dim are ignored. */
struct XdmfGrid
{
  unsigned int dim                  = 2;  ///< 2 or 3
  std::array<unsigned int, 3> cells = {}; ///< numbers along x, y, z
  std::array<double, 3> origin      = {}; ///< lower left corner (m)
  std::array<double, 3> spacing     = {}; ///< edges of a cell (m)
};

/** A dataset shown on it. */
struct XdmfField
{
  /** Where the values belong. */
  enum class Centre
  {
    node,
    cell
  };

  /** Type of the numbers in the file. */
  enum class Number
  {
    float64,
    uint8
  };

  /** Name of the field in ParaView. */
  std::string name;
  /** HDF5 file beside the XDMF file, and the dataset in it. */
  std::string file;
  std::string dataset;             ///< absolute path in the HDF5 file
  Centre centre = Centre::node;    ///< where the values belong
  Number number = Number::float64; ///< type of the numbers in the dataset
  /** Length of the last axis; 0 when there is none. */
  unsigned int components = 0;
  /** With two last axes, of a matrix a cell: the length of the very last one (components
   * counts both); otherwise 0. */
  unsigned int columns = 0;
  /** Suffixes of components that are shown one by one: "xx" for "stress_xx". */
  std::vector<std::string> component_names;
  /** Whether the first axis counts the times; otherwise the field is there always. */
  bool time_series = false;
};

/**
 * Writes a file that ParaView opens (with its "XDMF Reader", not "Xdmf3 Reader"). The
 * arrays are [time] z y x [component], as in the exchange files; @p times may be empty
 * for fields that do not change. Fields of dim components are vectors, of other numbers
 * single components "name_xx" (or "name_0"). ParaView cannot show data of nodes and of
 * cells on one plane grid: for both write two files. A plane
 * grid with data of cells is shown as a slab one cell thick.
 */
void write_xdmf(const std::string &path,
                const XdmfGrid &grid,
                const std::vector<XdmfField> &fields,
                const std::vector<double> &times = {});
} // namespace mesoslip

#endif
