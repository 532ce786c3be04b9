"""Starts the three programs and chains of them, and opens what they leave."""

import os
import shutil
import subprocess
import sys
import warnings

from .folders import open_folder
from .maps import settings_of
from .program_choice import PROGRAMS, Refused, program_for, results_folder, sentence_of
from .ranks import keep_ranks, ranks_begun_with, ranks_worth, start_of

HERE = os.path.dirname(os.path.abspath(__file__))


class RunError(RuntimeError):
    """A program or a chain did not end well. Its text is the program's sentence; `status` the exit status: 2 bad input, 3 numerical
    failure, 130 interrupted, 1 anything else."""

    def __init__(self, sentence, status):
        super().__init__(sentence)
        self.status = status


def find_program(name, programs=None):
    """Path of a program: in the folder `programs`, else in that of the environment variable MESOSLIP_PROGRAMS, else in PATH, else in the
    build of the checkout that this module lies in. Raises FileNotFoundError."""
    given = programs or os.environ.get("MESOSLIP_PROGRAMS")
    if given:
        path = os.path.join(os.path.abspath(given), name)
        if os.access(path, os.X_OK) and os.path.isfile(path):
            return path
        where = "the argument programs" if programs else "MESOSLIP_PROGRAMS"
        raise FileNotFoundError(f"there is no program {path}; {where} has to name the folder of the programs")
    built = os.path.normpath(os.path.join(HERE, *[os.pardir] * 4, "build", "applications", name))
    path = shutil.which(name) or (built if os.access(built, os.X_OK) else None)
    if path is None:
        raise FileNotFoundError(f"the program {name} is not in PATH; name its folder with programs=... or MESOSLIP_PROGRAMS")
    return path


def run(prm, settings=None, output=None, ranks=None, resume=False, program=None, programs=None):
    """Runs the program that a .prm file is for, and returns its opened results: a ResultFile, or a RunFolder where the run leaves no HDF5.

    `settings`: {"Supports/Top/Pressure": 4e5} goes before what the file says; lists become "a, b". `output`: folder of the results, else that of the
    file's key `Output folder`, else output/NAME. `ranks`: number of MPI processes; without it one, or for a long run as many as there are
    idle cores. `program`: its name, where neither the file's name nor its keys tell. Warnings of the run become Python warnings. Raises
    RunError with the program's sentence."""
    words = [f"--set={key}={_value_text(value)}" for key, value in (settings or {}).items()]
    prm = os.fspath(prm)
    words += [f"--output={os.fspath(output)}"] if output is not None else []
    words += ["--resume"] if resume else []
    path, said = _program_for(prm, words, program, programs)
    output = results_folder(said)
    if ranks is None:
        ranks = ranks_begun_with(output) if resume else ranks_worth(said, os.cpu_count() or 1)
    keep_ranks(output, ranks)
    _call([*start_of(ranks), path, prm, "--quiet", *words])
    return open_folder(output)


def sweep(prm, axes, settings=None, output=None, processes=None, complex_modes=False, program=None, programs=None):
    """Runs a .prm of contact_dynamics at all points of a grid, side by side, and returns the opened map: `.map` is the SweepMap.

    `axes`: {"Supports/Top/Pressure": values, ...}, or {name: (key, values)}. `processes`: how many points at once, without it as many as
    there are cores; `complex_modes`: whether each point has them, too. Points that are in the output folder already are not computed
    again. Points that fail become a warning. Raises RunError with the program's sentence."""
    more = {**({"Sweep/Processes": processes} if processes else {}), **({"Sweep/Complex modes": True} if complex_modes else {})}
    return run(prm, {**(settings or {}), **settings_of(axes), **more}, output, 1, False, program or "contact_dynamics", programs)


def run_chain(folder, output=None, jobs=None, ranks=None, resume=False, report=True, programs=None):
    """Runs the .prm files of a folder as ./run.sh does, and returns the opened Chain.

    `output`: the results folder, else results/NAME in the current folder; `jobs`: runs side by side; `report`: whether to write
    report.html. Nothing runs unless the whole chain is valid. Raises RunError with the sentence of the chain, or of the run that failed."""
    folder = os.path.abspath(os.fspath(folder))
    output = os.path.join("results", os.path.basename(folder)) if output is None else os.fspath(output)
    place = os.path.dirname(find_program(PROGRAMS[0], programs))
    words = [folder, "--programs", place, "--output", os.path.abspath(output)]
    words += [f"--{name}={value}" for name, value in (("jobs", jobs), ("ranks", ranks)) if value is not None]
    words += [option for option, wanted in (("--resume", resume), ("--no-report", not report)) if wanted]
    _call([sys.executable, "-B", _chain_script(place), *words])
    return open_folder(output)


def _value_text(value):
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return value
    if hasattr(value, "__iter__"):
        return ", ".join(_value_text(item) for item in value)
    return repr(float(value)) if hasattr(value, "dtype") and value.dtype.kind == "f" else str(value)


def _program_for(prm, words, program, programs):
    """The program, and what it says when it checks the file. Raises RunError."""
    if program is not None and program not in PROGRAMS:
        raise ValueError(f"there is no program {program}, there are {', '.join(PROGRAMS)}")
    try:
        return program_for(prm, words, lambda name: find_program(name, programs), program)
    except Refused as refused:
        advice = "; say which with program=..." if str(refused).startswith("none of the programs") else ""
        raise RunError(str(refused) + advice, refused.status) from refused


def _chain_script(place):
    """run_chain.py beside this module, or by the programs: of a build, or installed with them."""
    beside = os.path.join(HERE, os.pardir, os.pardir)
    for tools in (beside, os.path.join(place, *[os.pardir] * 2, "applications", "tools"),
                  os.path.join(place, os.pardir, "share", "mesoslip", "applications", "tools")):
        if os.path.isfile(os.path.join(tools, "run_chain.py")):
            return os.path.normpath(os.path.join(tools, "run_chain.py"))
    raise FileNotFoundError(f"run_chain.py is neither beside this module nor with the programs in {place}; install mesoslip with cmake --install")


def _call(command):
    """Runs a command; Ctrl-C waits for it, as runs save their state. Raises RunError; passes warnings on."""
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    child = subprocess.Popen(command, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        said, errors = child.communicate()
    except KeyboardInterrupt:
        child.communicate()
        raise
    # Steps of a chain beside one another speak through its standard output.
    errors += "".join(f"{line.partition('] ')[2]}\n" for line in said.splitlines() if line.startswith("["))if "run_chain.py" in " ".join(command) else ""
    for line in errors.splitlines():
        if ": warning: " in line:
            warnings.warn(line.partition(": warning: ")[2], stacklevel=3)
    if child.returncode:
        raise RunError(sentence_of(errors), child.returncode)
