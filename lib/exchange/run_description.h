#ifndef mesoslip_exchange_run_description_h
#define mesoslip_exchange_run_description_h

#include "base/serialize_members.h"
#include "grid/uniform_grid.h"
#include "material/voigt.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace mesoslip
{
/** Saves or restores a phase (Boost.Serialization). */
template <class Archive>
void serialize(Archive &archive, Phase<2> &phase, const unsigned int)
{
  serialize_members<5>(archive, phase);
}

/** The body that slides: geometry, materials and friction coefficients. */
struct BodyDescription
{
  UniformGrid<2> grid;                ///< number of cells, their size and origin (m)
  std::vector<Phase<2>> phases;       ///< a single one if homogeneous
  std::vector<std::uint8_t> phase_id; ///< of each cell, x fastest; empty if homogeneous
  std::vector<double> node_friction;  ///< Coulomb coefficient of the bottom nodes
  std::string rve_digest;             ///< of the RVE file; empty without one
  std::string rve_content;            ///< RveFile::content()
  std::vector<std::string> warnings;  ///< sentences on the RVE file for the user

  /** Number of the phase of a cell. */
  std::size_t phase_of(const std::size_t cell) const
  {
    return phase_id.empty() ? 0 : phase_id[cell];
  }

  /** Fraction of the first @p n_cells cells that each phase takes. */
  std::vector<double> fractions(const std::size_t n_cells) const
  {
    std::vector<double> result(phases.size(), 0.);
    for (std::size_t cell = 0; cell < n_cells; ++cell)
      result[phase_of(cell)] += 1. / static_cast<double>(n_cells);
    return result;
  }

  /** Saves or restores the body (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<7>(archive, *this);
  }
};

class Hdf5File;

/**
 * Under what a contact_dynamics run was made: loads, supports, friction, damping, time
 * step, and its steady part, numbers in SI units and words by their names. The attributes
 * of /run in dynamics.h5; doc/file_formats.md lists them. What does not apply is absent.
 */
using RunConditions = std::map<std::string, std::variant<double, std::string>>;

/** The number of that name; nothing if it does not apply. */
std::optional<double> number_of(const RunConditions &conditions, const std::string &name);

/** Those of a run as the file of its counter body has them, whose contact is the upper side. */
RunConditions conditions_below(RunConditions conditions);

/** Whether the contact is the upper side of the body. */
bool is_below(const RunConditions &conditions);

/** Writes /run; all names must be known. */
void write_run_conditions(Hdf5File &file, const RunConditions &conditions);

/** Reads /run; nothing if the file is older and has none. @throws UserError */
std::optional<RunConditions> read_run_conditions(const Hdf5File &file);

/** One condition in which two runs differ. */
struct ConditionDifference
{
  std::string name;  ///< of the attribute
  std::string first; ///< value with unit in the first run; "none" where it does not apply
  std::string second; ///< the same in the second run
  /**
   * Whether results of the two runs cannot be compared: load, support or friction
   * coefficient differ. False for what is part of the method or adapted on purpose: time
   * step, beta, beta2, regularization, a coefficient for each phase against a constant.
   */
  bool of_load = false;
};

/** In what the two differ, in a fixed order; steady parts and bodies are not compared. */
std::vector<ConditionDifference> condition_differences(const RunConditions &first,
                                                       const RunConditions &second);

/** "pressure is 5e+06 Pa and 6e+06 Pa, ...", those with (@p of_load) or the others. */
std::string differences_text(const std::vector<ConditionDifference> &differences,
                             const bool of_load);
} // namespace mesoslip

#endif
