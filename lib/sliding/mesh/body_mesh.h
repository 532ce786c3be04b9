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
 * The mesh of a body as rank 0 has it: what its sides are, where its points lie, what files say of it. Of a
 * box of bricks, see BoxBody, it may be the mesh of some cells; here it is that of all.
 */
template <int dim>
class BodyMesh : public MeshMorphology<dim>
{
public:
  virtual ~BodyMesh() = default;

  /**
   * Reads the mesh and joins the sides that are periodic, on rank 0, whose machine has @p n_here of all @p
   * n_ranks; @p parameters are those after with_phases(). Returns what the analysis takes of memory.
   * @throws UserError naming the key or file, also when the machine has not the memory
   */
  virtual BodyMemory read(const ContactParameters &parameters,
                          const unsigned int n_here,
                          const unsigned int n_ranks);

  /** Gives the other ranks what they need to have their parts of it. Collective. */
  virtual void share(const BodyParameters & /*parameters*/)
  {
  }

  /** The phases in the orientations that cells of a box have; empty: as they are. */
  std::vector<OrientedPhase> oriented;

  /** What the cells are made of, by their numbers. */
  std::vector<Phase<dim>> materials() const
  {
    return oriented_phases(this->phases, oriented);
  }

  /** The phase of material @p m. */
  unsigned int phase_of(const unsigned int m) const
  {
    return oriented.empty() ? m : oriented[m].phase;
  }

  /** Damping by phase for materials(). */
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

  /** All faces of the boundary, unless group() needs none. */
  virtual std::vector<BoundaryFace<dim>> boundary() const
  {
    return boundary_faces(this->mesh);
  }

  /** Of the faces of the boundary() those of physical group number @p group, which @p key asks for.
   * @throws UserError if some of them are inside */
  virtual std::vector<BoundaryFace<dim>>
  group(const std::vector<BoundaryFace<dim>> &faces,
        const std::string &key,
        const unsigned int group) const;

  /** Of all cells (m). */
  virtual double smallest_edge() const;

  /** See locate_probes(). */
  virtual std::vector<MeshPlace> places_of(const std::vector<ProbePoint> &points) const
  {
    return locate_probes(this->mesh, points);
  }

  /** Mass (kg, in 2D kg/m), where that of the bounding box would be @p of_box. */
  virtual double mass(const double of_box) const;

  /** Number in the whole body of point @p i of the mesh. */
  virtual unsigned int whole_point(const unsigned int i) const
  {
    return i;
  }

  /** The same of cell @p k. */
  virtual unsigned int whole_cell(const unsigned int k) const
  {
    return k;
  }

  /** Where point @p number of the whole body is. */
  virtual dealii::Point<dim> point(const unsigned int number) const
  {
    return this->mesh.points[number];
  }

  /** Of the whole body. */
  virtual std::size_t n_points() const
  {
    return this->mesh.points.size();
  }

  /** Of the whole body. */
  virtual std::size_t n_cells() const
  {
    return this->mesh.cells.size();
  }

  /** Ranks that steps can make use of. */
  virtual unsigned int most_ranks() const
  {
    return std::numeric_limits<unsigned int>::max();
  }

  /** Divides the body among the ranks for steps: a mesh by METIS, where cells at the points of the @p contact
   * weigh more; a box by layers, with those cells that hold the @p probes. Collective.
   * @throws UserError for more ranks than layers of a box, or if its cells cannot be read */
  virtual std::unique_ptr<DistributedBody<dim>>
  distribute(const std::vector<unsigned int> &contact,
             const std::vector<MeshPlace> &probes,
             const std::vector<ElasticPhase<dim>> &phases,
             const InstructionSet isa,
             const MPI_Comm communicator) const;

  /**
   * The body for statics and modes, with fields that are divided among the ranks; or if @p whole, with
   * whole ones, and then all ranks hold the whole mesh. Groups of faces that are contact and top have these
   * names, empty where there is none. Collective.
   */
  virtual std::unique_ptr<PointBody<dim>>
  make_elastic(const MeshBodyParameters &parameters,
               const std::string &contact,
               const std::string &top,
               const std::vector<ElasticPhase<dim>> &phases,
               const MPI_Comm communicator,
               const bool whole) const;

  /** Of the cells under the displacement @p u of the @p elastic body that it made. Collective. */
  virtual Deformation deformation(const PointBody<dim> &elastic,
                                  const NodalField<double> &u) const;

  /** What is behind the name of the format of its files. */
  virtual std::string format_ending() const
  {
    return "-mesh";
  }

  /** Writes the grid or mesh and the phases of the cells. */
  virtual void write_cells(Hdf5File &file) const;

  /** Extents of a vector for each point: [points][dim], of a box [nz + 1][ny + 1][nx + 1][3]. */
  virtual Shape vectors_shape() const
  {
    return {this->mesh.points.size(), dim};
  }

  /** Writes NAME.xdmf for ParaView, if there are @p fields of the file NAME.h5 at @p path, and
   * NAME-phases.xdmf with the phases of the cells: data of nodes and of cells cannot be shown in one. */
  virtual void show(const std::string &path,
                    const std::vector<XdmfField> &fields,
                    const std::vector<double> &times) const;
};

/** The faces of the physical group @p name of @p body, which @p key asks for, of all @p faces of its
 * boundary(). @throws UserError */
template <int dim>
std::vector<BoundaryFace<dim>> group_faces(const BodyMesh<dim> &body,
                                           const std::vector<BoundaryFace<dim>> &faces,
                                           const std::string &key,
                                           const std::string &name);

/**
 * Joins the sides of the mesh that are periodic, and refuses those with points that do not
 * lie opposite. Returns a line on each pair. @throws UserError
 */
template <int dim>
std::vector<std::string> join_periodic_sides(BodyMesh<dim> &body,
                                             const MeshBodyParameters &parameters);
} // namespace mesoslip

#endif
