#!/usr/bin/env python3
"""The Python module on the files of a short chain: values, shapes, units, errors, and its example."""

import os
import pickle
import re
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
        assert repr(mesoslip.files.Grid((52, 24), (0.0012 / 24, 5e-5), (0.0, 0.0))) == "Grid(cells=(52, 24), spacing=(5e-05, 5e-05) m, origin=(0, 0) m)"
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
    assert callable(mesoslip.participation.participation)
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
    """pip install without network, as doc/python.md says: it leaves the sources as they are, the module opens the same numbers, and has the
    version of the programs."""
    source = os.path.join(TOOLS, "python")
    before = tree(source)
    python = os.path.join(folder, "venv", "bin", "python")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", os.path.join(folder, "venv")], check=True)
    pip = [sys.executable, "-B", "-m", "pip", "--quiet", "--python", python, "install", "--no-deps", "--no-index"]
    code = ("import importlib.metadata, sys, mesoslip\nwith mesoslip.open(sys.argv[1]) as rve:\n"
            "    print(mesoslip.__file__, importlib.metadata.version('mesoslip'), mesoslip.__version__, float(rve['stiffness/effective'][0, 0]))")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    environment["PYTHONDONTWRITEBYTECODE"] = "1"
    for options, place in (([], os.path.join(folder, "venv")), (["--editable"], source)):
        subprocess.run([*pip, *options, source], check=True, env=environment)
        assert tree(source) == before, "pip has left something among the sources"
        done = subprocess.run([python, "-c", code, rve], cwd=folder, env=environment, text=True, stdout=subprocess.PIPE, check=True)
        path, version, own_version, stiffness = done.stdout.split()
        assert path.startswith(place), path
        with open(os.path.join(TOP, "CMakeLists.txt"), encoding="utf-8") as file:
            assert version == own_version == re.search(r"project\(mesoslip VERSION (\S+)", file.read())[1], version
        with mesoslip.open(rve) as file:
            assert float(stiffness) == file["stiffness/effective"][0, 0]


def tree(folder):
    """Names of all files below a folder but what Python keeps of its own."""
    return sorted(os.path.join(where, name) for where, _, names in os.walk(folder) for name in names if not name.endswith(".pyc"))


def check_units_and_texts(rve, dynamics):
    """Units by hand, and what is shown of arrays and files."""
    from mesoslip.units import factor_to
    for unit, other, factor in (("Pa", "N/mm^2", 1e-6), ("Pa", "MPa", 1e-6), ("N/m", "kN/m", 1e-3), ("W/m^2", "mW/mm^2", 1e-3),
                                ("kg/m^3", "g/cm^3", 1e-3), ("J/m^3", "MPa", 1e-6), ("s", "µs", 1e6), ("Pa s", "GPa ns", 1.0), ("", "%", 100.0),
                                ("Hz", "1/ms", 1e-3), ("N/m", "J/m^2", 1.0), ("m", "mm", 1e3), ("m^2", "mm^2", 1e6)):
        assert abs(factor_to(unit, other) / factor - 1) < 1e-12, (unit, other, factor_to(unit, other))
    for unit, other in (("Pa", "N"), ("m", "s"), ("", "m"), ("Pa", "bar"), ("Pa", "N/mm^3")):
        expect(ValueError, other, lambda unit=unit, other=other: factor_to(unit, other))
    array = mesoslip.Array([1.0, 2.0], "Pa", "x")
    assert repr(array) == "Array([1., 2.], unit='Pa')" and str(array) == "[1. 2.] Pa", (repr(array), str(array))
    copy = pickle.loads(pickle.dumps(array))
    assert copy.unit == "Pa" and copy.name == "x" and np.array_equal(copy, array)
    with mesoslip.open(rve) as file:
        said = repr(file)
        assert "stiffness/effective  [3, 3] Pa" in said and "phase/id  [40, 80]\n" in said and said.startswith("<mesoslip-rve "), said
    assert "closed" in repr(file)
    with mesoslip.open(dynamics) as file:
        assert "history/contact_normal_force" in repr(file) and "\n  summary: analysis, " in repr(file), repr(file)


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
        check_units_and_texts(rve, dynamics)
        check_installed(rve, folder)
        check_mesh(folder)
        check_example(dynamics, sys.argv[2] if len(sys.argv) > 2 else folder)
    print("ok")


if __name__ == "__main__":
    main()
