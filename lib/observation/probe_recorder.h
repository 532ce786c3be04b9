#ifndef mesoslip_observation_probe_recorder_h
#define mesoslip_observation_probe_recorder_h

#include "base/serialize_members.h"
#include "contact/contact_surface.h"
#include "dynamics/stepper.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * A probe and what it saw: one value (or pair, or triple) a sample. Every rank knows name,
 * place and phase, its owner the samples.
 */
struct ProbeHistory
{
  std::string name;                      ///< as in the .prm
  std::array<double, 2> position   = {}; ///< from the lower left corner (m)
  unsigned int phase               = 0;  ///< of the cell that it lies in
  std::vector<double> time         = {}; ///< s
  std::vector<double> displacement = {}; ///< [k][2] (m)
  std::vector<double> velocity     = {}; ///< [k][2] (m/s)
  std::vector<double> strain       = {}; ///< [k][3], Voigt
  std::vector<double> stress       = {}; ///< [k][3] (Pa)
  std::vector<double> traction = {}; ///< tangential, pressure [k][2] (Pa); on the contact

  /** Saves or restores the probe (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<9>(archive, *this);
  }
};

/**
 * Samples displacement, velocity, strain, stress and contact traction at points: Q1
 * interpolation, the strain being the derivative at the point itself (the cell mean at
 * a cell's centre).
 */
class ProbeRecorder : public StepObserver
{
public:
  /** A point that is watched. */
  struct Point
  {
    std::string name;                       ///< as in the .prm
    std::array<double, 2> position = {};    ///< from the lower left corner (m)
    bool nearest_node              = false; ///< move the position to a node
  };

  /** References are kept. Points have to lie in the body. */
  ProbeRecorder(const std::vector<Point> &points,
                const UniformMaterial &material,
                const Stepper &stepper,
                const ContactSurface<2> &contact,
                const std::uint64_t interval);

  std::uint64_t next_step(const std::uint64_t n) const override
  {
    return next_multiple(n, interval);
  }
  void before_step(const std::uint64_t n) override;
  void after_step(const std::uint64_t n) override;

  /** All probes on rank 0, in their order (collective; elsewhere empty). */
  std::vector<ProbeHistory> gather() const;

  /** Saves or restores the samples (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &histories;
  }

private:
  /** Where a point lies: cell, and position in it from 0 to 1. */
  struct Place
  {
    unsigned int i = 0, j = 0;
    std::array<double, 2> xi       = {};
    bool owned                     = false;
    std::array<double, 2> w_before = {};
  };

  Place locate(const std::array<double, 2> &position) const;

  std::array<double, 2> interpolate(const NodalField<double> &field,
                                    const Place &place) const;

  VoigtVector<2> strain(const Place &place) const;

  /** If a probe lies between two ranks. Collective. */
  void update_ghosts(NodalField<double> &field) const;

  /** Appends the traction of the nearest contact node, if the place is on the contact. */
  void sample_contact(const Place &place, std::vector<double> &traction) const;

  const UniformMaterial &material;
  const Stepper &stepper;
  const NodeRows &rows;
  const ContactSurface<2> &contact;
  const std::uint64_t interval;
  std::vector<Place> places;
  bool needs_ghosts = false; ///< a probe lies between two ranks
  std::vector<ProbeHistory> histories;
};
} // namespace mesoslip

#endif
