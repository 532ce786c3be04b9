#ifndef mesoslip_material_voigt_h
#define mesoslip_material_voigt_h

#include <Eigen/Core>

#include <string>

namespace mesoslip
{
/**
 * Number of independent components of a symmetric tensor of rank two. Voigt order is
 * xx, yy, xy in 2D and xx, yy, zz, yz, xz, xy in 3D; strains carry engineering shear.
 */
template <int dim>
constexpr int n_voigt = dim *(dim + 1) / 2;

/** Stress (Pa) or strain (engineering shear) in Voigt order. */
template <int dim>
using VoigtVector = Eigen::Matrix<double, n_voigt<dim>, 1>;

/** Stiffness (Pa), compliance or concentration tensor; rows are contiguous. */
template <int dim>
using VoigtMatrix = Eigen::Matrix<double, n_voigt<dim>, n_voigt<dim>, Eigen::RowMajor>;

/** An entry of the upper triangle of a plane stiffness. */
struct StiffnessEntry
{
  unsigned int row;    ///< from 0
  unsigned int column; ///< from 0, not below the row
  const char *name;    ///< as in tables and messages
};

/** The upper triangle of a plane stiffness, row by row. */
constexpr StiffnessEntry stiffness_entries[6] = {{0, 0, "D11"}, {0, 1, "D12"},
                                                 {0, 2, "D13"}, {1, 1, "D22"},
                                                 {1, 2, "D23"}, {2, 2, "D33"}};

/** One constituent of the composite. */
template <int dim>
struct Phase
{
  std::string name; ///< unique among the phases

  /** Pa; plane strain in 2D. */
  VoigtMatrix<dim> stiffness = VoigtMatrix<dim>::Zero();

  /** kg/m^3 */
  double density = 0.;

  /** Coulomb coefficient of contact nodes that lie in this phase. */
  double friction_coefficient = 0.;
};
} // namespace mesoslip

#endif
