#ifndef mesoslip_exchange_dynamics_file_h
#define mesoslip_exchange_dynamics_file_h

#include "exchange/run_description.h"
#include "exchange/xdmf.h"
#include "grid/nodal_field.h"
#include "io/hdf5_file.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
/** Extents of a displacement of the nodes: [ny + 1][nx + 1][2]. */
Shape nodes_shape(const UniformGrid<2> &grid);

/** Shows @p series of nodes of the file at @p path in `NAME.xdmf`, and if it @p has_phases those of the cells in
 * `NAME-phases.xdmf`, as ParaView cannot read vectors and cell data from one plane grid. */
void show_grid(const std::string &path,
               const UniformGrid<2> &grid,
               const bool has_phases,
               const std::vector<XdmfField> &series,
               const std::vector<double> &times);

/** Values [rows][columns][components] of rows @p begin to @p end of a nodal field. */
std::vector<double> interleaved(const NodalField<double> &u,
                                const unsigned int begin,
                                const unsigned int end);

/** The same of all rows. */
inline std::vector<double> interleaved(const NodalField<double> &u)
{
  return interleaved(u, 0, u.n_rows());
}

/**
 * dynamics.h5 of a transient run or a static contact analysis (one snapshot), and modal.h5,
 * which begins as they do; opened for writing or reading. Errors name the file, the dataset
 * and what to run.
 */
class DynamicsFile : public Hdf5File
{
public:
  /** Begins a file with header, /grid and /material. */
  static DynamicsFile create(const std::string &path,
                             const BodyDescription &body,
                             const std::string &format = "mesoslip-dynamics");

  /** Opens for reading. @p hint follows where the file is missing. @throws UserError */
  static DynamicsFile open(const std::string &path, const std::string &hint);

  /**
   * @name Reading
   * @{
   */
  /** Digest of the rve.h5 that the run took its material from; empty when unknown. */
  std::string rve_digest() const;

  /** Phase of each cell; empty for a homogeneous body or when not stored. */
  std::vector<std::uint8_t> phase_id() const;

  /** Everything on a heterogeneous body but the phases' friction. @throws UserError */
  BodyDescription heterogeneous_body() const;

  /** A sentence if contact_dynamics did not write the file as it is; else empty. */
  std::string change_note() const
  {
    return Hdf5File::change_note("contact_dynamics");
  }
  /** @} */

  std::string digest;  ///< of what determines the content
  UniformGrid<2> grid; ///< the cells of the body: number, size and origin (m)

  /** Under what the run was made; nothing if the file is older and does not tell. */
  std::optional<RunConditions> conditions;

private:
  explicit DynamicsFile(Hdf5File &&file)
    : Hdf5File(std::move(file))
  {
  }
};
} // namespace mesoslip

#endif
