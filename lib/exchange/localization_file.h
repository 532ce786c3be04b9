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
/**
 * Statistics over time for each cell: [ny][nx] or [nz][ny][nx] on a grid, [n] on a mesh,
 * followed by the Voigt components of stresses. Fields that are not selected are empty.
 */
struct StressFields
{
  std::vector<double> mean_von_mises; ///< mean von Mises stress (Pa)
  std::vector<double> mean_stress;    ///< mean of each component (Pa)

  /** Standard deviation (divided by the number of samples) of each component (Pa). */
  std::vector<double> deviation_stress;
};

/** Selection of StressFields. */
struct FieldSelection
{
  bool von_mises = true; ///< mean von Mises stress
  bool mean      = true; ///< mean of each component
  bool deviation = true; ///< standard deviation of each component

  /** Whether any field is selected. */
  bool any() const
  {
    return von_mises || mean || deviation;
  }
};

/** Description of one of the StressFields, for loops over all of them. */
struct StressField
{
  const char *name;                          ///< name in localization.h5
  bool FieldSelection::*is_wanted;           ///< its selection flag
  std::vector<double> StressFields::*values; ///< the field
  std::vector<std::string> quantities;       ///< its components in field_errors.csv
};

/** Selected StressFields in two or three dimensions. */
std::vector<StressField> stress_fields(const unsigned int dim,
                                       const FieldSelection &fields = {});

/** Localized stress at a probe over time. */
struct LocalizedProbe
{
  std::string name; ///< name of its group
  /** Position (m): on a grid from the lower left corner, on a mesh in its coordinates. */
  std::vector<double> position      = {};
  std::vector<unsigned int> cell    = {}; ///< its cell: index along each axis, or number
  unsigned int phase                = 0;  ///< phase index of the cell
  std::string phase_name            = {}; ///< name of this phase
  std::vector<double> time          = {}; ///< s
  std::vector<double> stress        = {}; ///< stress (Pa), Voigt [k][3 or 6]
  std::vector<double> direct_stress = {}; ///< direct run (Pa); empty without one
};

/**
 * localization.h5, opened for writing or reading. Fields and probes are in groups: "" for
 * localized stresses, "/difference" for localized minus direct, "/direct",
 * "/mean_strain_variant" if there are two variants, and "/points/NAME" for the fields of
 * the volume element at a point of the body.
 */
class LocalizationFile : public Hdf5File
{
public:
  /** Creates a file; @p digest is the digest of all inputs. */
  template <int dim>
  static LocalizationFile create(const std::string &path,
                                 const std::string &digest,
                                 const UniformGrid<dim> &grid);

  /** Creates a file for fields on a mesh, which must outlive it. */
  template <int dim>
  static LocalizationFile
  create(const std::string &path, const std::string &digest, const Mesh<dim> &mesh);

  /** Opens a file with fields on a plane grid. @throws UserError */
  static LocalizationFile open(const std::string &path);

  /** Reserves space for the fields in @p group; write_fields() fills it. */
  void reserve_fields(const FieldSelection &fields, const std::string &group);

  /** Writes a probe to "probes" in group @p in. */
  void write_probe(const LocalizedProbe &probe, const std::string &in);

  /**
   * Completes the file after leave(), and writes `NAME.xdmf` with all fields, if there
   * are any.
   */
  void complete();

  /**
   * Reads the fields in @p group; fields that the file lacks are empty. @throws UserError
   */
  StressFields fields(const std::string &group) const;

  /** Reads probe @p name in group @p in. @throws UserError */
  LocalizedProbe probe(const std::string &name, const std::string &in) const;

private:
  LocalizationFile(Hdf5File &&file, const unsigned int n_axes, const Shape &extents)
    : Hdf5File(std::move(file))
    , dimension(n_axes)
    , cells(extents)
  {
  }

  Shape shape_of_field(const std::size_t n) const;

  /** Number of Voigt components of a stress. */
  std::size_t n_components() const
  {
    return dimension == 2 ? 3 : 6;
  }

  const unsigned int dimension;
  const Shape cells; ///< shape of a field with a number per cell
  std::vector<XdmfField> shown;
  /** Writes an XDMF file (first path) for these fields of an HDF5 file (second path). */
  std::function<void(
    const std::string &, const std::string &, const std::vector<XdmfField> &)>
    write_shown;
};

/**
 * Fills the space of LocalizationFile::reserve_fields() in the file @p path, which rank 0
 * has left. Each rank writes different cells, whole rows from @p first_row on.
 * Collective. @throws UserError, NumericalFailure on all ranks
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
