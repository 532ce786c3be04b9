#include "base/errors.h"
#include "base/object_exchange.h"
#include "sliding/analyses/modal_cases.h"
#include "sliding/body_analysis.h"
#include "sliding/complex/complex_output.h"
#include "sliding/complex/grid_complex.h"
#include "sliding/mesh/mesh_analysis.h"
#include "sliding/mesh/mesh_file.h"
#include "sliding/mesh/statics/mesh_static_load.h"

#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
namespace
{
template <int dim>
class MeshComplex : public MeshAnalysis<dim>
{
public:
  explicit MeshComplex(const ContactParameters &given)
    : MeshAnalysis<dim>(given)
  {
    check_complex_modes(this->parameters);
    try
      {
        if (is_pressed())
          check_mesh_static<dim>(this->parameters, this->body.friction);
        else if (dim == 3)
          throw UserError("the top is held, and nothing presses the body on the flat; in "
                          "3D the drag across the motion of the flat depends on the "
                          "pressure, set Top/Kind = platen or pressure");
      }
    catch (const UserError &e)
      {
        throw UserError("The static state of sliding, which complex modes need: " +
                        std::string(e.what()));
      }
  }

  void run(RunContext &context) override;

private:
  bool is_pressed() const
  {
    return top_at_start(this->parameters).kind != TopSetup::Kind::held;
  }

  SlidingState at_rest(const ContactParameters &of_case,
                       const double friction_factor,
                       MeshBody<dim> &elastic,
                       RunContext &context);
};

template <int dim>
SlidingState MeshComplex<dim>::at_rest(const ContactParameters &of_case,
                                       const double friction_factor,
                                       MeshBody<dim> &elastic,
                                       RunContext &context)
{
  MeshBodyDescription described = this->body;
  if (!of_case.friction.coefficient_by_phase)
    described.friction.assign(described.friction.size(), of_case.friction.coefficient);
  for (double &mu : described.friction)
    mu *= friction_factor;
  const DofMask held           = this->held_by_mesh(top_at_start(of_case), elastic);
  StaticContactOptions options = of_case.static_contact;
  options.before_iteration     = stop_or_report(context, "iteration");
  StaticContact solve;
  if (is_pressed())
    solve = [&](const std::vector<double> &friction) {
      described.friction = friction;
      StaticContactSolution found;
      with_advice(equilibrium_advice(friction, true), [&]() {
        MeshStaticLoad<dim> load(of_case, described, elastic, held,
                                 this->phases[0].stiffness(dim - 1, dim - 1));
        found = load.follow(options);
      });
      return found;
    };
  return sliding_state<dim>(elastic, of_case, held,
                            std::vector<double>(described.friction), solve);
}

template <int dim>
void MeshComplex<dim>::run(RunContext &context)
{
  this->log_body(context);
  context.remove_results(complex_modes_files());
  const auto elastic = this->make_whole_body();
  this->order_contact(*elastic);
  const auto scope = context.timer().scope("Complex modes");
  auto parts =
    std::make_pair(std::vector<std::string>(), std::vector<std::vector<double>>());
  if (context.root())
    for (const Phase<dim> &phase : this->morphology.phases)
      parts.first.push_back(phase.name);
  if (context.root())
    parts.second =
      contact_shares(this->morphology, this->parameters.mesh, this->body.contact);
  broadcast_object(context.communicator(), parts);
  const auto cases = compute_complex_modes<dim>(
    *elastic, this->parameters,
    highest_frequency_of(this->parameters, this->body.scales.wave_speed,
                         elastic->extent(dim - 1)),
    [&](const ContactParameters &of_case, const double friction_factor) {
      return at_rest(of_case, friction_factor, *elastic, context);
    },
    {parts.first, parts.second}, this->body.scales.shear_impedance, context);
  if (!context.root())
    return;
  log_complex_modes(cases, this->parameters, context);
  this->summarize_body("complex modes", context);
  write_complex_tables(cases, this->parameters, context);
  Hdf5File file =
    create_mesh_file(context.file("complex_modes.h5"), "mesoslip-complex-modes",
                     this->morphology, this->body);
  const ShownComplexShapes shown = write_complex_shapes(
    file, cases, *elastic, this->parameters, vectors_shape(this->morphology));
  file.close();
  if (!shown.fields.empty())
    show_body(context.file("complex_modes.xdmf"), "complex_modes.h5", this->morphology,
              shown.fields, shown.numbers);
  show_mesh_phases(context.file("complex_modes-phases.xdmf"), "complex_modes.h5",
                   this->morphology);
}
} // namespace

std::unique_ptr<Analysis> make_mesh_complex(const ContactParameters &parameters)
{
  if (parameters.mesh.mesh.dim == 2)
    return std::make_unique<MeshComplex<2>>(parameters);
  return std::make_unique<MeshComplex<3>>(parameters);
}
} // namespace mesoslip
