#ifndef mesoslip_sliding_transient_result_file_h
#define mesoslip_sliding_transient_result_file_h

#include "io/hdf5_file.h"
#include "observation/probe_recorder.h"

namespace mesoslip
{
/** Writes a probe of a body in @p dim dimensions. */
void write_probe(Hdf5File &file,
                 const std::string &group,
                 const ProbeHistory &probe,
                 const unsigned int dim);
} // namespace mesoslip

#endif
