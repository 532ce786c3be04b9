#!/usr/bin/env python3
"""The Python module on the files of a short chain: values, shapes, units, errors, and its example."""

import os
import re
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy as np

from scenes import TOOLS, TOP, Folder, sets

sys.path.insert(0, os.path.join(TOOLS, "python"))
import mesoslip

MESHES = os.path.join(TOP, "prm", "examples", "mesh")
IMAGE = os.path.join(TOP, "prm", "examples", "image")
SHORT = {"Time/End time": "6e-5", "Snapshots/From": "4e-5", "Snapshots/Interval": "2e-6", "Observation/Blocks": "5"}


def run(program, folder, name, settings, examples=IMAGE):
    Folder(folder).run(0, program, os.path.join(examples, name + ".prm"), "--quiet", "--output", name, *sets(settings))
    return os.path.join(folder, name)


def check_rve(folder):
    with mesoslip.open(folder) as rve:
        assert rve.format == "mesoslip-rve" and rve.grid.cells == (80, 40)
        stiffness = rve["stiffness/effective"]
        assert np.array_equal(stiffness, rve.summary["stiffness"]["effective"])
        assert rve["phase/name"] == ["matrix", "grain"]
        fraction = np.mean(rve["phase/id"] == 1)
        assert abs(fraction - rve.summary["phases"][1]["volume_fraction"]) < 1e-12
        # <L> = I by its definition.
        assert np.allclose(rve["concentration/KUBC"].mean(axis=(0, 1)), np.eye(3), atol=1e-8)
        x, y = rve.grid.centres()
        assert x.shape == (80,) and y.shape == (40,) and abs(x[0] - 0.5 * rve.grid.spacing[0]) < 1e-15


def check_dynamics(folder):
    with mesoslip.open(os.path.join(folder, "dynamics.h5")) as dynamics:
        time = dynamics.history["time"]
        assert time.unit == "s" and time[3:5].unit == "s" and not hasattr(time * 2.0, "unit")
        assert np.allclose(time.to("µs"), 1e6 * np.asarray(time)) and abs(time[-1] - 6e-5) < 1e-6
        assert dynamics.history["contact_normal_force"].unit == "N/m"
        times = [t for t, _ in dynamics.snapshots()]
        assert np.allclose(np.diff(times), 2e-6, atol=2e-8) and abs(times[0] - 4e-5) < 2e-8
        nodes = dynamics.grid.nodes()
        for _, u in dynamics.snapshots(step=5):
            assert u.shape == (len(nodes[1]), len(nodes[0]), 2)
        assert set(dynamics.probes) and all(p["stress"].shape[1] == 3 for p in dynamics.probes.values())
        expect(KeyError, "slip", lambda: dynamics["contact/slipp"])
        for action in (lambda: dynamics["nix"], lambda: dynamics.group("nix"), lambda: dynamics.attributes("nix"),
                       lambda: dynamics.unit("nix"), lambda: dynamics.group("history/time")):
            expect(KeyError, f"{dynamics.path} has no ", action)
        expect(ValueError, "multiple of MPa", lambda: time.to("MPa"))


def check_localization(folder, rve):
    with mesoslip.open(folder) as localization:
        assert localization["mean_von_mises"].shape == (40, 80)
        assert localization["mean_stress"].to("MPa").max() < 1e3
        assert localization["mean_stress"].unit == "Pa"
        expect(KeyError, "localization.h5 has no group 'history'; there is: ", lambda: localization.history)
    expect(FileNotFoundError, "no file or folder", lambda: mesoslip.open(os.path.join(folder, "nothing")))
    expect(mesoslip.FormatError, "HDF5", lambda: mesoslip.open(os.path.join(folder, "summary.json")))
    foreign = os.path.join(folder, "foreign.h5")
    with h5py.File(foreign, "w") as file:
        file["x"] = [1]
    expect(mesoslip.FormatError, "not a file of mesoslip", lambda: mesoslip.open(foreign))
    with h5py.File(foreign, "w") as file:
        file.attrs["format"], file.attrs["format_version"] = "mesoslip-rve", 99
    expect(mesoslip.FormatError, "99", lambda: mesoslip.open(foreign))


def check_mesh(folder):
    """Areas from the module's corners weigh the concentration tensors to the identity and the phases to their fractions."""
    with mesoslip.open(run("rve_homogenization", folder, "fibre_cell", {}, MESHES)) as rve:
        mesh, phase = rve.mesh, rve["phase/id"]
        assert mesh.points.unit == "m" and mesh.points.shape[1] == 2
        area = np.zeros(len(phase))
        for kind, corners in mesh.cells.items():
            x, y = np.moveaxis(np.asarray(mesh.points)[corners], 2, 0)
            area[mesh.numbers[kind]] = 0.5 * np.abs(np.sum(x * np.roll(y, -1, 1) - np.roll(x, -1, 1) * y, axis=1))
        for k, given in enumerate(rve.summary["phases"]):
            assert abs(area[phase == k].sum() / area.sum() - given["volume_fraction"]) < 1e-12
        mean = np.einsum("c,cij->ij", area, rve["concentration/KUBC"]) / area.sum()
        assert np.allclose(mean, np.eye(3), atol=1e-8), mean
        centre = area @ np.asarray(mesh.centres()) / area.sum()
        low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
        assert np.all(np.abs(centre - 0.5 * (low + high)) < 1e-3 * (high - low)), centre
        expect(KeyError, "it has a mesh", lambda: rve.grid)
    short = {"Time/End time": "4e-6"}
    with mesoslip.open(run("contact_dynamics", folder, "chamfered_pin", short, MESHES)) as dynamics:
        snapshots = list(dynamics.snapshots())
        assert len(snapshots) > 1 and all(u.shape == dynamics.mesh.points.shape and u.unit == "m" for _, u in snapshots)


def expect(error, words, action):
    try:
        action()
    except error as found:
        assert words in str(found), found
    else:
        raise AssertionError(f"no {error.__name__}")


def check_example(run_folder, folder):
    picture = os.path.join(folder, "friction.png")
    script = os.path.join(TOOLS, "python", "examples", "redraw_friction.py")
    subprocess.run([sys.executable, script, run_folder, picture], check=True)
    assert os.path.getsize(picture) > 2e4


def check_installed(rve, folder):
    """pip install, without network: the module opens the same numbers, and has the version of the programs."""
    # pip builds beside the sources; Debian's h5py does not tell pip that it is there.
    source = shutil.copytree(os.path.join(TOOLS, "python"), os.path.join(folder, "source"))
    python = os.path.join(folder, "venv", "bin", "python")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", os.path.join(folder, "venv")], check=True)
    subprocess.run([sys.executable, "-m", "pip", "--quiet", "--python", python, "install", "--no-deps", "--no-index",
                    "--no-build-isolation", source], check=True)
    code = ("import importlib.metadata, sys, mesoslip\nwith mesoslip.open(sys.argv[1]) as rve:\n"
            "    print(mesoslip.__file__, importlib.metadata.version('mesoslip'), float(rve['stiffness/effective'][0, 0]))")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([python, "-c", code, rve], cwd=folder, env=environment, text=True, stdout=subprocess.PIPE, check=True)
    path, version, stiffness = done.stdout.split()
    assert path.startswith(os.path.join(folder, "venv")), path
    with open(os.path.join(TOP, "CMakeLists.txt"), encoding="utf-8") as file:
        assert version == re.search(r"project\(mesoslip VERSION (\S+)", file.read())[1], version
    with mesoslip.open(rve) as file:
        assert float(stiffness) == file["stiffness/effective"][0, 0]


def main():
    with tempfile.TemporaryDirectory() as folder:
        rve = run("rve_homogenization", folder, "10-rve_homogenization", {})
        given = {"Body/RVE file": os.path.join(rve, "rve.h5")}
        dynamics = run("contact_dynamics", folder, "20-contact_dynamics-homogeneous", {**given, **SHORT})
        localization = run("stress_localization", folder, "40-stress_localization",
                           {"Input/RVE file": given["Body/RVE file"], "Input/Homogeneous run": os.path.join(dynamics, "dynamics.h5"),
                            "Input/Direct run": ""})
        check_rve(rve)
        check_dynamics(dynamics)
        check_localization(localization, rve)
        check_installed(rve, folder)
        check_mesh(folder)
        check_example(dynamics, sys.argv[2] if len(sys.argv) > 2 else folder)
    print("ok")


if __name__ == "__main__":
    main()
