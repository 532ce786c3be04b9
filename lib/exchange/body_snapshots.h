#ifndef mesoslip_exchange_body_snapshots_h
#define mesoslip_exchange_body_snapshots_h

#include "exchange/orientation_datasets.h"
#include "exchange/run_description.h"
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
 * dynamics.h5 of a body on a grid or on a mesh, opened for reading. Errors name the file,
 * the dataset and what to run.
 */
template <int dim>
class BodySnapshots
{
public:
  /** @throws UserError; @p hint follows where the file is missing */
  BodySnapshots(const std::string &path, const std::string &hint)
    : BodySnapshots(Hdf5File::open(path, hint))
  {
  }

  /** Opens what rank 0 has opened. @throws UserError */
  static BodySnapshots open_too(const std::string &path)
  {
    return BodySnapshots(Hdf5File::open_too(path));
  }

  /** The path given. */
  const std::string &path() const
  {
    return file.path();
  }

  /** A sentence if contact_dynamics did not write the file as it is; else empty. */
  std::string change_note() const
  {
    return file.change_note("contact_dynamics");
  }

  /** False for a run without snapshots. */
  bool has_snapshots() const;

  /** Times of the snapshots, ascending (s). @throws UserError without any */
  std::vector<double> times() const;

  /** Points of a mesh. */
  std::size_t n_points() const;

  /** Displacement of @p count points of a mesh from number @p first on in snapshot number @p k (m)
   * [count][dim]; nothing else is read. */
  std::vector<double> displacement(const std::size_t k,
                                   const std::size_t first,
                                   const std::size_t count) const;

  /** Displacement of the nodes of a block of the cells of a grid in some snapshots (m)
   * [snapshot][n_nodes][dim]; nothing else is read. */
  std::vector<double> displacement(const IndexRange &snapshots,
                                   const CellBlock<dim> &block) const;

  /** Points and cells of a mesh. @throws UserError */
  Mesh<dim> mesh() const;

  /** What the cells are made of: the phases, or these in all their orientations. */
  std::vector<Phase<dim>> constituents() const
  {
    return oriented_phases(phases, materials.oriented);
  }

  /** Which of the constituents @p count cells from number @p first on are made of. @throws
   * UserError */
  std::vector<std::uint16_t> constituent_ids(const std::size_t first,
                                             const std::size_t count) const;

  /** Names of the probes that the run has recorded. */
  std::vector<std::string> probes() const;

  /** Of such a probe: on a grid from the lower left corner, on a mesh in its coordinates (m). */
  std::vector<double> probe_position(const std::string &name) const;

  /** "strain" or "stress" of a probe in the window. @throws UserError */
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
  const bool is_grid;           ///< whether the body is one
  const std::string digest;     ///< of what determines the content
  const std::string rve_digest; ///< of the rve.h5 of its material; empty when unknown
  const std::vector<Phase<dim>> phases; ///< by index, without friction
  const CellMaterials materials;        ///< which phase, in which orientation, cells are
  const UniformGrid<dim> grid;          ///< the cells, if the body is a grid

  /** Under what the run was made; nothing if the file does not tell. */
  const std::optional<RunConditions> conditions;
};
} // namespace mesoslip

#endif
