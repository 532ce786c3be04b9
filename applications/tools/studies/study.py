"""Studies: many runs of the programs that differ in a few keys, side by side, resumable.

    study = Study("results/stability", programs, jobs=2)
    study.add("rve", "rve_homogenization", "prm/pin/10-rve_homogenization.prm")
    study.add("fast", "contact_dynamics", "prm/pin/20-contact_dynamics-homogeneous.prm",
              {"Body/RVE file": "{rve}/rve.h5", "Flat/Velocity": 20})
    results = study.run()
    results["fast"].summary["regime"]

`{name}` in a setting is the folder of another run of the study, which then goes first. A run whose .prm,
settings, program and needs did not change since it ended is not repeated; one that was stopped or killed goes on from
its last checkpoint.
"""

import argparse
import concurrent.futures
import dataclasses
import hashlib
import json
import os
import re
import subprocess
import sys
import threading
import time

STAMP = ".study.json"
BEGUN = ".study_begun"
PLACEHOLDER = re.compile(r"\{([\w.+=-]+)\}")
KEEPABLE = (0, 3)  # ended, or stopped as numerically unstable: both are answers


@dataclasses.dataclass
class Result:
    """How one run ended. `cpu_seconds` sums user and system time of all ranks: unlike `seconds` it hardly
    depends on what else the machine does. `message` is the last line on stderr, where a failure is named."""
    folder: str
    status: int
    seconds: float
    cpu_seconds: float
    message: str

    @property
    def summary(self):
        """The run's summary.json, or {} where the run left none."""
        try:
            with open(os.path.join(self.folder, "summary.json"), encoding="utf-8") as file:
                return json.load(file)
        except (OSError, ValueError):
            return {}


@dataclasses.dataclass
class Case:
    name: str
    program: str
    prm: str
    settings: dict
    ranks: int
    needs: list


class Study:
    """Runs under `folder`, one subfolder each. `programs` is the folder with the three executables."""

    def __init__(self, folder, programs, jobs=None, keep=False, timeout=None, always=False):
        self.folder, self.programs = os.path.abspath(folder), os.path.abspath(programs)
        self.jobs = jobs or os.cpu_count() or 1
        self.keep = keep  # take results of another build of the programs as well
        self.timeout = timeout
        self.always = always  # run again whatever is there: programs that keep results of the same inputs know better
        self.cases, self.stamps, self.digests = {}, {}, {}
        self.lock = threading.Lock()
        self.done = 0

    def add(self, name, program, prm, settings=None, ranks=1):
        """One run; `settings` maps 'Section/Key' to a value (see --set)."""
        if name in self.cases:
            raise ValueError(f"two runs named {name}")
        settings = {key: _text(value) for key, value in (settings or {}).items()}
        needs = sorted({n for value in settings.values() for n in PLACEHOLDER.findall(value)})
        for need in needs:
            if need not in self.cases:
                raise ValueError(f"{name} needs {need}, which has to be added before it")
        self.cases[name] = Case(name, program, os.path.abspath(prm), settings, ranks, needs)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self):
        """Runs what is not up to date; returns {name: Result} in the order of `add`. A run whose need failed is left out."""
        os.makedirs(self.folder, exist_ok=True)
        results, waiting, running, self.done = {}, list(self.cases.values()), {}, 0
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            while waiting or running:
                for case in list(waiting):
                    if all(need in results for need in case.needs):
                        waiting.remove(case)
                        if any(results[need].status != 0 for need in case.needs):
                            self._say(f"{case.name}: left out, as {', '.join(case.needs)} failed")
                        else:
                            running[pool.submit(self._attempt, case)] = case.name
                if not running:
                    break
                finished, _ = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
                for future in finished:
                    results[running.pop(future)] = future.result()
        return {name: results[name] for name in self.cases if name in results}

    def _attempt(self, case):
        stamp, plain = self._stamps(case)
        known = self._read_stamp(case)
        if known and not self.always and (known["stamp"] == stamp or self.keep and plain in (known["stamp"], known.get("plain"))):
            self.stamps[case.name] = known["stamp"], plain  # what needs it is stamped by the run that is there
            with self.lock:
                self.done += 1
            return Result(self.path(case.name), known["status"], known["seconds"], known["cpu_seconds"], known["message"])
        resume = self._begun(case) == stamp and not os.path.exists(os.path.join(self.path(case.name), "summary.json"))
        os.makedirs(self.path(case.name), exist_ok=True)
        with open(os.path.join(self.path(case.name), BEGUN), "w", encoding="utf-8") as file:
            file.write(stamp)
        result = self._execute(case, resume)
        with self.lock:
            self.done += 1
        if result.status in KEEPABLE:
            with open(os.path.join(self.path(case.name), STAMP), "w", encoding="utf-8") as file:
                json.dump({"stamp": stamp, "plain": plain, **{k: v for k, v in dataclasses.asdict(result).items() if k != "folder"}}, file)
        self._say(f"[{self.done}/{len(self.cases)}] {case.name}: "
                  + ("done" if result.status == 0 else f"exit status {result.status}: {result.message}")
                  + f" ({result.seconds:.1f} s)")
        return result

    def _words(self, case, resume):
        """What follows the program on its command line."""
        settings = [word for key, value in self._filled(case).items() for word in ("--set", f"{key}={value}")]
        return [case.prm, "--output", self.path(case.name), "--quiet", *["--resume"] * resume, *settings]

    def _execute(self, case, resume):
        command = [os.path.join(self.programs, case.program), *self._words(case, resume)]
        if case.ranks > 1:
            command = ["mpirun", "--oversubscribe", "-np", str(case.ranks)] + command
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        log = os.path.join(self.path(case.name), "study_stderr.txt")
        begin = time.monotonic()
        with open(log, "wb") as errors:
            child = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=errors)
            timer = threading.Timer(self.timeout, child.kill) if self.timeout else None
            if timer:
                timer.start()
            _, code, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(code)
            if timer:
                timer.cancel()
        with open(log, encoding="utf-8", errors="replace") as file:
            lines = [line.strip() for line in file if line.strip()]
        return Result(self.path(case.name), child.returncode, time.monotonic() - begin,
                      usage.ru_utime + usage.ru_stime, lines[-1] if lines and child.returncode else "")

    def _filled(self, case):
        return {key: PLACEHOLDER.sub(lambda m: self.path(m.group(1)), value) for key, value in case.settings.items()}

    def _stamps(self, case):
        """Digests of what determines a run: with its program, and without, for --keep."""
        self.stamps[case.name] = self._stamp(case, 0), self._stamp(case, 1)
        return self.stamps[case.name]

    def _stamp(self, case, which):
        digest = hashlib.sha256(json.dumps([case.settings, case.ranks]).encode())
        digest.update(self._digest(case.prm))
        if which == 0:
            digest.update(self._digest(os.path.join(self.programs, case.program)))
        for need in case.needs:
            digest.update(self.stamps[need][which].encode())
        return digest.hexdigest()

    def _digest(self, path):
        if path not in self.digests:
            with open(path, "rb") as file:
                self.digests[path] = hashlib.sha256(file.read()).digest()
        return self.digests[path]

    def _read_stamp(self, case):
        try:
            with open(os.path.join(self.path(case.name), STAMP), encoding="utf-8") as file:
                return json.load(file)
        except (OSError, ValueError):
            return None

    def _begun(self, case):
        try:
            with open(os.path.join(self.path(case.name), BEGUN), encoding="utf-8") as file:
                return file.read()
        except OSError:
            return None

    def _say(self, line):
        with self.lock:
            print(line, file=sys.stderr, flush=True)


def _text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(float(value))  # without the name that numpy 2 gives its own
    if isinstance(value, (list, tuple)):
        return ", ".join(_text(v) for v in value)
    return str(value)


def parse_arguments(description, default_output, parts, add_options=None, on_request=()):
    """The command line that all studies share: which `parts` (names, default all) to run, and where.
    `add_options(parser)` adds what only this study knows; parts `on_request` are not among all."""
    top = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", metavar="part", help="of " + ", ".join(parts) + " (default: all)"
                        + (f"; further {', '.join(on_request)}" if on_request else ""))
    parser.add_argument("--output", metavar="DIR", default=os.path.join(top, "results", default_output),
                        help=f"folder of the runs (default: results/{default_output})")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="runs side by side (default: all cores)")
    parser.add_argument("--keep", action="store_true", help="take the runs of an earlier build of the programs as they are")
    parser.add_argument("--programs", default=os.path.join(top, "build", "applications"), help=argparse.SUPPRESS)
    if add_options:
        add_options(parser)
    arguments = parser.parse_args()
    unknown = [part for part in arguments.parts if part not in (*parts, *on_request)]
    if unknown:
        parser.error(f"there is no part '{unknown[0]}'; the parts are {', '.join((*parts, *on_request))}")
    arguments.parts = arguments.parts or list(parts)
    return arguments
