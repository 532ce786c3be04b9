#include "program/command_line.h"

#include "base/errors.h"

#include <boost/program_options.hpp>

#include <sstream>

namespace mesoslip
{
namespace
{
namespace po = boost::program_options;

po::options_description visible_options()
{
  po::options_description options("Options", 96, 66);
  // clang-format off
  options.add_options()
    ("help,h",   "print this text")
    ("version",  "print the version")
    ("print-parameters", "print all parameters with meaning, allowed values and default, in .prm "
                         "syntax; with a file, its values")
    ("validate", "read and check the parameters, estimate memory and steps; run and create "
                 "nothing")
    ("set",      po::value<std::vector<std::string>>()->value_name("'Section/Key=value'"),
                 "override a parameter of the file; may be repeated")
    ("output,o", po::value<std::string>()->value_name("DIR"),
                 "output folder, relative to the current folder; goes before the file's "
                 "'Output folder'")
    ("resume",   "continue from the checkpoint in the output folder, if there is one")
    ("quiet,q",  "print nothing but warnings and errors")
    ("profile",  "print at the end where the time went");
  // clang-format on
  return options;
}

CommandLine from_map(const po::variables_map &found)
{
  CommandLine line;
  line.help             = found.count("help") > 0;
  line.version          = found.count("version") > 0;
  line.print_parameters = found.count("print-parameters") > 0;
  line.validate         = found.count("validate") > 0;
  line.resume           = found.count("resume") > 0;
  line.quiet            = found.count("quiet") > 0;
  line.profile          = found.count("profile") > 0;
  if (found.count("output"))
    line.output = found["output"].as<std::string>();
  if (found.count("set"))
    line.assignments = found["set"].as<std::vector<std::string>>();
  if (found.count("file"))
    {
      const auto &files = found["file"].as<std::vector<std::string>>();
      if (files.size() > 1)
        throw UserError("one parameter file is expected, but '" + files[0] + "' and '" +
                        files[1] + "' are given");
      line.prm_file = files.front();
    }
  return line;
}
} // namespace

CommandLine CommandLine::parse(int argc, char **argv)
{
  po::options_description all = visible_options();
  all.add_options()("file", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("file", -1);

  CommandLine line;
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
      line = from_map(found);
      if (found.count("output") && line.output.empty())
        throw UserError("--output needs the name of a folder");
    }
  catch (const po::error &error)
    {
      throw UserError(std::string(error.what()) + "; see --help");
    }
  if (line.prm_file.empty() && !line.help && !line.version && !line.print_parameters)
    throw UserError("a parameter file (.prm) is needed; see --help");
  return line;
}

std::string CommandLine::help_text(const std::string &program,
                                   const std::string &description)
{
  std::ostringstream text;
  text << "Usage: " << program << " [options] file.prm\n\n"
       << description << "\n\n"
       << visible_options() << '\n'
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
