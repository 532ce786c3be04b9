"""What tests of the programs and scripts share: where things are, texts of .prm files, and folders in which the programs run. With it
the modules of applications/tools/studies can be imported."""

import atexit
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
TOOLS = os.path.join(TOP, "applications", "tools")
PROGRAMS = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else ""
sys.path.append(os.path.join(TOOLS, "studies"))
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def prm(settings):
    """The text of a .prm file for {"Section/Key": value}."""
    text = ""
    for path, value in settings.items():
        *sections, key = path.split("/")
        text += "".join(f"subsection {name}\n" for name in sections) + f"set {key} = {value}\n" + "end\n" * len(sections)
    return text


PHASES = prm({"Phases/matrix/Young modulus": "30e9", "Phases/matrix/Density": 1770, "Phases/fibre/Young modulus": "240e9",
              "Phases/fibre/Density": 1770})
SMALL_GRID = prm({"Grid/Cells": "20, 10", "Grid/Size": "0.002, 0.001"})


def rve(cells, size, lowest, highest, **more):
    """Random fibres from `lowest` to `highest` (m)."""
    return PHASES + prm({"Grid/Cells": cells, "Grid/Size": size, "Microstructure/Random fibres/Minimum height": lowest,
                         "Microstructure/Random fibres/Maximum height": highest, **more})


SMALL_RVE = rve("20, 10", "0.002, 0.001", 2e-4, 4e-4)


def sets(settings):
    """{"Section/Key": value} or ["Section/Key=value"] as words of a command line."""
    return ["--set=" + (item if isinstance(item, str) else "%s=%s" % item)
            for item in (settings.items() if isinstance(settings, dict) else settings)]


def ccache(folder):
    """Words before those of a compiler that have ccache keep what is compiled below the folder, with the settings of CMakeLists.txt: the same files are
    not compiled again, wherever the folder is. No words where it is not installed."""
    if not shutil.which("ccache"):
        return []
    settings = {"CCACHE_BASEDIR": os.path.realpath(folder), "CCACHE_NOHASHDIR": 1,
                "CCACHE_SLOPPINESS": "time_macros,include_file_mtime,include_file_ctime"}
    if "CCACHE_DIR" not in os.environ:
        settings |= {"CCACHE_DIR": os.path.expanduser("~/.cache/mesoslip/ccache"), "CCACHE_MAXSIZE": "4G"}
    return ["env", *(f"{name}={value}" for name, value in settings.items()), "ccache"]


def run_chain(*arguments):
    """What applications/tools/run_chain.py says."""
    done = subprocess.run([sys.executable, "-B", os.path.join(TOOLS, "run_chain.py"), "--programs", PROGRAMS, *arguments], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    return done.stdout


class Server:
    """The process of program_server.cc: the programs without the 0.3 s that each start of them takes on each rank."""

    def __init__(self):
        self.program, self.client = (os.path.join(PROGRAMS, "..", "tests", "program_" + name) for name in ("server", "client"))
        self.process, self.lock, self.folder = None, threading.Lock(), None

    def is_there(self):
        """Programs that are installed, for example, have none."""
        return os.path.exists(self.program)

    def begin(self):
        self.folder = tempfile.TemporaryDirectory()
        self.process = subprocess.Popen([self.program, self.socket()], env=ENVIRONMENT, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        atexit.register(self.stop)
        assert self.process.stdout.readline() == b"listening\n"

    def socket(self):
        return os.path.join(self.folder.name, "socket")

    def stop(self):
        self.process.stdin.close()
        self.process.wait()
        self.folder.cleanup()

    def command(self, program):
        """Of a process that stands for the program, with its words to follow: mpirun can start it."""
        with self.lock:
            if not self.process:
                self.begin()
        return [os.path.abspath(self.client), self.socket(), program]

    def end(self, program, folder, words):
        """Exit status, standard output and errors of the program, run in the folder."""
        with self.lock:
            if not self.process:
                self.begin()
            texts = [os.path.join(self.folder.name, name) for name in ("output", "errors")]
            request = [program, os.path.abspath(folder), *texts, str(len(words)), *words]
            self.process.stdin.write(b"".join(os.fsencode(word) + b"\0" for word in request))
            self.process.stdin.flush()
            status = int(self.process.stdout.readline())
            out, err = (Folder(self.folder.name).read(name).decode() for name in ("output", "errors"))
            return status, out, err


def served(command, **_):
    """subprocess.run() of a program, its output captured, for the modules of run_chain.py in this process: as Folder.end()."""
    program, *words = command
    return subprocess.CompletedProcess(command, *Folder(os.getcwd()).end(os.path.basename(program), *words))


SERVED = ("rve_homogenization", "contact_dynamics", "stress_localization")
SERVER = Server()
# Ranks on one machine look for no network, and those that wait leave their core to others; when one has failed, mpirun ends the others at once.
QUICK = {"OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self,vader", "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_odls_base_sigkill_timeout": "0"}


class Folder:
    """A folder with files NAME.prm, in which programs run; called with names it is the path of what is in it."""

    def __init__(self, path, texts=()):
        self.path = path
        for name, text in dict(texts).items():
            self.write(name + ".prm", text)

    def __call__(self, *names):
        return os.path.join(self.path, *names)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self(name)), exist_ok=True)
        with open(self(name), "w", encoding="utf-8", newline="") as file:
            file.write(text)

    def read(self, *names):
        with open(self(*names), "rb") as file:
            return file.read()

    def summary(self, *names):
        return json.loads(self.read(*names, "summary.json"))

    def start(self, program, *words, ranks=1, by=None, **keywords):
        """The process of the program, or of the command `by` that stands for it."""
        mpirun = ["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
        return subprocess.Popen([*mpirun, *(by or [os.path.join(PROGRAMS, program)]), *words], **{
            "cwd": self.path, "env": ENVIRONMENT, "text": True, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **keywords})

    def end(self, program, *words, ranks=1, **keywords):
        """Exit status, standard output and errors. The server of the programs, which saves their start, runs them, where there is one; not
        when the process itself is to be another one: another user, or with a library before all others."""
        served = program in SERVED and SERVER.is_there() and set(keywords) <= {"env"} and "LD_PRELOAD" not in keywords.get("env", ())
        if served and ranks == 1 and not keywords:
            return SERVER.end(program, self.path, words)
        if ranks > 1:
            keywords["env"] = {**QUICK, **keywords.get("env", ENVIRONMENT)}
        child = self.start(program, *words, ranks=ranks, by=SERVER.command(program) if served else None, **keywords)
        out, err = child.communicate()
        return child.returncode, out, err

    def run(self, status, program, *words, **keywords):
        """What the program says, which has to end with the exit status."""
        found, out, err = self.end(program, *words, **keywords)
        assert found == status, f"{program} {words}: exit status {found} instead of {status}: {out}{err}"
        return out + err
