#include "program/interrupt.h"

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <sys/stat.h>
#include <unistd.h>

namespace mesoslip
{
namespace
{
volatile std::sig_atomic_t received = 0;
timespec first_signal               = {};

extern "C" void mesoslip_on_signal(int)
{
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (received == 0)
    first_signal = now;
  else if (now.tv_sec - first_signal.tv_sec > 1)
    _exit(130);
  received = 1;
}
} // namespace

void install_interrupt_handlers()
{
  struct sigaction action = {};
  action.sa_handler       = mesoslip_on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupt_received()
{
  return received != 0;
}

bool terminate_file_exists(const std::string &folder)
{
  struct stat status;
  return stat((folder + "/terminate").c_str(), &status) == 0;
}
} // namespace mesoslip
