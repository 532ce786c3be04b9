#ifndef mesoslip_exchange_localization_file_h
#define mesoslip_exchange_localization_file_h

#include "exchange/dynamics_file.h"
#include "exchange/xdmf.h"

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
/** Statistics over time for each cell; what was not asked for is empty. */
struct StressFields
{
  std::vector<double> mean_von_mises; ///< mean von Mises stress [ny][nx] (Pa)
  std::vector<double> mean_stress;    ///< xx, yy, xy [ny][nx][3] (Pa)

  /** Standard deviation (divided by the number of samples) [ny][nx][3] (Pa). */
  std::vector<double> deviation_stress;
};

/** One of the StressFields, for whoever treats all of them alike. */
struct StressField
{
  const char *name;                          ///< in localization.h5
  std::vector<double> StressFields::*values; ///< the field
  std::vector<const char *> quantities;      ///< its components in field_errors.csv
};

/** All StressFields. */
const std::vector<StressField> &stress_fields();

/** Localized stress at the place of a probe over time. */
struct LocalizedProbe
{
  std::string name;                       ///< name of its group
  std::array<double, 2> position    = {}; ///< from the lower left corner (m)
  std::array<unsigned int, 2> cell  = {}; ///< column and row of the cell that holds it
  unsigned int phase                = 0;  ///< number of the phase of the cell
  std::string phase_name            = {}; ///< name of that phase
  std::vector<double> time          = {}; ///< s
  std::vector<double> stress        = {}; ///< xx, yy, xy [k][3] (Pa)
  std::vector<double> direct_stress = {}; ///< of the direct run [k][3]; empty without one
};

/**
 * localization.h5, opened for writing or reading. Fields and probes are in groups: "" for
 * the localized stresses, "/difference" for localized minus direct, "/direct", and
 * "/mean_strain_variant" where there are two variants.
 */
class LocalizationFile : public Hdf5File
{
public:
  /** Begins a file. @p digest is that of all that determines its content. */
  static LocalizationFile
  create(const std::string &path, const std::string &digest, const UniformGrid<2> &grid);

  /** Opens for reading. @throws UserError */
  static LocalizationFile open(const std::string &path);

  /** Writes the fields that are not empty to @p group. */
  void write_fields(const StressFields &fields, const std::string &group);

  /** Writes a probe below "probes" in group @p in. */
  void write_probe(const LocalizedProbe &probe, const std::string &in);

  /** Closes the file and writes `NAME.xdmf` with all fields, if there are any. */
  void complete();

  /** The fields in @p group; empty where the file has none. @throws UserError */
  StressFields fields(const std::string &group) const;

  /** The probe @p name in group @p in. @throws UserError */
  LocalizedProbe probe(const std::string &name, const std::string &in) const;

  UniformGrid<2> grid; ///< the cells of the fields

private:
  explicit LocalizationFile(Hdf5File &&file)
    : Hdf5File(std::move(file))
  {
  }

  std::vector<XdmfField> shown;
};
} // namespace mesoslip

#endif
