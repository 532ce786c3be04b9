#ifndef mesoslip_io_program_h
#define mesoslip_io_program_h

#include "io/resources.h"

#include <functional>
#include <iosfwd>
#include <string>

namespace dealii
{
class ParameterHandler;
}

namespace mesoslip
{
class KeyUse;
class RawParameters;
class RunContext;

/**
 * What distinguishes one application from another. All functions are called on every
 * rank, with the handler at its top level.
 */
struct Program
{
  /** As typed in the shell. */
  std::string name;
  /** One line for --help. */
  std::string description;

  /**
   * Declares all keys. @p raw is what the .prm and --set say (empty for
   * --print-parameters without a file) and decides optional sections.
   * "Output folder" is declared already.
   */
  std::function<void(dealii::ParameterHandler &prm, const RawParameters &raw)> declare;

  /**
   * Refuses keys that others leave without effect; called before check() and before
   * anything is printed. Throws UserError. May be empty.
   */
  std::function<void(const KeyUse &use)> check_keys;

  /**
   * Parses and cross-checks, cheaply; always called, before anything is created.
   * Returns what the results take on the disk, to be compared with the free space.
   * Throws UserError. May be empty.
   */
  std::function<Need(dealii::ParameterHandler &prm)> check;

  /**
   * Prints memory, steps and the like for --validate; called after check(). Only what
   * rank 0 writes to @p report is shown. May be empty.
   */
  std::function<void(dealii::ParameterHandler &prm, std::ostream &report)> estimate;

  /**
   * Whether a run with these parameters writes checkpoints, so that run() has to heed
   * RunContext::resume(). Others start from the beginning with --resume as well. May be
   * empty: never.
   */
  std::function<bool(dealii::ParameterHandler &prm)> resumable;

  /** The work itself. */
  std::function<void(dealii::ParameterHandler &prm, RunContext &context)> run;
};

/**
 * The main function of an application: options, parameters, output folder, log,
 * timings, summary.json, exit status (ExitStatus). Errors are printed once, to stderr, as
 * `<program>: <sentence>`; nothing escapes.
 */
int run_program(int argc, char **argv, const Program &program);
} // namespace mesoslip

#endif
