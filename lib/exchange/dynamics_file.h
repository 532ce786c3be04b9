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

/** Values [rows][columns][components] of a nodal field. */
std::vector<double> interleaved(const NodalField<double> &u);

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

  /**
   * Opens the file of a run that goes on after @p n_snapshots snapshots, without what was
   * observed when it was stopped. @throws UserError if it has fewer of them
   */
  static DynamicsFile resume(const std::string &path, const std::size_t n_snapshots);

  /** Opens for reading. @p hint follows where the file is missing. @throws UserError */
  static DynamicsFile open(const std::string &path, const std::string &hint);

  /**
   * @name Writing
   * @{
   */
  /** Makes place for @p n snapshots, or cuts the place off behind them. */
  void reserve_snapshots(const std::size_t n);

  /** Writes the displacement @p u (m) as snapshot number @p k. */
  void write_snapshot(const std::size_t k, const NodalField<double> &u);

  /** Writes the times (s) of all snapshots, and `NAME.xdmf` if there are any. */
  void complete_snapshots(const std::vector<double> &times);

  /**
   * Shows series of nodes in `NAME.xdmf`, and the phases of a heterogeneous body in
   * `NAME-phases.xdmf`, as ParaView cannot read vectors and cell data from one plane grid.
   */
  void show(const std::vector<XdmfField> &series, const std::vector<double> &times) const;
  /** @} */

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

  Shape snapshot_shape(const std::size_t n) const;
};
} // namespace mesoslip

#endif
