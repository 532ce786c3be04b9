#ifndef mesoslip_sliding_body_memory_h
#define mesoslip_sliding_body_memory_h

#include "base/serialize_members.h"
#include "grid/uniform_grid.h"
#include "mesh/mesh.h"
#include "sliding/contact_parameters.h"

#include <string>

namespace mesoslip
{
/** Memory that an analysis takes for its body, without histories and libraries (bytes, as measured). */
struct BodyMemory
{
  double on_rank_0 = 0.; ///< what only rank 0 has, such as the mesh that it reads
  double divided   = 0.; ///< what the ranks divide among themselves
  double on_each   = 0.; ///< what every rank has

  /** Of each of @p n_ranks but the first. Together they have points of neighbours as well, which takes
   * a fifth more. */
  double on_other_rank(const unsigned int n_ranks) const
  {
    return (n_ranks > 1 ? 1.2 : 1.) * divided / n_ranks + on_each;
  }

  /** Of the machine of rank 0, which has @p n_here of all @p n_ranks. */
  double on_machine(const unsigned int n_here, const unsigned int n_ranks) const
  {
    return on_rank_0 + n_here * on_other_rank(n_ranks);
  }

  /** "1.2 GB of memory", of several ranks "400 MB of memory on rank 0, 300 MB on each other". */
  std::string text(const unsigned int n_ranks) const;

  /** Reads or writes all members, for broadcast_object(). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/** What the analysis that @p parameters ask for takes for a body on @p mesh, by the kinds of its cells. */
template <int dim>
BodyMemory memory_on_mesh(const ContactParameters &parameters, const Mesh<dim> &mesh);

/** The same for a box of voxels, of which steps need no mesh but that of rank 0 at the sides. */
BodyMemory memory_of_box(const ContactParameters &parameters, const UniformGrid<3> &grid);
} // namespace mesoslip

#endif
