#ifndef mesoslip_exchange_run_file_h
#define mesoslip_exchange_run_file_h

#include "exchange/run_conditions.h"
#include "exchange/time_window.h"
#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** Strain or stress at a place over time. */
struct ProbeSeries
{
  /** s */
  std::vector<double> time;
  /** [k][3]: xx, yy, xy. */
  std::vector<double> values;
};

/**
 * dynamics.h5 of a run, opened for reading. Also of a static analysis: one snapshot is
 * enough. Errors name the file, the dataset and what to run.
 */
class RunFile
{
public:
  /** @p role, "homogeneous run", is for messages. @throws UserError */
  RunFile(const std::string &path, const std::string &role);

  /** As given. */
  const std::string &path() const
  {
    return file.path();
  }

  /** Of the body. */
  const UniformGrid<2> &grid() const
  {
    return the_grid;
  }

  /** Of what determines the content. */
  const std::string &digest() const
  {
    return the_digest;
  }

  /** Digest of the rve.h5 that the run took its material from; empty when unknown. */
  std::string rve_digest() const;

  /** Phase of each cell; empty for a homogeneous body or when not stored. */
  std::vector<std::uint8_t> phase_id() const;

  /** Under what it was made; nothing if the file is older and does not tell. */
  const std::optional<RunConditions> &conditions() const
  {
    return the_conditions;
  }

  /** A sentence if contact_dynamics did not write the file as it is; else empty. */
  std::string change_note() const
  {
    return file.change_note("contact_dynamics");
  }

  /** Ascending (s); throws when there are no snapshots. */
  std::vector<double> snapshot_times() const;

  /** False for a run without them. */
  bool has_snapshots() const
  {
    return file.exists("/snapshots/displacement");
  }

  /** Displacements (m) [count][ny + 1][nx + 1][2]. */
  std::vector<double> snapshots(const std::size_t first, const std::size_t count) const;

  /** Names of all probes. */
  std::vector<std::string> probes() const;

  /** From the lower left corner (m). */
  std::array<double, 2> probe_position(const std::string &name) const;

  /** "strain" or "stress" of a probe in the window. */
  ProbeSeries probe(const std::string &name,
                    const std::string &quantity,
                    const TimeWindow &window) const;

private:
  std::vector<double> ascending_times(const std::string &dataset,
                                      const std::string &hint) const;

  Hdf5File file;
  std::string the_digest; // of a header that was checked before the grid was read
  UniformGrid<2> the_grid;
  std::optional<RunConditions> the_conditions;
};
} // namespace mesoslip

#endif
