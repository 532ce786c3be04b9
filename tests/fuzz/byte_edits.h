#ifndef mesoslip_tests_fuzz_byte_edits_h
#define mesoslip_tests_fuzz_byte_edits_h

#include <cstdint>
#include <string>

namespace mesoslip_tests
{
/** Takes bytes off the fuzzer's input; zeros at its end. */
class Choices
{
public:
  Choices(const std::uint8_t *begin, const std::size_t n)
    : data(begin)
    , left(n)
  {
  }
  bool empty() const
  {
    return left == 0;
  }
  unsigned int byte()
  {
    if (left == 0)
      return 0;
    --left;
    return *data++;
  }
  /** Of two bytes. */
  unsigned int place()
  {
    const unsigned int high = byte();
    return 256 * high + byte();
  }
  unsigned int below(const unsigned int n)
  {
    return byte() % n;
  }

private:
  const std::uint8_t *data;
  std::size_t left;
};

/**
 * @p file with single bytes, bits and runs overwritten, pieces moved, cut off or grown,
 * as
 * @p choices say until they are used up.
 */
std::string edit_bytes(std::string file, Choices &choices);
} // namespace mesoslip_tests

#endif
