// A program that program_server.cc runs in its place, with its environment, folder and standard files, so that mpirun can start the
// ranks of the programs without their libraries: program_client <socket> <program> <word>...
#include "descriptor_message.h"

#include <csignal>
#include <cstring>
#include <string>
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
} // namespace

int main(int argc, char **argv)
{
  if (argc < 3)
    return 127;
  const sockaddr_un address = address_of(argv[1]);
  const int server          = ::socket(AF_UNIX, SOCK_STREAM, 0);
  if (::connect(server, reinterpret_cast<const sockaddr *>(&address), sizeof(address)) !=
        0 ||
      !DescriptorMessage().send(server, {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}))
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
