#ifndef mesoslip_sliding_pair_grid_mesh_h
#define mesoslip_sliding_pair_grid_mesh_h

#include "exchange/run_description.h"
#include "sliding/mesh/body_mesh.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** A plane grid as a mesh, with the groups Left, Right, Contact and Top (a counter body:
 * Bottom and Contact); its files have the format of a grid. */
class GridMesh : public BodyMesh<2>
{
public:
  BodyMemory read(const ContactParameters &parameters,
                  const unsigned int n_here,
                  const unsigned int n_ranks) override;

  std::string format_ending() const override
  {
    return "";
  }

  void write_cells(Hdf5File &to) const override;
  Shape vectors_shape() const override;
  void show(const std::string &path,
            const std::vector<XdmfField> &fields,
            const std::vector<double> &times) const override;

private:
  void make_mesh();
  void name_sides();

  BodyDescription body; ///< on rank 0
};
} // namespace mesoslip

#endif
