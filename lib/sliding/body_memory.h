#ifndef mesoslip_sliding_body_memory_h
#define mesoslip_sliding_body_memory_h

#include "base/serialize_members.h"
#include "grid/uniform_grid.h"
#include "mesh/mesh.h"
#include "sliding/contact_parameters.h"

#include <string>

namespace mesoslip
{
/** Memory that an analysis takes for its body, without histories and libraries (bytes, as
 * measured). */
struct BodyMemory
{
  double on_rank_0 = 0.; ///< only on rank 0, such as the mesh that it reads
  double divided   = 0.; ///< divided among the ranks
  double on_each   = 0.; ///< replicated on every rank

  /** Memory of a rank other than 0 out of @p n_ranks. Ghost points add a fifth to the
   * divided part. */
  double on_other_rank(const unsigned int n_ranks) const
  {
    return (n_ranks > 1 ? 1.2 : 1.) * divided / n_ranks + on_each;
  }

  /** Memory on the machine of rank 0, which runs @p n_here of all @p n_ranks. */
  double on_machine(const unsigned int n_here, const unsigned int n_ranks) const
  {
    return on_rank_0 + n_here * on_other_rank(n_ranks);
  }

  /** "1.2 GB of memory", with several ranks "400 MB of memory on rank 0, 300 MB on each
   * other". */
  std::string text(const unsigned int n_ranks) const;

  /** Reads or writes all members, for broadcast_object(). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/** Memory of the analysis in @p parameters for a body on @p mesh, by cell kind. */
template <int dim>
BodyMemory memory_on_mesh(const ContactParameters &parameters, const Mesh<dim> &mesh);

/** Memory for a box of voxels. Time steps need only the mesh of the boundary cells, on
 * rank 0. */
BodyMemory memory_of_box(const ContactParameters &parameters, const UniformGrid<3> &grid);
} // namespace mesoslip

#endif
