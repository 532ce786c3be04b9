#include "program/workers.h"

#include "base/errors.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#ifdef __linux__
#  include <sched.h>
#endif

#ifdef __APPLE__
extern char **environ;
#endif

namespace mesoslip
{
namespace
{
/** A process that carries out tasks one by one. */
class Worker
{
public:
  Worker(const std::string &program, const std::string &errors);
  ~Worker();
  Worker(const Worker &)            = delete;
  Worker &operator=(const Worker &) = delete;

  /** Begins task @p k; if the process is gone, read() reports why. */
  void begin(const std::size_t k, const std::vector<std::string> &words);

  /** Call it after poll(): the outcome of its task, if it is complete or the process has
   * died. */
  std::optional<Outcome> read();

  void ask_to_stop() const
  {
    ::kill(process, SIGTERM);
  }

  int answers   = -1;              ///< file descriptor of its answers
  bool has_died = false;           ///< whether the process has died
  std::optional<std::size_t> task; ///< current task

private:
  Outcome death();

  pid_t process = -1;
  int requests  = -1;
  std::string text; ///< partial answer
};

Worker::Worker(const std::string &program, const std::string &errors)
{
  std::array<int, 2> in = {{-1, -1}}, out = {{-1, -1}};
  if (::pipe2(in.data(), O_CLOEXEC) != 0 || ::pipe2(out.data(), O_CLOEXEC) != 0)
    throw UserError(std::string("no process can be started for a point of the map: ") +
                    std::strerror(errno));
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in[0], 0);
  posix_spawn_file_actions_adddup2(&files, out[1], 1);
  posix_spawn_file_actions_addopen(&files, 2, errors.c_str(),
                                   O_WRONLY | O_CREAT | O_APPEND, 0644);
  std::string name = program, option = "--serve";
  std::array<char *, 3> words = {{name.data(), option.data(), nullptr}};
  const int error =
    ::posix_spawn(&process, name.c_str(), &files, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  ::close(in[0]);
  ::close(out[1]);
  requests = in[1];
  answers  = out[0];
  if (error != 0)
    {
      ::close(requests);
      ::close(answers);
      throw UserError("no process can be started for a point of the map: " +
                      std::string(std::strerror(error)));
    }
}

Worker::~Worker()
{
  ::close(requests); // end of input ends the process
  ::close(answers);
  if (!has_died)
    ::waitpid(process, nullptr, 0);
}

void Worker::begin(const std::size_t k, const std::vector<std::string> &words)
{
  const std::string line = nlohmann::json(words).dump() + "\n";
  task                   = k;
  std::size_t done       = 0;
  while (done < line.size())
    {
      const ssize_t n = ::write(requests, line.data() + done, line.size() - done);
      if (n < 0 && errno == EINTR)
        continue;
      if (n <= 0)
        return;
      done += static_cast<std::size_t>(n);
    }
}

Outcome Worker::death()
{
  int status = 0;
  ::waitpid(process, &status, 0);
  has_died = true;
  return {ExitStatus::unexpected,
          WIFSIGNALED(status)
            ? "its process was ended by signal " + std::to_string(WTERMSIG(status)) +
                " (" + ::strsignal(WTERMSIG(status)) +
                "); is there too little memory for as many processes (Sweep/Processes)?"
            : "its process ended before it did, with status " +
                std::to_string(WEXITSTATUS(status))};
}

std::optional<Outcome> Worker::read()
{
  std::array<char, 4096> buffer;
  const ssize_t n = ::read(answers, buffer.data(), buffer.size());
  if (n < 0 && errno == EINTR)
    return std::nullopt;
  if (n <= 0)
    return death();
  text.append(buffer.data(), static_cast<std::size_t>(n));
  const std::size_t end = text.find('\n');
  if (end == std::string::npos)
    return std::nullopt;
  const auto answer = nlohmann::json::parse(text.substr(0, end), nullptr, false);
  text.erase(0, end + 1);
  if (!answer.is_object())
    return Outcome{ExitStatus::unexpected, "its process answered what is no JSON object"};
  return Outcome{static_cast<ExitStatus>(answer.value("status", 1)),
                 answer.value("message", std::string())};
}

/** Ignores SIGPIPE: writing to a dead process must not end this one. */
class IgnoredPipeSignal
{
public:
  IgnoredPipeSignal()
    : before(std::signal(SIGPIPE, SIG_IGN))
  {
  }
  ~IgnoredPipeSignal()
  {
    std::signal(SIGPIPE, before);
  }
  IgnoredPipeSignal(const IgnoredPipeSignal &)            = delete;
  IgnoredPipeSignal &operator=(const IgnoredPipeSignal &) = delete;

private:
  void (*before)(int);
};

/** The processes and the remaining tasks. */
class Workplace
{
public:
  Workplace(const std::string &file,
            const unsigned int n_processes,
            const std::string &error_file,
            const WorkerTasks &all)
    : program(file)
    , errors(error_file)
    , tasks(all)
    , workers(std::min<std::size_t>(n_processes, all.n))
    , has_ended(all.n, false)
    , is_given(all.n, false)
  {
  }

  bool carry_out()
  {
    while (true)
      {
        if (!is_stopping && tasks.stop())
          stop();
        bool is_busy = false;
        for (auto &worker : workers)
          {
            if (!is_stopping && (!worker || !worker->task))
              give_task(worker);
            is_busy = is_busy || (worker && worker->task);
          }
        if (!is_busy)
          return !is_stopping;
        wait();
      }
  }

private:
  /** Gives the worker the first task that does not wait for another. */
  void give_task(std::unique_ptr<Worker> &worker)
  {
    while (first < tasks.n && is_given[first])
      ++first;
    std::size_t k = first;
    while (k < tasks.n && (is_given[k] || !may_begin(k)))
      ++k;
    if (k == tasks.n)
      return;
    if (!worker)
      worker = std::make_unique<Worker>(program, errors);
    is_given[k] = true;
    worker->begin(k, tasks.words(k));
  }

  bool may_begin(const std::size_t k) const
  {
    const std::optional<std::size_t> before = tasks.after(k);
    return !before || has_ended[*before];
  }

  void stop()
  {
    is_stopping = true;
    for (const auto &worker : workers)
      if (worker && worker->task)
        worker->ask_to_stop();
  }

  /** Waits for a quarter of a second, or until input arrives. */
  void wait()
  {
    std::vector<pollfd> waiting;
    for (const auto &worker : workers)
      if (worker && worker->task)
        waiting.push_back({worker->answers, POLLIN, 0});
    if (::poll(waiting.data(), waiting.size(), 250) <= 0)
      return;
    for (auto &worker : workers)
      if (worker && worker->task)
        for (const pollfd &one : waiting)
          if (one.fd == worker->answers && one.revents != 0)
            {
              receive(worker);
              break;
            }
  }

  void receive(std::unique_ptr<Worker> &worker)
  {
    const std::optional<Outcome> outcome = worker->read();
    if (!outcome)
      return;
    const std::size_t k = *worker->task;
    worker->task.reset();
    const bool was_stopped =
      outcome->status == ExitStatus::interrupted || (is_stopping && worker->has_died);
    if (worker->has_died || outcome->status == ExitStatus::interrupted)
      worker.reset();
    if (!was_stopped)
      {
        tasks.done(k, *outcome);
        has_ended[k] = true;
      }
    else if (!is_stopping)
      stop(); // Ctrl-C reached the process before this one
  }

  const std::string program, errors;
  const WorkerTasks &tasks;
  std::vector<std::unique_ptr<Worker>> workers;
  std::vector<bool> has_ended, is_given; ///< per task
  std::size_t first = 0;                 ///< first task that may not have been given
  bool is_stopping  = false;
};
} // namespace

std::string file_of_program(const std::string &name)
{
  std::error_code code;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", code);
  return !code && path.filename() == name ? path.string() : "";
}

unsigned int available_cores()
{
#ifdef __linux__
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof(allowed), &allowed) == 0)
    return static_cast<unsigned int>(std::max(1, CPU_COUNT(&allowed)));
#endif
  return std::max(1U, std::thread::hardware_concurrency());
}

bool carry_out_side_by_side(const std::string &file,
                            const unsigned int n_processes,
                            const std::string &errors,
                            const WorkerTasks &tasks)
{
  const IgnoredPipeSignal ignored;
  return Workplace(file, n_processes, errors, tasks).carry_out();
}
} // namespace mesoslip
