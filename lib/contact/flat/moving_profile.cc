#include "contact/flat/moving_profile.h"

#include <deal.II/base/exceptions.h>

#include <cmath>

namespace mesoslip
{
template <int dim>
MovingProfile<dim>::MovingProfile(std::shared_ptr<const FlatProfile> given,
                                  const std::array<std::vector<double>, 2> &position,
                                  const std::vector<double> &heights)
  : profile(std::move(given))
{
  AssertDimension(position[0].size(), heights.size());
  for (unsigned int i = 0; i < heights.size(); ++i)
    if (std::isfinite(heights[i]))
      {
        nodes.push_back(i);
        place[0].push_back(position[0][i]);
        place[1].push_back(dim == 3 ? position[1][i] : 0.);
        height.push_back(heights[i]);
      }
}

template <int dim>
void MovingProfile<dim>::start(double *gap) const
{
  for (std::size_t k = 0; k < nodes.size(); ++k)
    gap[nodes[k]] = height[k] - (*profile)(place[0][k], place[1][k]);
}

template <int dim>
void MovingProfile<dim>::start_rise(const std::array<double, 2> &moved,
                                    const ContactArrays &contact) const
{
  using Arrays = ContactArrays;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    {
      const unsigned int i = nodes[k];
      const double x = place[0][k] + moved[0] - contact.column[Arrays::increment_x][i],
                   y = dim == 2 ? 0.
                                : place[1][k] + moved[1] -
                                    contact.column[Arrays::lateral_increment][i];
      contact.column[Arrays::rise][i] =
        height[k] - (*profile)(x, y) - contact.column[Arrays::gap][i];
    }
}

template <int dim>
void MovingProfile<dim>::advance(const SurfaceView<dim> &surface,
                                 const std::array<double, 2> &moved,
                                 const ContactArrays &contact)
{
  using Arrays = ContactArrays;
  double *gap = contact.column[Arrays::gap], *rise = contact.column[Arrays::rise],
         *rise_before = contact.column[Arrays::rise_before];
  for (unsigned int d = 0; d < 2; ++d)
    way[d] += moved[d];
  for (std::size_t k = 0; k < nodes.size(); ++k)
    {
      const unsigned int i = nodes[k];
      const double x       = place[0][k] + surface.u[0][i] +
                       contact.column[Arrays::increment_x][i] - way[0],
                   y    = dim == 2 ? 0.
                                   : place[1][k] + surface.u[1][i] +
                                    contact.column[Arrays::lateral_increment][i] - way[1],
                   next = height[k] - (*profile)(x, y);
      rise_before[i]    = rise[i];
      rise[i]           = gap[i] - next;
      gap[i]            = next;
    }
}

template class MovingProfile<2>;
template class MovingProfile<3>;
} // namespace mesoslip
