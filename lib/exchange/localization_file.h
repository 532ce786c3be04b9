#ifndef mesoslip_exchange_localization_file_h
#define mesoslip_exchange_localization_file_h

#include "exchange/xdmf.h"
#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "mesh/mesh.h"

#include <functional>
#include <mpi.h>
#include <string>
#include <vector>

namespace mesoslip
{
/** Statistics over time for each cell, on a grid [ny][nx] or [nz][ny][nx], on a mesh [n],
 * stresses with their Voigt components behind; what was not asked for is empty. */
struct StressFields
{
  std::vector<double> mean_von_mises; ///< mean von Mises stress (Pa)
  std::vector<double> mean_stress;    ///< mean of each component (Pa)

  /** Standard deviation (divided by the number of samples) of each component (Pa). */
  std::vector<double> deviation_stress;
};

/** Which of the StressFields are wanted. */
struct FieldSelection
{
  bool von_mises = true; ///< mean over time
  bool mean      = true; ///< of each stress component
  bool deviation = true; ///< standard deviation of each component

  /** Whether there is anything to compute. */
  bool any() const
  {
    return von_mises || mean || deviation;
  }
};

/** One of the StressFields, for whoever treats all of them alike. */
struct StressField
{
  const char *name;                          ///< in localization.h5
  bool FieldSelection::*is_wanted;           ///< whether it is asked for
  std::vector<double> StressFields::*values; ///< the field
  std::vector<std::string> quantities;       ///< its components in field_errors.csv
};

/** Those of the StressFields, in two or three dimensions, that are selected. */
std::vector<StressField> stress_fields(const unsigned int dim,
                                       const FieldSelection &fields = {});

/** Localized stress at the place of a probe over time. */
struct LocalizedProbe
{
  std::string name; ///< name of its group
  /** On a grid from the lower left corner, on a mesh in its coordinates (m). */
  std::vector<double> position   = {};
  std::vector<unsigned int> cell = {}; ///< that holds it: along each axis, or its number
  unsigned int phase             = 0;  ///< number of the phase of the cell
  std::string phase_name         = {}; ///< name of that phase
  std::vector<double> time       = {}; ///< s
  std::vector<double> stress     = {}; ///< in Voigt order [k][3 or 6] (Pa)
  std::vector<double> direct_stress = {}; ///< of the direct run; empty without one
};

/**
 * localization.h5, opened for writing or reading. Fields and probes are in groups: "" for
 * the localized stresses, "/difference" for localized minus direct, "/direct",
 * "/mean_strain_variant" where there are two variants, and "/points/NAME" for the fields
 * of the volume element at a point of the body.
 */
class LocalizationFile : public Hdf5File
{
public:
  /** Begins a file. @p digest is that of all that determines its content. */
  template <int dim>
  static LocalizationFile create(const std::string &path,
                                 const std::string &digest,
                                 const UniformGrid<dim> &grid);

  /** The same for fields on a mesh, which must outlive the file. */
  template <int dim>
  static LocalizationFile
  create(const std::string &path, const std::string &digest, const Mesh<dim> &mesh);

  /** Opens for reading, if the fields are on a plane grid. @throws UserError */
  static LocalizationFile open(const std::string &path);

  /** Makes place for the fields in @p group, which write_fields() fills. */
  void reserve_fields(const FieldSelection &fields, const std::string &group);

  /** Writes a probe below "probes" in group @p in. */
  void write_probe(const LocalizedProbe &probe, const std::string &in);

  /** Completes the file after leave(), and writes `NAME.xdmf` with all fields, if there are
   * any. */
  void complete();

  /** The fields in @p group; empty where the file has none. @throws UserError */
  StressFields fields(const std::string &group) const;

  /** The probe @p name in group @p in. @throws UserError */
  LocalizedProbe probe(const std::string &name, const std::string &in) const;

private:
  LocalizationFile(Hdf5File &&file, const unsigned int n_axes, const Shape &extents)
    : Hdf5File(std::move(file))
    , dimension(n_axes)
    , cells(extents)
  {
  }

  Shape shape_of_field(const std::size_t n) const;

  /** Of a stress. */
  std::size_t n_components() const
  {
    return dimension == 2 ? 3 : 6;
  }

  const unsigned int dimension;
  const Shape cells; ///< extents of a field of one number a cell
  std::vector<XdmfField> shown;
  /** Writes an XDMF file of the first name for these fields of a file of the second. */
  std::function<void(
    const std::string &, const std::string &, const std::vector<XdmfField> &)>
    write_shown;
};

/**
 * Fills the places of LocalizationFile::reserve_fields() in the file @p path that rank 0 has
 * left: each rank has the values of other cells, whole rows from @p first_row on. Collective.
 * @throws UserError, NumericalFailure on all ranks
 */
void write_fields(const std::string &path,
                  const unsigned int dim,
                  const FieldSelection &selection,
                  const StressFields &fields,
                  const std::string &group,
                  const std::size_t first_row,
                  const MPI_Comm communicator);
} // namespace mesoslip

#endif
