#include "io/interrupt.h"

#include <csignal>
#include <cstdlib>
#include <sys/stat.h>
#include <unistd.h>

namespace mesoslip
{
namespace
{
volatile std::sig_atomic_t n_signals = 0;

extern "C" void mesoslip_on_signal(int)
{
  n_signals = n_signals + 1;
  if (n_signals > 1)
    _exit(130);
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
  return n_signals > 0;
}

bool terminate_file_exists(const std::string &folder)
{
  struct stat status;
  return stat((folder + "/terminate").c_str(), &status) == 0;
}
} // namespace mesoslip
