#ifndef mesoslip_body_brick_body_h
#define mesoslip_body_brick_body_h

#include "body/point_body.h"
#include "grid/brick_box.h"
#include "grid/cell_planes.h"
#include "grid/cell_reader.h"
#include "statics/voxel/stiffness.h"

#include <memory>
#include <vector>

namespace mesoslip
{
template <int dim>
class GridBody;

/**
 * The body on a box of equal bricks: products by the kernels of voxels, solves by BrickSolver. Its
 * points are numbered with x fastest, those at the upper ends of periodic axes included. Fields are
 * divided among the ranks by planes across z, or whole; of fewer than two planes a rank they are
 * whole, and each rank solves alone.
 */
template <>
class GridBody<3> final : public PointBody<3>
{
public:
  /** Cells have the numbers in @p phases that @p materials gives for them. With @p whole fields these
   * are ordered as the points are. Collective over @p communicator. @throws UserError if cells cannot
   * be read */
  GridBody(const BrickBox &box,
           const CellReader &materials,
           const std::vector<ElasticPhase<3>> &phases,
           const MPI_Comm communicator,
           const bool whole = false);

  /** The planes of cells above the planes of points that are this rank's. */
  PlaneRange cell_planes() const;

  /** Copies the displacements or forces of own planes; ghosts are set. Collective. */
  void to_voxels(const NodalField<double> &field, voxel::VoxelField<double> &to) const;

  /** Takes those of all its points from @p field, whose ghosts are set. */
  void from_voxels(const voxel::VoxelField<double> &field, NodalField<double> &to) const;

  /** Products in units of it. */
  const voxel::Stiffness &stiffness() const
  {
    return *K;
  }

  /** N/m, of stiffness(). */
  double unit_stiffness() const
  {
    return K->modulus * K->length;
  }

  /** Numbers in fields of voxels of a node along the axes, if its plane is this rank's. */
  std::optional<std::array<unsigned int, 3>> voxel_node(const NodeIndex &node) const;

  std::optional<NodeIndex> find(const unsigned int number) const override;
  std::uint64_t number(const NodeIndex &node) const override;
  void copy_duplicates(NodalField<double> &field) const override;
  using ElasticBody<3>::copy_duplicates;
  std::array<double, 3> point(const NodeIndex &node) const override;
  std::vector<double> mass_of_cells() const override;
  std::size_t n_cell_groups() const override;
  void evaluate(const NodalField<double> &u,
                const std::size_t group,
                Cells &cells) const override;
  void multiply(NodalField<double> &Ku, const NodalField<double> &u) const override;
  std::vector<MatrixEntry> stiffness_entries() const override;
  std::unique_ptr<StaticSolver> make_solver() const override;
  std::unique_ptr<ElasticBody<3>> make_periodic() const override;

private:
  using Place = std::array<unsigned int, 3>; ///< numbers along the axes

  GridBody(const BrickBox &box,
           const CellReader &materials,
           const std::vector<ElasticPhase<3>> &phases,
           const MPI_Comm communicator,
           const bool whole,
           std::unique_ptr<const voxel::Stiffness> stiffness);

  void number_points();
  void set_sides();
  bool is_original(const Place &at) const;
  Place place_of(const unsigned int point) const;
  unsigned int point_at(const Place &at) const;
  unsigned int phase_beside(const Place &node, const unsigned int corner) const;
  NodeIndex node_at(const Place &at) const;

  const BrickBox box;
  const CellReader materials;
  const MPI_Comm ranks;
  const bool is_whole; ///< fields are, as that was asked for or there are few planes
  const std::unique_ptr<const voxel::Stiffness> K;
  const unsigned int first_plane;    ///< of the points of this rank
  std::vector<unsigned int> points;  ///< number in the box of the point of each node
  std::vector<unsigned int> node_of; ///< node of each point from that plane on
  mutable voxel::VoxelField<double> input, output; ///< fields that multiply() works with
  mutable voxel::VoxelField<float> rounded; ///< the same, which kernels write as well
};
} // namespace mesoslip

#endif
