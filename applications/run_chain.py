#!/usr/bin/env python3
"""Run a chain of .prm files, each program reading what those before it left.

A folder holds files such as 10-rve_homogenization.prm and 20-contact_dynamics-homogeneous.prm: the name
contains the program, the order is that of the names. All files are copied to the results folder; the
output of NAME.prm goes to NAME/ beside it, so that a later file reads NAME/rve.h5. What is up to date is
skipped; runs that do not need one another go side by side. At the end stands report.html, and one of what is
there already as soon as a core is idle.
"""

import argparse
import concurrent.futures
import functools
import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

PROGRAMS = ("rve_homogenization", "contact_dynamics", "stress_localization")
HERE = os.path.dirname(os.path.abspath(__file__))
STAMP, RANKS = ".up_to_date", ".ranks"
LONG_RUN = 3e9  # cells times steps, some seconds: worth the start of several ranks
ROWS_A_RANK = 40


def fail(sentence):
    print(f"run.sh: {sentence}", file=sys.stderr)
    sys.exit(2)


class Step:
    """One .prm file of a chain."""

    def __init__(self, name, folder, programs):
        self.name = name
        self.prm = os.path.join(folder, name + ".prm")
        self.output = os.path.join(folder, name)
        found = [p for p in PROGRAMS if p in name]
        if not found:
            fail(f"{name}.prm names no program; put one of {', '.join(PROGRAMS)} into the file's name")
        self.program = os.path.join(programs, found[0])
        self.needs = []
        self.stamp = None

    def find_needs(self, earlier):
        with open(self.prm, encoding="utf-8", errors="replace") as file:
            text = "\n".join(line.split("#")[0] for line in file)
        self.needs = [step for step in earlier if step.name + "/" in text or step.name + "\n" in text]

    def compute_stamp(self, data_files):
        digest = hashlib.sha256()
        for path in [self.prm, self.program, *data_files]:
            with open(path, "rb") as file:
                digest.update(hashlib.sha256(file.read()).digest())
        for step in self.needs:
            digest.update(step.stamp.encode())
        self.stamp = digest.hexdigest()

    def up_to_date(self):
        try:
            with open(os.path.join(self.output, STAMP), encoding="utf-8") as file:
                return file.read() == self.stamp and os.path.exists(os.path.join(self.output, "summary.json"))
        except OSError:
            return False

    def begun(self):
        """What is complete and yet not up to date was asked for differently: it starts anew."""
        return os.path.isdir(self.output) and not os.path.exists(os.path.join(self.output, "summary.json"))

    def command(self, ranks, resume):
        start = ["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
        return start + [self.program, self.prm, "--output", self.output] + (["--resume"] if resume else [])

    def hangs_on(self, other):
        return any(need is other or need.hangs_on(other) for need in self.needs)

    def ranks_begun_with(self):
        """A run is resumed with as many."""
        try:
            with open(os.path.join(self.output, RANKS), encoding="utf-8") as file:
                return int(file.read())
        except (OSError, ValueError):
            return 1

    def keep_ranks(self, ranks):
        path = os.path.join(self.output, RANKS)
        if ranks > 1:
            os.makedirs(self.output, exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(str(ranks))
        elif os.path.exists(path):
            os.remove(path)

    def ask_to_stop(self):
        with open(os.path.join(self.output, "terminate"), "w", encoding="utf-8"):
            pass

    def useful_ranks(self):
        """How many ranks a long transient contact run is worth; 1 for everything else."""
        if not self.program.endswith("contact_dynamics"):
            return 1
        said = subprocess.run([self.program, "--validate", self.prm], capture_output=True, text=True, check=False).stdout
        cells, steps = re.search(r"(\d+) x (\d+) cells", said), re.search(r"(\d+) steps", said)
        if not cells or not steps or int(cells[1]) * int(cells[2]) * int(steps[1]) < LONG_RUN:
            return 1
        return max(1, int(cells[2]) // ROWS_A_RANK)

    def mark_done(self):
        with open(os.path.join(self.output, STAMP), "w", encoding="utf-8") as file:
            file.write(self.stamp)


def copy_inputs(source, target):
    """Copies the files of a chain; what did not change keeps its time."""
    os.makedirs(target, exist_ok=True)
    names = sorted(n for n in os.listdir(source) if os.path.isfile(os.path.join(source, n)))
    for name in names:
        new, old = os.path.join(source, name), os.path.join(target, name)
        if os.path.abspath(new) != os.path.abspath(old):
            shutil.copy2(new, old)
    return names


class Runner:
    """Runs the steps of a chain in the order of their needs, several at a time."""

    def __init__(self, steps, jobs, ranks, resume, preview=None):
        self.steps, self.jobs, self.ranks, self.preview = steps, jobs, ranks, preview
        self.resume = resume
        self.lock = threading.Lock()
        self.children = []  # processes, each with the function that stops it
        self.environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")

    def say(self, line):
        with self.lock:
            print(line, flush=True)

    def ranks_for(self, step, resume, last):
        """As asked for; else all cores for the `last` run, beside which no other can start."""
        if self.ranks:
            return self.ranks
        if resume:
            return step.ranks_begun_with()
        return min(self.jobs, step.useful_ranks()) if last and self.jobs > 1 else 1

    def run_step(self, step, alone, last):
        resume = self.resume and step.begun()
        ranks = self.ranks_for(step, resume, last)
        step.keep_ranks(ranks)
        output = {} if alone else {"text": True, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        # mpirun would end its ranks on Ctrl-C before they have saved their state.
        child = subprocess.Popen(step.command(ranks, resume), env=self.environment, start_new_session=ranks > 1, **output)
        with self.lock:
            self.children.append((child, step.ask_to_stop if ranks > 1 else child.terminate))
        for line in child.stdout or ():
            self.say(f"[{step.name}] {line.rstrip()}")
        return child.wait()

    def attempt(self, step, alone, last):
        begin = time.monotonic()
        status = self.run_step(step, alone, last)
        if status == 0:
            step.mark_done()
            self.say(f"{step.name}: done in {time.monotonic() - begin:.1f} s")
        else:
            self.say(f"{step.name}: stopped with exit status {status}")
        return status

    def run(self):
        waiting, done, running, worst, shown = list(self.steps), set(), {}, 0, None
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            try:
                while waiting or running:
                    ready = [s for s in waiting if all(n.name in done for n in s.needs)]
                    alone = len(ready) == 1 and not running and not any(
                        all(n.name in done for n in s.needs) for s in waiting if s is not ready[0])
                    for step in ready if worst == 0 else []:
                        if len(running) >= self.jobs:
                            break
                        waiting.remove(step)
                        if step.up_to_date():
                            self.say(f"{step.name}: up to date")
                            done.add(step.name)
                        else:
                            last = all(s.hangs_on(step) for s in waiting)
                            running[pool.submit(self.attempt, step, alone or self.jobs == 1, last)] = step
                    if not running:
                        if worst or not any(all(n.name in done for n in s.needs) for s in waiting):
                            break
                        continue
                    if self.preview and done and waiting and worst == 0 and len(running) < self.jobs and (shown is None or shown.done()):
                        shown = pool.submit(self.preview)
                    finished, _ = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
                    for future in finished:
                        step, status = running.pop(future), future.result()
                        worst = worst or status
                        if status == 0:
                            done.add(step.name)
            except KeyboardInterrupt:
                # The runs save their state; leaving the pool waits for them.
                for child, stop in self.children:
                    if child.poll() is None:
                        stop()
                worst = 130
        if worst == 130:
            self.say("stopped; the same command with --resume goes on from here")
        return worst


def write_report(steps, target, words="Report"):
    script = os.path.join(HERE, "report", "make_report.py")
    page = os.path.join(target, "report.html")
    folders = [s.output for s in steps if os.path.exists(os.path.join(s.output, "summary.json"))]
    if not folders or not os.path.exists(script):
        return 0
    status = subprocess.call([sys.executable, script, "--output", page, *folders])
    print(f"{words}: {page}" if status == 0 else f"run.sh: the report could not be written to {page}")
    return status


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./run.sh", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", help="folder with .prm files, or the name of one in prm/; "
                        "without it the paper's pin, prm/pin")
    parser.add_argument("--output", metavar="DIR", help="results folder (default: results, or results/<folder>)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="runs side by side (default: all cores)")
    parser.add_argument("--ranks", type=int, help="MPI ranks of each run (default: one, but all cores for a long contact run "
                        "that comes last)")
    parser.add_argument("--resume", action="store_true", help="continue interrupted runs from their checkpoints")
    parser.add_argument("--no-report", action="store_true", help="do not write report.html")
    parser.add_argument("--programs", default=os.path.join(HERE, "..", "build", "applications"), help=argparse.SUPPRESS)
    parser.add_argument("--from", dest="origin", default=os.getcwd(), help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.jobs < 1 or (arguments.ranks is not None and arguments.ranks < 1):
        fail("--jobs and --ranks have to be at least 1")
    return arguments


def find_folder(arguments):
    top = os.path.dirname(HERE)
    if arguments.folder is None:
        return os.path.join(top, "prm", "pin"), os.path.join(top, "results")
    for start in (arguments.origin, top, os.path.join(top, "prm")):
        folder = os.path.normpath(os.path.join(start, arguments.folder))
        if os.path.isdir(folder):
            return folder, os.path.join(top, "results", os.path.basename(folder))
    return fail(f"there is no folder '{arguments.folder}', neither here nor in prm/")


def on_sigterm(*_):
    raise KeyboardInterrupt


def main():
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, on_sigterm)
    arguments = parse_arguments()
    source, target = find_folder(arguments)
    if arguments.output:
        target = os.path.normpath(os.path.join(arguments.origin, arguments.output))
    names = copy_inputs(source, target)
    chain = [n[:-4] for n in names if n.endswith(".prm")]
    if not chain:
        fail(f"no .prm file in {source}")
    steps = []
    data_files = [os.path.join(target, n) for n in names if n.rsplit(".", 1)[-1] in ("csv", "png", "txt")]
    for name in chain:
        step = Step(name, target, arguments.programs)
        step.find_needs(steps)
        step.compute_stamp(data_files)
        steps.append(step)
    report = None if arguments.no_report else functools.partial(write_report, steps, target)
    preview = report and functools.partial(report, "Report so far")
    status = Runner(steps, arguments.jobs, arguments.ranks, arguments.resume, preview).run()
    if report:
        status = status or report()
    sys.exit(status)


if __name__ == "__main__":
    main()
