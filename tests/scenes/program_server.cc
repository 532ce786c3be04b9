// The three programs in one process that forks, for the tests that start them by the hundred: each start of a program loads deal.II's
// 200 shared libraries, 0.3 s of CPU time. Reads requests from its standard input, one after the other: program, folder, files for
// standard output and errors, number of words, words, each ended by a zero byte. Runs the program in a process of its own and answers
// with a line: its exit status, or minus the signal that ended it. scenes.py asks.
#include "homogenization/rve_program.h"
#include "localization/localization_program.h"
#include "program/program.h"
#include "sliding/contact_program.h"

#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <iostream>
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

std::string next_word()
{
  std::string word;
  std::getline(std::cin, word, '\0');
  return word;
}

void redirect(const std::string &file, const int descriptor)
{
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (opened < 0 || ::dup2(opened, descriptor) < 0)
    std::_Exit(127);
  ::close(opened);
}

struct Request
{
  std::string program, folder, output, errors;
  std::vector<std::string> words;
};

[[noreturn]] void run(Request &request)
{
  if (::chdir(request.folder.c_str()) != 0)
    std::_Exit(127);
  redirect("/dev/null", STDIN_FILENO);
  redirect(request.output, STDOUT_FILENO);
  redirect(request.errors, STDERR_FILENO);
  std::vector<char *> arguments = {request.program.data()};
  for (std::string &word : request.words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::exit(mesoslip::run_program(static_cast<int>(arguments.size()) - 1,
                                  arguments.data(), application(request.program)));
}
} // namespace

int main()
{
  while (true)
    {
      Request request;
      for (std::string *word :
           {&request.program, &request.folder, &request.output, &request.errors})
        *word = next_word();
      if (!std::cin)
        return 0;
      request.words.resize(std::stoul(next_word()));
      for (std::string &word : request.words)
        word = next_word();
      const pid_t child = ::fork();
      if (child == 0)
        run(request);
      int status = 0;
      if (child < 0 || ::waitpid(child, &status, 0) != child)
        return 1;
      std::printf("%d\n", WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status));
      std::fflush(stdout);
    }
}
