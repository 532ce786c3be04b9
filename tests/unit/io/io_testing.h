#ifndef mesoslip_tests_unit_io_testing_h
#define mesoslip_tests_unit_io_testing_h

#include "base/errors.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <unistd.h>

namespace mesoslip_tests
{
/** An empty folder that disappears with the test. */
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name =
      (std::filesystem::temp_directory_path() / "mesoslip_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("no temporary folder");
    path = name;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::string operator/(const std::string &name) const
  {
    return path + "/" + name;
  }
  std::string path;
};

/** The sentence of the UserError that @p action throws; fails the test without one. */
inline std::string user_error(const std::function<void()> &action)
{
  try
    {
      action();
    }
  catch (const mesoslip::UserError &error)
    {
      return error.what();
    }
  ADD_FAILURE() << "no UserError";
  return "";
}

/** Expects that @p text contains @p part. */
inline void expect_contains(const std::string &text, const std::string &part)
{
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

/** Expects a UserError of @p action whose sentence contains @p part. */
inline void expect_error(const std::string &part, const std::function<void()> &action)
{
  expect_contains(user_error(action), part);
}

/** @p bytes with the number @p now in the place of @p before, which has to be there. */
inline std::string with_number(std::string bytes, const double before, const double now)
{
  std::string old(sizeof(before), '\0');
  std::memcpy(old.data(), &before, sizeof(before));
  const std::size_t position = bytes.find(old);
  if (position == std::string::npos)
    ADD_FAILURE() << before << " is not there";
  else
    std::memcpy(bytes.data() + position, &now, sizeof(now));
  return bytes;
}
} // namespace mesoslip_tests

#endif
