#include "program/command_line.h"

#include "base/errors.h"

#include <boost/program_options.hpp>

#include <sstream>

namespace mesoslip
{
namespace
{
namespace po = boost::program_options;

/** The options of --help, which parsing stores in @p line. */
po::options_description visible_options(CommandLine &line, const std::string &draft)
{
  const std::string writes_draft =
    "with --validate: write to the folder DIR what the --validate of later runs has to "
    "read, " +
    draft;
  po::options_description options("Options", 96, 66);
  // clang-format off
  options.add_options()
    ("help,h",   po::bool_switch(&line.help), "print this text")
    ("version",  po::bool_switch(&line.version), "print the version")
    ("print-parameters", po::bool_switch(&line.print_parameters),
                 "print all parameters with meaning, allowed values and default, in .prm "
                 "syntax; with a file, its values")
    ("validate", po::bool_switch(&line.validate),
                 "read and check the parameters, estimate memory and steps; run and create "
                 "nothing");
  if (!draft.empty())
    options.add_options()
    ("draft",    po::value(&line.draft)->value_name("DIR"), writes_draft.c_str());
  options.add_options()
    ("set",      po::value(&line.assignments)->value_name("'Section/Key=value'"),
                 "override a parameter of the file; may be repeated")
    ("ignore-unused", po::bool_switch(&line.ignore_unused),
                 "leave keys aside that have no effect with the others, instead of refusing them, "
                 "as with --set 'Analysis=complex modes' for the file of a transient run")
    ("output,o", po::value(&line.output)->value_name("DIR"),
                 "output folder, relative to the current folder; goes before the file's "
                 "'Output folder'")
    ("resume",   po::bool_switch(&line.resume),
                 "continue from the checkpoint in the output folder, if there is one")
    ("try",      po::bool_switch(&line.trial),
                 "run where inputs may be drafts, to see how long it takes; the results, in "
                 "a new folder, are drafts, too, which no other run takes")
    ("quiet,q",  po::bool_switch(&line.quiet), "print nothing but warnings and errors")
    ("summary-only", po::bool_switch(&line.summary_only),
                 "of transient runs: write no histories, fields and tables, which takes time where "
                 "many short runs are made")
    ("profile",  po::bool_switch(&line.profile), "print at the end where the time went")
    ("serve",    po::bool_switch(&line.serve),
                 "without a file: carry out the command lines on standard input one after the "
                 "other, each a JSON list of words on a line, and answer each with its exit "
                 "status and message");
  // clang-format on
  return options;
}
} // namespace

CommandLine
CommandLine::parse(int argc, const char *const *argv, const std::string &draft)
{
  CommandLine line;
  std::vector<std::string> files;
  po::options_description all = visible_options(line, draft);
  all.add_options()("file", po::value(&files));
  po::positional_options_description positional;
  positional.add("file", -1);
  try
    {
      namespace style = po::command_line_style;
      po::variables_map found;
      po::store(po::command_line_parser(argc, argv)
                  .options(all)
                  .positional(positional)
                  .style(style::unix_style & ~style::allow_guessing)
                  .run(),
                found);
      po::notify(found);
      if (found.count("output") && line.output.empty())
        throw UserError("--output needs the name of a folder");
      if (found.count("draft") && (line.draft.empty() || !line.validate))
        throw UserError("--draft needs the name of a folder, and --validate");
      if (line.trial && (line.validate || line.resume))
        throw UserError(
          "--try begins a run in a new folder: it goes neither with --validate "
          "nor with --resume");
    }
  catch (const po::error &error)
    {
      throw UserError(std::string(error.what()) + "; see --help");
    }
  if (files.size() > 1)
    throw UserError("one parameter file is expected, but '" + files[0] + "' and '" +
                    files[1] + "' are given");
  if (!files.empty())
    line.prm_file = files.front();
  if (line.serve && argc > 2)
    throw UserError("--serve goes with nothing else; the runs come on standard input");
  if (line.prm_file.empty() && !line.help && !line.version && !line.print_parameters &&
      !line.serve)
    throw UserError("a parameter file (.prm) is needed; see --help");
  return line;
}

std::string CommandLine::help_text(const std::string &program,
                                   const std::string &description,
                                   const std::string &draft)
{
  CommandLine unused;
  std::ostringstream text;
  text << "Usage: " << program << " [options] file.prm\n\n"
       << description << "\n\n"
       << visible_options(unused, draft) << '\n'
       << "Relative paths of input files in a .prm start at the folder of that .prm, "
          "those of\n"
          "--set and all output folders at the current folder. Without --output and "
          "'Output\n"
          "folder' the results go to output/<name of the .prm>.\n\n"
          "A run is stopped by Ctrl-C or by a file named 'terminate' in its output "
          "folder (under\n"
          "mpirun use the file); it then keeps what it has observed and "
          "returns "
          "130.\n\n"
          "Exit status: 0 done; 2 bad input; 3 numerical failure; 130 interrupted; 1 "
          "anything "
          "else.\n";
  return text.str();
}
} // namespace mesoslip
