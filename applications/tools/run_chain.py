#!/usr/bin/env python3
"""Run a chain of .prm files, each program reading what those before it left, or a single .prm file.

A folder holds files such as 10-rve_homogenization.prm and 20-contact_dynamics-homogeneous.prm: the name contains
the program, the order is that of the names. They and the files that they name, beside them or below, are copied to
the results folder; the output of NAME.prm goes to NAME/ beside it, so that a later file reads NAME/rve.h5. The
whole chain is checked before anything runs. What is up to date (.prm, the files it names, program, and the runs
before it) is skipped; runs that do not need one another go side by side. At the end stands report.html, and one of
what is there already as soon as a core is idle.

A single file, which may be a map (section Sweep), is run where it is; its results go to its Output folder, seen from
the current folder, and the report to report.html there.
"""

import argparse
import functools
import os
import shutil
import signal
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # leave no __pycache__ in a source tree
HERE = os.path.dirname(os.path.abspath(__file__))

from chain.inputs import ChainError, check_target, copy_inputs, list_inputs  # noqa: E402
from chain.plan import Plan  # noqa: E402
from chain.runner import INTERRUPTED, Runner  # noqa: E402
from chain.single import SingleFile  # noqa: E402
from chain.step import PROGRAMS, Step  # noqa: E402


def write_report(folders, page, words="Report"):
    script = os.path.join(HERE, "report", "make_report.py")
    if not folders or not os.path.exists(script):
        return 0
    status = subprocess.call([sys.executable, script, "--output", page, *folders])
    if status >= 0:  # not by a signal
        print(f"{words}: {page}" if status == 0 else f"run.sh: the report could not be written to {page}")
    return status


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./run.sh", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", help="folder with .prm files, or the name of one in prm/; or a .prm file; "
                        "without it the paper's pin, prm/pin")
    parser.add_argument("--output", metavar="DIR", help="results folder (default: results, or results/<folder>, beside run.sh; of an "
                        "installed script in the current folder)")
    parser.add_argument("--validate", action="store_true", help="check the whole chain and say what it takes: memory, disk, and the time, "
                        "for which each run is begun for some seconds; nothing is left")
    parser.add_argument("--jobs", type=int, help="runs side by side (default: all cores)")
    parser.add_argument("--ranks", type=int, help="MPI ranks of each run (default: one; where no other run can start beside "
                        "it and it is long, as many as there are idle cores)")
    parser.add_argument("--resume", action="store_true", help="continue interrupted runs from their checkpoints")
    parser.add_argument("--no-report", action="store_true", help="do not write report.html")
    parser.add_argument("--programs", metavar="DIR", help="folder of the three programs (default: where they are built or installed)")
    parser.add_argument("--from", dest="origin", default=os.getcwd(), help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if any(number is not None and number < 1 for number in (arguments.jobs, arguments.ranks)):
        raise ChainError("--jobs and --ranks have to be at least 1")
    arguments.programs = os.path.abspath(arguments.programs or find_programs())
    return arguments


def find_programs():
    """Built beside these scripts, installed with them, or in the search path."""
    build = os.path.normpath(os.path.join(HERE, "..", "..", "build", "applications"))
    installed = os.path.normpath(os.path.join(HERE, "..", "..", "..", "..", "bin"))
    for folder in (build, installed, os.path.dirname(shutil.which(PROGRAMS[0]) or "")):
        if os.path.isfile(os.path.join(folder, PROGRAMS[0])):
            return folder
    return build


def find_folder(arguments):
    top = os.path.dirname(os.path.dirname(HERE))
    checkout = os.path.isfile(os.path.join(top, "run.sh"))
    results = os.path.join(top if checkout else arguments.origin, "results")
    if arguments.folder is None:
        return os.path.join(top, "prm", "pin"), results
    for start in (arguments.origin, top, os.path.join(top, "prm")):
        folder = os.path.normpath(os.path.join(start, arguments.folder))
        if os.path.isdir(folder):
            return folder, os.path.join(results, os.path.basename(folder))
    raise ChainError(f"there is no folder '{arguments.folder}', neither here nor in prm/")


def find_file(arguments):
    """Path of the single .prm file that is meant, seen from the current folder; None: a folder is."""
    path = arguments.folder or ""
    if not os.path.isfile(os.path.join(arguments.origin, path)):
        return None
    if not path.endswith(".prm"):
        raise ChainError(f"'{path}' is no .prm file; name one, or a folder of them")
    if arguments.jobs:
        raise ChainError("--jobs is for the runs of a chain; points of a map run side by side as Sweep/Processes says")
    return path


def on_signal(*_):
    raise KeyboardInterrupt


def run_file(step, arguments):
    """The exit status."""
    if arguments.validate:
        print(step.said, end="")
        return 0
    status = Runner([step], os.cpu_count() or 1, arguments.ranks, arguments.resume, None, {step.name: step.said}).run()
    return status if status or arguments.no_report else write_report([step.output], os.path.join(step.output, "report.html"))


def run():
    """The exit status."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, on_signal)
    arguments = parse_arguments()
    if file := find_file(arguments):
        return run_file(SingleFile(file, arguments), arguments)
    jobs = arguments.jobs or os.cpu_count() or 1
    source, target = find_folder(arguments)
    if arguments.output:
        target = os.path.normpath(os.path.join(arguments.origin, arguments.output))
    names, files = list_inputs(source)
    check_target(source, target, files)
    with tempfile.TemporaryDirectory(prefix="mesoslip-") as folder:
        plan = Plan(source, target, names, files, arguments.programs, folder)
        if arguments.validate:
            return 2 if plan.tell(jobs) else 0
        plan.check_all(arguments.resume)
    copy_inputs(source, target, files)
    steps = []
    for name in names:
        steps.append(Step(name, target, arguments.programs, steps))

    def report(words="Report"):
        return write_report([s.output for s in steps if s.up_to_date()], os.path.join(target, "report.html"), words)

    preview = None if arguments.no_report else functools.partial(report, "Report so far")
    status = Runner(steps, jobs, arguments.ranks, arguments.resume, preview, plan.said).run()
    if preview and status != INTERRUPTED:  # of a chain that failed: what it has done until then
        said = preview() if status else report()
        return status or said
    return status


def main():
    try:
        status = run()
    except ChainError as error:
        print(f"run.sh: {error}", file=sys.stderr)
        status = 2
    except KeyboardInterrupt:
        status = INTERRUPTED
    except BrokenPipeError:  # whoever read what is printed has enough, as `head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        status = 1
    if status == INTERRUPTED:
        print("stopped; the same command with --resume goes on from here")
    sys.exit(status)


if __name__ == "__main__":
    main()
