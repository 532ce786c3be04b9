#ifndef mesoslip_io_json_h
#define mesoslip_io_json_h

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace nlohmann
{
/** Converts an optional value: null in JSON if it is absent. */
template <typename T>
struct adl_serializer<std::optional<T>>
{
  /** Conversion for `json = value`. */
  static void to_json(json &target, const std::optional<T> &value)
  {
    target = value ? json(*value) : json();
  }
};
} // namespace nlohmann

namespace mesoslip
{
/** The text, or null if it is empty. */
inline nlohmann::json text_or_null(const std::string &text)
{
  return text.empty() ? nlohmann::json() : nlohmann::json(text);
}

/** The number, or null if it is not finite. */
inline nlohmann::json number_or_null(const double value)
{
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}
} // namespace mesoslip

#endif
