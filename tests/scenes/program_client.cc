// A program that program_server.cc runs in its place, with its environment, folder and standard files, so that mpirun can start the
// ranks of the programs without their libraries: program_client <socket> <program> <word>...
#include <csignal>
#include <cstring>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace
{
void add(std::string &request, const char *word)
{
  request.append(word, std::strlen(word) + 1);
}

void add_all(std::string &request, char **words)
{
  int n = 0;
  while (words[n] != nullptr)
    ++n;
  add(request, std::to_string(n).c_str());
  for (; *words != nullptr; ++words)
    add(request, *words);
}

bool send_descriptors(const int server)
{
  const int given[3] = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO};
  char byte          = 0;
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(given))] = {};
  iovec data                                               = {&byte, 1};
  msghdr message                                           = {};
  message.msg_iov                                          = &data;
  message.msg_iovlen                                       = 1;
  message.msg_control                                      = control;
  message.msg_controllen                                   = sizeof(control);
  cmsghdr *header                                          = CMSG_FIRSTHDR(&message);
  header->cmsg_level                                       = SOL_SOCKET;
  header->cmsg_type                                        = SCM_RIGHTS;
  header->cmsg_len                                         = CMSG_LEN(sizeof(given));
  std::memcpy(CMSG_DATA(header), given, sizeof(given));
  return ::sendmsg(server, &message, 0) == 1;
}
} // namespace

int main(int argc, char **argv)
{
  sockaddr_un address = {};
  address.sun_family  = AF_UNIX;
  if (argc < 3)
    return 127;
  std::strncpy(address.sun_path, argv[1], sizeof(address.sun_path) - 1);
  const int server = ::socket(AF_UNIX, SOCK_STREAM, 0);
  if (::connect(server, reinterpret_cast<sockaddr *>(&address), sizeof(address)) != 0 ||
      !send_descriptors(server))
    return 127;
  std::string request, folder(4096, '\0');
  add(request, argv[2]);
  add(request, ::getcwd(folder.data(), folder.size()));
  add_all(request, argv + 3);
  add_all(request, environ);
  for (std::size_t sent = 0; sent < request.size();)
    {
      const ssize_t n = ::send(server, request.data() + sent, request.size() - sent, 0);
      if (n <= 0)
        return 127;
      sent += static_cast<std::size_t>(n);
    }
  int status = 0;
  if (::read(server, &status, sizeof(status)) != sizeof(status))
    return 127;
  return status < 0 ? ::raise(-status) : status;
}
