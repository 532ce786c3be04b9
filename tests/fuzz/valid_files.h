#ifndef mesoslip_tests_fuzz_valid_files_h
#define mesoslip_tests_fuzz_valid_files_h

#include <string>

namespace mesoslip_tests
{
/** Writes a small rve.h5 of two phases on 4 x 3 cells. */
void write_rve(const std::string &path);

/**
 * Writes the dynamics.h5 of a run of that body (of its effective material, or of its
 * phases), with three snapshots and a probe A, and the summary.json beside it.
 */
void write_dynamics(const std::string &folder, const bool heterogeneous);

/** What is read of a static contact analysis of that body. */
void write_static_contact(const std::string &folder);
} // namespace mesoslip_tests

#endif
