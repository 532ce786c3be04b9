#include "dynamics/shared_nodes.h"

#include "grid/nodal_field.h"

#include <algorithm>

namespace mesoslip
{
template <int dim>
SharedNodes::SharedNodes(const std::vector<unsigned int> &points,
                         const MeshPart<dim> &part)
{
  const PointIndex index(part, points);
  for (const bool copies : {false, true})
    {
      for (unsigned int k = 0; k < points.size(); ++k)
        for (const unsigned int i : index.find(points[k]))
          {
            if ((i >= part.n_distinct) != copies)
              continue;
            if (copies && place.size() == owned)
              {
                place.resize(whole_vectors<double>(owned), none);
                local.resize(place.size(), none);
              }
            place.push_back(k);
            local.push_back(i);
          }
      if (!copies)
        owned = size();
    }
}

std::vector<double> SharedNodes::of(const std::vector<double> &whole,
                                    const double otherwise) const
{
  std::vector<double> values;
  for (const unsigned int k : place)
    values.push_back(k == none ? otherwise : whole[k]);
  return values;
}

std::optional<unsigned int> SharedNodes::find(const unsigned int of_whole) const
{
  const auto found = std::find(place.begin(), place.end(), of_whole);
  return found == place.end() ? std::nullopt
                              : std::optional<unsigned int>(found - place.begin());
}

template SharedNodes::SharedNodes(const std::vector<unsigned int> &, const MeshPart<2> &);
template SharedNodes::SharedNodes(const std::vector<unsigned int> &, const MeshPart<3> &);
} // namespace mesoslip
