#ifndef mesoslip_sliding_analyses_static_springs_h
#define mesoslip_sliding_analyses_static_springs_h

#include "contact/laws/power_spring.h"
#include "contact/static_contact_solver.h"

#include <vector>

namespace mesoslip
{
/** Areas (m^2, in 2D m) of contact nodes for their springs; nodes without area get a tiny
 * one. */
std::vector<double> spring_areas(const std::vector<double> &areas);

/** Springs between the contact nodes and the flat in statics, linearized by Newton's
 * method. */
class StaticSprings
{
public:
  /** Springs of nodes with tributary @p areas, see spring_areas(), under the mean
   * @p pressure (Pa) on the flat. */
  StaticSprings(const PowerSpring &spring,
                const std::vector<double> &areas,
                const double pressure);

  /** Whether the springs are linear, so that one solve is enough. */
  bool are_linear() const
  {
    return spring.is_linear();
  }

  /** Sets tangent stiffness and equivalent gap of the nodes in @p problem for the current
   * indentation, over a flat at the distances @p gaps (m). */
  void linearize(StaticContactProblem &problem, const std::vector<double> &gaps) const;

  /** Updates the indentation from the normal @p displacements (m).
   * @return relative difference between the spring forces and the forces in
   * @p solution */
  double settle(const StaticContactSolution &solution,
                const std::vector<double> &displacements,
                const std::vector<double> &gaps);

private:
  const PowerSpring spring;
  const std::vector<double> area;
  double least;              ///< indentation (m) assigned to nodes without contact
  std::vector<double> depth; ///< current indentation (m)
};
} // namespace mesoslip

#endif
