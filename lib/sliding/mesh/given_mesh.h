#ifndef mesoslip_sliding_mesh_given_mesh_h
#define mesoslip_sliding_mesh_given_mesh_h

#include "body/point_body.h"
#include "elasticity/dof_mask.h"
#include "sliding/body_memory.h"
#include "sliding/given_body.h"
#include "sliding/mesh/body_mesh.h"
#include "sliding/mesh/mesh_body.h"

#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/** A body on a mesh, or on a grid in 3D. */
template <int dim>
class GivenMesh : public GivenBody<dim>
{
public:
  /**
   * Rank 0 reads @p unread; the description is sent to all ranks. Time steps use a
   * partition.
   * @throws UserError for input that no analysis supports
   */
  GivenMesh(const ContactParameters &given, std::unique_ptr<BodyMesh<dim>> unread);

  BodyInMotion<dim> start(const SlidingSetup &given,
                          RunContext &context,
                          CounterMotion<dim> *counter) const override;
  CounterMotion<dim> start_below(const SlidingSetup &given,
                                 RunContext &context) const override;
  void write_contact(Hdf5File &file) const override;

  void make_elastic(const MPI_Comm communicator, const bool whole) override;
  const ElasticBody<dim> &elastic() const override;
  DampingByPhase make_damping(const StepParameters &step,
                              const MPI_Comm communicator) const override;
  DofMask held(const TopSetup &top, const bool contact_held) const override;
  std::size_t n_free(const TopSetup &top, const bool contact_held) const override;
  SupportNodes top_nodes() const override;
  std::vector<SupportNodes> side_nodes() const override;
  std::vector<NodeIndex> contact_of_elastic() const override;
  NodalField<double> compressed(const double strain) const override;
  std::vector<ContactCell> contact_cells(const NodalField<double> &u) const override;
  std::vector<std::vector<double>> contact_places() const override;
  ContactParts contact_parts() const override;
  Deformation deformation(const NodalField<double> &u) const override;

  Hdf5File create_file(const std::string &path, const std::string &format) const override;
  Shape vectors_shape() const override;
  void write_fields(std::optional<Hdf5File> &file,
                    const std::string &path,
                    const std::string &name,
                    const std::vector<const NodalField<double> *> &fields) const override;
  void show(const std::string &path,
            const std::vector<XdmfField> &fields,
            const std::vector<double> &times) const override;

  /** The body returned by elastic(). */
  const PointBody<dim> &points() const
  {
    return *of_statics;
  }

  using GivenBody<dim>::parameters;

private:
  using GivenBody<dim>::known;

  std::unique_ptr<BodyMesh<dim>> mesh;   ///< on rank 0, see BodyMesh::share()
  MeshBodyDescription body;              ///< the same on all ranks
  std::vector<ElasticPhase<dim>> phases; ///< per material, same on all ranks

  std::vector<std::string> lines() const;
  BodySize size() const;
  SlidingSetup with_sides(SlidingSetup setup) const;
  std::vector<ProbePoint> probe_places() const;
  unsigned int most_ranks() const;
  std::function<FieldRows()> displacement_rows(const SlidingMesh<dim> &moving) const;
  std::unique_ptr<ProbeRecorder> probes_of(const SlidingMesh<dim> &moving,
                                           const bool in_contact,
                                           const std::uint64_t interval) const;
  void describe_contact();

  std::unique_ptr<DistributedBody<dim>> distributed; ///< partition for time steps
  std::unique_ptr<PointBody<dim>> of_statics;        ///< see make_elastic()
};
} // namespace mesoslip

#endif
