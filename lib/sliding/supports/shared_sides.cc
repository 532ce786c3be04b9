#include "sliding/supports/shared_sides.h"

#include <array>
#include <map>
#include <utility>

namespace mesoslip
{
namespace
{
/** For each point: surface that moves it, and its index there. */
using Movers = std::map<unsigned int, std::array<unsigned int, 2>>;

/** Makes surface @p host move the @p points that no earlier surface moves. */
void take(Movers &movers,
          const std::vector<unsigned int> &points,
          const unsigned int host)
{
  for (unsigned int k = 0; k < points.size(); ++k)
    movers.insert({points[k], {{host, k}}});
}

/** Puts the nodes that the side itself moves into @p side.
 * @return their numbers in the whole side */
std::vector<unsigned int> own_nodes(SharedSide &side,
                                    const std::vector<unsigned int> &of_own)
{
  std::vector<unsigned int> numbers;
  for (unsigned int i = 0; i < side.own.size(); ++i)
    {
      const unsigned int number = side.own.number(i);
      numbers.push_back(number == SharedNodes::none ? number : of_own[number]);
      side.here.counted.push_back(i < side.own.n_owned());
    }
  return numbers;
}
} // namespace

template <int dim>
SharedSurfaces::SharedSurfaces(const std::vector<unsigned int> &contact_points,
                               const std::vector<unsigned int> &top_points,
                               const std::vector<LoadedSide> &loaded,
                               const MeshPart<dim> &part)
  : contact(contact_points, part)
  , top(top_points, part)
{
  Movers movers;
  take(movers, contact_points, 0);
  take(movers, top_points, 1);
  for (const LoadedSide &side : loaded)
    {
      std::vector<unsigned int> own, of_own, of_guests;
      for (unsigned int k = 0; k < side.points.size(); ++k)
        if (movers.count(side.points[k]) > 0)
          of_guests.push_back(k);
        else
          {
            own.push_back(side.points[k]);
            of_own.push_back(k);
          }
      SharedSide here = {
        SharedNodes(own, part), {side.support, {}, {}, {}, side.moves}, {}};
      std::vector<unsigned int> numbers = own_nodes(here, of_own);
      for (const unsigned int k : of_guests)
        {
          const auto [h, number] = movers.at(side.points[k]);
          for (unsigned int i = 0; i < host(h).size(); ++i)
            if (host(h).number(i) == number)
              {
                here.guests.push_back({h, i, static_cast<unsigned int>(numbers.size())});
                here.here.counted.push_back(i < host(h).n_owned());
                numbers.push_back(k);
              }
        }
      here.here.nodes = side.nodes.at(numbers);
      take(movers, own, static_cast<unsigned int>(2 + sides.size()));
      sides.push_back(std::move(here));
    }
}

template SharedSurfaces::SharedSurfaces(const std::vector<unsigned int> &,
                                        const std::vector<unsigned int> &,
                                        const std::vector<LoadedSide> &,
                                        const MeshPart<2> &);
template SharedSurfaces::SharedSurfaces(const std::vector<unsigned int> &,
                                        const std::vector<unsigned int> &,
                                        const std::vector<LoadedSide> &,
                                        const MeshPart<3> &);
} // namespace mesoslip
