#ifndef mesoslip_sliding_sweep_sweep_parameters_h
#define mesoslip_sliding_sweep_sweep_parameters_h

#include <cstddef>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** One direction of a map: keys that take the same value, and which values. */
struct SweepAxis
{
  std::string name;              ///< of its subsection and its column
  std::vector<std::string> keys; ///< "Section/Key"
  std::vector<double> values;    ///< in the unit of the keys; of random points none
  double from = 0., to = 0.;     ///< the ends, where no values are listed
  unsigned int number = 0;       ///< of values from one end to the other
  bool logarithmic    = false;   ///< whether they are equally spaced in their logarithms
};

/** How the points of a map follow from its axes. */
enum class SweepPoints
{
  grid,  ///< each value of an axis with each of the others
  pairs, ///< the first values of all axes, then the second ones, and so on
  random ///< between the ends of all axes, equally likely
};

/** Section Sweep of contact_dynamics: a map of many runs. */
struct SweepParameters
{
  std::vector<SweepAxis> axes; ///< none: one run
  SweepPoints points     = SweepPoints::grid;
  unsigned int n_random  = 100;   ///< random points
  unsigned int seed      = 0;     ///< of random points
  unsigned int processes = 0;     ///< side by side; 0: as many as there are cores
  bool complex_modes     = false; ///< whether each point has complex modes, too
  bool keep_results      = false; ///< whether the files of the points stay

  /** Binds the keys, after all others. @throws UserError */
  void bind(Keys &keys);

  /** Whether a map is wanted. */
  bool is_given() const
  {
    return !axes.empty();
  }

  /** Numbers of values along the axes of a grid; of others the number of points. */
  std::vector<std::size_t> shape() const;

  /** The values of all axes at each point; of a grid the last axis runs fastest. More random points begin with fewer. */
  std::vector<std::vector<double>> all_points() const;
};
} // namespace mesoslip

#endif
