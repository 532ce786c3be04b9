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
/** A probe, without series yet, and where they come from. */
struct PlannedProbe : LocalizedProbe
{
  bool recorded          = false; ///< by the homogeneous run; else the snapshots are used
  std::uint16_t material = 0;     ///< of its cell, see RveFile::constituents()
  ProbeSeries strain;             ///< of a recorded probe, if its own strain is asked for
  ProbeSeries direct; ///< stress of the direct run's probe at the place; may be empty
};

/** What rank 0 tells all ranks to do. */
template <int dim>
struct LocalizationPlan
{
  /** Whether the volume is the body, so that the strain at a place counts. */
  bool is_body = false;

  std::vector<std::size_t> probes;        ///< their cells in the volume
  std::vector<std::size_t> followed;      ///< cells of the probes that were not recorded
  std::vector<dealii::Point<dim>> points; ///< of the body (m)
  std::vector<std::size_t> point_cells;   ///< that hold them
  IndexRange snapshots;                   ///< of the homogeneous run, used
  IndexRange direct_snapshots;            ///< of the direct run, used

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<7>(archive, *this);
  }
};

/**
 * The files of a localization, found to belong together, and what is taken from them. Of rank 0,
 * which has the cells of meshes, but of grids nothing that grows with their cells.
 */
template <int dim>
class LocalizationInput
{
public:
  /**
   * @throws UserError when the volume is neither the body nor asked for at points, when the
   * body of the homogeneous run has several materials, when the direct run has other cells than
   * the volume (on grids it may divide them), other materials or other loads; when there are no snapshots
   * or samples in the window, and for unknown probes and places outside. What is only
   * suspicious is added to warnings. The files must outlive it.
   */
  LocalizationInput(const LocalizationParameters &p,
                    const LocalizationFiles<dim> &the_files);

  /** Files, snapshots, memory and disk, for --validate. */
  void describe(std::ostream &out) const;

  const LocalizationParameters parameters;      ///< what is asked for
  const LocalizationFiles<dim> &files;          ///< those that belong together
  const CellSet<dim> volume;                    ///< cells of the RVE file
  const CellSet<dim> body;                      ///< cells of the homogeneous run
  CellSet<dim> direct_body;                     ///< cells of the direct run
  std::vector<unsigned int> body_cell;          ///< of a mesh that holds each centroid
  TimeWindow window;                            ///< times used (s)
  std::vector<PlannedProbe> probes;             ///< those asked for
  LocalizationPlan<dim> plan;                   ///< for all ranks
  std::vector<double> times;                    ///< of the snapshots used (s)
  std::vector<double> direct_times;             ///< of those of the direct run (s)
  std::vector<ConditionDifference> differences; ///< of the runs, homogeneous first
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

  /** @name In probe_plan.cc
   * @{ */
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
