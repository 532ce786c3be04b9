#ifndef mesoslip_sliding_complex_complex_output_h
#define mesoslip_sliding_complex_complex_output_h

#include "io/hdf5_file.h"
#include "sliding/complex/complex_cases.h"

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
/** Files that the analysis writes. */
std::vector<std::string> complex_modes_files();

/** Name of what is swept, with its unit, as a column has it. */
std::string swept_column(const ContactParameters &parameters);

/** Lines and warnings on modes, completeness and the static state. */
template <int dim>
void log_complex_modes(const ComplexCases<dim> &cases,
                       const ContactParameters &parameters,
                       RunContext &context);

/** On rank 0: complex_modes.csv, of a sweep complex_modes_sweep.csv, and the keys of summary.json
 * that are about modes. */
template <int dim>
void write_complex_tables(const ComplexCases<dim> &cases,
                          const ContactParameters &parameters,
                          RunContext &context);

/** Shapes that files have and ParaView shows; the time of a frame is the number of its mode. */
struct ComplexShapes
{
  std::array<std::vector<NodalField<double>>, 2> parts; ///< real and imaginary ones
  std::vector<double> numbers;                          ///< 1, 2, ...
};

/** On rank 0: writes /complex_modes but for the shapes, which it returns. */
template <int dim>
ComplexShapes write_complex_modes(Hdf5File &file,
                                  const ComplexCases<dim> &cases,
                                  const ElasticBody<dim> &body,
                                  const ContactParameters &parameters);
} // namespace mesoslip

#endif
