#include "io/errors.h"
#include "io/hdf5/internal.h"

#include <unistd.h>

namespace mesoslip
{
namespace hdf5
{
namespace
{
/** What the handler prints: it may call next to nothing. */
struct Sentence
{
  const char *text;
  std::size_t length;
} sentence = {nullptr, 0};

extern "C" void mesoslip_on_crash(int)
{
  const bool told = write(STDERR_FILENO, sentence.text, sentence.length) >= 0;
  _exit(static_cast<int>(told ? ExitStatus::user_error : ExitStatus::unexpected));
}
} // namespace

CrashGuard::CrashGuard(const std::string &path)
  : own(path +
        ": HDF5 crashes on it, as the file is damaged or made to do harm; write it "
        "anew with the program it comes from\n")
{
  if (sentence.text != nullptr)
    return; // within another one
  outermost               = true;
  sentence                = {own.data(), own.size()};
  struct sigaction action = {};
  action.sa_handler       = mesoslip_on_crash;
  sigemptyset(&action.sa_mask);
  for (std::size_t k = 0; k < crashes.size(); ++k)
    sigaction(crashes[k], &action, &before[k]);
}

CrashGuard::~CrashGuard()
{
  if (!outermost)
    return;
  for (std::size_t k = 0; k < crashes.size(); ++k)
    sigaction(crashes[k], &before[k], nullptr);
  sentence = {nullptr, 0};
}
} // namespace hdf5
} // namespace mesoslip
