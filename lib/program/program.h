#ifndef mesoslip_program_program_h
#define mesoslip_program_program_h

#include "program/outcome.h"
#include "program/output_folder.h"

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;
class RunContext;

/**
 * A computation whose parameters and input files have been read and checked. All
 * functions are called on every rank.
 */
class Analysis
{
public:
  virtual ~Analysis() = default;

  /** Disk space of the results, to be compared with the free space. */
  virtual ResourceNeed need() const
  {
    return {};
  }

  /**
   * Prints memory, steps and the like for --validate. Only output of rank 0 to @p out is
   * shown.
   */
  virtual void describe(std::ostream & /*out*/) const
  {
  }

  /**
   * Writes draft results to @p folder, with which later runs can be validated: files
   * like the results, with guesses or gaps in place of computed data (io/drafts.h).
   * Called on every rank.
   * @throws UserError also if no later run reads the results
   */
  virtual void write_draft(const std::string &folder) const;

  /**
   * Whether it writes checkpoints, so that run() observes RunContext::resume(). Other
   * analyses start from the beginning with --resume, too.
   */
  virtual bool resumable() const
  {
    return false;
  }

  /** Number of processes on idle cores that still shorten the run; 1 if starting them
   * takes longer than they save. --validate reports it, so that ./run.sh can choose. */
  virtual unsigned int useful_ranks() const
  {
    return 1;
  }

  /** Runs the analysis. */
  virtual void run(RunContext &context) = 0;
};

/** Properties of an application. */
struct Application
{
  std::string name;        ///< name in the shell
  std::string description; ///< a line for --help

  /**
   * Binds all keys; "Output folder" is bound already. Called once to declare them and once
   * to judge the conditions between them, before anything is printed. @throws UserError
   */
  std::function<void(Keys &keys)> declare;

  /**
   * Reads the keys and the input files, and checks both quickly; always called before
   * anything is created.
   * @throws UserError
   */
  std::function<std::unique_ptr<Analysis>(Keys &keys)> build;

  /** Content of Analysis::write_draft(), for --help; empty: there is no --draft. */
  std::string draft = {};
};

/**
 * Like run_program() for @p words, the command line without the program's name, in a
 * running process. Called on all ranks of @p communicator, which are all ranks. Errors
 * are returned on all of them, not printed.
 */
Outcome carry_out(const std::vector<std::string> &words,
                  const Application &program,
                  const MPI_Comm communicator);

/**
 * The main function of an application: options, parameters, output folder, log, timings,
 * summary.json, exit status (ExitStatus). Errors are printed once, to stderr, as
 * `<program>: <sentence>`; no exception escapes.
 */
int run_program(int argc, char **argv, const Application &program);
} // namespace mesoslip

#endif
