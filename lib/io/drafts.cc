#include "io/drafts.h"

#include "base/errors.h"

#include <filesystem>

namespace mesoslip
{
namespace
{
/** State of the process, which is one run of a program. */
struct DraftState
{
  bool accepted = false, marked = false, empty = false;
  std::string path = {}; ///< path of the draft being written
};
DraftState draft_state;
} // namespace

void accept_drafts()
{
  draft_state.accepted = true;
}

bool drafts_are_accepted()
{
  return draft_state.accepted;
}

std::string path_of_draft(const std::string &folder, const std::string &name)
{
  const std::string path = (std::filesystem::path(folder) / name).string();
  for (const std::string &found : {path, path + ".part"})
    if (std::filesystem::exists(found))
      throw UserError("--draft: there is a file " + found +
                      " already; name a folder without one");
  std::error_code ignored; // a later write reports the error
  std::filesystem::create_directories(folder, ignored);
  draft_state.path = path;
  return path;
}

void discard_draft()
{
  std::error_code ignored;
  if (!draft_state.path.empty())
    std::filesystem::remove(draft_state.path + ".part", ignored);
}

DraftMark::DraftMark(const bool is_filled)
{
  draft_state.marked = true;
  draft_state.empty  = !is_filled;
}

DraftMark::~DraftMark()
{
  draft_state.marked = draft_state.empty = false;
}

bool DraftMark::is_set()
{
  return draft_state.marked;
}

bool DraftMark::leaves_empty()
{
  return draft_state.empty;
}
} // namespace mesoslip
