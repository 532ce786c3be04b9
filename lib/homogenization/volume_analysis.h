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
/** What rve_homogenization does whatever the volume lies on. Plane grids, voxels and meshes differ in how they
 * make their morphologies and the volume elements of these. */
template <int dim>
class VolumeAnalysis : public Analysis
{
public:
  ResourceNeed need() const override;
  void describe(std::ostream &out) const override;
  void run(RunContext &context) override;
  void write_draft(const std::string &folder) const override;

protected:
  /** @p digest identifies parameters and input files; @p grid is that of the cells, unless they are those of
   * a mesh. */
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

  /** How much memory the load cases take, and what the ranks divide, for --validate. */
  virtual std::string memory() const = 0;

  /** Lines on the morphologies, for --validate, and sentences of warning on them. On rank 0. */
  virtual std::vector<std::string>
  describe_morphologies(std::vector<std::string> &warnings) const = 0;

  /** Grid or mesh of the first member, its phases, where they are and their fractions, its rectangles and
   * number of nodes; on rank 0. */
  virtual RveResults<dim> morphology() const = 0;

  /** Whether the ranks write what their cells are made of, which morphology() then leaves out in a run. */
  virtual bool are_cells_divided() const = 0;

  /** Writes what the cells of the first member are made of into room that was made for it in @p path:
   * their phases and, if @p with_orientations, which of the oriented materials they are. Collective. */
  virtual void write_cells(const std::string & /*path*/,
                           const bool /*with_orientations*/) const
  {
  }

  /** The rank that solves member @p m alone; empty: all solve it together. */
  virtual std::optional<int> owner(const unsigned int /*m*/) const
  {
    return std::nullopt;
  }

  /** Makes the morphology of member @p m, after which the one before is not needed; sets where it comes from,
   * its fractions and warnings, and returns lines for the log. Collective among the ranks that solve it;
   * what is set and returned is that of rank 0. */
  virtual std::vector<std::string> make_morphology(const unsigned int m,
                                                   EnsembleMember<dim> &member) = 0;

  /** The volume element of the morphology that was made last, of @p materials (stiffness in Pa). Collective among those that
   * solve it. */
  virtual std::unique_ptr<VolumeElement<dim>>
  make_volume(const std::vector<ElasticPhase<dim>> &materials,
              const std::function<void()> &case_done,
              Timer &timer) = 0;

  /** What the cells are made of, as LocalFields needs it: the phases, or these in all orientations of the
   * morphology that was made last. */
  virtual std::vector<LoadedPhase<dim>> materials() const
  {
    return loaded_phases<dim>(parameters.microstructure.phases);
  }

  /** A stiffness, or a change of it (Pa), of material @p material, from that of its phase. */
  virtual VoigtMatrix<dim> turned(const std::size_t /*material*/,
                                  const VoigtMatrix<dim> &of_phase) const
  {
    return of_phase;
  }

  /** The cells of member @p m and, in the order of their materials, their conductivities; on one rank, which
   * has or makes all of its morphology. */
  virtual ConductionCells<dim> cells_for_conduction(const unsigned int m) const = 0;

  /** What explains a solve that failed, or helps; empty: nothing is known. */
  virtual std::string advice(const NotConverged &failure) const;

  const RveParameters parameters;             ///< checked
  const std::string digest;                   ///< of all inputs
  const std::optional<UniformGrid<dim>> grid; ///< of the cells; empty: a mesh

private:
  /** Number of load cases of a member, but those of solve_loss(). */
  std::uint64_t n_first_cases() const
  {
    return (std::uint64_t{n_voigt<dim>} + (expands() ? 1 : 0)) *
           parameters.conditions.size();
  }

  /** Number of all of them. */
  std::uint64_t n_cases() const
  {
    return n_first_cases() + (parameters.complex_loss ? std::uint64_t{2} * n_voigt<dim> *
                                                          parameters.conditions.size()
                                                      : 0);
  }

  /** Whether a phase expands. */
  bool expands() const;

  /** Of an array with a number for each cell. */
  Shape shape() const
  {
    return grid ? shape_of_cells(*grid) : Shape{n_cells()};
  }

  /** For sentences on locking; on rank 0. */
  CellKinds kinds_of_cells() const;

  /** On the phases with mean dilatation; on rank 0. */
  std::vector<std::string> lines_of_cells() const;

  /** Sentences on what looks like another unit. */
  std::vector<std::string> slips() const;

  /** Conditions whose concentration tensors are written, in the order of their names. */
  std::vector<std::string> reserved_conditions() const;

  /** Computes conductivities of member @p m, if they are asked for, on the rank that has its results; fields are kept
   * of the first one. */
  void solve_conduction(const unsigned int m,
                        EnsembleMember<dim> &member,
                        RunContext &context);

  /** Sets the complex stiffnesses of @p member, whose load cases were solved. Collective among those that did. */
  void solve_loss(const unsigned int m, EnsembleMember<dim> &member, RunContext &context);

  /** The changes of each of these materials with the @p variations. */
  std::vector<StiffnessChanges<dim>>
  changes_of(const std::vector<LoadedPhase<dim>> &of_cells,
             const std::vector<Variation<dim>> &variations) const;

  /** Fields in rve.h5 beside the concentration tensors. */
  FurtherFields further_fields() const;

  /** Bytes of ConductionVolume on the ranks of this machine; 0: no conductivity is asked for. */
  double bytes_of_conduction(const unsigned int n_ranks) const;

  /** Makes room in rve.h5 and loads.h5 for what the ranks write of the first member; returns where the fields
   * of loads go (empty: nowhere). Collective. */
  std::string reserve_fields(const RunContext &context) const;

  /** Makes the morphology of member @p m and tells of it; @p results get that of the first one. */
  void begin_member(const unsigned int m,
                    EnsembleMember<dim> &member,
                    RveResults<dim> &results,
                    RunContext &context);

  /** Solves its load cases; fields are written of the first one, those of loads to @p loads_file. */
  void solve_member(const unsigned int m,
                    const std::string &loads_file,
                    EnsembleMember<dim> &member,
                    RunContext &context);

  /** Solves all load cases of all members. Collective; results are those of rank 0.
   * @throws NotConverged */
  RveResults<dim> compute(RunContext &context);
};

/** The analysis of volumes on a plane grid. @throws UserError */
std::unique_ptr<Analysis> make_grid_analysis(const RveParameters &parameters,
                                             const std::string &digest);

/** Collective. @throws UserError, with the number of cells that would fit, unless the machine
 * has the memory for these voxels; before anything is read but what a file says of itself */
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
