#ifndef mesoslip_contact_contact_map_h
#define mesoslip_contact_contact_map_h

#include "contact/laws/coefficient_law.h"
#include "contact/node_loads.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/** Quantities that a map of the contact may store for each node. */
enum class MapQuantity : unsigned int
{
  pressure,
  traction,
  slip_velocity,
  state,
  friction_work,
  law_state,
  remembered_pressure,
  gap
};

/** Names of the quantities in parameter files, in the order of MapQuantity. */
std::vector<std::string> map_field_names();

/** A field of the map, as stored in the file. */
struct MapField
{
  MapQuantity quantity;    ///< quantity of the field
  std::string name;        ///< name of the dataset
  std::string unit;        ///< unit, after division by the area if over_area
  unsigned int components; ///< 2 for vectors in 3D
  bool over_area;          ///< whether samples are divided by the tributary area
};

/** Sampled steps and quantities of a map. */
struct ContactMapSetup
{
  std::uint64_t first    = 0;          ///< step of the first sample
  std::uint64_t end      = 0;          ///< steps from this one on have no sample
  std::uint64_t interval = 0;          ///< steps between two samples; 0: no map
  std::vector<MapQuantity> quantities; ///< in the order of MapQuantity
  StateVariable law_state;             ///< state variable of the coefficient law, if any

  /** Whether step @p n has a sample. */
  bool has(const std::uint64_t n) const
  {
    return interval > 0 && n >= first && n < end && (n - first) % interval == 0;
  }

  /** Number of samples in the steps before @p n. */
  std::uint64_t count(const std::uint64_t n) const
  {
    const std::uint64_t last = n < end ? n : end;
    return interval == 0 || last <= first ? 0 : (last - first - 1) / interval + 1;
  }

  /** Whether the map has @p quantity. */
  bool has(const MapQuantity quantity) const;

  /** Fields for a contact in @p dim dimensions. */
  std::vector<MapField> fields(const unsigned int dim) const;

  /** Bytes in the file per sample and node. */
  double bytes_per_node(const unsigned int dim) const;
};

/**
 * Samples of all nodes of this rank: forces of the step (N, in 2D N/m) and energies (J,
 * in 2D J/m), not yet divided by areas; centred slip velocity of NodeSlip (m/s); states 0
 * separated, 1 stick, 2 slip. State of the law and remembered normal force are the values
 * from which the friction of the step was computed. Gaps (m) are at the instant of the
 * forces.
 */
template <int dim>
class ContactMapSampler : public ContactObserver<dim>
{
public:
  /**
   * Samples @p contact; @p loads is needed for the friction work. Both must outlive this
   * object.
   */
  ContactMapSampler(const ContactMapSetup &setup,
                    const ContactSurface<dim> &contact,
                    const NodeLoadObserver<dim> &loads)
    : setup(setup)
    , slip(contact)
    , loads(loads)
    , samples(setup.quantities.size())
  {
  }

  bool wants(const std::uint64_t step) const override
  {
    return setup.has(step);
  }
  void before(const SurfaceView<dim> &) override
  {
    slip.before();
  }
  void after(const SurfaceView<dim> &surface, ContactSurface<dim> &contact) override;

  /**
   * Returns and clears the samples since the last call: for each field [samples][nodes],
   * or [samples][nodes][components].
   */
  std::vector<std::vector<double>> take();

private:
  const ContactMapSetup setup;
  NodeSlip<dim> slip;
  const NodeLoadObserver<dim> &loads;
  std::vector<std::vector<double>> samples;
};
} // namespace mesoslip

#endif
