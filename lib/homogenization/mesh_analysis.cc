#include "base/object_exchange.h"
#include "homogenization/volume_analysis.h"
#include "homogenization/volumes/mesh_volume.h"
#include "program/machine.h"

#include <algorithm>
#include <filesystem>

namespace mesoslip
{
namespace
{
/** Bytes per node on all ranks together, measured with ML: cells, matrix, hierarchy, load
 * cases. */
template <int dim>
constexpr double bytes_per_node = dim == 2 ? 3400. : 15000.;
/** Additional bytes per node if several boundary conditions or members are computed one
 * after the other. */
template <int dim>
constexpr double bytes_of_several = dim == 2 ? 1200. : 6000.;

/** Number of nodes for displacements of @p degree; for degree 2 estimated by Euler's
 * formulas. */
template <int dim>
std::uint64_t n_nodes(const Mesh<dim> &mesh, const unsigned int degree)
{
  auto n = static_cast<double>(mesh.points.size());
  for (const Cell &cell : mesh.cells)
    if (degree > 1)
      n += cell.vertices.size() == dim + 1 ? (dim == 2 ? 1.5 : 1.) : (dim == 2 ? 3. : 7.);
  return static_cast<std::uint64_t>(n);
}

template <int dim>
class MeshVolumeAnalysis : public VolumeAnalysis<dim>
{
public:
  MeshVolumeAnalysis(const RveParameters &given, const std::string &digest_of_inputs)
    : VolumeAnalysis<dim>(given, digest_of_inputs, std::nullopt)
  {
    on_root(MPI_COMM_WORLD, [this]() { read_all(); });
    broadcast_object(MPI_COMM_WORLD, sizes);
    require_memory({share_of_this_machine() * bytes_of_volume(),
                    "take a coarser mesh or more machines"});
  }

protected:
  std::size_t n_cells() const override
  {
    return sizes[1];
  }

  std::string memory() const override
  {
    return std::to_string(static_cast<unsigned long>(150 + 1e-6 * bytes_of_volume())) +
           " MB, divided among the ranks";
  }

  std::vector<std::string>
  describe_morphologies(std::vector<std::string> &warnings) const override
  {
    std::vector<std::string> lines;
    for (const MeshMorphology<dim> &volume : volumes)
      {
        lines.insert(lines.end(), volume.description.begin(), volume.description.end());
        for (const std::string &line : periodicity_lines(volume.mesh))
          lines.push_back(line);
        warnings.insert(warnings.end(), volume.warnings.begin(), volume.warnings.end());
      }
    return lines;
  }

  RveResults<dim> morphology() const override
  {
    RveResults<dim> results;
    RveContent<dim> &content = results.first;
    content.mesh             = &volumes[0].mesh;
    content.phases           = volumes[0].phases;
    content.fractions        = volumes[0].fractions;
    for (const auto &cell : content.mesh->cells)
      content.phase_id.push_back(static_cast<std::uint8_t>(cell.material_id));
    results.n_nodes = sizes[0];
    return results;
  }

  bool has_simplices() const override
  {
    return std::any_of(volumes.begin(), volumes.end(), [](const auto &volume) {
      return mesoslip::has_simplices(volume.mesh);
    });
  }

  bool are_cells_divided() const override
  {
    return false;
  }

  std::vector<std::string> make_morphology(const unsigned int m,
                                           EnsembleMember<dim> &member) override
  {
    number = m;
    if (volumes.empty())
      return {}; // rank other than 0
    const MeshMorphology<dim> &volume = volumes[m];
    member.origin    = "mesh " + std::filesystem::path(volume.file).filename().string();
    member.warnings  = volume.warnings;
    member.fractions = volume.fractions;
    std::vector<std::string> lines = volume.description;
    if (parameters.mesh.degree > 1)
      lines.push_back("Quadratic displacements (Mesh/Degree), about " +
                      std::to_string(n_nodes(volume.mesh, 2)) + " nodes");
    lines.push_back(std::string("Solver: conjugate gradients with the multigrid ") +
                    AlgebraicMultigrid::name());
    return lines;
  }

  std::unique_ptr<VolumeElement<dim>>
  make_volume(const std::vector<ElasticPhase<dim>> &phases,
              const std::function<void()> & /*case_done*/,
              Timer & /*timer*/) override
  {
    const Mesh<dim> none; // for ranks other than 0
    return std::make_unique<MeshVolume<dim>>(
      volumes.empty() ? none : volumes[number].mesh, phases, MPI_COMM_WORLD,
      parameters.mesh.degree);
  }

  ConductionCells<dim> cells_for_conduction(const unsigned int m) const override
  {
    ConductionCells<dim> cells = conduction_cells(volumes[m].mesh);
    for (const PhaseParameters &phase : parameters.microstructure.phases)
      cells.conductivity.push_back(phase.conductivity<dim>());
    return cells;
  }

private:
  using VolumeAnalysis<dim>::parameters;

  /** Memory of the first mesh on all ranks together (bytes). */
  double bytes_of_volume() const
  {
    const bool several  = parameters.conditions.size() > 1 || parameters.n_members > 1;
    const double more   = several ? bytes_of_several<dim> : 0.;
    const double denser = parameters.mesh.degree > 1 ? 1.12 : 1.; // matrices are denser
    return denser * (bytes_per_node<dim> + more) * static_cast<double>(sizes[0]);
  }

  // Reads all meshes first, so that errors in a later mesh appear before any computation.
  void read_all()
  {
    const bool periodic = std::count(parameters.conditions.begin(),
                                     parameters.conditions.end(), BoundaryCondition::PBC);
    for (const std::string &file : parameters.mesh.files)
      try
        {
          volumes.push_back(
            read_mesh<dim>(parameters.mesh, file, parameters.microstructure.phases));
          require_volume(volumes.back().mesh, periodic);
          if (!volumes.back().mesh.bulges.empty() &&
              !parameters.microstructure.phases[0].conductivities.empty())
            volumes.back().warnings.push_back(
              "the conductivity of " + file +
              " is computed on linear cells with straight sides, other than its "
              "stiffness, and so converges with order 2");
        }
      catch (const UserError &e)
        {
          const std::string said = e.what();
          const bool names_it    = said.find(file) != std::string::npos;
          throw UserError(names_it ? said : file + " of " + said);
        }
    sizes = {n_nodes(volumes[0].mesh, parameters.mesh.degree),
             volumes[0].mesh.cells.size()};
  }

  std::vector<MeshMorphology<dim>> volumes; ///< on rank 0
  unsigned int number = 0;                  ///< current member

  /** Broadcasts points and cells of the first mesh. */
  std::vector<std::uint64_t> sizes = {0, 0};
};
} // namespace

template <int dim>
std::unique_ptr<Analysis> make_mesh_analysis(const RveParameters &parameters,
                                             const std::string &digest)
{
  return std::make_unique<MeshVolumeAnalysis<dim>>(parameters, digest);
}

template std::unique_ptr<Analysis> make_mesh_analysis<2>(const RveParameters &,
                                                         const std::string &);
template std::unique_ptr<Analysis> make_mesh_analysis<3>(const RveParameters &,
                                                         const std::string &);
} // namespace mesoslip
