#include "sliding/mesh/mesh_modal.h"

#include "base/exchange.h"
#include "eigenvalues/free_dofs.h"
#include "sliding/analyses/modal_cases.h"
#include "sliding/mesh/mesh_analysis.h"
#include "sliding/mesh/mesh_file.h"

#include <deal.II/base/mpi.h>

#include <set>
#include <utility>

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
      require_modes(n_free(bottom == "held"), this->parameters);
  }

  void run(RunContext &context) override;

private:
  /** Of a contact that is held along the normal of the flat, or not. */
  DofMask constraints(const bool contact_held, const MeshBody<dim> &elastic) const
  {
    DofMask held = this->held_by_mesh(top_at_start(this->parameters), elastic);
    if (contact_held)
      for (const unsigned int point : this->body.contact.points)
        if (const auto node = elastic.find(point))
          held.constrain(dim - 1, *node);
    return held;
  }

  /** As FreeDofs::size(), without the body. */
  std::size_t n_free(const bool contact_held) const
  {
    std::set<std::pair<unsigned int, unsigned int>> held; // point and component
    for (const HeldComponent &h : this->body.held)
      held.emplace(h.point, h.component);
    for (unsigned int c = 0; c < dim; ++c)
      if (top_at_start(this->parameters).is_fixed(c, dim))
        for (const unsigned int point : this->body.top.points)
          held.emplace(point, c);
    for (const unsigned int point : this->body.contact.points)
      if (contact_held)
        held.emplace(point, dim - 1);
    // Nothing holds copies but their originals.
    return dim * (this->body.n_points - n_copies) - held.size() +
           (modal_options(this->parameters).platen_mass ? 1 : 0);
  }

  /** Points that move as others do, of the mesh that rank 0 has. Collective. */
  std::size_t copies_on_rank_0() const
  {
    const Mesh<dim> &mesh = this->morphology.mesh;
    std::size_t n         = 0;
    for (unsigned int p = 0; p < mesh.points.size(); ++p)
      n += mesh.original(p) == p ? 0 : 1;
    return mpi::broadcast(n, 0, MPI_COMM_WORLD);
  }

  const std::size_t n_copies; ///< see above
};

template <int dim>
void MeshModal<dim>::run(RunContext &context)
{
  this->log_body(context);
  context.remove_results({"modal.h5", "modal.xdmf", "modal-phases.xdmf", "modes.csv"});
  const auto elastic = this->divide_body();
  const auto cases   = compute_modes<dim>(
    *elastic, [&](const bool held) { return constraints(held, *elastic); },
    this->parameters, context);
  const auto scope       = context.timer().scope("Output");
  const std::string path = context.file("modal.h5");
  std::optional<Hdf5File> file;
  on_root(context.communicator(), [&]() {
    this->summarize_body("modal", context);
    write_modes(cases, context);
    file.emplace(create_mesh_file(path, "mesoslip-modal", this->morphology, this->body));
    write_frequencies(*file, cases);
  });
  for (const ModalCase<dim> &c : cases)
    {
      std::vector<const NodalField<double> *> shapes;
      for (const VibrationMode<dim> &mode : c.modes.modes)
        shapes.push_back(&mode.shape);
      write_divided_fields(file, path, shapes_name(c), shapes, this->morphology,
                           *elastic);
    }
  if (!context.root())
    return;
  file->close();
  const ShownShapes shown = shown_shapes(cases);
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
