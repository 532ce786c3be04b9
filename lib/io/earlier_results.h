#ifndef mesoslip_io_earlier_results_h
#define mesoslip_io_earlier_results_h

#include <filesystem>
#include <map>
#include <string>

namespace mesoslip
{
/**
 * The results (.h5, .csv, .xdmf) that a run finds in its folder. It replaces them when it
 * has all of its own, but parameters and log when it starts. Those that are not its own
 * are listed in `earlier_results.txt`: all meanwhile, and for good if it fails; in the
 * end those that it has none of, such as energy.csv of a run with energies. Nothing is
 * removed.
 */
class EarlierResults
{
public:
  EarlierResults() = default;

  /** Lists what is in @p folder. @throws UserError if the list cannot be written. */
  explicit EarlierResults(const std::string &folder);

  /** The run has written its results: only what it has not replaced remains listed. */
  void replaced();

  /** What is there is of this run: the list goes. */
  void adopted();

private:
  void write_list() const;

  std::string folder;
  std::map<std::string, std::filesystem::file_time_type> written;
};

/** Whether a file in a folder is a result of the kinds above. */
bool is_result(const std::filesystem::directory_entry &entry);

/**
 * Throws a UserError beginning with @p what if @p path, an input, is among the results
 * that the list in its folder names.
 */
void require_of_latest_run(const std::string &what, const std::string &path);
} // namespace mesoslip

#endif
