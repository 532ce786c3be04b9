#ifndef mesoslip_sliding_mesh_mesh_analysis_h
#define mesoslip_sliding_mesh_mesh_analysis_h

#include "body/mesh/mesh_body.h"
#include "dynamics/deformation.h"
#include "program/program.h"
#include "sliding/contact_parameters.h"
#include "sliding/mesh/body_memory.h"

#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/** What the analyses of a body on a mesh have in common. */
template <int dim>
class MeshAnalysis : public Analysis
{
public:
  /**
   * Rank 0 reads the mesh; all know what is described of it. @throws UserError for input
   * that no analysis can work with
   */
  explicit MeshAnalysis(const ContactParameters &given);

  /** Mesh, boundaries, degrees of freedom, memory and warnings. */
  void describe(std::ostream &out) const override;

protected:
  /** Writes mesh and boundaries to the log, with warnings. */
  void log_body(RunContext &context) const;

  /** Puts analysis, material and size of the body into summary.json. */
  void summarize_body(const std::string &analysis, RunContext &context) const;

  /** The body for statics and modes, with fields that are divided among the ranks. Collective. */
  std::unique_ptr<MeshBody<dim>> divide_body() const;

  /** The same with whole fields; then all ranks hold the whole mesh. Collective. */
  std::unique_ptr<MeshBody<dim>> make_whole_body() const;

  /** What groups of faces and top hold, of a platen the normal component as well. */
  DofMask held_by_mesh(const TopSetup &top, const MeshBody<dim> &elastic) const;

  /** "cell 12 around x = 1.25 mm, y = 0.05 mm". */
  static std::string place_of_cell(const CellExtreme &cell);

  /** Puts the contact nodes of the description into the order of @p elastic. */
  void order_contact(const MeshBody<dim> &elastic);

  const ContactParameters parameters; ///< all of them, checked
  /** On rank 0; of a box that is advanced in time all ranks have what reads its cells. */
  MeshMorphology<dim> morphology;
  MeshBodyDescription body;              ///< the same on all ranks
  std::vector<ElasticPhase<dim>> phases; ///< of the cells, the same on all ranks
  BodyMemory memory;                     ///< to which analyses add what they need

private:
  std::vector<std::string> lines() const;
  MeshBodyInput<dim> input_without_mesh() const;
};
} // namespace mesoslip

#endif
