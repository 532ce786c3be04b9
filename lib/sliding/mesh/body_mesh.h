#ifndef mesoslip_sliding_mesh_body_mesh_h
#define mesoslip_sliding_mesh_body_mesh_h

#include "body/point_body.h"
#include "dynamics/deformation.h"
#include "exchange/xdmf.h"
#include "io/hdf5_file.h"
#include "material/orientations.h"
#include "mesh/boundary.h"
#include "morphology/mesh_morphology.h"
#include "observation/mesh_probes.h"
#include "sliding/body_memory.h"
#include "sliding/mesh/distributed_body.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * The mesh of a body on rank 0: sides, points, file layout. BoxBody has a mesh of some
 * cells only; here the mesh has all cells.
 */
template <int dim>
class BodyMesh : public MeshMorphology<dim>
{
public:
  virtual ~BodyMesh() = default;

  /**
   * Reads the mesh and joins periodic sides, on rank 0, whose machine runs @p n_here of
   * all @p n_ranks; @p parameters come from with_phases().
   * @return the memory of the analysis.
   * @throws UserError naming the key or file, also if the memory is insufficient
   */
  virtual BodyMemory read(const ContactParameters &parameters,
                          const unsigned int n_here,
                          const unsigned int n_ranks);

  /** Sends the other ranks the data for their parts of the body. Collective. */
  virtual void share(const BodyParameters & /*parameters*/)
  {
  }

  /** Phases in the orientations of the cells of a box; empty: not rotated. */
  std::vector<OrientedPhase> oriented;

  /** Materials of the cells, by material number. */
  std::vector<Phase<dim>> materials() const
  {
    return oriented_phases(this->phases, oriented);
  }

  /** The phase of material @p m. */
  unsigned int phase_of(const unsigned int m) const
  {
    return oriented.empty() ? m : oriented[m].phase;
  }

  /** Expands damping by phase to damping per entry of materials(). */
  StepParameters of_materials(StepParameters step) const
  {
    for (std::vector<double> *values : {&step.beta_of_phases, &step.alpha_of_phases})
      {
        const std::vector<double> of_phases = *values;
        if (!of_phases.empty() && !oriented.empty())
          values->resize(oriented.size());
        for (std::size_t m = 0; m < values->size(); ++m)
          (*values)[m] = of_phases[phase_of(static_cast<unsigned int>(m))];
      }
    return step;
  }

  /** All boundary faces, unless group() needs none. */
  virtual std::vector<BoundaryFace<dim>> boundary() const
  {
    return boundary_faces(this->mesh);
  }

  /** Boundary @p faces of physical group number @p group, which @p key asks for.
   * @throws UserError if a face of the group is inside the body */
  virtual std::vector<BoundaryFace<dim>>
  group(const std::vector<BoundaryFace<dim>> &faces,
        const std::string &key,
        const unsigned int group) const;

  /** Shortest edge of all cells (m). */
  virtual double smallest_edge() const;

  /** Locates probes, see locate_probes(). */
  virtual std::vector<MeshPlace> places_of(const std::vector<ProbePoint> &points) const
  {
    return locate_probes(this->mesh, points);
  }

  /** Mass (kg, in 2D kg/m); @p of_box is the mass of the bounding box. */
  virtual double mass(const double of_box) const;

  /** Number of mesh point @p i in the whole body. */
  virtual unsigned int whole_point(const unsigned int i) const
  {
    return i;
  }

  /** Number of mesh cell @p k in the whole body. */
  virtual unsigned int whole_cell(const unsigned int k) const
  {
    return k;
  }

  /** Coordinates of point @p number of the whole body. */
  virtual dealii::Point<dim> point(const unsigned int number) const
  {
    return this->mesh.points[number];
  }

  /** Number of points of the whole body. */
  virtual std::size_t n_points() const
  {
    return this->mesh.points.size();
  }

  /** Number of cells of the whole body. */
  virtual std::size_t n_cells() const
  {
    return this->mesh.cells.size();
  }

  /** Largest number of ranks that time steps can use. */
  virtual unsigned int most_ranks() const
  {
    return std::numeric_limits<unsigned int>::max();
  }

  /** Partitions the body for time steps: a mesh by METIS, where cells at the points of
   * the @p contact weigh more; a box by layers, keeping only the cells of the @p probes.
   * Collective.
   * @throws UserError for more ranks than layers of a box, or if its cells cannot be
   * read */
  virtual std::unique_ptr<DistributedBody<dim>>
  distribute(const std::vector<unsigned int> &contact,
             const std::vector<MeshPlace> &probes,
             const std::vector<ElasticPhase<dim>> &phases,
             const InstructionSet isa,
             const MPI_Comm communicator) const;

  /**
   * The body for statics and modes. Fields are distributed or, if @p whole, replicated;
   * then all ranks hold the whole mesh. @p contact and @p top name the face groups,
   * empty where there is none. Collective.
   */
  virtual std::unique_ptr<PointBody<dim>>
  make_elastic(const MeshBodyParameters &parameters,
               const std::string &contact,
               const std::string &top,
               const std::vector<ElasticPhase<dim>> &phases,
               const MPI_Comm communicator,
               const bool whole) const;

  /** Strains and rotations of the cells under the displacement @p u of @p elastic, which
   * make_elastic() made. Collective. */
  virtual Deformation deformation(const PointBody<dim> &elastic,
                                  const NodalField<double> &u) const;

  /** Suffix of the format name of its files. */
  virtual std::string format_ending() const
  {
    return "-mesh";
  }

  /** Writes the grid or mesh and the phases of the cells. */
  virtual void write_cells(Hdf5File &file) const;

  /** Shape of a nodal vector field: [points][dim], for a box [nz + 1][ny + 1][nx +
   * 1][3]. */
  virtual Shape vectors_shape() const
  {
    return {this->mesh.points.size(), dim};
  }

  /** Writes NAME.xdmf for ParaView, if there are @p fields of the file NAME.h5 at
   * @p path, and NAME-phases.xdmf with the phases of the cells: ParaView cannot show
   * nodal and cell data of one file. */
  virtual void show(const std::string &path,
                    const std::vector<XdmfField> &fields,
                    const std::vector<double> &times) const;
};

/** Boundary @p faces of the physical group @p name of @p body, which @p key asks for.
 * @throws UserError */
template <int dim>
std::vector<BoundaryFace<dim>> group_faces(const BodyMesh<dim> &body,
                                           const std::vector<BoundaryFace<dim>> &faces,
                                           const std::string &key,
                                           const std::string &name);

/**
 * Joins the periodic sides of the mesh; their points have to match.
 * @return a line per pair of sides.
 * @throws UserError
 */
template <int dim>
std::vector<std::string> join_periodic_sides(BodyMesh<dim> &body,
                                             const MeshBodyParameters &parameters);
} // namespace mesoslip

#endif
