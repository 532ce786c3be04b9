#ifndef mesoslip_sliding_mesh_box_body_h
#define mesoslip_sliding_mesh_box_body_h

#include "grid/brick_box.h"
#include "grid/cell_reader.h"
#include "sliding/mesh/body_mesh.h"

namespace mesoslip
{
/**
 * A 3D grid as a body with the groups Left, Right (lower and upper x), Front, Back (y),
 * Contact and Top (z). Its mesh has only the cells at the sides and near the probes.
 * Nodes and cells are numbered with x fastest, then y.
 */
class BoxBody : public BodyMesh<3>
{
public:
  BrickBox box; ///< on rank 0, after share() on all ranks

  /** Reads the materials of the cells: phases, or oriented phases. */
  CellReader materials_in;

  /** Number in the box of each mesh point, ascending. */
  std::vector<unsigned int> point_in_box;

  std::vector<unsigned int> cell_in_box; ///< number in the box of each mesh cell

  BodyMemory read(const ContactParameters &parameters,
                  const unsigned int n_here,
                  const unsigned int n_ranks) override;

  /** @throws UserError if other ranks cannot open the file of the materials */
  void share(const BodyParameters &parameters) override;

  std::vector<BoundaryFace<3>> boundary() const override
  {
    return {};
  }

  /** Faces of the mesh on side number @p group, found by position. */
  std::vector<BoundaryFace<3>> group(const std::vector<BoundaryFace<3>> &faces,
                                     const std::string &key,
                                     const unsigned int group) const override;
  double smallest_edge() const override;
  std::vector<MeshPlace> places_of(const std::vector<ProbePoint> &points) const override;

  double mass(const double of_box) const override
  {
    return of_box;
  }

  unsigned int whole_point(const unsigned int i) const override
  {
    return point_in_box[i];
  }

  unsigned int whole_cell(const unsigned int k) const override
  {
    return cell_in_box[k];
  }

  dealii::Point<3> point(const unsigned int number) const override;

  std::size_t n_points() const override
  {
    return box.grid.n_nodes();
  }

  std::size_t n_cells() const override
  {
    return box.grid.n_cells();
  }

  unsigned int most_ranks() const override
  {
    return box.grid.cells[2] / 4;
  }

  /** Partitions by layers; each part has the cells of its @p probes only. Collective.
   * @throws UserError for more ranks than layers, or if cells cannot be read */
  std::unique_ptr<DistributedBody<3>>
  distribute(const std::vector<unsigned int> &contact,
             const std::vector<MeshPlace> &probes,
             const std::vector<ElasticPhase<3>> &phases,
             const InstructionSet isa,
             const MPI_Comm communicator) const override;

  /** A GridBody<3>, partitioned by planes across z; ignores the names of contact and top.
   * Collective. */
  std::unique_ptr<PointBody<3>> make_elastic(const MeshBodyParameters &parameters,
                                             const std::string &contact,
                                             const std::string &top,
                                             const std::vector<ElasticPhase<3>> &phases,
                                             const MPI_Comm communicator,
                                             const bool whole) const override;
  /** Deformation of a GridBody<3>. Collective. */
  Deformation deformation(const PointBody<3> &elastic,
                          const NodalField<double> &u) const override;

  std::string format_ending() const override
  {
    return "";
  }

  void write_cells(Hdf5File &to) const override;
  Shape vectors_shape() const override;
  void show(const std::string &path,
            const std::vector<XdmfField> &fields,
            const std::vector<double> &times) const override;
};
} // namespace mesoslip

#endif
