#ifndef mesoslip_localization_stress_statistics_h
#define mesoslip_localization_stress_statistics_h

#include "exchange/localization_file.h"
#include "localization/cell_rows.h"
#include "material/voigt.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * Adds the von Mises stress of @p n cells to @p sum; in 2D with sigma_zz = ratio (sigma_xx +
 * sigma_yy), in 3D @p ratio is not used. @p work holds @p n numbers and is overwritten.
 */
template <int dim>
void add_von_mises_row(const CellRow &stress,
                       const double *ratio,
                       const std::size_t n,
                       double *work,
                       double *sum);

/**
 * Maps the macroscopic strain of each cell to its local stress, sigma = C L eps (eqs 22
 * to 24); without L to the stress of a run that resolves the phases. In 2D it also has
 * the ratio of sigma_zz to sigma_xx + sigma_yy.
 */
template <int dim>
class StressMap
{
public:
  /** @p n_cells cells in rows of @p n_in_row, all zero. */
  StressMap(const std::size_t n_cells, const std::size_t n_in_row)
    : data(n_cells, n_in_row, n_numbers)
  {
  }

  /** Sets C L (Pa) of cell @p i of row @p j. */
  void
  set_matrix(const std::size_t j, const std::size_t i, const VoigtMatrix<dim> &matrix)
  {
    for (unsigned int e = 0; e < n_entries; ++e)
      data.array(e, j)[i] = matrix.data()[e];
  }

  /** Sets sigma_zz / (sigma_xx + sigma_yy) of such a cell; without effect in 3D. */
  void set_ratio(const std::size_t j, const std::size_t i, const double ratio)
  {
    if (dim == 2)
      data.array(n_entries, j)[i] = ratio;
  }

  /** C L (Pa) of cell @p k. */
  VoigtMatrix<dim> matrix(const std::size_t k) const
  {
    VoigtMatrix<dim> result;
    for (unsigned int e = 0; e < n_entries; ++e)
      result.data()[e] = data(e, k);
    return result;
  }

  /** Sets the thermal stress (Pa) of cell @p i of row @p j; @p zz (2D): part of sigma_zz
   * not given by the ratio. */
  void set_thermal(const std::size_t j,
                   const std::size_t i,
                   const VoigtVector<dim> &stress,
                   const double zz)
  {
    if (!thermal_data)
      thermal_data.emplace(data.n_cells(), data.n_in_row(), n_thermal);
    for (unsigned int c = 0; c < n_voigt<dim>; ++c)
      thermal_data->array(c, j)[i] = stress[c];
    if (dim == 2)
      thermal_data->array(n_voigt<dim>, j)[i] = zz;
  }

  /** Thermal stresses set by set_thermal(), all components and in 2D zz; null: none. */
  const CellRows *thermal() const
  {
    return thermal_data ? &*thermal_data : nullptr;
  }

  /** The ratios of the cells of row @p j; null in 3D. */
  const double *ratio(const std::size_t j) const
  {
    return dim == 2 ? data.array(n_entries, j) : nullptr;
  }

  /** The entries of C L by rows, then in 2D the ratio. */
  const CellRows &rows() const
  {
    return data;
  }

  static constexpr unsigned int n_entries = n_voigt<dim> * n_voigt<dim>; ///< C L
  static constexpr unsigned int n_thermal =
    n_voigt<dim> + (dim == 2 ? 1 : 0); ///< per thermal stress
  static constexpr unsigned int n_numbers = n_entries + (dim == 2 ? 1 : 0); ///< per cell

private:
  CellRows data;                        ///< see rows()
  std::optional<CellRows> thermal_data; ///< see thermal()
};

/**
 * Time averages of the stresses of cells, fed row by row; the memory does not depend on
 * the number of samples. The map must outlive this object.
 */
template <int dim>
class StressStatistics
{
public:
  /** No samples yet; @p stress_map must outlive it. */
  StressStatistics(const StressMap<dim> &stress_map, const FieldSelection &fields);

  /** Adds a sample of row @p j: the macroscopic strain of its cells. */
  void add(const std::size_t j, const CellRow &strain);

  /** Fields [n], [n][components]. Every row must have the same number of samples, at
   * least one. */
  StressFields fields() const;

  /** Stored numbers per cell. */
  static unsigned int n_numbers(const FieldSelection &fields);

private:
  std::vector<double>
  interleaved(const unsigned int first, const unsigned int n, const bool as_root) const;

  const StressMap<dim> &map;        ///< stress map of the cells
  FieldSelection selection;         ///< requested fields
  std::vector<std::size_t> samples; ///< per row, so far
  CellRows sums;                    ///< von Mises stresses, means, squared deviations
  CellRows scratch;                 ///< buffers for a row: stress and work array
};
} // namespace mesoslip

#endif
