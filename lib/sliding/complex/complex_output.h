#ifndef mesoslip_sliding_complex_complex_output_h
#define mesoslip_sliding_complex_complex_output_h

#include "exchange/xdmf.h"
#include "io/hdf5_file.h"
#include "sliding/complex/complex_cases.h"

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

/** Shapes that ParaView is to show; the time of a frame is the number of its mode. */
struct ShownComplexShapes
{
  std::vector<XdmfField> fields; ///< real and imaginary parts
  std::vector<double> numbers;   ///< 1, 2, ...
};

/** On rank 0: writes /complex_modes; @p extents are those of one shape in the file,
 * components last. */
template <int dim>
ShownComplexShapes write_complex_shapes(Hdf5File &file,
                                        const ComplexCases<dim> &cases,
                                        const ElasticBody<dim> &body,
                                        const ContactParameters &parameters,
                                        const Shape &extents);
} // namespace mesoslip

#endif
