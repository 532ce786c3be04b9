#ifndef mesoslip_sliding_analyses_static_springs_h
#define mesoslip_sliding_analyses_static_springs_h

#include "contact/laws/power_spring.h"
#include "contact/static_contact_solver.h"

#include <vector>

namespace mesoslip
{
/** Areas (m^2, in 2D m) of contact nodes for their springs; those without any have next to none. */
std::vector<double> spring_areas(const std::vector<double> &areas);

/** Springs between the contact nodes of a body at rest and the flat, which Newton's method makes linear. */
class StaticSprings
{
public:
  /** Of nodes with these @p areas, see spring_areas(), pressed on the flat by @p pressure (Pa) in the mean. */
  StaticSprings(const PowerSpring &spring,
                const std::vector<double> &areas,
                const double pressure);

  /** Whether they are linear, so that one solve is enough. */
  bool are_linear() const
  {
    return spring.is_linear();
  }

  /** Stiffness and gap of the nodes in @p problem: of springs that are tangent to theirs, over a flat at the distances
   * @p gaps (m). */
  void linearize(StaticContactProblem &problem, const std::vector<double> &gaps) const;

  /** Takes the depths of nodes at these @p displacements along the normal (m); the share of the forces in @p solution
   * by which those of the linear springs differ. */
  double settle(const StaticContactSolution &solution,
                const std::vector<double> &displacements,
                const std::vector<double> &gaps);

private:
  const PowerSpring spring;
  const std::vector<double> area;
  double least;              ///< depth (m) at which a node is that does not touch
  std::vector<double> depth; ///< m
};
} // namespace mesoslip

#endif
