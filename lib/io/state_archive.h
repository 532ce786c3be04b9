#ifndef mesoslip_io_state_archive_h
#define mesoslip_io_state_archive_h

#include <boost/archive/binary_iarchive_impl.hpp>
#include <boost/archive/impl/archive_serializer_map.ipp>
#include <boost/archive/impl/basic_binary_iarchive.ipp>
#include <boost/archive/impl/basic_binary_iprimitive.ipp>
#include <boost/serialization/array_optimization.hpp>
#include <boost/serialization/collection_size_type.hpp>

#include <stdexcept>
#include <streambuf>
#include <string>

namespace mesoslip
{
/** Bytes to be read, and how many are left. */
class StateBuffer : public std::streambuf
{
public:
  /** @p bytes have to outlive it. */
  explicit StateBuffer(const std::string &bytes)
  {
    char *begin = const_cast<char *>(bytes.data()); // a streambuf's pointers; only read
    setg(begin, begin, begin + bytes.size());
  }

  /** Bytes that have not been read. */
  std::size_t left() const
  {
    return static_cast<std::size_t>(egptr() - gptr());
  }
};

/**
 * Boost's binary archive for bytes that nobody vouches for: lengths beyond what is left
 * would allocate any amount of memory, and a bool of another value than 0 and 1 is
 * undefined. Both throw std::length_error.
 */
class StateArchive : public boost::archive::
                       binary_iarchive_impl<StateArchive, char, std::char_traits<char>>
{
  using Base =
    boost::archive::binary_iarchive_impl<StateArchive, char, std::char_traits<char>>;

public:
  /** Reads Boost's header. @throws boost::archive::archive_exception */
  explicit StateArchive(StateBuffer &bytes)
    : Base(bytes, 0)
    , buffer(bytes)
  {
    init(0);
  }

  /** Of boost::archive, as those below. */
  template <typename T>
  void load_override(T &value)
  {
    Base::load_override(value);
  }

  /** Every element takes a byte at least. */
  void load_override(boost::serialization::collection_size_type &length)
  {
    Base::load_override(length);
    require(length <= buffer.left());
  }

  /** As Boost saves it: length and characters. */
  void load_override(std::string &text)
  {
    std::size_t length = 0;
    Base::load_override(length);
    require(length <= buffer.left());
    text.resize(length);
    this->load_binary(text.data(), length);
  }

  /** 0 or 1. */
  void load_override(bool &value)
  {
    unsigned char byte = 0;
    Base::load_override(byte);
    require(byte <= 1);
    value = byte == 1;
  }

private:
  static void require(const bool possible)
  {
    if (!possible)
      throw std::length_error("not a saved state");
  }

  StateBuffer &buffer;
};

} // namespace mesoslip

// Without it vectors of numbers would be expected in another layout than they are saved
// in.
BOOST_SERIALIZATION_USE_ARRAY_OPTIMIZATION(mesoslip::StateArchive)

#endif
