#ifndef mesoslip_localization_stress_statistics_h
#define mesoslip_localization_stress_statistics_h

#include "exchange/localization_file.h"
#include "grid/nodal_field.h"
#include "material/voigt.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/**
 * Before a loop over one row of cells: the compiler vectorizes it for three instruction sets,
 * of which that of the processor is picked when the program starts.
 */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#  define MESOSLIP_CLONES \
    __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#  define MESOSLIP_CLONES
#endif

namespace mesoslip
{
/** Strain of a row of cells: arrays of xx, yy and xy (engineering shear). */
using StrainRow = std::array<const double *, 3>;

/**
 * Adds the von Mises stress to @p sum, with sigma_zz = ratio (sigma_xx + sigma_yy);
 * @p work holds @p n numbers and is overwritten.
 */
void add_von_mises_row(const double *xx,
                       const double *yy,
                       const double *xy,
                       const double *ratio,
                       const std::size_t n,
                       double *work,
                       double *sum);

/**
 * From the macroscopic strain of each cell to its local stress: sigma = C_phase L eps
 * (eqs 23 and 24). The product is formed once; with it goes the ratio of sigma_zz to
 * sigma_xx + sigma_yy in plane strain.
 */
class StressMap
{
public:
  /**
   * @p phase holds n_cells ids, @p stiffness (Pa) and @p ratio one entry for each phase,
   * @p concentration the tensors L [ny][nx][3][3]; empty: the identity, which leaves
   * sigma = C_phase eps, the stress of a run that resolves the phases.
   */
  StressMap(const UniformGrid<2> &grid,
            const std::vector<std::uint8_t> &phase,
            const std::vector<VoigtMatrix<2>> &stiffness,
            const std::vector<double> &ratio,
            const std::vector<double> &concentration);

  /** C_phase L (Pa) of one cell. */
  VoigtMatrix<2> matrix(const unsigned int i, const unsigned int j) const;

  /**
   * Rows of ten arrays: the entries of C_phase L, row-major, and the ratio of sigma_zz to
   * sigma_xx + sigma_yy.
   */
  const NodalField<double> &rows() const
  {
    return data;
  }

private:
  NodalField<double> data;
};

/**
 * Averages over time of the stresses of all cells, fed row by row; the memory does not
 * depend on the number of samples. The map must outlive the object.
 */
class StressStatistics
{
public:
  /** No samples yet; @p stress_map must outlive it. */
  StressStatistics(const StressMap &stress_map, const FieldSelection &fields);

  /** The next sample of row @p j, as the macroscopic strain of its cells. */
  void add(const unsigned int j, const StrainRow &strain);

  /** Every row must have been given the same number of samples, at least one. */
  StressFields fields() const;

private:
  std::vector<double>
  interleaved(const unsigned int first, const unsigned int n, const bool as_root) const;

  const StressMap &map;
  FieldSelection selection;
  std::vector<std::size_t> samples;
  NodalField<double> sums;
  /** One row: the stress and a work array. */
  NodalField<double> scratch;
};
} // namespace mesoslip

#endif
