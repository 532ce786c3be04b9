// The three programs in one process that forks, for the tests that start them by the hundred: each start of a program loads deal.II's
// 200 shared libraries, 0.3 s of CPU time. Reads requests from its standard input, one after the other: program, folder, files for
// standard output and errors, number of words, words, each ended by a zero byte. Runs the program in a process of its own and answers
// with a line: its exit status, or minus the signal that ended it. scenes.py asks.
//
//     program_server [<socket>]
//
// At a socket, of which it tells in a first line, it takes requests of program_client.cc, many at a time: ranks that mpirun starts.
#include "descriptor_message.h"
#include "homogenization/rve_program.h"
#include "localization/localization_program.h"
#include "program/program.h"
#include "sliding/contact_program.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace
{
mesoslip::Application application(const std::string &name)
{
  return name == "rve_homogenization" ? mesoslip::rve_homogenization_program()
         : name == "contact_dynamics" ? mesoslip::contact_dynamics_program()
                                      : mesoslip::stress_localization_program();
}

std::string next_word(std::FILE *file)
{
  std::string word;
  int c = 0;
  while ((c = std::getc(file)) > 0)
    word += static_cast<char>(c);
  return word;
}

std::vector<std::string> next_words(std::FILE *file)
{
  std::vector<std::string> words(std::strtoul(next_word(file).c_str(), nullptr, 10));
  for (std::string &word : words)
    word = next_word(file);
  return words;
}

void redirect(const std::string &file, const int descriptor)
{
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (opened < 0 || ::dup2(opened, descriptor) < 0)
    std::_Exit(127);
  ::close(opened);
}

[[noreturn]] void
run(std::string program, const std::string &folder, std::vector<std::string> words)
{
  if (::chdir(folder.c_str()) != 0)
    std::_Exit(127);
  std::vector<char *> arguments = {program.data()};
  for (std::string &word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::exit(mesoslip::run_program(static_cast<int>(arguments.size()) - 1,
                                  arguments.data(), application(program)));
}

/** Exit status of a process, or minus the signal that ended it. */
int end_of(const pid_t child)
{
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child)
    std::_Exit(1);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/** False at the end of the input. */
bool answer_input()
{
  const std::string program = next_word(stdin);
  if (program.empty())
    return false;
  const std::string folder = next_word(stdin), output = next_word(stdin),
                    errors             = next_word(stdin);
  const std::vector<std::string> words = next_words(stdin);
  const pid_t child                    = ::fork();
  if (child == 0)
    {
      redirect("/dev/null", STDIN_FILENO);
      redirect(output, STDOUT_FILENO);
      redirect(errors, STDERR_FILENO);
      run(program, folder, words);
    }
  std::printf("%d\n", end_of(child));
  std::fflush(stdout);
  return true;
}

/** Of a client at the socket: its standard input, output and errors become those of this process. */
void take_descriptors(const int client)
{
  DescriptorMessage::Descriptors taken = {};
  if (!DescriptorMessage().receive(client, taken))
    std::_Exit(127);
  for (int k = 0; k < 3; ++k)
    {
      ::dup2(taken[k], k);
      ::close(taken[k]);
    }
}

/** In a process of its own, which a second one watches; it ends with its client. */
void answer_client(const int client)
{
  if (::fork() != 0)
    return;
  const pid_t child = ::fork();
  if (child != 0)
    {
      const int status = end_of(child);
      std::_Exit(::write(client, &status, sizeof(status)) == sizeof(status) ? 0 : 1);
    }
  take_descriptors(client);
  std::FILE *file     = ::fdopen(client, "r");
  std::string program = next_word(file), folder = next_word(file);
  const std::vector<std::string> words       = next_words(file);
  const std::vector<std::string> environment = next_words(file);
  ::clearenv();
  for (const std::string &variable : environment)
    if (const std::size_t sign = variable.find('='); sign != std::string::npos)
      ::setenv(variable.substr(0, sign).c_str(), variable.substr(sign + 1).c_str(), 1);
  // SIGIO ends this process when mpirun has ended its client.
  ::fcntl(client, F_SETOWN, ::getpid());
  ::fcntl(client, F_SETFL, O_ASYNC);
  run(program, folder, words);
}

int listening(const char *path)
{
  const sockaddr_un address = address_of(path);
  const int made            = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (::bind(made, reinterpret_cast<const sockaddr *>(&address), sizeof(address)) != 0 ||
      ::listen(made, 64) != 0)
    std::_Exit(1);
  return made;
}
} // namespace

int main(int argc, char **argv)
{
  pollfd watched[2] = {{STDIN_FILENO, POLLIN, 0}, {-1, POLLIN, 0}};
  if (argc > 1)
    {
      watched[1].fd = listening(argv[1]);
      std::puts("listening");
      std::fflush(stdout);
    }
  while (::poll(watched, 2, -1) > 0)
    {
      if (watched[1].revents != 0)
        if (const int client = ::accept(watched[1].fd, nullptr, nullptr); client >= 0)
          {
            answer_client(client);
            ::close(client);
          }
      if (watched[0].revents != 0 && !answer_input())
        return 0;
      while (::waitpid(-1, nullptr, WNOHANG) > 0) // those that watched
        ;
    }
}
