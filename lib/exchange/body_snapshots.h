#ifndef mesoslip_exchange_body_snapshots_h
#define mesoslip_exchange_body_snapshots_h

#include "exchange/run_description.h"
#include "io/hdf5_file.h"
#include "mesh/mesh.h"

#include <array>
#include <mpi.h>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * dynamics.h5 of a body on a grid or on a mesh, opened for reading both alike: the nodes
 * and cells of a grid are those of a mesh, x fastest. Errors name the file, the dataset
 * and what to run.
 */
template <int dim>
class BodySnapshots
{
public:
  /** @throws UserError; @p hint follows where the file is missing */
  BodySnapshots(const std::string &path, const std::string &hint);

  /** Opens for reading by all ranks of @p communicator together, see
   * Hdf5File::open_together(). Collective. @throws UserError */
  BodySnapshots(const std::string &path, const MPI_Comm communicator);

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

  /** Times of the snapshots, ascending (s). @throws UserError without any */
  std::vector<double> times() const;

  /** Displacement of all points in snapshot number @p k (m) [n_points][dim]. */
  std::vector<double> displacement(const std::size_t k) const;

  /** In which rows the file has the points: how many there are, of how many points. */
  std::array<std::size_t, 2> rows_of_points() const;

  /** Displacement of the points of @p n_rows rows from row @p first on in snapshot number @p k (m)
   * [n_points][dim]; only these are read. With ranks that have opened the file together, others
   * on each of them: collective. */
  std::vector<double> displacement(const std::size_t k,
                                   const std::size_t first,
                                   const std::size_t n_rows) const;

  /** Points and cells, with their phases as material_id, or what materials() has of them. */
  Mesh<dim> mesh() const;

  /** What the cells are made of: the phases, or these in all their orientations. */
  std::vector<Phase<dim>> materials() const;

private:
  explicit BodySnapshots(Hdf5File &&opened);

  const Hdf5File file;

public:
  const bool is_grid;           ///< whether the body is one
  const std::string digest;     ///< of what determines the content
  const std::string rve_digest; ///< of the rve.h5 of its material; empty when unknown
  const std::vector<Phase<dim>> phases; ///< by index, without friction

  /** Under what the run was made; nothing if the file does not tell. */
  const std::optional<RunConditions> conditions;
};
} // namespace mesoslip

#endif
