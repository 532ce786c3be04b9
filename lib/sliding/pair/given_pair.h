#ifndef mesoslip_sliding_pair_given_pair_h
#define mesoslip_sliding_pair_given_pair_h

#include "sliding/mesh/given_mesh.h"
#include "sliding/pair/pair_body.h"

#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/** A body and the counter body below it, in static contact and complex modes. Facts and
 * nodes refer to the upper body, equations contain both bodies. Fields are replicated on
 * all ranks. */
template <int dim>
class GivenPair : public GivenBody<dim>
{
public:
  /** @throws UserError for input that no analysis supports */
  explicit GivenPair(const ContactParameters &given);

  BodyInMotion<dim> start(const SlidingSetup &given,
                          RunContext &context,
                          CounterMotion<dim> *counter) const override;
  CounterMotion<dim> start_below(const SlidingSetup &given,
                                 RunContext &context) const override;
  void write_contact(Hdf5File &file) const override;

  /** Always replicated.
   * @throws UserError if the supports of the counter body do not hold it */
  void make_elastic(const MPI_Comm communicator, const bool whole) override;
  const ElasticBody<dim> &elastic() const override;
  const ElasticBody<dim> &vibrating() const override;
  VibrationModes<dim> modes(const TopSetup &top,
                            const bool contact_held,
                            const VibrationModesOptions &options) const override;
  DampingByPhase make_damping(const StepParameters &step,
                              const MPI_Comm communicator) const override;
  DofMask held(const TopSetup &top, const bool contact_held) const override;
  std::size_t n_free(const TopSetup &top, const bool contact_held) const override;
  SupportNodes top_nodes() const override;
  std::vector<SideSupport> loaded_sides() const override;
  std::vector<SupportNodes> side_nodes() const override;
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
  const GivenBody<dim> *lower() const override
  {
    return below.get();
  }
  void write_below(const std::string &path,
                   const std::string &format,
                   const std::vector<ShownFields> &shown,
                   const std::vector<double> &numbers,
                   const RunConditions &conditions) const override;
  void show(const std::string &path,
            const std::vector<XdmfField> &fields,
            const std::vector<double> &times) const override;

private:
  using GivenBody<dim>::known;
  using GivenBody<dim>::parameters;

  GivenPair(const ContactParameters &given,
            std::unique_ptr<GivenMesh<dim>> upper,
            std::unique_ptr<GivenMesh<dim>> lower);

  void add_size_below();
  bool floats_below() const;
  MeetingNodes meeting() const;
  std::vector<NodalField<double>>
  fields_of(const std::size_t body,
            const std::vector<const NodalField<double> *> &fields) const;

  const std::unique_ptr<GivenMesh<dim>> above, below;
  std::unique_ptr<PairBody<dim>> at_rest; ///< see elastic()
  std::unique_ptr<PairBody<dim>> moving;  ///< see vibrating()
};
} // namespace mesoslip

#endif
