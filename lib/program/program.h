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

  /** What the results take on the disk, to be compared with the free space. */
  virtual ResourceNeed need() const
  {
    return {};
  }

  /**
   * Prints memory, steps and the like for --validate. Only what rank 0 writes to @p out
   * is shown.
   */
  virtual void describe(std::ostream & /*out*/) const
  {
  }

  /**
   * Writes to the folder @p folder what runs that read the results of this one have to
   * find for their own --validate: files like the results, with a guess or nothing in the
   * place of what is to be computed (io/drafts.h). Called on every rank. @throws UserError
   * also where no later run reads the results
   */
  virtual void write_draft(const std::string &folder) const;

  /**
   * Whether it writes checkpoints, so that run() has to heed RunContext::resume(). Others
   * start from the beginning with --resume as well.
   */
  virtual bool resumable() const
  {
    return false;
  }

  /** Processes on idle cores by which it ends sooner; one where they take as long to start as they save. --validate
   * tells it, so that ./run.sh can choose. */
  virtual unsigned int useful_ranks() const
  {
    return 1;
  }

  /** The work itself. */
  virtual void run(RunContext &context) = 0;
};

/** What distinguishes one application from another. */
struct Application
{
  std::string name;        ///< as typed in the shell
  std::string description; ///< one line for --help

  /**
   * Binds all keys; "Output folder" is bound already. Called once to declare them and once
   * to judge the conditions between them, before anything is printed. @throws UserError
   */
  std::function<void(Keys &keys)> declare;

  /**
   * Reads the keys and the input files, and checks both, cheaply; always called, before
   * anything is created. @throws UserError
   */
  std::function<std::unique_ptr<Analysis>(Keys &keys)> build;

  /** What Analysis::write_draft() writes, for --help; empty: there is no --draft. */
  std::string draft = {};
};

/**
 * Does what run_program() does with @p words, the command line without the name of the program, in a process that runs
 * already. All ranks of @p communicator, which are all there are, call it. Errors are returned on all of them, not printed.
 */
Outcome carry_out(const std::vector<std::string> &words,
                  const Application &program,
                  const MPI_Comm communicator);

/**
 * The main function of an application: options, parameters, output folder, log,
 * timings, summary.json, exit status (ExitStatus). Errors are printed once, to stderr, as
 * `<program>: <sentence>`; nothing escapes.
 */
int run_program(int argc, char **argv, const Application &program);
} // namespace mesoslip

#endif
