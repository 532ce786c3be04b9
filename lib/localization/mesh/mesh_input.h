#ifndef mesoslip_localization_mesh_mesh_input_h
#define mesoslip_localization_mesh_mesh_input_h

#include "base/serialize_members.h"
#include "localization/localization_input.h"
#include "localization/mesh/cell_set.h"

#include <iosfwd>
#include <memory>

namespace mesoslip
{
/** The files of a localization, which every rank opens. */
template <int dim>
struct LocalizationFiles
{
  /** On rank 0, whose checksums count, or on another one once rank 0 has opened them. @throws
   * UserError */
  LocalizationFiles(const LocalizationParameters &p, const bool is_root);

  /** Extents of a field of the volume: [ny][nx], [nz][ny][nx] or, of a mesh, [n]. */
  const Shape &shape() const
  {
    return rve.materials.shape;
  }

  /** Cells in a row of the first axis. */
  std::size_t cells_in_row() const;

  /** The first row of the cells of the volume that rank @p r of @p n_ranks has. */
  std::size_t first_row(const std::size_t r, const std::size_t n_ranks) const
  {
    return r * shape()[0] / n_ranks;
  }

  /** The first of these cells. */
  std::size_t first_cell(const std::size_t r, const std::size_t n_ranks) const
  {
    return first_row(r, n_ranks) * cells_in_row();
  }

  RveFile<dim> rve;                           ///< stiffnesses, tensors
  BodySnapshots<dim> homogeneous;             ///< run whose strains are localized
  std::unique_ptr<BodySnapshots<dim>> direct; ///< run to compare with, or null
};

/** What rank 0 tells all ranks to do. */
template <int dim>
struct LocalizationPlan
{
  bool is_body =
    false; ///< whether the volume is the body, so that the strain at a place counts
  std::vector<std::size_t> probes;        ///< their cells in the volume
  std::vector<dealii::Point<dim>> points; ///< of the body (m)
  std::vector<std::size_t> point_cells;   ///< that hold them
  IndexRange snapshots;                   ///< of the homogeneous run, used
  IndexRange direct_snapshots;            ///< of the direct run, used
  std::vector<double> times;              ///< of the snapshots used (s)
  std::vector<double> direct_times;       ///< of those of the direct run (s)

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<8>(archive, *this);
  }
};

/**
 * The files of a localization in which the volume or the body is a mesh or three-dimensional, or
 * the body is larger than the volume, found to belong together. Of rank 0, which has
 * the cells of meshes, but of grids nothing that grows with their cells.
 */
template <int dim>
class MeshLocalizationInput
{
public:
  /**
   * @throws UserError when the volume is neither the body nor asked for at points, when
   * the body of the homogeneous run has several materials, the direct run has other cells
   * than the volume, there are no snapshots in the window, or a place lies outside. What
   * is only suspicious is added to warnings. The files must outlive it.
   */
  MeshLocalizationInput(const LocalizationParameters &p,
                        const LocalizationFiles<dim> &the_files);

  /** Files, snapshots, memory and disk, for --validate. */
  void describe(std::ostream &out) const;

  /** What localization.h5 takes. */
  ResourceNeed need() const;

  const LocalizationParameters parameters;      ///< what is asked for
  const LocalizationFiles<dim> &files;          ///< those that belong together
  const CellSet<dim> volume;                    ///< cells of the RVE file
  const CellSet<dim> body;                      ///< cells of the homogeneous run
  CellSet<dim> direct_body;                     ///< cells of the direct run
  std::vector<unsigned int> body_cell;          ///< of a mesh that holds each centroid
  std::vector<LocalizedProbe> probes;           ///< in the volume, without series
  LocalizationPlan<dim> plan;                   ///< for all ranks
  std::vector<ConditionDifference> differences; ///< of the runs
  std::vector<std::string> notes;               ///< sentences for the log, no warnings
  std::vector<std::string> warnings;            ///< sentences for the log

private:
  void check_homogeneous();
  void check_direct();
  void compare_boxes();
  void find_cells();
  void find_places();
  void choose_snapshots();
  template <typename Treat>
  void for_cells(const BodySnapshots<dim> *run, const Treat &treat) const;
};
} // namespace mesoslip

#endif
