"""Checks a whole chain before anything runs, and tells what it will take.

The check goes on in a folder of links to the inputs, where each step has the results of those before it: the finished ones, or
drafts of rve.h5 and dynamics.h5 that `PROGRAM --validate --draft` writes. So contact_dynamics knows grid and phases of a volume that has
not been computed, and stress_localization the bodies, snapshots and probes of runs that have not been made. A step that reads what has no
draft has its keys and values checked, and the names of the files that it reads.
"""

import difflib
import os
import re
import shutil
import signal
import subprocess

from chain.inputs import ChainError, output_named, settings, values
from chain.runner import STOPPING
from chain.speed import measure
from chain.step import Step

BYTES = {"bytes": 1, "kB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12, "PB": 1e15, "EB": 1e18}
SIZE = rf"([\d.e+]+) ({'|'.join(BYTES)})"
LIBRARIES = 170e6  # bytes, which contact_dynamics leaves out of what it says; as measured
DRAFTED = {"rve.h5", "dynamics.h5", "counter_body.h5"}  # what `--validate --draft` writes
MADE = {"rve_homogenization": {"": ("rve.h5", "loads.h5")}, "stress_localization": {"": ("localization.h5",)},
        "contact_dynamics": {"transient": ("dynamics.h5", "counter_body.h5"), "static contact": ("dynamics.h5", "counter_body.h5"), "modal": ("modal.h5",),
                             "complex modes": ("complex_modes.h5",)}}


def bytes_text(size):
    unit = max((u for u in BYTES if BYTES[u] <= max(size, 1)), key=BYTES.get)
    return f"{size / BYTES[unit]:.3g} {unit}"


def duration_text(seconds):
    if seconds < 90:
        return f"{seconds:.0f} s" if seconds >= 1 else "1 s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def link_inputs(source, target, names, files, folder):
    """Links to the files of a chain and to what has run before."""
    for name in files:
        link = os.path.join(folder, name)
        os.makedirs(os.path.dirname(link), exist_ok=True)
        os.symlink(os.path.join(os.path.abspath(source), name), link)
    for name in names:
        if os.path.isdir(os.path.join(target, name)):
            os.symlink(os.path.join(os.path.abspath(target), name), os.path.join(folder, name))


class Estimate:
    """What the step `name` is going to take; None where that is not known."""

    def __init__(self, name, text="", libraries=0.0):
        self.name, self.checked = name, bool(text)
        self.memory = self._size(rf"{SIZE} of memory|about {SIZE}", text)
        self.memory = self.memory and self.memory + libraries
        self.disk = self._size(rf"{SIZE} on the disk", text)
        self.seconds = None

    @staticmethod
    def _size(pattern, text):
        found = re.search(pattern, text)
        if not found:
            return None
        number, unit = (word for word in found.groups() if word)
        return float(number) * BYTES[unit]

    def text(self):
        """What is known, as the end of a sentence."""
        parts = [f"{bytes_text(size)} {what}" for size, what in ((self.memory, "of memory"), (self.disk, "on the disk")) if size]
        if self.seconds:
            parts.append(f"about {duration_text(self.seconds)} on one core")
        return ", ".join(parts)


class Plan:
    def __init__(self, source, target, names, files, programs, folder):
        """`folder`: an empty one for the check. Raises ChainError for what can be seen without the programs."""
        self.target, self.folder, self.steps = target, folder, []
        link_inputs(source, target, names, files, folder)
        for name in names:
            self.steps.append(Step(name, folder, programs, self.steps))
        for step in self.steps:
            self._check_order(step)
        self.environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        self.to_run = [step for step in self.steps if not step.up_to_date()]
        self.drafted, self.said = set(), {}  # steps with drafts; what the programs say of the steps

    def _check_order(self, step):
        """A file of another step is one of an earlier step, and of a name that this step gives."""
        names = [other.name for other in self.steps]
        for value in values(step.prm):
            maker = output_named(value, self.folder, names)
            if maker is None:
                self._check_name(step, value, names)
            if maker is None or maker == step.name:
                continue
            if names.index(maker) > names.index(step.name):
                raise ChainError(f"{step.name}.prm reads {value}, but {maker} runs later: the order is that of the names; rename one of them")
            made = made_by(self.steps[names.index(maker)])
            if value.endswith(".h5") and os.path.basename(value) not in made:
                raise ChainError(f"{step.name}.prm reads {value}, but {maker} makes {' and '.join(made) or 'no file of that kind'}")

    def _check_name(self, step, value, names):
        """A result that is not there, in a folder whose name is nearly that of a step, or begins as one."""
        first = value.split("/")[0]
        near = [name for name in names if name.startswith(first)] or difflib.get_close_matches(first, names, 1)
        if value.endswith(".h5") and near and not os.path.exists(os.path.join(self.folder, first)):
            raise ChainError(f"{step.name}.prm reads {value}, but no step of this chain is called {first}; did you mean {near[0]}{value[len(first):]}?")

    def missing(self, step):
        """Values of its .prm that name what has yet to be made and has no draft."""
        names = {other.name for other in self.to_run}
        return [value for value in values(step.prm) if (output_named(value, self.folder, names) or step.name) != step.name
                and not self._can_read_draft(step, value)]

    def _can_read_draft(self, step, value):
        """A localization; or a run of the body, of rve.h5. The homogenization of friction needs numbers of a run."""
        path = os.path.normpath(value)
        return ((path in self.drafted or os.path.dirname(path) in self.drafted) and not step.program.endswith("rve_homogenization")
                and (step.program.endswith("stress_localization")
                     or all(need.program.endswith("rve_homogenization") for need in step.needs)))

    def check(self, step, resume=False):
        """The Estimate of a step of `to_run`, and what its program says for the user. Raises ChainError."""
        begun = resume and step.begun()
        if os.path.islink(step.output):
            os.remove(step.output)  # what is there is not what the next step will read
        missing = self.missing(step)
        output = os.path.join(self.target, step.name)
        if missing:
            for value in values(step.prm):
                if value.endswith(".h5") and value not in missing and not os.path.exists(os.path.join(self.folder, value)):
                    raise ChainError(f"{step.name}.prm: there is no file {value}, and no step before makes it")
            self._ask(step, "--print-parameters")
            return Estimate(step.name), [f"the rest is checked when it runs, as it reads {', '.join(missing)}"]
        words = ["--validate", "--output", output]
        draft = DRAFTED & set(made_by(step))
        said = self.said[step.name] = self._ask(step, *words, *(["--draft", step.output] if draft else []), *(["--resume"] if begun else []))
        if draft:
            self.drafted.add(step.name)
        lines = [line for line in said.splitlines() if line.startswith("warning: ") and "is a draft for" not in line]
        guessed = [need.name for need in step.needs if need.name in self.drafted]
        if guessed:
            lines.insert(0, f"{self._stand_in(step)} that {', '.join(guessed)} will compute")
        return Estimate(step.name, said, LIBRARIES if step.program.endswith("contact_dynamics") else 0.0), lines

    @staticmethod
    def _stand_in(step):
        return "drafts stand for the results" if step.program.endswith("stress_localization") else "Hill's mean of the phases stands for the stiffness"

    def _ask(self, step, *words):
        """What the program says. Raises ChainError with its sentence or the signal that ended it, KeyboardInterrupt when that was one to
        stop."""
        done = subprocess.run([step.program, step.prm, *words], env=self.environment, capture_output=True, text=True, check=False)
        if -done.returncode in STOPPING:
            raise KeyboardInterrupt
        if done.returncode < 0:
            raise ChainError(f"{step.name}: the check was ended by signal {-done.returncode} ({signal.strsignal(-done.returncode)})")
        if done.returncode:
            said = done.stderr.strip().splitlines() or [f"{step.program}: exit status {done.returncode}"]
            sentence = said[-1].partition(": ")[2].replace(self.folder + os.sep, "")
            raise ChainError(sentence if sentence.startswith(step.name) else f"{step.name}: {sentence}")
        return done.stdout.replace(self.folder + os.sep, "")

    def check_all(self, resume=False):
        """Raises ChainError for the first step that would not run."""
        for step in self.to_run:
            self.check(step, resume)

    def tell(self, jobs):
        """Prints what each step and all of them will take; the number of those that would not run."""
        estimates, wrong = [], 0
        for step in self.steps:
            if step not in self.to_run:
                print(f"{step.name}: up to date")
                continue
            try:
                estimate, lines = self.check(step)
            except ChainError as error:
                wrong += 1
                print(error)
                continue
            verdict = "keys and values are valid"
            if not self.missing(step):
                estimate.seconds = measure(step, os.path.join(self.folder, "speed"), self.environment)
                verdict = f"valid; {estimate.text() or 'its need is not known'}"
            estimates.append(estimate)
            print(f"{step.name}: {verdict}", *(f"  {line}" for line in lines), sep="\n", flush=True)
        shutil.rmtree(os.path.join(self.folder, "speed"), ignore_errors=True)
        if estimates and not wrong:
            print(sum_text(estimates, jobs))
        return wrong


def made_by(step):
    """Names of the HDF5 files that a step may leave."""
    program = os.path.basename(step.program)
    keys = dict(settings(step.prm)) if program == "contact_dynamics" else {}
    if keys.get("Axes"):  # of Sweep
        return ("map.h5",)
    analysis = keys.get("Analysis", "transient") if program == "contact_dynamics" else ""
    return MADE[program].get(analysis, ())


def sum_text(estimates, jobs):
    """Of all steps together, and which of them are left out of it and why."""
    def known(name):
        return [getattr(e, name) for e in estimates if getattr(e, name) is not None]
    seconds, disk, memory = sum(known("seconds")), sum(known("disk")), sum(sorted(known("memory"))[-jobs:])
    lines = [f"In sum: about {duration_text(seconds)} on one core, {bytes_text(disk)} on the disk, {bytes_text(memory)} of memory with "
             f"{jobs} side by side"]
    not_in = [(lambda e: not e.checked, "not in the sum, as what it reads has yet to be made"),
              (lambda e: e.checked and e.seconds is None, "not in the time, as no short run told it"),
              (lambda e: e.checked and e.disk is None, "not in the place on the disk, which the program does not tell"),
              (lambda e: e.checked and e.memory is None, "not in the memory, which the program does not tell")]
    for pick, why in not_in:
        names = [e.name for e in estimates if pick(e)]
        if names:
            lines.append(f"  {why}: {', '.join(names)}")
    return "\n".join(lines)
