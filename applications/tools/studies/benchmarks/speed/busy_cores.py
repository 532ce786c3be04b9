"""How many ranks where other processes run as well: one, two, and what ./run.sh and the Python module choose, with the time that choosing takes.
Whole programs by the clock, in turns."""

import os
import subprocess
import sys
import time

from common import TOP, prm
from fits import spread

sys.path.append(os.path.join(TOP, "applications", "tools", "python", "mesoslip"))

from ranks import ranks_worth, start_of  # noqa: E402

BUSY = (0, 1, 4, 10)  # processes that only count
LAYOUTS = {"one rank": 1, "two ranks": 2, "chosen": None}
# Each some seconds on one rank.
SCENES = {
    "steps in 2D": ("contact_dynamics", "pin/20-contact_dynamics-homogeneous.prm", {
        "Body/RVE file": "{rve}/rve.h5", "Body/Cells": "560, 160", "Time/End time": 2e-4, "Observation/Steady from": "auto",
        "Observation/Stop at limit cycle": "false", "Snapshots/From": 0, "Snapshots/To": "auto", "Snapshots/Interval": 0}),
    "steps in 3D": ("contact_dynamics", "examples/voxels/pad/20-contact_dynamics-homogeneous.prm", {
        "Body/RVE file": "{pad}/rve.h5", "Body/Cells": "96, 96, 96", "Body/Size": "0.048, 0.048, 0.048", "Time/End time": 1e-6,
        "Observation/Steady from": "auto", "Observation/Stop at limit cycle": "false", "Snapshots/From": 0, "Snapshots/To": "auto",
        "Snapshots/Interval": 0}),
    "statics": ("rve_homogenization", "examples/voxels/pad/10-rve_homogenization.prm", {"Grid/Cells": "192, 64, 96"}),
}
REPETITIONS = 3


def run(bench):
    os.makedirs(os.path.join(bench.runs, "busy_cores"), exist_ok=True)
    inputs = {name: seconds_of(bench, "rve_homogenization", file, {}, 1, name) and os.path.join(bench.runs, "busy_cores", name)
              for name, file in (("rve", "pin/10-rve_homogenization.prm"), ("pad", "examples/voxels/pad/10-rve_homogenization.prm"))}
    turns = 1 if bench.quick else REPETITIONS
    rows = []
    for scene, (program, file, settings) in SCENES.items():
        settings = {key: str(value).format(**inputs) for key, value in settings.items()}
        for n_busy in BUSY:
            taken = measure(bench, n_busy, turns, program, file, settings)
            for layout, seconds in taken.items():
                ratios = [one / found for one, found in zip(taken["one rank"], seconds)]
                rows.append({"scene": scene, "busy": n_busy, "layout": layout, **spread("seconds", seconds), **spread("times_as_fast", ratios)})
                print(f"  {scene}, {n_busy} busy, {layout}: {min(seconds):.1f} s", file=sys.stderr, flush=True)
    bench.write("busy-cores", rows, "seconds by the clock of whole programs, beside so many processes that only count; chosen: with the time that "
                "the choice takes; times as fast as one rank in the same turn", ranks="1 and 2", repetitions=turns)


def measure(bench, n_busy, turns, program, file, settings):
    """Seconds of each layout in each turn."""
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(n_busy)]
    try:
        taken = {layout: [] for layout in LAYOUTS}
        for _ in range(turns):
            for layout, ranks in LAYOUTS.items():
                taken[layout].append(seconds_of(bench, program, file, settings, ranks, f"run-{program}"))
        return taken
    finally:
        for process in busy:
            process.kill()
            process.wait()


def seconds_of(bench, program, file, settings, ranks, name):
    words = [os.path.join(bench.programs, program), prm(file), *(word for key, value in settings.items() for word in ("--set", f"{key}={value}"))]
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    begin = time.monotonic()
    if ranks is None:
        said = subprocess.run([*words, "--validate"], capture_output=True, text=True, check=True).stdout
        ranks = ranks_worth(said, 2)
    subprocess.run([*start_of(ranks), *words, "--quiet", "--output", os.path.join(bench.runs, "busy_cores", name)], env=environment, check=True,
                   stdout=subprocess.DEVNULL)
    return time.monotonic() - begin
