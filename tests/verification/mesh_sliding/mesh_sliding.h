#ifndef mesoslip_tests_verification_mesh_sliding_h
#define mesoslip_tests_verification_mesh_sliding_h

#include "../sliding/sliding_body.h"
#include "exchange/mesh_datasets.h"
#include "mesh/boundary.h"
#include "mesh/mesh_part.h"
#include "mesh/periodic_points.h"
#include "mesh_of_triangulation.h"
#include "sliding/mesh/sliding_mesh.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <vector>

namespace verification
{
/** What the cells of a brick are. */
struct Cells
{
  bool simplices = false; ///< instead of quadrilaterals and hexahedra
  double shift   = 0.;    ///< of inner points, as a part of the cell before it is cut
};

/** A brick of equal cells from the origin on, or one of cut or distorted ones. */
template <int dim>
Mesh<dim> brick(const std::array<unsigned int, dim> &n,
                const std::array<double, dim> &size,
                const Cells &kind = {})
{
  dealii::Triangulation<dim> tria, simplex;
  dealii::Point<dim> corner;
  for (unsigned int d = 0; d < dim; ++d)
    corner[d] = size[d];
  dealii::GridGenerator::subdivided_hyper_rectangle(
    tria, std::vector<unsigned int>(n.begin(), n.end()), dealii::Point<dim>(), corner);
  if (kind.simplices)
    dealii::GridGenerator::convert_hypercube_to_simplex_mesh(tria, simplex);
  Mesh<dim> mesh;
  take_cells(mesh, kind.simplices ? simplex : tria);
  std::mt19937 generator(3);
  std::uniform_real_distribution<> random(-kind.shift, kind.shift);
  for (auto &p : mesh.points)
    {
      bool inside = true;
      for (unsigned int d = 0; d < dim; ++d)
        inside = inside && p[d] > 1e-9 * size[d] && p[d] < (1. - 1e-9) * size[d];
      for (unsigned int d = 0; d < dim && inside; ++d)
        p[d] += random(generator) * size[d] / n[d];
    }
  for (auto &cell : mesh.cells)
    cell.material_id = 0;
  return mesh;
}

/** A mesh with all that makes it a body on the flat. */
template <int dim>
struct MeshCase
{
  Mesh<dim> mesh;
  std::vector<ElasticPhase<dim>> phases;
  SlidingSetup setup;
  double friction = 0.;
  std::vector<HeldComponent> held;
  std::map<unsigned int, MeshBoundary>
    sides;                          ///< of a box that does not lie along the axes
  std::optional<BrickBox> box = {}; ///< the cells as bricks, if they are to be that

  /** The boundary on a side of the box, numbered as deal.II does. */
  MeshBoundary side(const unsigned int number) const
  {
    if (const auto known = sides.find(number); known != sides.end())
      return known->second;
    return mesh_boundary(mesh, faces_of_box(mesh, boundary_faces(mesh))[number]);
  }

  /** Makes it periodic along @p axis. */
  void join(const unsigned int axis)
  {
    const auto faces = faces_of_box(mesh, boundary_faces(mesh));
    join_sides(mesh, faces[2 * axis], faces[2 * axis + 1], axis, 1e-6);
    if (box)
      box->periodic[axis] = true;
  }

  void hold(const unsigned int side_number, const unsigned int component)
  {
    for (const unsigned int p : side(side_number).points)
      held.push_back({p, component});
  }
};

/** A box of equal bricks from the origin on, with edges @p h. */
inline MeshCase<3> box_of_bricks(const std::array<unsigned int, 3> &n,
                                 const std::array<double, 3> &h)
{
  MeshCase<3> c;
  c.box  = BrickBox{{n, h, {}}, {}};
  c.mesh = mesh_of_cells(c.box->grid);
  for (auto &cell : c.mesh.cells)
    cell.material_id = 0;
  return c;
}

/** What SlidingMesh needs of such a body: bricks in one sweep, or cells. */
template <int dim>
struct BodyParts
{
  BodyParts(const MeshCase<dim> &c, const MPI_Comm communicator)
    : case_setup(c.setup)
    , held(c.held)
    , contact_boundary(c.side(2 * (dim - 1)))
    , top_boundary(c.side(2 * dim - 1))
    , distributed(distribute(c, contact_boundary.points, communicator))
  {
  }

  /** The setup with the friction coefficient of all nodes. */
  SlidingSetup with_friction(const double friction) const
  {
    SlidingSetup s = case_setup;
    s.contact.friction_coefficient.assign(contact_boundary.points.size(), friction);
    return s;
  }

  const SlidingSetup case_setup;
  const std::vector<HeldComponent> held;
  const MeshBoundary contact_boundary, top_boundary;
  const std::unique_ptr<DistributedBody<dim>> distributed;

private:
  static std::unique_ptr<DistributedBody<dim>>
  distribute(const MeshCase<dim> &c,
             const std::vector<unsigned int> &contact,
             const MPI_Comm communicator)
  {
    if constexpr (dim == 3)
      if (c.box)
        {
          std::vector<std::uint8_t> id;
          for (const auto &cell : c.mesh.cells)
            id.push_back(static_cast<std::uint8_t>(cell.material_id));
          return distribute_box(*c.box, reader_of(c.box->grid, id), {}, c.phases,
                                InstructionSet::automatic, communicator);
        }
    return distribute_mesh(c.mesh, contact, c.phases, InstructionSet::automatic,
                           communicator);
  }
};

/** Such a body, its fields from functions and as a whole. */
template <int dim>
class MeshRun : BodyParts<dim>
{
public:
  MeshRun(const MeshCase<dim> &c, const MPI_Comm communicator)
    : BodyParts<dim>(c, communicator)
    , part(this->distributed->part())
    , points(c.mesh.points)
    , body(*this->distributed,
           this->contact_boundary,
           this->top_boundary,
           this->held,
           completed(c.friction))
  {
  }

  /** What is held does not move at the start either; points that move together begin with
   * the same bits, on whichever rank they are. */
  void set_w(const std::function<double(const dealii::Point<dim> &, unsigned int)> &f)
  {
    for (unsigned int c = 0; c < dim; ++c)
      for (std::size_t i = 0; i < part.points.size(); ++i)
        {
          const auto is_here = [&](const HeldComponent &h) {
            return h.point == part.master_in_mesh[i] && h.component == c;
          };
          const bool held_here =
            std::any_of(this->held.begin(), this->held.end(), is_here);
          body.w.row(c, 0)[i] = held_here ? 0. : f(points[part.master_in_mesh[i]], c);
        }
  }

  void run(const std::uint64_t n_steps)
  {
    std::vector<StepObserver *> observers;
    if (body.energy)
      observers.push_back(body.energy.get());
    run_time_loop(body.stepper, observers, body.stepper.step_number() + n_steps, 1U << 20,
                  [](const std::uint64_t) { return true; });
  }

  /** [point of the mesh][component], on all ranks. */
  std::vector<double> whole(const NodalField<double> &field) const
  {
    std::vector<double> own(points.size() * dim), all(points.size() * dim);
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < part.n_owned; ++i)
        own[std::size_t(part.point_in_mesh[i]) * dim + c] = field.row(c, 0)[i];
    dealii::Utilities::MPI::sum(own, this->distributed->communicator(), all);
    return all;
  }

  const MeshPart<dim> &part; ///< points and cells that this rank has

private:
  const std::vector<dealii::Point<dim>> points;

  SlidingSetup completed(const double friction) const
  {
    SlidingSetup s = this->with_friction(friction);
    if (!(s.step.dt > 0.))
      s.step.dt = 0.95 * critical_time_step(this->distributed->largest_frequency().upper,
                                            s.step.beta2, s.step.beta);
    return s;
  }

public:
  SlidingMesh<dim> body;
};

/** Two phases, the same in two and three dimensions (plane strain). */
template <int dim>
std::vector<ElasticPhase<dim>> two_phases()
{
  const double G = 1900. * 2560. * 2560.;
  return {{isotropic_stiffness<dim>(2.4 * G, 0.2), 1900.},
          {isotropic_stiffness<dim>(1.2e11, 0.25), 2600.}};
}

/** The largest difference of two vectors over the largest value of the first. */
inline double relative_difference(const std::vector<double> &a,
                                  const std::vector<double> &b)
{
  std::vector<double> difference(a.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    difference[k] = a[k] - b[k];
  return largest(difference) / largest(a);
}
} // namespace verification

#endif
