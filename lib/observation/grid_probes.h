#ifndef mesoslip_observation_grid_probes_h
#define mesoslip_observation_grid_probes_h

#include "contact/contact_surface.h"
#include "elasticity/uniform_material.h"
#include "observation/probe_recorder.h"

namespace mesoslip
{
/** Position of a probe; the nearest node, if it is to be moved there. */
std::array<double, 3> place_of_probe(const ProbePoint &point, const UniformGrid<2> &grid);

/** Checks that points lie in a body, which is below y = 0 if it is @p turned_over.
 * @throws UserError naming the key of a point outside */
void check_probes(const std::vector<ProbePoint> &points,
                  const UniformGrid<2> &grid,
                  const bool turned_over);

/** Probes on a grid: Q1 interpolation, the strain at a cell's centre is the cell mean. */
class GridProbes : public ProbeRecorder
{
public:
  /** References are kept. Points have to lie in the body, which is @p turned_over if its
   * rows are stored downwards from y = 0. Without @p contact, as for a counter body,
   * there are no tractions. */
  GridProbes(const std::vector<ProbePoint> &points,
             const UniformMaterial &material,
             const Stepper &stepper,
             const ContactSurface<2> *contact,
             const bool turned_over,
             const std::uint64_t interval);

private:
  /** Location of a point: cell, its phase, and position in the cell from 0 to 1. */
  struct Place
  {
    unsigned int i = 0, j = 0, phase = 0;
    std::array<double, 2> xi = {};
  };

  Place locate(const Vector &position) const;
  VoigtVector<2> strain(const Place &place) const;

  /** Does an exchange only if a probe lies between two ranks. */
  void update_ghosts(NodalField<double> &field) const override;
  Vector interpolate(const NodalField<double> &field, const std::size_t k) const override;
  void sample_strain(const std::size_t k, ProbeHistory &history) const override;
  void sample_contact(const std::size_t k, ProbeHistory &history) const override;

  const UniformMaterial &material;
  const NodeRows &rows;
  const ContactSurface<2> *const contact;
  const double upwards; ///< -1 if the body is turned over
  std::vector<Place> places;
  bool needs_ghosts = false; ///< whether a probe lies between two ranks
};
} // namespace mesoslip

#endif
