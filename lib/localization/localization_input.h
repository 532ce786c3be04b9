#ifndef mesoslip_localization_localization_input_h
#define mesoslip_localization_localization_input_h

#include "base/serialize_members.h"
#include "exchange/run_description.h"
#include "localization/localization_files.h"
#include "localization/strain/cell_set.h"
#include "program/output_folder.h"

#include <iosfwd>

namespace mesoslip
{
/** A probe before its series are computed, with the source of its strain. */
struct PlannedProbe : LocalizedProbe
{
  bool recorded          = false; ///< by the homogeneous run; else from snapshots
  std::uint16_t material = 0;     ///< material of its cell, see RveFile::constituents()
  ProbeSeries strain;             ///< recorded strain, if the local strain is requested
  ProbeSeries direct; ///< stress of the direct run's probe at this place; may be empty
};

/** Plan of the localization, made by rank 0 and sent to all ranks. */
template <int dim>
struct LocalizationPlan
{
  /** Whether the volume is the body; then the local strain is used. */
  bool is_body = false;

  std::vector<std::size_t> probes;        ///< cells of the probes in the volume
  std::vector<std::size_t> followed;      ///< cells of the probes that were not recorded
  std::vector<dealii::Point<dim>> points; ///< in the body (m)
  std::vector<std::size_t> point_cells;   ///< cells that hold the points
  IndexRange snapshots;                   ///< used snapshots of the homogeneous run
  IndexRange direct_snapshots;            ///< used snapshots of the direct run

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<7>(archive, *this);
  }
};

/**
 * The files of a localization after consistency checks, and the data taken from them. On
 * rank 0, which has the cells of meshes; for grids nothing grows with the number of
 * cells.
 */
template <int dim>
class LocalizationInput
{
public:
  /**
   * @throws UserError if the volume is not the body and no points are given; if the body
   * of the homogeneous run has several materials; if the direct run has different cells
   * (on grids it may refine them), materials or loads; if the window has no snapshots or
   * samples; and for unknown probes and places outside. Suspicious input is added to
   * warnings. The files must outlive this object.
   */
  LocalizationInput(const LocalizationParameters &p,
                    const LocalizationFiles<dim> &the_files);

  /** Files, snapshots, memory and disk, for --validate. */
  void describe(std::ostream &out) const;

  const LocalizationParameters parameters;      ///< input parameters
  const LocalizationFiles<dim> &files;          ///< the checked files
  const CellSet<dim> volume;                    ///< cells of the RVE file
  const CellSet<dim> body;                      ///< cells of the homogeneous run
  CellSet<dim> direct_body;                     ///< cells of the direct run
  std::vector<unsigned int> body_cell;          ///< cell of a mesh at each centroid
  TimeWindow window;                            ///< times used (s)
  std::vector<PlannedProbe> probes;             ///< requested probes
  LocalizationPlan<dim> plan;                   ///< for all ranks
  std::vector<double> times;                    ///< used snapshots (s)
  std::vector<double> direct_times;             ///< used snapshots of the direct run (s)
  std::vector<ConditionDifference> differences; ///< between the runs
  std::vector<std::string> notes;               ///< sentences for the log, no warnings
  std::vector<std::string> warnings;            ///< sentences for the log

private:
  void check_run(const BodySnapshots<dim> &run, const std::string &role);
  void check_homogeneous();
  void compare_boxes(CellFinder<dim> &in_body);
  void find_cells(CellFinder<dim> &in_body);
  void check_direct();
  void check_direct_cells(const std::string &the_run);
  void check_direct_grid(const std::string &the_run);
  void check_material(const std::uint16_t ours,
                      const std::uint16_t theirs,
                      const std::size_t cell) const;
  void choose_window();
  void choose_snapshots();

  /** @name Defined in probe_plan.cc
   * @{
   */
  void find_points(CellFinder<dim> &in_body);
  void plan_probes(CellFinder<dim> &in_volume);
  void read_probe(PlannedProbe &probe);
  dealii::Point<dim> place_in(const CellSet<dim> &cells,
                              const std::vector<double> &position) const;
  std::size_t find_place(const LocalizedProbe &asked,
                         const std::string &key,
                         const CellSet<dim> &cells,
                         CellFinder<dim> &finder) const;
  std::string direct_probe_at(const PlannedProbe &probe) const;
  /** @} */
};
} // namespace mesoslip

#endif
