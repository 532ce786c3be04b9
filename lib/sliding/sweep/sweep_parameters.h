#ifndef mesoslip_sliding_sweep_sweep_parameters_h
#define mesoslip_sliding_sweep_sweep_parameters_h

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** A key that changes from point to point, or one number of a list. */
struct SweptKey
{
  std::string text;              ///< as typed: "Section/Key" or "Section/Key[2]"
  std::string path;              ///< "Section/Key"
  std::size_t entry = 0;         ///< number of the list, counted from 1; 0: all there is
  std::vector<std::string> list; ///< value of the key in the file, for the other numbers

  /** The value of the key with this number in it: "14e-3, 0.01". */
  std::string with(const double value) const;

  /** Whether both change the same number. */
  bool overlaps(const SweptKey &other) const
  {
    return path == other.path && (entry == other.entry || entry == 0 || other.entry == 0);
  }
};

/** The keys as they were typed. */
std::vector<std::string> texts_of(const std::vector<SweptKey> &keys);

/** An axis of a map: keys that take the same value, and the values. */
struct SweepAxis
{
  std::string name;            ///< name of its subsection and column
  std::vector<SweptKey> keys;  ///< keys that take the values
  std::vector<double> values;  ///< in the unit of the keys; empty for random points
  double from         = 0.;    ///< lower end, if no values are listed
  double to           = 0.;    ///< upper end, if no values are listed
  unsigned int number = 0;     ///< number of values between the ends
  bool logarithmic    = false; ///< whether spacing is logarithmic
};

/** A value without the round-off of a division: 0.3, not 0.30000000000000004. */
double rounded(const double value);

/** How axes are combined to points. */
enum class SweepPoints
{
  grid,  ///< Cartesian product of the axes
  pairs, ///< the k-th values of all axes form point k
  random ///< between the ends of all axes, equally likely
};

/** Whether points of a grid continue from the end of their neighbour along the first
 * axis. */
enum class Continuation
{
  none, ///< all points start alike
  up,   ///< first value to last value
  down, ///< last value to first value
  both  ///< up, then down from the end of the last point
};

/** Section Sweep of contact_dynamics: a map of many runs. */
struct SweepParameters
{
  /** Empty: a single run. With Continuation::both the first axis has no keys; its values
   * are the branches 1 (up) and -1. */
  std::vector<SweepAxis> axes;
  SweepPoints points        = SweepPoints::grid;  ///< combination of the axes
  Continuation continuation = Continuation::none; ///< start of the points
  unsigned int n_random     = 100;                ///< random points
  unsigned int seed         = 0;                  ///< seed of random points
  unsigned int processes    = 0;                  ///< side by side; 0: one per core
  double border_tolerance =
    0.01;                     ///< relative error of the border of growth; 0: no border
  bool complex_modes = false; ///< whether each point has complex modes, too
  bool skip_stable   = false; ///< whether points without growing modes are skipped
  bool keep_results  = false; ///< whether the result files of the points are kept

  /** Binds the keys; call it after all other keys are bound.
   * @throws UserError */
  void bind(Keys &keys);

  /** Whether the border of growth is searched between the points. */
  bool wants_border() const
  {
    return complex_modes && points == SweepPoints::grid && border_tolerance > 0.;
  }

  /** Whether a map is wanted. */
  bool is_given() const
  {
    return !axes.empty();
  }

  /** Numbers of values along the axes of a grid; for pairs and random points the number
   * of points. */
  std::vector<std::size_t> shape() const;

  /** The values of all axes at each point; on a grid the last axis runs fastest. A longer
   * random list begins with the shorter one. */
  std::vector<std::vector<double>> all_points() const;

  /** The point from whose end point @p k starts, if any. */
  std::optional<std::size_t> point_before(const std::size_t k) const;
};
} // namespace mesoslip

#endif
