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
 * The body on a box of equal bricks: products by the voxel kernels, solves by
 * BrickSolver. Points are numbered with x fastest, including the points at the upper ends
 * of periodic axes. Fields are distributed over the ranks by planes across z, or
 * replicated. With fewer than two planes per rank they are replicated and each rank
 * solves alone.
 */
template <>
class GridBody<3> final : public PointBody<3>
{
public:
  /**
   * @p materials gives each cell its index into @p phases. With @p whole, fields are
   * replicated and ordered like the points. Collective over @p communicator. @throws
   * UserError if cells cannot be read
   */
  GridBody(const BrickBox &box,
           const CellReader &materials,
           const std::vector<ElasticPhase<3>> &phases,
           const MPI_Comm communicator,
           const bool whole = false);

  /** Planes of cells directly above the planes of points of this rank. */
  PlaneRange cell_planes() const;

  /**
   * Copies displacements or forces of the planes of this rank; updates ghost values.
   * Collective.
   */
  void to_voxels(const NodalField<double> &field, voxel::VoxelField<double> &to) const;

  /** Copies the values of all local points from @p field, whose ghost values are set. */
  void from_voxels(const voxel::VoxelField<double> &field, NodalField<double> &to) const;

  /** Stiffness of the voxel kernels, whose products are dimensionless. */
  const voxel::Stiffness &stiffness() const
  {
    return *K;
  }

  /** Unit of products by stiffness() (N/m). */
  double unit_stiffness() const
  {
    return K->modulus * K->length;
  }

  /**
   * Indices along the axes of @p node in voxel fields; empty if its plane is not on this
   * rank.
   */
  std::optional<std::array<unsigned int, 3>> voxel_node(const NodeIndex &node) const;

  std::optional<NodeIndex> find(const unsigned int number) const override;
  std::uint64_t number(const NodeIndex &node) const override;
  void update_copies(NodalField<double> &field) const override;
  using ElasticBody<3>::update_copies;
  std::array<double, 3> point(const NodeIndex &node) const override;
  std::vector<double> mass_of_cells() const override;
  std::size_t n_cell_groups() const override;
  void evaluate(const NodalField<double> &u,
                const std::size_t group,
                Cells &cells) const override;
  std::vector<VoigtMatrix<3>> strain_products(const NodalField<double> &u) const override;
  void multiply(NodalField<double> &Ku, const NodalField<double> &u) const override;
  std::vector<MatrixEntry> stiffness_entries() const override;
  std::unique_ptr<StaticSolver> make_solver() const override;
  std::unique_ptr<ElasticBody<3>> make_periodic() const override;

private:
  using Place = std::array<unsigned int, 3>; ///< indices along the axes

  GridBody(const BrickBox &box,
           const CellReader &materials,
           const std::vector<ElasticPhase<3>> &phases,
           const MPI_Comm communicator,
           const bool whole,
           std::unique_ptr<const voxel::Stiffness> stiffness);

  void number_points();
  void set_sides();
  bool is_master(const Place &at) const;
  Place place_of(const unsigned int point) const;
  unsigned int point_at(const Place &at) const;
  unsigned int phase_beside(const Place &node, const unsigned int corner) const;
  NodeIndex node_at(const Place &at) const;

  const BrickBox box;
  const CellReader materials;
  const MPI_Comm ranks;
  const bool is_whole; ///< whether fields are replicated: requested, or too few planes
  const std::unique_ptr<const voxel::Stiffness> K;
  const unsigned int first_plane;    ///< first plane of points of this rank
  std::vector<unsigned int> points;  ///< point number in the box of each node
  std::vector<unsigned int> node_of; ///< node of each point from first_plane on
  mutable voxel::VoxelField<double> input, output; ///< work fields of multiply()
  mutable voxel::VoxelField<float> rounded;        ///< work field in single precision
};
} // namespace mesoslip

#endif
