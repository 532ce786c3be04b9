#ifndef mesoslip_homogenization_volume_analysis_h
#define mesoslip_homogenization_volume_analysis_h

#include "exchange/datasets.h"
#include "exchange/rve_file.h"
#include "homogenization/conduction/conduction_cells.h"
#include "homogenization/derivatives/variations.h"
#include "homogenization/rve_program.h"
#include "homogenization/volumes/volume_element.h"
#include "material/plausibility.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** The analysis of rve_homogenization, independent of the discretization. Derived classes
 * for plane grids, voxels and meshes make the morphologies and their volume elements. */
template <int dim>
class VolumeAnalysis : public Analysis
{
public:
  ResourceNeed need() const override;
  void describe(std::ostream &out) const override;
  void run(RunContext &context) override;
  void write_draft(const std::string &folder) const override;

protected:
  /** @p digest identifies parameters and input files; @p grid is the grid of the cells,
   * empty for a mesh. */
  VolumeAnalysis(const RveParameters &parameters,
                 const std::string &digest,
                 const std::optional<UniformGrid<dim>> &grid)
    : parameters(parameters)
    , digest(digest)
    , grid(grid)
  {
  }

  /** Number of cells of the first member. */
  virtual std::size_t n_cells() const
  {
    return grid->n_cells();
  }

  /** Whether some cells are triangles or tetrahedra; on rank 0. */
  virtual bool has_simplices() const
  {
    return false;
  }

  /** Memory of the load cases and its division among the ranks, as text for
   * --validate. */
  virtual std::string memory() const = 0;

  /** Lines on the morphologies for --validate; appends to @p warnings. On rank 0. */
  virtual std::vector<std::string>
  describe_morphologies(std::vector<std::string> &warnings) const = 0;

  /** Grid or mesh of the first member with its phases, phase map, volume fractions,
   * rectangles and number of nodes; on rank 0. */
  virtual RveResults<dim> morphology() const = 0;

  /** Whether each rank writes the phases of its cells; morphology() then leaves them out
   * in a run. */
  virtual bool are_cells_divided() const = 0;

  /** Writes phases and, if @p with_orientations, material numbers of the cells of the
   * first member into the datasets reserved in @p path. Collective. */
  virtual void write_cells(const std::string & /*path*/,
                           const bool /*with_orientations*/) const
  {
  }

  /** The rank that solves member @p m alone; empty: all ranks solve it together. */
  virtual std::optional<int> owner(const unsigned int /*m*/) const
  {
    return std::nullopt;
  }

  /** Makes the morphology of member @p m and releases the morphology before it. Sets
   * origin, fractions and warnings of @p member, and returns lines for the log.
   * Collective among the ranks that solve the member; results are valid on rank 0. */
  virtual std::vector<std::string> make_morphology(const unsigned int m,
                                                   EnsembleMember<dim> &member) = 0;

  /** The volume element of the current morphology with @p materials (stiffness in Pa).
   * Collective among the ranks that solve it. */
  virtual std::unique_ptr<VolumeElement<dim>>
  make_volume(const std::vector<ElasticPhase<dim>> &materials,
              const std::function<void()> &case_done,
              Timer &timer) = 0;

  /** Materials of the cells as LocalFields needs them: the phases, or the phases in all
   * orientations of the current morphology. */
  virtual std::vector<LoadedPhase<dim>> materials() const
  {
    return loaded_phases<dim>(parameters.microstructure.phases);
  }

  /** Rotates a stiffness or its change (Pa) from the axes of the phase to the orientation
   * of @p material. */
  virtual VoigtMatrix<dim> turned(const std::size_t /*material*/,
                                  const VoigtMatrix<dim> &of_phase) const
  {
    return of_phase;
  }

  /** The cells of member @p m and their conductivities by material; on one rank, which
   * holds or makes the whole morphology. */
  virtual ConductionCells<dim> cells_for_conduction(const unsigned int m) const = 0;

  /** Likely cause or remedy of a failed solve; empty: unknown. */
  virtual std::string advice(const NotConverged &failure) const;

  const RveParameters parameters;             ///< checked
  const std::string digest;                   ///< digest of all inputs
  const std::optional<UniformGrid<dim>> grid; ///< grid of the cells; empty: a mesh

private:
  /** Number of load cases of a member without the cases of solve_loss(). */
  std::uint64_t n_first_cases() const
  {
    return (std::uint64_t{n_voigt<dim>} + (expands() ? 1 : 0)) *
           parameters.conditions.size();
  }

  /** Number of all load cases of a member. */
  std::uint64_t n_cases() const
  {
    return n_first_cases() + (parameters.complex_loss ? std::uint64_t{2} * n_voigt<dim> *
                                                          parameters.conditions.size()
                                                      : 0);
  }

  /** Whether a phase expands. */
  bool expands() const;

  /** Shape of an array with a number for each cell. */
  Shape shape() const
  {
    return grid ? shape_of_cells(*grid) : Shape{n_cells()};
  }

  /** Kinds of cells for sentences on locking; on rank 0. */
  CellKinds kinds_of_cells() const;

  /** Lines on the phases with mean dilatation; on rank 0. */
  std::vector<std::string> lines_of_cells() const;

  /** Warnings on values that look like another unit. */
  std::vector<std::string> slips() const;

  /** Conditions whose concentration tensors are written, sorted by name. */
  std::vector<std::string> reserved_conditions() const;

  /** Computes the conductivities of member @p m, if asked for, on the rank that holds its
   * results; keeps the fields of the first member. */
  void solve_conduction(const unsigned int m,
                        EnsembleMember<dim> &member,
                        RunContext &context);

  /** Computes the complex stiffnesses of @p member from solved load cases. Collective
   * among the ranks that solved them. */
  void solve_loss(const unsigned int m, EnsembleMember<dim> &member, RunContext &context);

  /** Changes of each material in @p of_cells along the @p variations. */
  std::vector<StiffnessChanges<dim>>
  changes_of(const std::vector<LoadedPhase<dim>> &of_cells,
             const std::vector<Variation<dim>> &variations) const;

  /** Fields in rve.h5 beside the concentration tensors. */
  FurtherFields further_fields() const;

  /** Bytes of ConductionVolume on the ranks of this machine; 0: no conductivity is asked for. */
  double bytes_of_conduction(const unsigned int n_ranks) const;

  /** Reserves rve.h5 and loads.h5 for the rows of the first member that the ranks write.
   * @return the file for load fields, empty if there are none. Collective. */
  std::string reserve_fields(const RunContext &context) const;

  /** Makes the morphology of member @p m and logs it; stores the first morphology in
   * @p results. */
  void begin_member(const unsigned int m,
                    EnsembleMember<dim> &member,
                    RveResults<dim> &results,
                    RunContext &context);

  /** Solves all load cases of @p member; writes the fields of the first member, load
   * fields into @p loads_file. */
  void solve_member(const unsigned int m,
                    const std::string &loads_file,
                    EnsembleMember<dim> &member,
                    RunContext &context);

  /** Solves all load cases of all members. Collective; results are valid on rank 0.
   * @throws NotConverged */
  RveResults<dim> compute(RunContext &context);
};

/** The analysis of volumes on a plane grid. @throws UserError */
std::unique_ptr<Analysis> make_grid_analysis(const RveParameters &parameters,
                                             const std::string &digest);

/** Checks that the machine has the memory for these voxels; reads file headers only.
 * Collective.
 * @throws UserError with the number of cells that would fit */
void require_voxel_memory(const RveParameters &parameters);

/** The analysis of volumes of voxels. Collective. @throws UserError */
std::unique_ptr<Analysis> make_voxel_analysis(const RveParameters &parameters,
                                              const std::string &digest);

/** The analysis of volumes on meshes. Collective. @throws UserError */
template <int dim>
std::unique_ptr<Analysis> make_mesh_analysis(const RveParameters &parameters,
                                             const std::string &digest);
} // namespace mesoslip

#endif
