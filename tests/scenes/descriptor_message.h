#ifndef mesoslip_tests_descriptor_message_h
#define mesoslip_tests_descriptor_message_h

#include <array>
#include <cstring>
#include <sys/socket.h>
#include <sys/un.h>

/** The socket at @p path, for bind() and connect(). */
inline sockaddr_un address_of(const char *path)
{
  sockaddr_un address = {};
  address.sun_family  = AF_UNIX;
  std::strncpy(address.sun_path, path, sizeof(address.sun_path) - 1);
  return address;
}

/** Standard input, output and errors of a process on their way to another one: a message of one byte at a socket, see unix(7). */
class DescriptorMessage
{
public:
  using Descriptors = std::array<int, 3>; ///< input, output, errors

  DescriptorMessage()
  {
    message.msg_iov        = &data;
    message.msg_iovlen     = 1;
    message.msg_control    = control;
    message.msg_controllen = sizeof(control);
  }

  DescriptorMessage(const DescriptorMessage &) = delete; // it points to itself

  /** Whether @p given could be sent. */
  bool send(const int socket, const Descriptors &given)
  {
    cmsghdr *header    = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type  = SCM_RIGHTS;
    header->cmsg_len   = CMSG_LEN(sizeof(given));
    std::memcpy(CMSG_DATA(header), given.data(), sizeof(given));
    return ::sendmsg(socket, &message, 0) == 1;
  }

  /** Whether @p taken could be received. */
  bool receive(const int socket, Descriptors &taken)
  {
    if (::recvmsg(socket, &message, 0) != 1 || CMSG_FIRSTHDR(&message) == nullptr)
      return false;
    std::memcpy(taken.data(), CMSG_DATA(CMSG_FIRSTHDR(&message)), sizeof(taken));
    return true;
  }

private:
  char byte                                                      = 0;
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(Descriptors))] = {};
  iovec data                                                     = {&byte, 1};
  msghdr message                                                 = {};
};

#endif
