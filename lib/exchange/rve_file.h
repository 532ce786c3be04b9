#ifndef mesoslip_exchange_rve_file_h
#define mesoslip_exchange_rve_file_h

#include "exchange/rve/orientation_datasets.h"
#include "exchange/rve/variation_datasets.h"
#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "material/orientations.h"
#include "material/voigt.h"
#include "mesh/mesh.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
/** Format of rve.h5, and its newest version. */
inline constexpr char rve_format[] = "mesoslip-rve";
inline constexpr int newest_rve_version =
  2; ///< version of files with orientations; else 1

/** Content of rve.h5. */
template <int dim>
struct RveContent
{
  std::string digest;              ///< digest of all inputs
  std::string summary;             ///< JSON
  UniformGrid<dim> grid;           ///< grid of the morphology, unless it is a mesh
  const Mesh<dim> *mesh = nullptr; ///< mesh; null for a grid
  std::vector<Phase<dim>> phases;  ///< phases by index
  std::vector<double> fractions;   ///< volume fractions of the phases, stored with a mesh

  /**
   * Phase of each cell, on a grid x fastest; empty if write_cell_planes() has already
   * written it and the ids of orientations.
   */
  std::vector<std::uint8_t> phase_id;

  /** Number of cells. */
  std::size_t n_cells() const
  {
    return mesh != nullptr ? mesh->cells.size() : grid.n_cells();
  }

  Orientations orientations; ///< orientations of the cells, in 3D; empty if uniform

  /**
   * Materials of the cells and their volume fractions: the phases, or all pairs of phase
   * and orientation.
   */
  std::pair<std::vector<Phase<dim>>, std::vector<double>> constituents() const;

  std::map<std::string, VoigtMatrix<dim>> stiffness; ///< KUBC, SUBC, PBC, effective (Pa)

  std::map<std::string, VoigtVector<dim>>
    expansion; ///< thermal expansion for the same names (1/K); may be empty

  /** Constants of the phases with their derivatives; empty if not requested. */
  std::vector<VariedConstant<dim>> variations;

  /** Conductivities [dim][dim] by condition, and "effective"; empty if not requested. */
  std::map<std::string, std::vector<double>> conductivity;

  /** Conditions whose concentration tensors were reserved by reserve_concentration(). */
  std::vector<std::string> reserved;
};

/** Dataset of the concentration tensors of KUBC, SUBC or PBC. */
std::string concentration_dataset(const std::string &condition);

/**
 * Dataset of the stresses for one kelvin without macroscopic strain (SUBC: without
 * stress).
 */
std::string thermal_stress_dataset(const std::string &condition);

/** Dataset of sigma_zz for one kelvin in 2D, if it is known for all phases. */
std::string transverse_thermal_stress_dataset(const std::string &condition);

/**
 * Dataset of the mean gradients of cells for unit gradients (SUBC: fluxes for unit
 * fluxes).
 */
std::string conduction_dataset(const std::string &condition);

/** Optional fields in rve.h5 besides the concentration tensors. */
struct FurtherFields
{
  bool thermal_stress            = false; ///< see thermal_stress_dataset()
  bool transverse_thermal_stress = false; ///< see transverse_thermal_stress_dataset()
  bool conduction                = false; ///< see conduction_dataset()
};

/**
 * Creates rve.h5 at @p path and leaves it, with space for the concentration tensors of
 * all cells under @p conditions. ParallelRows fills it before write_rve_file() adds the
 * rest. Tensors are in Voigt components of strain (KUBC, PBC, MUBC: row local, column
 * macroscopic) or stress (SUBC). @p cells is the shape of an array with a number per
 * cell: the datasets are [ny][nx][3][3] or [nz][ny][nx][6][6] on a grid, [n][3][3] or
 * [n][6][6] on a mesh. @p further selects optional fields.
 */
template <int dim>
void reserve_concentration(const std::string &path,
                           const Shape &cells,
                           const std::vector<std::string> &conditions,
                           const FurtherFields &further = {});

/** Writes rve.h5 at @p path, and `NAME.xdmf` for ParaView beside it. */
template <int dim>
void write_rve_file(const std::string &path, const RveContent<dim> &content);

/** Summary (JSON) of the run that wrote the rve.h5 at @p path; empty if there is none. */
std::string read_rve_summary(const std::string &path);

/**
 * Dimension of an exchange file. @throws UserError with @p hint if the file does not
 * exist
 */
unsigned int dimension_of_file(const std::string &path, const std::string &hint);

/**
 * rve.h5 opened for reading. Format, version, shapes, phase indices and finiteness are
 * checked; every error names the file, the dataset and the program to run. Small data are
 * read at once, fields on demand.
 */
template <int dim>
class RveFile
{
public:
  /** Opens a file for reading. @throws UserError */
  explicit RveFile(const std::string &path)
    : RveFile(Hdf5File::open(path, "run rve_homogenization first"))
  {
  }

  /** Opens a file that rank 0 has already opened. @throws UserError */
  static RveFile open_too(const std::string &path)
  {
    return RveFile(Hdf5File::open_too(path));
  }

  /** Path of the file. */
  const std::string &path() const
  {
    return file.path();
  }

  /**
   * A warning if the file was changed after rve_homogenization wrote it, or was written
   * as a draft; else empty.
   */
  std::string change_note() const;

  /** Identifies the content of the file, including later changes. */
  std::string content() const
  {
    return digest + file.changed_content();
  }

  /** Whether the volume is a mesh. */
  bool is_mesh() const
  {
    return file.exists("/mesh");
  }

  /** Requires a grid. @throws UserError that @p nothing can be taken from a mesh */
  void require_grid(const std::string &nothing) const;

  /** Materials of the cells: the phases, or all pairs of phase and orientation. */
  std::vector<Phase<dim>> constituents() const
  {
    return oriented_phases(phases, materials.oriented);
  }

  /**
   * Index into constituents() of @p count cells from number @p first on. @throws
   * UserError
   */
  std::vector<std::uint16_t> constituent_ids(const std::size_t first,
                                             const std::size_t count) const
  {
    return materials.of_cells(file, first, count);
  }

  /**
   * Index into constituents() of the cells of @p block of a grid, x fastest. @throws
   * UserError
   */
  std::vector<std::uint16_t> constituent_ids(const CellBlock<dim> &block) const
  {
    return materials.of_cells(file, block);
  }

  /** Volume mean of the density (kg/m^3). */
  double mean_density() const;

  /**
   * Stiffness for KUBC, SUBC, PBC or effective (Pa). @throws UserError if it was not
   * computed
   */
  VoigtMatrix<dim> stiffness(const std::string &name) const;

  /**
   * Strain concentration tensors of KUBC or PBC of all cells. @throws UserError if there
   * are none
   */
  std::vector<double> concentration(const std::string &name) const;

  /** Concentration tensors of @p count cells from cell @p first on; reads only these. */
  std::vector<double> concentration(const std::string &name,
                                    const std::size_t first,
                                    const std::size_t count) const;

  /**
   * Stress for one kelvin without macroscopic strain under condition @p name (Pa/K) of
   * @p count cells from cell @p first on: Voigt components and, in 2D, zz, which is NaN
   * if unknown. @throws UserError if no phase has thermal expansion
   */
  std::vector<Eigen::Matrix<double, n_voigt<dim> + 1, 1>> thermal_stress(
    const std::string &name, const std::size_t first, const std::size_t count) const;

  /**
   * Thermal expansion (1/K) under condition @p name. @throws UserError if no phase has
   * thermal expansion
   */
  VoigtVector<dim> expansion(const std::string &name) const;

  /**
   * Constants of the phases with the derivatives of the stiffness @p name; empty without
   * Homogenization/Derivatives and Relative deviation. @throws UserError
   */
  std::vector<VariedConstant<dim>> variations(const std::string &name) const
  {
    return read_variations<dim>(file, name, phases.size());
  }

  /** Points and cells of a mesh. @throws UserError */
  Mesh<dim> mesh() const;

private:
  explicit RveFile(Hdf5File &&opened);

  Hdf5File file;

public:
  const std::string digest;             ///< digest of all inputs
  UniformGrid<dim> grid;                ///< grid; for a mesh its bounding box as one cell
  const std::vector<Phase<dim>> phases; ///< phases by index
  const CellMaterials materials;        ///< phase and orientation of each cell
};
} // namespace mesoslip

#endif
