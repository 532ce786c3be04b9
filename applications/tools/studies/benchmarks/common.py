"""What all benchmark studies share: where things are, the machine, CSV, repeated measurements."""

import csv
import dataclasses
import os
import platform
import re
import subprocess
import sys

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), *4 * [".."]))
sys.path.insert(0, os.path.join(TOP, "applications", "tools", "studies"))

from fits import spread  # noqa: E402
from study import Study  # noqa: E402


# The pin of prm/pin at ten times the pressure and without a push, in the motion that the diagrams show: there V counts as
# well as P/V, and modes of higher frequency grow, which needs finer grids and smaller time steps than regime 1.
FROM_REST = {"Supports/Top/Pressure": 5e6, "Body/Initial velocity": [0, 0], "Observation/Steady from": "auto",
             "Observation/Stop at limit cycle": False, "Snapshots/To": "auto"}


def prm(name):
    return os.path.join(TOP, "prm", name)


@dataclasses.dataclass
class Bench:
    """One call of the benchmarks. `pictures` is where diagrams and CSV go, `earlier` the build folder of an earlier commit,
    `fans` the program of that name."""
    runs: str
    programs: str
    pictures: str
    jobs: int
    keep: bool
    quick: bool
    earlier: str = ""
    fans: str = ""

    def study(self, name):
        return Study(os.path.join(self.runs, name), self.programs, jobs=self.jobs, keep=self.keep)

    def tool(self, name, *arguments, ranks=1):
        """Rows (dicts, numbers where they are numbers) of the CSV that a benchmark program prints."""
        command = [os.path.join(self.programs, "..", "tests", name)] + [str(a) for a in arguments]
        if ranks > 1:
            command = ["mpirun", "--oversubscribe", "-np", str(ranks)] + command
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        done = subprocess.run(command, env=environment, text=True, stdout=subprocess.PIPE, check=True)
        return [{key: number(value) for key, value in row.items()} for row in csv.DictReader(done.stdout.splitlines())]

    def write(self, name, rows, note, ranks=1, repetitions=1):
        """NAME.csv: '#' lines say what, on which machine and how often; then one line a row."""
        os.makedirs(self.pictures, exist_ok=True)
        with open(os.path.join(self.pictures, name + ".csv"), "w", encoding="utf-8", newline="") as file:
            facts = {"what": note, **machine(self.programs), "ranks": ranks, "repetitions": repetitions}
            for key, value in facts.items():
                file.write(f"# {key}: {value}\n")
            writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
            writer.writeheader()
            writer.writerows({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows)

    def draw(self, name, figure):
        """NAME.svg, the same bytes for the same numbers; and a PNG beside the runs, for a quick look."""
        os.makedirs(self.pictures, exist_ok=True)
        os.makedirs(self.runs, exist_ok=True)
        figure.savefig(os.path.join(self.pictures, name + ".svg"), metadata={"Date": None})
        figure.savefig(os.path.join(self.runs, name + ".png"), dpi=100)


def read_csv(path):
    """(rows, facts of the '#' lines) of a file by Bench.write."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    facts = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    table = csv.DictReader(line for line in lines if not line.startswith("#"))
    return [{key: number(value) for key, value in row.items()} for row in table], facts


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return text


def machine(programs):
    """Processor, caches, instruction set, compiler and version of the programs."""
    facts = {"machine": f"{platform.system()} {platform.machine()}"}
    try:
        listing = subprocess.run(["lscpu"], text=True, stdout=subprocess.PIPE, check=True,
                                 env=dict(os.environ, LC_ALL="C")).stdout
        cpu = dict(re.split(r":\s*", line.strip(), maxsplit=1) for line in listing.splitlines() if ":" in line)
        caches = ", ".join(f"{name} {cpu[name + ' cache']}" for name in ("L1d", "L2", "L3") if name + " cache" in cpu)
        facts["machine"] = f"{cpu.get('Model name')}, {cpu.get('CPU(s)')} cores, {caches}"
        flags = cpu.get("Flags", "").split()
        facts["instruction set"] = ("x86-64-v4 (AVX-512)" if "avx512vl" in flags
                                    else "x86-64-v3 (AVX2)" if "avx2" in flags and "fma" in flags else "x86-64")
    except (OSError, subprocess.CalledProcessError):
        pass
    facts["compiler"] = compiler(os.path.join(programs, "..", "CMakeCache.txt"))
    version = subprocess.run([os.path.join(programs, "contact_dynamics"), "--version"], text=True, stdout=subprocess.PIPE)
    facts["program"] = version.stdout.strip().splitlines()[0] if version.stdout.strip() else "unknown"
    return facts


def compiler(cache):
    try:
        with open(cache, encoding="utf-8") as file:
            entries = dict(re.findall(r"^(\w+):\w+=(.*)$", file.read(), re.M))
        name = subprocess.run([entries["CMAKE_CXX_COMPILER"], "--version"], text=True, stdout=subprocess.PIPE).stdout
        return f"{name.splitlines()[0]}, {entries.get('CMAKE_BUILD_TYPE', '')}"
    except (OSError, KeyError, IndexError):
        return "unknown"


def cpu_seconds(command):
    """User and system time of a command and its children."""
    before = os.times()
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def require_ended(results):
    """Times of runs that failed say nothing."""
    failed = [f"{name}: {result.message}" for name, result in results.items() if result.status != 0]
    if failed:
        raise RuntimeError("\n".join(failed))


def add_repeated(study, name, repetitions, *arguments, **options):
    """The same run several times, for its time."""
    for k in range(repetitions):
        study.add(f"{name}.{k + 1}", *arguments, **options)


def repeated(results, name, repetitions):
    """(first result, {cpu_s, cpu_s_low, cpu_s_high}) of what add_repeated asked for."""
    runs = [results[f"{name}.{k + 1}"] for k in range(repetitions)]
    return runs[0], spread("cpu_s", [run.cpu_seconds for run in runs])
