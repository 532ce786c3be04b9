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

/** The sliding body: geometry, materials and friction coefficients. */
struct BodyDescription
{
  UniformGrid<2> grid;          ///< number of cells, their size and origin (m)
  std::vector<Phase<2>> phases; ///< one phase if homogeneous
  std::vector<std::uint8_t>
    phase_id; ///< index of the phase of each cell, x fastest; may be empty
  std::vector<double> node_friction; ///< Coulomb coefficient of the bottom nodes
  std::string rve_digest;            ///< digest of the RVE file; empty without one
  std::string rve_content;           ///< see RveFile::content()
  std::vector<std::string> warnings; ///< warnings about the RVE file for the user

  /** Phase index of a cell. */
  std::size_t phase_of(const std::size_t cell) const
  {
    return phase_id.empty() ? 0 : phase_id[cell];
  }

  /** Fractions of the phases in the first @p n_cells cells. */
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
 * Conditions of a contact_dynamics run: loads, supports, friction, damping, time step,
 * and its steady part; numbers in SI units and words by name. Stored as attributes of
 * /run in dynamics.h5, listed in doc/file_formats.md. Conditions that do not apply are
 * absent.
 */
using RunConditions = std::map<std::string, std::variant<double, std::string>>;

/** Value of the condition @p name; empty if it does not apply. */
std::optional<double> number_of(const RunConditions &conditions, const std::string &name);

/**
 * Converts conditions to those in the file of the counter body, whose contact is its
 * upper side.
 */
RunConditions conditions_below(RunConditions conditions);

/** Whether the contact is the upper side of the body. */
bool is_below(const RunConditions &conditions);

/** Writes /run; all names must be known. */
void write_run_conditions(Hdf5File &file, const RunConditions &conditions);

/** Reads /run; empty for older files without it. @throws UserError */
std::optional<RunConditions> read_run_conditions(const Hdf5File &file);

/** A condition in which two runs differ. */
struct ConditionDifference
{
  std::string name;   ///< name of the attribute
  std::string first;  ///< value with unit in the first run; "none" if absent
  std::string second; ///< value with unit in the second run; "none" if absent
  /**
   * Whether results cannot be compared: load, support or friction coefficient differ.
   * False for the method and for intended differences: time step, beta, beta2,
   * regularization, coefficients per phase against a constant.
   */
  bool of_load = false;
};

/** Differences in a fixed order; steady parts and bodies are not compared. */
std::vector<ConditionDifference> condition_differences(const RunConditions &first,
                                                       const RunConditions &second);

/**
 * Text such as "pressure is 5e+06 Pa and 6e+06 Pa, ...", for differences with this
 * @p of_load.
 */
std::string differences_text(const std::vector<ConditionDifference> &differences,
                             const bool of_load);
} // namespace mesoslip

#endif
