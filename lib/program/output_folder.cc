#include "program/output_folder.h"

#include "base/errors.h"
#include "base/files.h"
#include "io/hdf5_file.h"
#include "parameters/keys.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <unistd.h>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

/** Files that every run replaces when it starts. */
constexpr std::array<const char *, 4> papers = {
  {"summary.json", "log.txt", "parameters.prm", "original.prm"}};

/** Results of the programs, without the XDMF files that belong to them. */
constexpr std::array<const char *, 31> results = {{"complex_modes.csv",
                                                   "border.csv",
                                                   "complex_modes.h5",
                                                   "complex_modes_sweep.csv",
                                                   "conductivity.csv",
                                                   "derivatives.csv",
                                                   "dynamics.h5",
                                                   "energy.csv",
                                                   "engineering_constants.csv",
                                                   "ensemble.csv",
                                                   "expansion.csv",
                                                   "field_errors.csv",
                                                   "frequency_derivatives.csv",
                                                   "frequency_uncertainty.csv",
                                                   "friction_homogenization.csv",
                                                   "history.csv",
                                                   "load_steps.csv",
                                                   "loads.csv",
                                                   "loads.h5",
                                                   "loss_factors.csv",
                                                   "localization.h5",
                                                   "map.csv",
                                                   "map.h5",
                                                   "modal.h5",
                                                   "modes.csv",
                                                   "phase_means.csv",
                                                   "probes.csv",
                                                   "rve.h5",
                                                   "static_contact.csv",
                                                   "stiffness.csv",
                                                   "uncertainty.csv"}};

bool is_result(const fs::directory_entry &entry)
{
  std::error_code ignored;
  const std::string kind = entry.path().extension().string();
  return entry.is_regular_file(ignored) &&
         (kind == ".h5" || kind == ".csv" || kind == ".xdmf");
}

bool is_replaced(const fs::directory_entry &entry)
{
  const std::string name = entry.path().filename().string();
  return is_result(entry) ||
         std::find(papers.begin(), papers.end(), name) != papers.end();
}

/** Whether two paths are one existing file, resolving links and "..". */
bool are_the_same(const fs::path &one, const fs::path &other)
{
  std::error_code ignored;
  return fs::equivalent(one, other, ignored);
}

void check_input(const std::string &folder,
                 const std::string &key,
                 const std::string &input)
{
  const std::string remedy =
    ", where this run would replace log, parameters and summary; choose another folder "
    "with --output";
  if (are_the_same(input, folder))
    throw UserError(key + ": " + input + " is the output folder" + remedy);
  std::error_code ignored;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder, ignored))
    if (is_replaced(entry) && are_the_same(entry.path(), input))
      throw UserError(key + ": " + input + " lies in the output folder " + folder +
                      remedy);
}

/** Program and analysis of a run. */
struct RunKind
{
  std::string program;
  std::string analysis = {};    ///< empty if the program has only one
  bool is_told         = false; ///< whether the first line states it, with the version

  /** "the analysis 'modal' of contact_dynamics". */
  std::string text() const
  {
    return analysis.empty() ? program : "the analysis '" + analysis + "' of " + program;
  }
};

/** "# contact_dynamics 0.1.0: ..." and "set Analysis = modal" of the parameters.prm that a
 *  run writes when it begins. */
std::optional<RunKind> kind_in_parameters(const std::string &path)
{
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    return std::nullopt;
  std::istringstream text(read_file(path));
  RunKind kind;
  std::string line, hash, version;
  const std::string analysis = "set Analysis = ";
  std::getline(text, line);
  std::istringstream(line) >> hash >> kind.program >> version;
  kind.is_told = hash == "#" && !version.empty() && std::isdigit(version[0]) != 0;
  while (kind.analysis.empty() && std::getline(text, line))
    if (line.compare(0, analysis.size(), analysis) == 0)
      kind.analysis = line.substr(analysis.size());
  return kind;
}

/** Kind of the results in a folder; empty if there are none. */
std::optional<RunKind> kind_of_results(const std::string &folder)
{
  std::error_code ignored;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder, ignored))
    if (is_result(entry) || entry.path().extension() == ".checkpoint" ||
        entry.path().filename() == "summary.json")
      return kind_in_parameters(folder + "/parameters.prm");
  return std::nullopt;
}

/** Whether it is a file of --draft, alone in its folder. */
bool is_draft(const std::string &path)
{
  try
    {
      return Hdf5File::open(path, "").is_draft();
    }
  catch (const UserError &) // no file of HDF5
    {
      return false;
    }
}

/** An entry of @p folder with the name of an output file for which is_meant(entry) holds;
 * empty if none. */
template <typename Predicate>
std::string named_as_output(const std::string &folder, const Predicate &is_meant)
{
  std::error_code ignored;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder, ignored))
    {
      const std::string name = entry.path().filename().string();
      if ((std::find(papers.begin(), papers.end(), name) != papers.end() ||
           std::find(results.begin(), results.end(), name) != results.end()) &&
          is_meant(entry))
        return name;
    }
  return "";
}

/** A file in @p folder that a run would replace but did not write; empty if none. */
std::string foreign_file(const std::string &folder)
{
  const auto run = kind_in_parameters(folder + "/parameters.prm");
  return run && run->is_told
           ? ""
           : named_as_output(folder, [](const fs::directory_entry &entry) {
               std::error_code ignored;
               return entry.is_regular_file(ignored) && !is_draft(entry.path().string());
             });
}

/** The folder itself, or its nearest existing parent. */
fs::path existing_part(const std::string &folder)
{
  std::error_code ignored;
  fs::path path = fs::absolute(folder).lexically_normal();
  while (!fs::exists(path, ignored) && path.has_relative_path())
    path = path.parent_path();
  return path;
}
} // namespace

void check_output_folder(const std::string &folder,
                         const std::string &program,
                         const Keys &keys)
{
  for (const Key &key : keys.all())
    for (const std::string &input : key.inputs())
      check_input(folder, key.path(), input);
  for (std::size_t k = 1; k < keys.files().size(); ++k)
    check_input(folder, keys.files()[0] + " includes a file", keys.files()[k]);
  const RunKind kind = {program, keys.has("Analysis") ? keys.value("Analysis") : ""};
  const auto found   = kind_of_results(folder);
  if (found && !found->program.empty() &&
      (found->program != kind.program || found->analysis != kind.analysis))
    throw UserError("the output folder " + folder + " holds results of " + found->text() +
                    ", which those of " + kind.text() +
                    " would replace; choose another folder with --output, or remove "
                    "that one");
  const std::string in_the_way =
    named_as_output(folder, [](const fs::directory_entry &entry) {
      std::error_code ignored;
      return entry.is_directory(ignored);
    });
  if (!in_the_way.empty())
    throw UserError("the output folder " + folder + " has a folder " + in_the_way +
                    ", the name of a file that this run would write; choose another "
                    "folder with --output, or rename that one");
  const std::string foreign = foreign_file(folder);
  if (!foreign.empty())
    throw UserError("the output folder " + folder + " holds " + foreign +
                    ", which this run would replace, and no parameters.prm of a run that "
                    "wrote it; choose another folder with --output, or move that file");
}

std::string bytes_text(const double bytes)
{
  constexpr std::array<const char *, 7> units = {
    {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"}};
  double value     = bytes;
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < units.size(); ++unit)
    value /= 1000.;
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g %s", value, units[unit]);
  return text;
}

double memory_of_machine()
{
  if (const char *given = std::getenv("MESOSLIP_MEMORY"); given != nullptr)
    {
      char *end          = nullptr;
      const double bytes = std::strtod(given, &end);
      if (end == given || *end != '\0' || !(bytes > 0.))
        throw UserError("the environment variable MESOSLIP_MEMORY is '" +
                        std::string(given) +
                        "'; set it to the bytes of memory that a machine offers, such "
                        "as 16e9, or unset it");
      return bytes;
    }
  return static_cast<double>(std::max(0L, sysconf(_SC_PHYS_PAGES))) *
         static_cast<double>(sysconf(_SC_PAGESIZE));
}

void require_memory(const ResourceNeed &need)
{
  const double present = memory_of_machine();
  if (present > 0. && !(need.bytes <= present))
    throw UserError("the run needs about " + bytes_text(need.bytes) +
                    " of memory, but the machine has " + bytes_text(present) + "; " +
                    need.remedy);
}

std::string cells_that_fit(const std::vector<unsigned int> &cells, const double bytes)
{
  const double part = std::pow(memory_of_machine() / bytes, 1. / cells.size());
  std::string shape;
  for (const unsigned int n : cells)
    shape += (shape.empty() ? "" : " x ") +
             std::to_string(std::max(1, static_cast<int>(part * n)));
  return "about " + shape + " cells would fit";
}

void require_disk(const std::string &folder, const ResourceNeed &need)
{
  const fs::path path = existing_part(folder);
  std::error_code code;
  if (!fs::is_directory(path, code))
    throw UserError("the output folder " + folder + " cannot be created: " +
                    path.string() + " is not a folder; give another one with --output");
  if (access(path.c_str(), W_OK | X_OK) != 0)
    throw UserError("the output folder " + folder +
                    " cannot be written to: " + path.string() + " (" + system_message() +
                    "); give another one with --output");
  const fs::space_info space = fs::space(path, code);
  if (!code && !(need.bytes <= static_cast<double>(space.available)))
    throw UserError("the results take about " + bytes_text(need.bytes) +
                    ", but the disk of the output folder " + folder + " has only " +
                    bytes_text(static_cast<double>(space.available)) + " free; " +
                    need.remedy + ", or give another folder with --output");
}
} // namespace mesoslip
