#ifndef mesoslip_sliding_complex_complex_output_h
#define mesoslip_sliding_complex_complex_output_h

#include "io/hdf5_file.h"
#include "sliding/complex/complex_cases.h"

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
/** Names of the files that the analysis writes. */
std::vector<std::string> complex_modes_files();

/** Column heading of the swept parameter, with its unit. */
std::string swept_column(const ContactParameters &parameters);

/** Lines and warnings on modes, completeness and the static state. */
template <int dim>
void log_complex_modes(const ComplexCases<dim> &cases,
                       const ContactParameters &parameters,
                       RunContext &context);

/** On rank 0: writes complex_modes.csv, for a sweep complex_modes_sweep.csv, and the
 * modes in summary.json. */
template <int dim>
void write_complex_tables(const ComplexCases<dim> &cases,
                          const ContactParameters &parameters,
                          RunContext &context);

/** Mode shapes for files and ParaView; the time of a frame is the number of its mode. */
struct ComplexShapes
{
  std::array<std::vector<NodalField<double>>, 2> parts; ///< real and imaginary parts
  std::vector<double> numbers;                          ///< 1, 2, ...
};

/** On rank 0: writes /complex_modes without the shapes.
 * @return the shapes */
template <int dim>
ComplexShapes write_complex_modes(Hdf5File &file,
                                  const ComplexCases<dim> &cases,
                                  const ElasticBody<dim> &body,
                                  const ContactParameters &parameters);
} // namespace mesoslip

#endif
