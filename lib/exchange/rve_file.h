#ifndef mesoslip_exchange_rve_file_h
#define mesoslip_exchange_rve_file_h

#include "exchange/orientation_datasets.h"
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
/** Format of rve.h5 and its newest version. */
inline constexpr char rve_format[] = "mesoslip-rve";
inline constexpr int newest_rve_version =
  2; ///< of files with orientations of cells; else 1

/** What rve_homogenization leaves in rve.h5. */
template <int dim>
struct RveContent
{
  std::string digest;              ///< of the inputs that determine the content
  std::string summary;             ///< JSON
  UniformGrid<dim> grid;           ///< of the morphology, unless it is a mesh
  const Mesh<dim> *mesh = nullptr; ///< null: it is a grid
  std::vector<Phase<dim>> phases;  ///< by index
  std::vector<double> fractions;   ///< volume fractions of the phases, stored with a mesh

  /** Phase of each cell, on a grid x fastest; empty: in the file since write_cell_planes(), as the id
   * of orientations. */
  std::vector<std::uint8_t> phase_id;

  /** Number of cells. */
  std::size_t n_cells() const
  {
    return mesh != nullptr ? mesh->cells.size() : grid.n_cells();
  }

  Orientations orientations; ///< of the cells, in 3D, where they differ within a phase

  /** What the cells are made of, and the volume fraction of each: the phases, or these in
   * all their orientations. */
  std::pair<std::vector<Phase<dim>>, std::vector<double>> constituents() const;

  std::map<std::string, VoigtMatrix<dim>> stiffness; ///< KUBC, SUBC, PBC, effective (Pa)

  std::map<std::string, VoigtVector<dim>>
    expansion; ///< the same (1/K); empty: nothing expands

  /** Conductivities [dim][dim] by condition, and "effective"; empty: not asked for. */
  std::map<std::string, std::vector<double>> conductivity;

  /** Conditions whose concentration tensors are in the file since reserve_concentration(). */
  std::vector<std::string> reserved;
};

/** The dataset of the concentration tensors of KUBC, SUBC or PBC. */
std::string concentration_dataset(const std::string &condition);

/** The dataset of the stresses of one kelvin without macroscopic strain (SUBC: stress). */
std::string thermal_stress_dataset(const std::string &condition);

/** In 2D that of sigma_zz of one kelvin, which is there if it is known of all phases. */
std::string transverse_thermal_stress_dataset(const std::string &condition);

/** The dataset of the mean gradients of cells for unit gradients (SUBC: fluxes for unit fluxes). */
std::string conduction_dataset(const std::string &condition);

/** Fields in rve.h5 beside the concentration tensors. */
struct FurtherFields
{
  bool thermal_stress            = false; ///< thermal_stress_dataset()
  bool transverse_thermal_stress = false; ///< the one of zz
  bool conduction                = false; ///< conduction_dataset()
};

/**
 * Begins rve.h5, of which @p path is the name, and leaves it, with room for the concentration tensors of all
 * cells under @p conditions, which ParallelRows fills before write_rve_file() adds the rest: in Voigt
 * components of strain (KUBC, PBC, MUBC: row local, column macroscopic) or stress (SUBC). @p cells is the
 * shape of an array with a number for each cell: the datasets are [ny][nx][3][3] or [nz][ny][nx][6][6] on a
 * grid, [n][3][3] or [n][6][6] on a mesh. @p further says what there is room for besides.
 */
template <int dim>
void reserve_concentration(const std::string &path,
                           const Shape &cells,
                           const std::vector<std::string> &conditions,
                           const FurtherFields &further = {});

/**
 * Writes rve.h5, of which @p path is the name, and `NAME.xdmf` for ParaView beside it.
 */
template <int dim>
void write_rve_file(const std::string &path, const RveContent<dim> &content);

/** Summary (JSON) of the run that wrote the rve.h5 at @p path; empty if it holds none. */
std::string read_rve_summary(const std::string &path);

/** The dimension that an exchange file states. @throws UserError with @p hint if there is
 * no such file */
unsigned int dimension_of_file(const std::string &path, const std::string &hint);

/**
 * rve.h5 opened for reading: format, version, shapes, phase numbers and finiteness are
 * checked, and every error names the file, the dataset and what to run. The small data
 * are read at once, the fields when they are asked for.
 */
template <int dim>
class RveFile
{
public:
  /** Opens for reading. @throws UserError */
  explicit RveFile(const std::string &path)
    : RveFile(Hdf5File::open(path, "run rve_homogenization first"))
  {
  }

  /** Opens what rank 0 has opened. @throws UserError */
  static RveFile open_too(const std::string &path)
  {
    return RveFile(Hdf5File::open_too(path));
  }

  /** The path given. */
  const std::string &path() const
  {
    return file.path();
  }

  /** A sentence if rve_homogenization did not write it as it is, or wrote it as a draft; else
   * empty. */
  std::string change_note() const;

  /** What tells its content from that of others, also where it was edited. */
  std::string content() const
  {
    return digest + file.changed_content();
  }

  /** Whether the volume is a mesh. */
  bool is_mesh() const
  {
    return file.exists("/mesh");
  }

  /** @throws UserError if the volume is a mesh, of which @p nothing can be taken. */
  void require_grid(const std::string &nothing) const;

  /** What the cells are made of: the phases, or these in all their orientations. */
  std::vector<Phase<dim>> constituents() const
  {
    return oriented_phases(phases, materials.oriented);
  }

  /** Which of the constituents @p count cells from number @p first on are made of. @throws
   * UserError */
  std::vector<std::uint16_t> constituent_ids(const std::size_t first,
                                             const std::size_t count) const
  {
    return materials.of_cells(file, first, count);
  }

  /** The same of the cells of @p block of a grid, x fastest. @throws UserError */
  std::vector<std::uint16_t> constituent_ids(const CellBlock<dim> &block) const
  {
    return materials.of_cells(file, block);
  }

  /** Volume mean of the density (kg/m^3). */
  double mean_density() const;

  /** KUBC, SUBC, PBC or effective (Pa). @throws UserError when it was not computed. */
  VoigtMatrix<dim> stiffness(const std::string &name) const;

  /** Strain concentration tensors of KUBC or PBC of all cells. @throws UserError without
   * them */
  std::vector<double> concentration(const std::string &name) const;

  /** Those of @p count cells from cell @p first on; only these are read. */
  std::vector<double> concentration(const std::string &name,
                                    const std::size_t first,
                                    const std::size_t count) const;

  /** Stress for one kelvin without macroscopic strain under condition @p name (Pa/K) of @p count cells from cell
   * @p first on: components in Voigt order and, in 2D, zz, NaN where it is not known. @throws
   * UserError if no phase expands */
  std::vector<Eigen::Matrix<double, n_voigt<dim> + 1, 1>> thermal_stress(
    const std::string &name, const std::size_t first, const std::size_t count) const;

  /** Thermal expansion (1/K) under condition @p name. @throws UserError if no phase expands */
  VoigtVector<dim> expansion(const std::string &name) const;

  /** The points and cells of a mesh. @throws UserError */
  Mesh<dim> mesh() const;

private:
  explicit RveFile(Hdf5File &&opened);

  Hdf5File file;

public:
  const std::string digest; ///< of the inputs that determine the content
  UniformGrid<dim> grid;    ///< of the morphology; of a mesh its box as one cell
  const std::vector<Phase<dim>> phases; ///< by index
  const CellMaterials materials;        ///< which phase, in which orientation, cells are
};
} // namespace mesoslip

#endif
