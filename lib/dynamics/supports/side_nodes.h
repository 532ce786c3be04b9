#ifndef mesoslip_dynamics_side_nodes_h
#define mesoslip_dynamics_side_nodes_h

#include "base/serialize_members.h"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace mesoslip
{
/** Area, position and impedance of each node of a side. */
struct SideNodes
{
  /** Placeholder of an empty place, as SharedNodes::none. */
  static constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

  std::vector<double> area; ///< m^2, in 2D m

  /**
   * Force of a pressure of 1 Pa, components x, y and z: area times normal into the body
   * (m^2, in 2D m); empty components are 0.
   */
  std::array<std::vector<double>, 3> push;

  /**
   * Positions of the nodes, x, y and z (m), if there is a traction; empty components are
   * 0.
   */
  std::array<std::vector<double>, 3> position;

  /**
   * For absorbing sides: component (r, c) of the impedance of the phases at the side in
   * [dim r + c] (Pa s/m).
   */
  std::vector<std::vector<double>> impedance;

  /** Position of node @p i (m). */
  std::array<double, 3> place_of(const std::size_t i) const
  {
    std::array<double, 3> place = {};
    for (unsigned int c = 0; c < 3; ++c)
      if (!position[c].empty())
        place[c] = position[c][i];
    return place;
  }

  /** Component @p c of the force of a pressure of 1 Pa on node @p i (m^2, in 2D m). */
  double push_of(const std::size_t i, const unsigned int c) const
  {
    return push[c].empty() ? 0. : push[c][i];
  }

  /** Data of the nodes @p numbers, in this order; zeros for none. */
  SideNodes at(const std::vector<unsigned int> &numbers) const;

  /** Area of the first @p n nodes, or of all (m^2, in 2D m). */
  double whole_area(const std::size_t n = none) const;

  /** Force of a pressure of 1 Pa on the first @p n nodes, or on all (m^2, in 2D m). */
  std::array<double, 3> whole_push(const std::size_t n = none) const;

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<4>(archive, *this);
  }
};
} // namespace mesoslip

#endif
