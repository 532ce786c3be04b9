#ifndef mesoslip_homogenization_conduction_conduction_response_h
#define mesoslip_homogenization_conduction_conduction_response_h

#include "base/serialize_members.h"
#include "homogenization/load_cases.h"

#include <Eigen/Core>

#include <vector>

namespace mesoslip
{
/** A tensor of rank two that relates vectors, such as a conductivity. */
template <int dim>
using Tensor2 = Eigen::Matrix<double, dim, dim, Eigen::RowMajor>;

/** Conductivity of a volume from the load cases of one boundary condition. */
template <int dim>
struct ConductionResponse
{
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< for the load cases

  /** Effective conductivity, in the unit of the phases, from the energy: of second order
   * in the error of the solutions. MUBC: the diagonal. */
  Tensor2<dim> conductivity = Tensor2<dim>::Zero();

  /** Largest difference from the conductivity from the mean flux (SUBC: gradient), over
   * the root of its diagonal entries. */
  double residual = 0.;

  std::vector<unsigned int> iterations; ///< solver iterations per load case

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<4>(archive, *this);
  }
};
} // namespace mesoslip

#endif
