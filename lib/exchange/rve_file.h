#ifndef mesoslip_exchange_rve_file_h
#define mesoslip_exchange_rve_file_h

#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "material/phase.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * rve.h5, opened for reading: format, version, shapes, phase numbers and finiteness are
 * checked, and every error names the file, the dataset and what to run. The small data
 * are read at once, the fields when they are asked for.
 */
class RveFile
{
public:
  /** @throws UserError */
  static RveFile open(const std::string &path);

  /** As given. */
  const std::string &path() const
  {
    return file.path();
  }

  /** A sentence if rve_homogenization did not write it as it is; else empty. */
  std::string change_note() const
  {
    return file.change_note("rve_homogenization");
  }

  /** Of the morphology. */
  const UniformGrid<2> &grid() const
  {
    return the_grid;
  }

  /** By index. */
  const std::vector<Phase<2>> &phases() const
  {
    return the_phases;
  }

  /** Digest of the inputs that determine the content. */
  const std::string &digest() const
  {
    return the_digest;
  }

  /** Phase of each cell, x fastest; below phases().size(). */
  std::vector<std::uint8_t> phase_id() const;

  /** Volume mean of the density (kg/m^3). */
  double mean_density() const;

  /** KUBC, SUBC, PBC or effective (Pa). @throws UserError when it was not computed. */
  VoigtMatrix<2> stiffness(const std::string &name) const;

  /**
   * Strain concentration tensors [ny][nx][3][3] of KUBC or PBC: row local, column
   * macroscopic strain component. @throws UserError when it was not computed.
   */
  std::vector<double> concentration(const std::string &name) const;

private:
  explicit RveFile(Hdf5File &&opened);

  Hdf5File file;
  UniformGrid<2> the_grid;
  std::vector<Phase<2>> the_phases;
  std::string the_digest;
};

/** The newest version of the format. */
constexpr int rve_format_version = 1;

/** Reads the attributes of /grid; every file that has a uniform grid stores it so. */
UniformGrid<2> read_grid(const Hdf5File &file, const std::string &hint = "");

/** Writes the attributes of /grid. */
void write_grid(Hdf5File &file, const UniformGrid<2> &grid);
} // namespace mesoslip

#endif
