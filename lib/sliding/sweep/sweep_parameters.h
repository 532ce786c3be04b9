#ifndef mesoslip_sliding_sweep_sweep_parameters_h
#define mesoslip_sliding_sweep_sweep_parameters_h

#include <cstddef>
#include <optional>
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
  double from         = 0.;      ///< one end, where no values are listed
  double to           = 0.;      ///< the other one
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

/** Whether points of a grid start from the end of their neighbours along the first axis. */
enum class Continuation
{
  none, ///< all start alike
  up,   ///< from the first value to the last one
  down, ///< from the last value to the first one
  both  ///< up, and from the end of that down again
};

/** Section Sweep of contact_dynamics: a map of many runs. */
struct SweepParameters
{
  /** None: one run. With Continuation::both the first one has no keys but the branches 1 (up) and -1. */
  std::vector<SweepAxis> axes;
  SweepPoints points        = SweepPoints::grid;  ///< how they follow from the axes
  Continuation continuation = Continuation::none; ///< where points start
  unsigned int n_random     = 100;                ///< random points
  unsigned int seed         = 0;                  ///< of random points
  unsigned int processes    = 0;     ///< side by side; 0: as many as there are cores
  bool complex_modes        = false; ///< whether each point has complex modes, too
  bool skip_stable  = false; ///< whether points of which no mode grows are not run
  bool keep_results = false; ///< whether the files of the points stay

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

  /** The point from whose end point @p k starts, if there is one. */
  std::optional<std::size_t> point_before(const std::size_t k) const;
};
} // namespace mesoslip

#endif
