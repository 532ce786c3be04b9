#!/usr/bin/env python3
"""What the Python module runs and derives: programs and chains with their errors, von Mises and principal stresses and means by phase
against numpy and the program's own fields, xarray where it is installed, and the examples."""

import csv
import os
import subprocess
import sys
import tempfile
import warnings

import numpy as np

from scenes import ENVIRONMENT, PROGRAMS, TOOLS, TOP, prm, rve

sys.path.insert(0, os.path.join(TOOLS, "python"))
import mesoslip
from mesoslip import derived, ranks

LOADS = os.path.join(TOP, "prm", "examples", "loads.prm")
MESHES = os.path.join(TOP, "prm", "examples", "mesh")
EXAMPLES = os.path.join(TOOLS, "python", "examples")
BODY = prm({"Time/End time": "2e-6", "Flat/Velocity": 2, "Supports/Top/Pressure": "5e6", "Snapshots/Interval": "1e-6"})


def raises(error, words, action):
    try:
        action()
    except error as found:
        assert words in str(found), found
        return found
    raise AssertionError(f"no {error.__name__} with '{words}'")


def check_run(folder):
    """Settings go before the file, whichever program it is for; what is wrong is an exception with the program's sentence."""
    write(folder, "volume.prm", rve("20, 10", "0.002, 0.001", 2e-4, 4e-4))
    write(folder, "contact_dynamics.prm", BODY + prm({"Body/RVE file": "results/volume/rve.h5"}))
    volume = mesoslip.run("volume.prm", {"Grid/Cells": [40, 20]}, output="results/volume")
    assert volume.format == "mesoslip-rve" and volume.grid.cells == (40, 20)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with mesoslip.run("contact_dynamics.prm", {"Supports/Top/Pressure": 4e5, "Flat/Velocity": np.float64(0.5)}) as run:
            assert run.path == os.path.join("output", "contact_dynamics", "dynamics.h5"), run.path
            assert run.summary["pressure"] == 4e5 and run.summary["flat_velocity"] == 0.5 and run.summary["ranks"] == 1
        with mesoslip.run("contact_dynamics.prm", output="ranks", ranks=2) as run:
            assert run.summary["ranks"] == 2 and run.summary["pressure"] == 5e6
    # As homogenization of friction leaves it, without an HDF5 file.
    write(folder, "plain/summary.json", '{"delta": 0.5}')
    write(folder, "plain/nodes.csv", "x [m],state\n0.5,slip\n,stick\n")
    with mesoslip.open("plain") as plain:
        assert isinstance(plain, mesoslip.RunFolder) and plain.summary == {"delta": 0.5} and "nodes.csv" in repr(plain)
        table = plain.table("nodes.csv")
        assert table["x [m]"][0] == 0.5 and np.isnan(table["x [m]"][1]) and list(table["state"]) == ["slip", "stick"]
        raises(KeyError, "there is: nodes.csv", lambda: plain.table("nix.csv"))
    error = raises(mesoslip.RunError, "there is no key 'Pressur'", lambda: mesoslip.run("contact_dynamics.prm", {"Supports/Top/Pressur": 1}))
    assert error.status == 2 and not str(error).startswith("contact_dynamics"), error
    raises(mesoslip.RunError, "there is no file nix.prm", lambda: mesoslip.run("nix.prm"))
    write(folder, "typo.prm", "set Analysi = modal\n")
    raises(mesoslip.RunError, "none of the programs accepts typo.prm", lambda: mesoslip.run("typo.prm"))
    raises(ValueError, "there is no program x", lambda: mesoslip.run("volume.prm", program="x"))
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        mesoslip.run("volume.prm", {"Phases/fibre/Young modulus": 240}, output="soft").close()
    assert any("240" in str(w.message) or "Pa" in str(w.message) for w in seen), [str(w.message) for w in seen]


def check_ranks(folder):
    """As many as a long run is worth, but only on idle cores; a run is resumed on as many as it was begun with."""
    said = "pin.prm: the parameters are valid\nup to 4 ranks on idle cores make it faster\n"
    for idle, most, expected in ((8, 8, 4), (8, 2, 2), (3, 8, 3), (1, 8, 1), (0, 8, 1)):
        assert ranks.ranks_worth(said, most, lambda idle=idle: idle) == expected
    assert ranks.ranks_worth("valid\n", 8, lambda: 8) == 1
    assert ranks.start_of(1) == [] and ranks.start_of(3)[-2:] == ["-np", "3"]
    assert 0 <= ranks.idle_cores(0.05) <= len(os.sched_getaffinity(0))
    assert ranks.ranks_begun_with(folder) == 1
    for n in (3, 1):
        ranks.keep_ranks(folder, n)
        assert ranks.ranks_begun_with(folder) == n
    # Programs tell it of what is long: 160 rows, 40 for each rank; 96 planes of voxels, eight for each; not of short runs.
    pin = os.path.join(TOP, "prm", "pin", "20-contact_dynamics-homogeneous.prm")
    body = ["--set", "Body/RVE file=", "--set", "Body/Stiffness=36.54e9, 9.1e9, 47.26e9, 13.785e9", "--set", "Body/Density=1770"]
    voxels = os.path.join(TOP, "prm", "examples", "voxels", "pad", "10-rve_homogenization.prm")
    for program, file, words, expected in (
            ("contact_dynamics", pin, [*body, "--set", "Body/Cells=560, 160"], 4), ("contact_dynamics", pin, [*body, "--set", "Body/Cells=28, 16"], 1),
            ("rve_homogenization", voxels, ["--set", "Grid/Cells=192, 64, 96"], 12), ("rve_homogenization", voxels, [], 1)):
        said = subprocess.run([os.path.join(PROGRAMS, program), file, "--validate", *words], env=ENVIRONMENT, capture_output=True, text=True, check=True)
        assert ranks.ranks_worth(said.stdout, 99, lambda: 99) == expected, (expected, said.stdout)


def check_programs(folder):
    """By the argument, the environment, PATH, in this order."""
    os.environ.pop("MESOSLIP_PROGRAMS")
    raises(FileNotFoundError, "the argument programs", lambda: mesoslip.find_program("contact_dynamics", folder))
    assert mesoslip.find_program("contact_dynamics", PROGRAMS) == os.path.join(PROGRAMS, "contact_dynamics")
    before = os.environ["PATH"]
    os.environ["PATH"] = PROGRAMS + os.pathsep + before
    assert mesoslip.find_program("contact_dynamics") == os.path.join(PROGRAMS, "contact_dynamics")
    os.environ["MESOSLIP_PROGRAMS"] = folder
    raises(FileNotFoundError, "MESOSLIP_PROGRAMS", lambda: mesoslip.find_program("contact_dynamics"))
    os.environ["PATH"], os.environ["MESOSLIP_PROGRAMS"] = before, PROGRAMS


def check_chain(folder):
    for name, text in {"10-rve_homogenization": rve("20, 10", "0.002, 0.001", 2e-4, 4e-4),
                       "20-contact_dynamics": BODY + prm({"Body/RVE file": "10-rve_homogenization/rve.h5"})}.items():
        write(folder, f"case/{name}.prm", text)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with mesoslip.run_chain("case", report=False) as chain:
            assert chain.path == os.path.join("results", "case") and list(chain) == ["10-rve_homogenization", "20-contact_dynamics"]
            assert chain["rve"] is chain["10-rve_homogenization"] and chain["contact"].format == "mesoslip-dynamics"
            assert chain.summaries["20-contact_dynamics"]["pressure"] == 5e6 and "20-contact_dynamics" in repr(chain)
            raises(KeyError, "no run 'nix'", lambda: chain["nix"])
            raises(KeyError, "several runs '0-'", lambda: chain["0-"])
    with mesoslip.open("results/case") as chain:
        assert len(chain) == 2
    write(folder, "case/30-contact_dynamics.prm", BODY.replace("Pressure", "Pressur"))
    error = raises(mesoslip.RunError, "30-contact_dynamics.prm:", lambda: mesoslip.run_chain("case", report=False))
    assert error.status == 2 and not os.path.exists("results/case/30-contact_dynamics"), error
    raises(mesoslip.RunError, "there is no folder", lambda: mesoslip.run_chain("no-case"))
    os.makedirs("empty")
    raises(FileNotFoundError, "neither a run", lambda: mesoslip.open("empty"))


def check_formulas():
    """Against numpy's eigenvalues and the definition by the deviator, at random tensors in 2D and 3D."""
    random = np.random.default_rng(7)
    full = random.normal(size=(50, 3, 3))
    full = full + np.swapaxes(full, 1, 2)
    voigt = np.stack([full[:, i, j] for i, j in ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))], axis=1)
    deviator = full - np.trace(full, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
    expected = np.sqrt(1.5 * np.einsum("nij,nij->n", deviator, deviator))
    assert np.allclose(mesoslip.von_mises(voigt), expected, rtol=1e-13)
    assert np.allclose(mesoslip.principal(voigt), np.linalg.eigvalsh(full)[:, ::-1], rtol=1e-12)
    plane = full.copy()
    plane[:, 2, :2] = plane[:, :2, 2] = 0
    flat, zz = voigt[:, [0, 1, 5]], full[:, 2, 2]
    assert np.allclose(mesoslip.principal(flat, zz), np.linalg.eigvalsh(plane)[:, ::-1], rtol=1e-12)
    assert np.allclose(mesoslip.principal(flat), np.linalg.eigvalsh(plane[:, :2, :2])[:, ::-1], rtol=1e-12)
    sheared = flat * [1, 1, 2]
    assert np.allclose(mesoslip.principal(sheared, strain=True), mesoslip.principal(flat), rtol=1e-12)
    deviator = plane - np.trace(plane, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
    assert np.allclose(mesoslip.von_mises(flat, zz), np.sqrt(1.5 * np.einsum("nij,nij->n", deviator, deviator)), rtol=1e-13)
    raises(ValueError, "plane strain", lambda: mesoslip.von_mises(flat))
    raises(ValueError, "3 components", lambda: mesoslip.principal(np.ones((2, 4))))


def table_of(path):
    """{(load, phase, quantity): mean} of loads.csv."""
    with open(path, encoding="utf-8") as file:
        return {(row["load"], row["phase"], row["quantity"]): float(row["mean"]) for row in csv.DictReader(file)}


def check_fields():
    """Against loads.h5 and loads.csv, on a grid and on a mesh."""
    mesoslip.run(LOADS, {"Grid/Cells": "140, 80"}, output="loads").close()
    means = table_of("loads/loads.csv")
    with mesoslip.open("loads/loads.h5") as loads:
        for load in loads.loads:
            group = f"loads/{load}/PBC/"
            own = loads[group + "von_mises"]
            assert np.abs(loads.von_mises(group + "stress") - own).max() < 1e-12 * own.max(), load
            # nu (sigma_xx + sigma_yy) from the stiffness is what the program has.
            nu = derived.poisson_ratio_of(loads["phase/stiffness"])[np.asarray(loads.phase_id())]
            zz = loads[group + "stress_zz"]
            assert np.abs(derived.stress_zz(loads[group + "stress"], nu) - zz).max() < 1e-12 * np.abs(zz).max(), load
            largest = loads.phase_means(loads.principal(group + "stress"))
            for phase, mean in loads.phase_means(group + "stress").items():
                for k, component in enumerate(("xx", "yy", "xy")):
                    same(mean[k], means[load, phase, "stress_" + component], 1e-7 * np.abs(mean).max())
                for k in range(3):
                    same(largest[phase][k], means[load, phase, f"principal_{k + 1}"], 1e-7 * np.abs(largest[phase]).max())
            assert mean.unit == "Pa"
        raises(ValueError, "cells", lambda: loads.phase_means(np.ones(3)))
        check_labels(loads)
    with mesoslip.run(os.path.join(MESHES, "fibre_cell.prm"), output="mesh") as mesh:
        for k, phase in enumerate(mesh.summary["phases"]):
            share = mesh.cell_measures()[np.asarray(mesh.phase_id()) == k].sum() / mesh.cell_measures().sum()
            same(share, phase["volume_fraction"], 1e-10)
        whole = sum(p["volume_fraction"] * m for p, m in zip(mesh.summary["phases"], mesh.phase_means("concentration/KUBC").values()))
        assert np.allclose(whole, np.eye(3), atol=1e-8), whole


def same(one, other, tolerance):
    assert abs(float(one) - float(other)) <= tolerance, (float(one), float(other), tolerance)


def check_boxes():
    """Measures of skewed quadrilaterals and hexahedra: by hand of a trapezium and the frustum of a pyramid, and a parallelepiped."""
    class Body:
        points = np.array([[0, 0], [4, 0], [3, 2], [1, 2]], dtype=float)
        cells, numbers = {"quadrilateral": np.array([[0, 1, 2, 3]])}, {"quadrilateral": np.array([0])}
    same(derived.measures_of(Body)[0], 6.0, 1e-13)
    axes = np.array([[1.0, 0.2, 0.1], [0.3, 2.0, -0.2], [0.0, 0.5, 1.5]])
    Body.points = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]) @ axes
    Body.cells, Body.numbers = {"hexahedron": np.arange(8)[None]}, {"hexahedron": np.array([0])}
    same(derived.measures_of(Body)[0], np.linalg.det(axes), 1e-13)
    base = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    Body.points = np.array([(*(c * (1 - z / 2)), 3 * z) for z in (0, 1) for c in base])
    same(derived.measures_of(Body)[0], 3 / 3 * (4 + 1 + 2), 1e-13)


def check_labels(loads):
    """Axes and coordinates of xarray, or a sentence where it is not installed."""
    group = "loads/tension across/PBC"
    try:
        import xarray
    except ImportError:
        raises(ImportError, "python3-xarray", lambda: loads.to_xarray(group))
        print("xarray is not installed: its arrays were not looked at")
        return
    whole = loads.to_xarray(group)
    assert isinstance(whole, xarray.Dataset) and whole["stress"].dims == ("y", "x", "component") and whole["stress"].attrs["units"] == "Pa"
    x, y = loads.grid.centres()
    assert float(whole["stress"].sel(x=x[3], y=y[5], component="yy")) == loads[group + "/stress"][5, 3, 1]
    assert loads.to_xarray(group + "/von_mises").dims == ("y", "x")
    names = []
    loads.hdf5.visititems(lambda name, found: names.append(name) if hasattr(found, "shape") else None)
    assert len(names) > 10
    for name in names:
        found, given = loads.to_xarray(name), loads[name]
        assert np.array_equal(found.values, np.asarray(given)) and found.attrs["units"] == getattr(given, "unit", ""), name


def check_examples(folder):
    os.symlink(os.path.join(TOP, "prm"), "prm")
    environment = dict(ENVIRONMENT, PYTHONPATH=os.path.join(TOOLS, "python"), MESOSLIP_PROGRAMS=PROGRAMS, PYTHONDONTWRITEBYTECODE="1")
    for name, picture in (("rve_homogenization", "example_volume/largest_principal_stress.png"),
                          ("contact_dynamics", "example_pressures/pressures.png"), ("stress_localization", "example_chain/localized.png")):
        subprocess.run([sys.executable, "-W", "ignore", os.path.join(EXAMPLES, name + ".py")], env=environment, check=True, cwd=folder)
        assert os.path.getsize(os.path.join("output", picture)) > 2e4
    undone = {file[:-3] for file in os.listdir(EXAMPLES) if file.endswith(".py")} - {"rve_homogenization", "contact_dynamics",
                                                                                     "stress_localization", "redraw_friction"}
    assert not undone, f"no test runs the examples {undone}"


def write(folder, name, text):
    os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def main():
    os.environ["MESOSLIP_PROGRAMS"] = PROGRAMS
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        check_formulas()
        check_boxes()
        check_run(folder)
        check_ranks(folder)
        check_programs(folder)
        check_chain(folder)
        check_fields()
        check_examples(folder)
        os.chdir(TOP)
    print("ok")


if __name__ == "__main__":
    main()
