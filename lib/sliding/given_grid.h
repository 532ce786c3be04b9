#ifndef mesoslip_sliding_given_grid_h
#define mesoslip_sliding_given_grid_h

#include "elasticity/dof_mask.h"
#include "elasticity/uniform_material.h"
#include "exchange/run_description.h"
#include "sliding/given_body.h"

#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * The body that parameters and RVE file describe. The coefficient of a bottom node
 * follows from the two cells beside it by FrictionParameters::node_rule: mean weighted
 * with the stiffness D22 (as the pressure is shared when both cells have the same
 * strain, eq. 18), plain mean, largest or smallest. @p n_copies ranks of this machine
 * keep fields of the whole body.
 * @throws UserError naming key or file, or if the memory is insufficient
 */
BodyDescription make_body(const ContactParameters &parameters,
                          const unsigned int n_copies);

/** The grid of the body with the materials of its cells. @throws UserError */
UniformMaterial make_material(const BodyDescription &body,
                              const MeanDilatation choice,
                              const bool periodic);

/** Constraints by sides and top (a platen: u_x and u_y); with @p bottom_held also u_y of
 * the bottom. */
DofMask held_by_supports(const UniformMaterial &material,
                         const SideConstraints &sides,
                         const TopSetup &top,
                         const bool bottom_held = false);

/** Mirrors the body: exchanges top and bottom. */
void turn_over(BodyDescription &body);

/** A plane grid. */
class GivenGrid : public GivenBody<2>
{
public:
  /** Rank 0 reads the RVE file.
   * @throws UserError for input that no analysis supports, or if the memory for its
   * fields is insufficient */
  explicit GivenGrid(const ContactParameters &given);

  /** A body with a given description. */
  GivenGrid(const ContactParameters &given, const BodyDescription &described);

  /** Starts the body, above @p counter if there is one. */
  BodyInMotion<2> start(const SlidingSetup &given,
                        RunContext &context,
                        CounterMotion<2> *counter) const override;
  CounterMotion<2> start_below(const SlidingSetup &given,
                               RunContext &context) const override;
  void write_contact(Hdf5File &file) const override;

  void make_elastic(const MPI_Comm communicator, const bool whole) override;
  const ElasticBody<2> &elastic() const override;
  DampingByPhase make_damping(const StepParameters &step,
                              const MPI_Comm communicator) const override;
  DofMask held(const TopSetup &top, const bool contact_held) const override;
  std::size_t n_free(const TopSetup &top, const bool contact_held) const override;
  SupportNodes top_nodes() const override;
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
  void show(const std::string &path,
            const std::vector<XdmfField> &fields,
            const std::vector<double> &times) const override;

protected:
  const BodyDescription body;     ///< the same on all ranks; may be upside down
  const UniformMaterial material; ///< stiffness and density of its cells

private:
  std::vector<std::string> lines() const;
  std::vector<std::string> warnings() const;
  std::vector<SurfaceFacet> facets() const;
  BodyScales scales() const;
  double mass_for_area(const SideSupport &platen, const double density) const;
  BodySize size() const;
  std::vector<std::vector<double>> top_impedance() const;
  SideNodes column_of(const SideSupport &side) const;
  SlidingSetup with_sides(SlidingSetup setup) const;
  double place_of_row(const double row) const;
  BodyDescription described() const;

  std::unique_ptr<ElasticBody<2>> of_statics; ///< see make_elastic()
};
} // namespace mesoslip

#endif
