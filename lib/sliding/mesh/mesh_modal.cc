#include "sliding/mesh/mesh_modal.h"

#include "sliding/analyses/modal_cases.h"
#include "sliding/mesh/mesh_analysis.h"
#include "sliding/mesh/mesh_file.h"

#include <deal.II/base/mpi.h>

namespace mesoslip
{
namespace
{
template <int dim>
class MeshModal : public MeshAnalysis<dim>
{
public:
  explicit MeshModal(const ContactParameters &given)
    : MeshAnalysis<dim>(given)
    , n_copies(copies_on_rank_0())
  {
    for (const std::string &bottom : modal_bottoms(this->parameters))
      require_modes(n_free(constraints(bottom == "held")), this->parameters);
  }

  void run(RunContext &context) override;

private:
  /** Of a contact that is held along the normal of the flat, or not. */
  DofMask constraints(const bool contact_held) const
  {
    DofMask held = this->held_by_mesh(top_at_start(this->parameters));
    if (contact_held)
      for (const unsigned int point : this->body.contact.points)
        held.constrain(dim - 1, {point, 0});
    return held;
  }

  /** As FreeDofs::size(), without the body. */
  std::size_t n_free(const DofMask &held) const
  {
    std::size_t n = modal_options(this->parameters).platen_mass ? 1 : 0;
    for (unsigned int i = 0; i < this->body.n_points; ++i)
      for (unsigned int c = 0; c < dim; ++c)
        n += held.is_constrained(c, {i, 0}) ? 0 : 1;
    return n - dim * n_copies; // which nothing holds but their originals
  }

  /** Points that move as others do, of the mesh that rank 0 has. Collective. */
  std::size_t copies_on_rank_0() const
  {
    const Mesh<dim> &mesh = this->morphology.mesh;
    std::size_t n         = 0;
    for (unsigned int p = 0; p < mesh.points.size(); ++p)
      n += mesh.original(p) == p ? 0 : 1;
    return dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, n);
  }

  const std::size_t n_copies; ///< see above
};

template <int dim>
void MeshModal<dim>::run(RunContext &context)
{
  this->log_body(context);
  context.remove_results({"modal.h5", "modal.xdmf", "modal-phases.xdmf", "modes.csv"});
  const auto elastic = this->make_elastic_body();
  const auto cases   = compute_modes<dim>(
    *elastic, [this](const bool held) { return constraints(held); }, this->parameters,
    context);
  if (!context.root())
    return;
  const auto scope = context.timer().scope("Output");
  this->summarize_body("modal", context);
  write_modes(cases, context);
  Hdf5File file           = create_mesh_file(context.file("modal.h5"), "mesoslip-modal",
                                             this->morphology, this->body);
  const ShownShapes shown = write_shapes(file, cases, vectors_shape(this->morphology));
  file.close();
  show_body(context.file("modal.xdmf"), "modal.h5", this->morphology, shown.fields,
            shown.numbers);
  show_mesh_phases(context.file("modal-phases.xdmf"), "modal.h5", this->morphology);
}
} // namespace

std::unique_ptr<Analysis> make_mesh_modal(const ContactParameters &parameters)
{
  if (parameters.mesh.mesh.dim == 2)
    return std::make_unique<MeshModal<2>>(parameters);
  return std::make_unique<MeshModal<3>>(parameters);
}
} // namespace mesoslip
