#ifndef mesoslip_exchange_body_snapshots_h
#define mesoslip_exchange_body_snapshots_h

#include "exchange/run_description.h"
#include "exchange/rve/orientation_datasets.h"
#include "exchange/time_window.h"
#include "grid/cell_block.h"
#include "io/hdf5_file.h"
#include "mesh/mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * dynamics.h5 of a body on a grid or a mesh, opened for reading. Errors name the file,
 * the dataset and the program to run.
 */
template <int dim>
class BodySnapshots
{
public:
  /** Opens the file. @throws UserError; @p hint is appended if the file is missing */
  BodySnapshots(const std::string &path, const std::string &hint)
    : BodySnapshots(Hdf5File::open(path, hint))
  {
  }

  /** Opens a file that rank 0 has already opened. @throws UserError */
  static BodySnapshots open_too(const std::string &path)
  {
    return BodySnapshots(Hdf5File::open_too(path));
  }

  /** Path of the file. */
  const std::string &path() const
  {
    return file.path();
  }

  /** A warning if the file was changed after contact_dynamics wrote it; else empty. */
  std::string change_note() const
  {
    return file.change_note("contact_dynamics");
  }

  /** Whether the file contains snapshots. */
  bool has_snapshots() const;

  /** Times of the snapshots, ascending (s). @throws UserError if there are none */
  std::vector<double> times() const;

  /** Number of points of a mesh. */
  std::size_t n_points() const;

  /**
   * Displacement of @p count points of a mesh, from number @p first on, in snapshot @p k
   * (m) [count][dim]. Reads only these values.
   */
  std::vector<double> displacement(const std::size_t k,
                                   const std::size_t first,
                                   const std::size_t count) const;

  /**
   * Displacement of the nodes of a block of grid cells in some snapshots (m)
   * [snapshot][n_nodes][dim]. Reads only these values.
   */
  std::vector<double> displacement(const IndexRange &snapshots,
                                   const CellBlock<dim> &block) const;

  /** Points and cells of a mesh. @throws UserError */
  Mesh<dim> mesh() const;

  /** Materials of the cells: the phases, or all pairs of phase and orientation. */
  std::vector<Phase<dim>> constituents() const
  {
    return oriented_phases(phases, materials.oriented);
  }

  /**
   * Index into constituents() of @p count cells from number @p first on. @throws
   * UserError
   */
  std::vector<std::uint16_t> constituent_ids(const std::size_t first,
                                             const std::size_t count) const;

  /** Names of the recorded probes. */
  std::vector<std::string> probes() const;

  /**
   * Position of a probe (m): on a grid from the lower left corner, on a mesh in its
   * coordinates.
   */
  std::vector<double> probe_position(const std::string &name) const;

  /** "strain" or "stress" of a probe within the window. @throws UserError */
  ProbeSeries probe(const std::string &name,
                    const std::string &quantity,
                    const TimeWindow &window) const;

private:
  explicit BodySnapshots(Hdf5File &&opened);
  std::vector<double> ascending_times(const std::string &dataset,
                                      const std::string &hint) const;
  void require_sizes(const Shape &cells, const Shape &displacement) const;

  Hdf5File file;

public:
  const bool is_grid;                   ///< whether the body is a grid
  const std::string digest;             ///< digest of all inputs of the file
  const std::string rve_digest;         ///< digest of the material's rve.h5; or empty
  const std::vector<Phase<dim>> phases; ///< phases by index, without friction
  const CellMaterials materials;        ///< phase and orientation of each cell
  const UniformGrid<dim> grid;          ///< grid of the cells, if is_grid

  /** Conditions of the run; empty if the file does not have them. */
  const std::optional<RunConditions> conditions;
};
} // namespace mesoslip

#endif
