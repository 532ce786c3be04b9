#ifndef mesoslip_material_voigt_h
#define mesoslip_material_voigt_h

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

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

/** Voigt index of the component with the axes @p c and @p d. */
template <int dim>
constexpr unsigned int voigt_index(const unsigned int c, const unsigned int d)
{
  return c == d ? c : dim == 2 ? 2 : 6 - c - d;
}

/** Strains at a place under unit loads, a column per load: the components in Voigt order
 * and, last, one kelvin. */
template <int dim>
using UnitStrains = Eigen::Matrix<double, n_voigt<dim>, n_voigt<dim> + 1>;

/** Names of the components in Voigt order. */
template <int dim>
inline constexpr std::array<const char *, n_voigt<dim>> voigt_names = {};
/** 2D case. */
template <>
inline constexpr std::array<const char *, 3> voigt_names<2> = {{"xx", "yy", "xy"}};
/** 3D case. */
template <>
inline constexpr std::array<const char *, 6> voigt_names<3> = {
  {"xx", "yy", "zz", "yz", "xz", "xy"}};

/** An entry of the upper triangle of a stiffness. */
struct StiffnessEntry
{
  unsigned int row;    ///< counts from 0
  unsigned int column; ///< counts from 0, not below the row
  std::string name;    ///< D11, D12, ... as in tables and messages

  /** Whether it vanishes for an orthotropic solid with axes along the coordinate axes. */
  bool couples_shear(const unsigned int dim) const
  {
    return row != column && column >= dim;
  }
};

/** The upper triangle of a stiffness, row by row: 6 entries in 2D, 21 in 3D. */
template <int dim>
std::vector<StiffnessEntry> stiffness_entries()
{
  std::vector<StiffnessEntry> entries;
  for (unsigned int i = 0; i < n_voigt<dim>; ++i)
    for (unsigned int j = i; j < n_voigt<dim>; ++j)
      entries.push_back({i, j, "D" + std::to_string(i + 1) + std::to_string(j + 1)});
  return entries;
}

/** A VoigtVector initialized with zeros: GCC 12 ends with an internal error if an
 * aggregate initializer omits a member whose default is VoigtVector::Zero(). */
template <int dim>
struct ZeroedVector : VoigtVector<dim>
{
  ZeroedVector()
  {
    this->setZero();
  }

  /** Takes the numbers of @p other. */
  template <typename Other>
  ZeroedVector(const Eigen::MatrixBase<Other> &other)
    : VoigtVector<dim>(other)
  {
  }

  /** Saves or restores all numbers, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    for (int k = 0; k < n_voigt<dim>; ++k)
      archive &(*this)[k];
  }
};

/** A constituent of the composite. */
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

  /** C alpha (Pa/K): stress = C strain - thermal_stress * change of temperature. */
  ZeroedVector<dim> thermal_stress = {};
};
} // namespace mesoslip

#endif
