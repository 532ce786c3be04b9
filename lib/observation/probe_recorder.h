#ifndef mesoslip_observation_probe_recorder_h
#define mesoslip_observation_probe_recorder_h

#include "base/serialize_members.h"
#include "dynamics/stepper.h"

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * A probe and its samples: d numbers per sample for vectors, Voigt components for strain
 * and stress. Every rank knows name, place and phase; only the owner has the samples.
 */
struct ProbeHistory
{
  std::string name;                      ///< as in the .prm
  std::array<double, 3> position   = {}; ///< see ProbePoint (m)
  unsigned int phase               = 0;  ///< phase of the cell that holds it
  std::vector<double> time         = {}; ///< s
  std::vector<double> displacement = {}; ///< [k][d] (m)
  std::vector<double> velocity     = {}; ///< [k][d] (m/s)
  std::vector<double> strain       = {}; ///< [k][3 or 6], Voigt
  std::vector<double> stress       = {}; ///< [k][3 or 6] (Pa)
  std::vector<double> traction = {}; ///< tangential, pressure [k][d] (Pa); on the contact

  /** Saves or restores the probe (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<9>(archive, *this);
  }
};

/** An observed point. */
struct ProbePoint
{
  std::string section;                 ///< in the .prm, "Observation"
  std::string name;                    ///< as in the .prm
  std::array<double, 3> position = {}; ///< relative to the lower left; mesh: absolute (m)
  bool nearest_node              = false; ///< whether to move it to a node
};

/**
 * Samples displacement, velocity, strain, stress and contact traction at points by the
 * interpolation of their cells; the strain is the derivative at the point itself.
 * Derived classes define the cells.
 */
class ProbeRecorder : public StepObserver
{
public:
  std::uint64_t next_step(const std::uint64_t n) const override
  {
    return next_multiple(n, interval);
  }
  void before_step(const std::uint64_t n) override;
  void after_step(const std::uint64_t n) override;

  /** All probes on rank 0, in order; elsewhere empty. Collective. */
  std::vector<ProbeHistory> gather() const;

  /** Saves or restores the samples (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &histories;
  }

protected:
  /** A vector at a point; in 2D only two components are used. */
  using Vector = std::array<double, 3>;

  /** References @p stepper, whose fields have @p n_components; samples every @p interval
   * steps. */
  ProbeRecorder(const Stepper &stepper,
                const unsigned int n_components,
                const std::uint64_t interval);

  /** Adds a probe; exactly one rank owns it. */
  void add(const ProbeHistory &probe, const bool is_owned);

  /** Updates ghost values of @p field before it is used. Collective. */
  virtual void update_ghosts(NodalField<double> &field) const = 0;

  /** Interpolates @p field at probe @p k, which this rank owns. */
  virtual Vector interpolate(const NodalField<double> &field,
                             const std::size_t k) const = 0;

  /** Appends strain and stress at probe @p k, which this rank owns. */
  virtual void sample_strain(const std::size_t k, ProbeHistory &history) const = 0;

  /** Appends the traction of the contact node nearest to probe @p k, which this rank
   * owns, if the probe is on the contact. */
  virtual void sample_contact(const std::size_t k, ProbeHistory &history) const = 0;

  const Stepper &stepper; ///< has the fields

private:
  const unsigned int n_components;
  const std::uint64_t interval;
  std::vector<ProbeHistory> histories;
  std::vector<char> owned;
  std::vector<Vector> w_before;
};
} // namespace mesoslip

#endif
