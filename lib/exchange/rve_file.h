#ifndef mesoslip_exchange_rve_file_h
#define mesoslip_exchange_rve_file_h

#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "material/voigt.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mesoslip
{
/** What rve_homogenization leaves in rve.h5. */
struct RveContent
{
  std::string digest;                 ///< of the inputs that determine the content
  std::string summary;                ///< JSON
  UniformGrid<2> grid;                ///< of the morphology
  std::vector<Phase<2>> phases;       ///< by index
  std::vector<std::uint8_t> phase_id; ///< phase of each cell, x fastest
  std::map<std::string, VoigtMatrix<2>> stiffness; ///< KUBC, SUBC, PBC, effective (Pa)

  /**
   * Concentration tensors [ny][nx][3][3] of KUBC and PBC (strain: row local, column
   * macroscopic component) and of SUBC (stress), as far as they are to be stored.
   */
  std::map<std::string, const std::vector<double> *> concentration;
};

/**
 * rve.h5, opened for reading: format, version, shapes, phase numbers and finiteness are
 * checked, and every error names the file, the dataset and what to run. The small data
 * are read at once, the fields when they are asked for.
 */
class RveFile
{
public:
  /** Writes `NAME.h5`, and `NAME.xdmf` for ParaView beside it. */
  static void write(const std::string &path, const RveContent &content);

  /** Opens for reading. @throws UserError */
  explicit RveFile(const std::string &path);

  /** The path given. */
  const std::string &path() const
  {
    return file.path();
  }

  /** A sentence if rve_homogenization did not write it as it is; else empty. */
  std::string change_note() const
  {
    return file.change_note("rve_homogenization");
  }

  /** Summary of the run that wrote it (JSON); empty if the file holds none. */
  std::string summary() const;

  /** Phase of each cell, x fastest; below the number of phases. */
  std::vector<std::uint8_t> phase_id() const;

  /** Volume mean of the density (kg/m^3). */
  double mean_density() const;

  /** KUBC, SUBC, PBC or effective (Pa). @throws UserError when it was not computed. */
  VoigtMatrix<2> stiffness(const std::string &name) const;

  /** Strain concentration tensors of KUBC or PBC. @throws UserError without them. */
  std::vector<double> concentration(const std::string &name) const;

private:
  Hdf5File file;

public:
  const std::string digest;           ///< of the inputs that determine the content
  const UniformGrid<2> grid;          ///< of the morphology
  const std::vector<Phase<2>> phases; ///< by index
};
} // namespace mesoslip

#endif
