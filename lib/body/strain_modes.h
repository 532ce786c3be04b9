#ifndef mesoslip_body_strain_modes_h
#define mesoslip_body_strain_modes_h

#include "material/voigt.h"

#include <array>

namespace mesoslip
{
/**
 * The strains of a rectangle or brick whose displacements are linear along each of its
 * axes:
 *
 *     u = sum over sets s of axes of a_s prod_{d in s} xi_d,  -1 <= xi_d <= 1,
 *
 * a set being a number with a bit for each axis. The derivative along axis d has 2 / h_d
 * a_{s + d} in the product of s, products are orthogonal, and the mean square of one is
 * 3^-|s|.
 */
template <int dim, int n_fields = n_voigt<dim> + 1>
class StrainModes
{
public:
  /** A number for each displacement field. */
  using Loads = Eigen::Matrix<double, n_fields, 1>;

  /** Strains of all fields, one a column. */
  using Strains = Eigen::Matrix<double, n_voigt<dim>, n_fields>;

  /** Strain modes of a cell with these edges (m). */
  explicit StrainModes(const std::array<double, dim> &edges)
    : edges(edges)
  {
  }

  /** Component @p c of the displacements (m) of a corner; bit d of @p corner is set at the
   * upper end of axis d. */
  Loads &displacement(const unsigned int corner, const unsigned int c)
  {
    return u[corner][c];
  }

  /**
   * Calls visit(volume, strains of all fields) for the mean strain and each further mode
   * of a cell of @p volume; the volume passed is multiplied by the
   * mean square of the mode. With @p mean_dilatation the further modes are made
   * deviatoric. @p applied is added to the mean.
   */
  template <typename Visit>
  void visit(const bool mean_dilatation,
             const double volume,
             const Visit &visit,
             const Strains &applied = Strains::Zero())
  {
    transform();
    constexpr unsigned int all = n_corners - 1; // has no derivative
    for (unsigned int set = 0; set < all; ++set)
      {
        Strains strain = Strains::Zero();
        double part    = volume;
        for (unsigned int d = 0; d < dim; ++d)
          if ((set >> d & 1U) != 0)
            part /= 3.;
          else
            for (unsigned int c = 0; c < dim; ++c)
              strain.row(voigt_index<dim>(c, d)) +=
                2. / edges[d] * u[set | 1U << d][c].transpose();
        if (set == 0)
          strain += applied;
        else if (mean_dilatation)
          {
            const auto normal = strain.template topRows<dim>();
            const Eigen::Matrix<double, 1, n_fields> mean = normal.colwise().mean();
            strain.template topRows<dim>().rowwise() -= mean;
          }
        visit(part, strain);
      }
  }

private:
  static constexpr unsigned int n_corners = 1U << dim;

  /** Transforms corner displacements to the factors a. */
  void transform()
  {
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int corner = 0; corner < n_corners; ++corner)
        if ((corner >> d & 1U) == 0)
          for (unsigned int c = 0; c < dim; ++c)
            {
              Loads &lower = u[corner][c], &upper = u[corner | 1U << d][c];
              const Loads sum = 0.5 * (lower + upper);
              upper           = 0.5 * (upper - lower);
              lower           = sum;
            }
  }

  const std::array<double, dim> edges;
  std::array<std::array<Loads, dim>, n_corners> u;
};
} // namespace mesoslip

#endif
