#ifndef mesoslip_localization_mesh_mesh_input_h
#define mesoslip_localization_mesh_mesh_input_h

#include "exchange/body_snapshots.h"
#include "localization/localization_input.h"

#include <deal.II/base/bounding_box.h>

#include <iosfwd>
#include <memory>

namespace mesoslip
{
/**
 * The files of a localization in which the volume or the body is a mesh, or the body is
 * larger than the volume, opened and found to belong together. Of rank 0.
 */
template <int dim>
class MeshLocalizationInput
{
public:
  /**
   * @throws UserError when the volume is neither the body nor asked for at points, when
   * the body of the homogeneous run has several materials, the direct run has other cells
   * than the volume, there are no snapshots in the window, or a place lies outside. What
   * is only suspicious is added to warnings.
   */
  explicit MeshLocalizationInput(const LocalizationParameters &p);

  /** Files, snapshots, memory and disk, for --validate. */
  void describe(std::ostream &out) const;

  /** What localization.h5 takes. */
  ResourceNeed need() const;

  /** Whether the body is the volume, so that the strain at a place counts there. */
  bool is_body() const
  {
    return body_cell.size() == volume.cells.size();
  }

  /** What cell @p k of the volume is made of, of the materials. */
  unsigned int material_of(const std::size_t k) const
  {
    return orientations.empty() ? volume.cells[k].material_id : orientations.id[k];
  }

  /** The first of the cells of the volume that rank @p r of @p n_ranks has. */
  std::size_t first_cell(const std::size_t r, const std::size_t n_ranks) const
  {
    return r * volume.cells.size() / n_ranks;
  }

  /** A place in the body or the volume that is asked for. */
  struct Place
  {
    LocalizedProbe probe;  ///< name, position, and in the volume cell and phase
    dealii::Point<dim> at; ///< its position
    unsigned int cell = 0; ///< that holds it: of the body for points, else of the volume
  };

  const LocalizationParameters parameters;      ///< what is asked for
  const RveFile<dim> rve;                       ///< stiffnesses, tensors
  const BodySnapshots<dim> homogeneous;         ///< run whose strains are localized
  std::unique_ptr<BodySnapshots<dim>> direct;   ///< run to compare with, or null
  const Mesh<dim> volume;                       ///< cells of the RVE file, with phases
  const Orientations orientations;              ///< of these cells
  const std::vector<Phase<dim>> materials;      ///< phases in their orientations
  const Mesh<dim> body;                         ///< cells of the homogeneous run
  Mesh<dim> direct_body;                        ///< cells of the direct run
  std::vector<dealii::Point<dim>> centroids;    ///< of the volume's cells (m)
  std::vector<double> measures;                 ///< of the volume's cells (m^dim)
  std::vector<double> out_of_plane_ratio;       ///< by phase
  std::vector<unsigned int> body_cell;          ///< that holds each centroid
  std::vector<Place> probes;                    ///< in the volume
  std::vector<Place> points;                    ///< in the body
  TimeWindow window;                            ///< times used (s)
  IndexRange snapshots;                         ///< of the homogeneous run, used
  IndexRange direct_snapshots;                  ///< of the direct run, used
  std::vector<double> times;                    ///< of the snapshots used (s)
  std::vector<double> direct_times;             ///< of those of the direct run (s)
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
};
} // namespace mesoslip

#endif
