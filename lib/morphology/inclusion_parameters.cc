#include "base/errors.h"
#include "morphology/random_inclusions.h"
#include "parameters/keys.h"

#include <algorithm>
#include <array>

namespace mesoslip
{
namespace
{
const std::vector<std::string> shape_names = {"spheres", "ellipsoids", "cylinders",
                                              "bars"};

[[noreturn]] void refuse_key(const std::string &key, const std::string &what)
{
  throw UserError(random_inclusions_section + "/" + key + ": " + what);
}

void bind_sizes(Keys &keys, InclusionPlacement &p)
{
  keys.bind("Minimum diameter", p.min_diameter, Range::length(),
            "Smallest diameter of a sphere or cylinder, edge of the cross section of a "
            "bar; of an ellipsoid the diameter along an own axis whose ratio is 1. "
            "Diameters are uniformly distributed in [Minimum diameter, Maximum diameter] "
            "[m]");
  keys.bind("Maximum diameter", p.max_diameter, Range::length(), "Largest of them [m]");
  keys.bind(
    "Minimum length", p.min_length, Range::non_negative(),
    "Cylinders, bars: smallest length along Axis; lengths are uniformly "
    "distributed in [Minimum length, Maximum length]. 0 for both: they go through "
    "the box [m]");
  keys.bind("Maximum length", p.max_length, Range::non_negative(),
            "Cylinders, bars: largest length along Axis [m]");
  keys.bind("Axis", p.axis, {"x", "y", "z"},
            "Cylinders, bars: the axis of space along which they lie [-]");
  keys.bind(
    "Axis ratios", p.axis_ratios, Range::closed(1e-3, 1e3),
    "Ellipsoids: the diameters along their own three axes, over the diameter that "
    "is drawn; the own axes are x, y and z before they are turned [-]");
  keys.bind(
    "Orientation", p.turned, {"aligned", "random"},
    "Ellipsoids: aligned: with the axes x, y, z; random: turned, all orientations "
    "being equally likely [-]");
}

/** Names of the smallest and largest extents (m) along the coordinate axes. */
struct Extents
{
  Vector3 smallest, largest;
};

Extents extents_of(const InclusionPlacement &p, const UniformGrid<3> &grid)
{
  Extents e;
  e.smallest.fill(p.min_diameter);
  e.largest.fill(p.max_diameter);
  if (p.shape == InclusionShape::ellipsoid)
    for (unsigned int d = 0; d < 3; ++d)
      {
        const auto &r = p.axis_ratios;
        e.smallest[d] *= p.turned ? *std::min_element(r.begin(), r.end()) : r[d];
        e.largest[d] *= p.turned ? *std::max_element(r.begin(), r.end()) : r[d];
      }
  if (p.has_length())
    {
      const bool through = p.max_length == 0.;
      e.smallest[p.axis] = through ? grid.extent(p.axis) : p.min_length;
      e.largest[p.axis]  = through ? grid.extent(p.axis) : p.max_length;
    }
  return e;
}
} // namespace

std::string InclusionPlacement::name_of_shape() const
{
  return shape_names[static_cast<std::size_t>(shape)];
}

void InclusionPlacement::bind(Keys &keys)
{
  keys.bind("Shape", shape, shape_names,
            "What the inclusions look like: spheres; ellipsoids; cylinders or bars of "
            "square cross section along Axis [-]");
  keys.bind("Seed", seed, 0, largest_seed,
            "Start of the random numbers; the same seed gives the same morphology [-]");
  keys.bind("Phase", phase,
            "Name of the phase of the inclusions; empty: the second of Phases/Names [-]");
  bind_sizes(keys, *this);
  keys.bind("Volume fraction", volume_fraction, Range::open(0., 1.),
            "Volume of the inclusions over volume of the box, met to half an inclusion "
            "[-]");
  keys.bind(
    "Fraction rule", fraction_rule, {"actual", "nominal"},
    "What counts for the volume fraction: actual: the cells that become inclusion, "
    "each once; nominal: the sum of the cells of all inclusions, overlaps counted "
    "each time [-]");
  keys.bind("Allow overlap", allow_overlap, "Inclusions may overlap [-]");
  keys.bind(
    "Minimum gap", minimum_gap, Range::non_negative(),
    "Spheres, cylinders, bars: free distance between two of them; between bars and "
    "between the ends of cylinders that along x, y or z [m]");
  keys.bind(
    "Sides", sides, {"periodic", "cut", "inside"},
    "At the sides of the box: periodic: what leaves on one side comes in on the "
    "other; cut: centres lie anywhere, and what is outside is cut off; inside: all "
    "of each inclusion lies in the box [-]");
  keys.only_with("Shape", {"cylinders", "bars"},
                 {"Axis", "Minimum length", "Maximum length"});
  keys.only_with("Shape", {"ellipsoids"}, {"Axis ratios", "Orientation"});
  keys.only_with("Shape", {"spheres", "cylinders", "bars"}, {"Minimum gap"});
}

void InclusionPlacement::check(const UniformGrid<3> &grid) const
{
  if (!(min_diameter <= max_diameter))
    refuse_key("Minimum diameter", to_text(min_diameter) +
                                     " m is more than the maximum of " +
                                     to_text(max_diameter) + " m; swap them");
  if (has_length() &&
      !(min_length <= max_length && (min_length > 0. || max_length == 0.)))
    refuse_key("Minimum length",
               to_text(min_length) + " m does not go with a maximum of " +
                 to_text(max_length) +
                 " m; give two lengths in ascending order, or 0 for both if they go "
                 "through the box");
  if (allow_overlap && minimum_gap > 0.)
    refuse_key("Minimum gap", "a gap of " + to_text(minimum_gap) +
                                " m contradicts Allow overlap; set one of them to 0 or "
                                "false");
  constexpr double almost = 1. - 1e-9;
  const Extents extents   = extents_of(*this, grid);
  const double free       = sides == InclusionSides::periodic ? minimum_gap : 0.;
  for (unsigned int d = 0; d < 3; ++d)
    {
      const std::string where = std::string(" along ") + "xyz"[d];
      const bool length       = has_length() && d == this->axis;
      const std::string key   = length ? " length" : " diameter";
      if (!(extents.smallest[d] >= almost * grid.spacing[d]))
        refuse_key("Minimum" + key,
                   to_text(extents.smallest[d]) + " m" + where +
                     " is less than a cell, " + to_text(grid.spacing[d]) +
                     " m, so that inclusions would vanish; increase it or "
                     "Grid/Cells");
      if (sides == InclusionSides::cut || (length && max_length == 0.))
        continue;
      if (almost * extents.largest[d] <= grid.extent(d) &&
          almost * (extents.largest[d] + free) > grid.extent(d))
        refuse_key("Minimum gap", to_text(free) + " m leaves no room for inclusions of " +
                                    to_text(extents.largest[d]) + " m" + where +
                                    " in the periodic box of " + to_text(grid.extent(d)) +
                                    " m; reduce it");
      if (!(almost * (extents.largest[d] + free) <= grid.extent(d)))
        refuse_key("Maximum" + key, to_text(extents.largest[d]) + " m" + where +
                                      " does not fit into the box of " +
                                      to_text(grid.extent(d)) +
                                      " m; reduce it, or set Sides = cut");
    }
}
} // namespace mesoslip
