#ifndef mesoslip_tests_measured_h
#define mesoslip_tests_measured_h

#include <cstdio>
#include <gtest/gtest.h>
#include <string>

/**
 * What a test measured, as properties of the running test: tests/verification/run.py
 * collects them (--gtest_output=json) for doc/verification.md.
 */
namespace measured
{
inline void record(const std::string &key, const double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.9g", value);
  ::testing::Test::RecordProperty(key, text);
}

/** The error of a series of refinements on `size` cells (or with as many time steps). */
inline void error(const std::string &series, const double size, const double value)
{
  record("error|" + series + "|" + std::to_string(size), value);
}

/** A number and what theory or an independent path says it is. */
inline void number(const std::string &what, const double expected, const double found)
{
  record("expected|" + what, expected);
  record("found|" + what, found);
}
} // namespace measured

#endif
