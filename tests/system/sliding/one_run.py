"""What surrounds the steps of a run is the same on a grid, a mesh and a box: results that cannot be written, the clock of a run that goes on,
why it blew up, and strains before it was interrupted; and strains of a static contact."""

import os
import re
import signal
import tempfile
import time

from mesh_files import Box
from scenes import Folder, prm

STIFFNESS = "283e9, 121e9, 283e9, 81e9"
STEEL = {"Phases/Names": "body", "Phases/body/Type": "stiffness", "Phases/body/Stiffness": STIFFNESS, "Phases/body/Density": 7800}
SLIDING = {"Flat/Velocity": 2, "Supports/Top/Pressure": 5e6, "Friction/Coefficient": 0.4, "Time/Time step": 4e-8, "Time/End time": 2e-5}
BODIES = {
    "grid": {"Body/Stiffness": STIFFNESS, "Body/Density": 7800, "Body/Size": "0.008, 0.004", "Body/Cells": "16, 8"},
    "mesh": {"Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, **STEEL},
    "box": {"Dimension": 3, "Body/Stiffness": "283e9, 121e9, 121e9, 283e9, 121e9, 283e9, 81e9, 81e9, 81e9", "Body/Density": 7800,
            "Body/Size": "0.004, 0.002, 0.004", "Body/Cells": "8, 4, 8"}}


def run(folder, status, body, output, settings=None, *options):
    return folder.run(status, "contact_dynamics", body + ".prm", "--output", output,
                      *(f"--set={key}={value}" for key, value in (settings or {}).items()), *options)


def check_output_that_fails(folder, body):
    """What was computed is in the checkpoint: --resume writes it, the same as without the failure."""
    run(folder, 0, body, "whole")
    os.mkdir(folder("late"))
    os.symlink("nowhere/at/all", folder("late", "history.csv"))
    said = run(folder, 2, body, "late")
    assert "history.csv" in said and "The state is in the checkpoint" in folder.read("late", "log.txt").decode(), (body, said)
    os.remove(folder("late", "history.csv"))
    said = run(folder, 0, body, "late", {}, "--resume")
    assert "Resumed at step 500, t = 2e-05 s" in said, (body, said)
    for name in ("history.csv", "energy.csv"):
        assert folder.read("late", name) == folder.read("whole", name), (body, name)


def check_clock(folder, body):
    """The time loop of a run that was stopped and resumed for one step has the seconds of all."""
    sparse = [f"--set=Observation/{name} interval=1000000" for name in ("History", "Energy")]
    words = ["contact_dynamics", body + ".prm", "--output", "parts", *sparse]
    child = folder.start(*words, "--set=Time/End time=0.4")
    time.sleep(2)
    child.send_signal(signal.SIGINT)
    said = "".join(child.communicate())
    steps = int(re.search(r"stopped on request after step (\d+)", said)[1])
    assert steps > 1000, (body, said)
    folder.run(0, *words, f"--set=Time/End time={4e-8 * (steps + 1)}", "--resume")
    summary = folder.summary("parts")
    seconds = summary["cells"] * summary["steps"] / summary["cell_updates_per_second"]
    assert summary["steps"] == steps + 1 and seconds > 0.3, (body, seconds)


def check_runaway(folder, body):
    """The cause is the time step, and no key that the body does not have."""
    said = run(folder, 3, body, "fast", {"Time/Time step": 2e-7, "Time/Check time step": "false", "Time/End time": 1e-3})
    assert "of the critical one; use Time/Time step = auto" in said and "Mesh/Scale" not in said, (body, said)
    assert (" J where" if body == "box" else " J/m where") in said, (body, said)
    said = run(folder, 2, body, "long", {"Time/End time": 1e12})
    assert "more than any run can do" in said and ("Mesh/Scale" if body == "mesh" else "Body/Size") in said, (body, said)


def check_strains(folder, body):
    """A blow that was over before the run was interrupted is told of the whole run."""
    blow = {"Supports/Top/Expression": "(t < 4e-6) ? 2e10 : 1e6", "Time/Rayleigh beta": 1e-7, "Time/Time step": 1e-8, "Checkpoints/Keep": "true"}
    said = run(folder, 0, body, "hit", {**blow, "Time/End time": 6e-5})
    assert "earlier in the run" not in said and " in step " in said and "the strain is " in said, (body, said)
    said = run(folder, 0, body, "hit", {**blow, "Time/End time": 6.1e-5}, "--resume")
    assert "earlier in the run, beyond small strains" in said, (body, said)


def check_static_strains(folder, body, largest):
    """Large ones are told with their place, the same on a grid and on a mesh of it, and a cell that is inside out ends the analysis."""
    settings = {key: value for key, value in {**SLIDING, **BODIES[body]}.items() if not key.startswith("Time/")}
    folder.write(body + ".prm", prm({"Analysis": "static contact", **settings, "Friction/Coefficient": 0.1, "Supports/Top/Pressure": 2.5e10}))
    for ranks in (1,) if body == "grid" else (1, 3):
        said = folder.run(0, "contact_dynamics", body + ".prm", "--output", "static", ranks=ranks)
        found = folder.summary("static")["largest_strain"]
        assert "the strain is " in said and " around x = " in said and found > 0.05, (body, said)
        assert abs(found / largest.setdefault(body.replace("mesh", "grid"), found) - 1) < 1e-6, (body, ranks, found, largest)
    said = folder.run(3, "contact_dynamics", body + ".prm", "--output", "static", "--set=Supports/Top/Pressure=1e12")
    assert "static contact: cell " in said and "turned inside out" in said and "Supports/Top/Pressure = 1e+12 Pa" in said, (body, said)


if __name__ == "__main__":
    mesh = Box([8, 4], [16, 8], lambda x: "body").name_side("Contact", 1, False).name_side("Top", 1, True)
    strains = {}
    for name, settings in BODIES.items():
        with tempfile.TemporaryDirectory() as path:
            scenes = Folder(path)
            mesh.write(scenes("mesh.msh"))
            scenes.write(name + ".prm", prm({**SLIDING, **settings}))
            for check in (check_output_that_fails, check_clock, check_runaway, check_strains):
                check(scenes, name)
            check_static_strains(scenes, name, strains)
