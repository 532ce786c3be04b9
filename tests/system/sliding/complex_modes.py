"""Analysis complex modes of contact_dynamics: a heterogeneous pin against scipy on 1, 2 and 3 ranks; without friction the modes of
vibration; the same cells as a mesh and as a slice in 3D; a sweep; what is refused."""

import csv
import math
import os
import shutil
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import PHASES, Folder, prm
from sliding_pin import SlidingPin, nearest

STIFFNESS, DENSITY, SIZE, BETA = (36.54e9, 9.1e9, 47.26e9, 13.785e9), 1770, (0.012, 0.004), 4.4e-9
COMMON = {"Analysis": "complex modes", "Supports/Top/Kind": "platen", "Supports/Top/Pressure": 5e6, "Flat/Velocity": 2, "Friction/Regularization time": 2e-7,
          "Friction/Coefficient": 0.25, "Complex modes/Highest frequency": 1.2e6, "Complex modes/Fastest decay": 20000}
BODY = {"Body/Stiffness": ", ".join(map(str, STIFFNESS)), "Body/Density": DENSITY, "Body/Size": "0.012, 0.004", "Body/Cells": "24, 8"}


def eigenvalues(modes):
    return np.array([complex(mode["growth_rate"], 2 * math.pi * mode["frequency"]) for mode in modes])


def found(folder, run):
    summary = folder.summary(run)
    assert summary["missing_modes"] == 0 and not summary["separated_nodes"], summary
    values = eigenvalues(summary["complex_modes"])
    assert len(values) and list(values.real) == sorted(values.real, reverse=True), values
    assert max(mode["residual"] for mode in summary["complex_modes"]) < 1e-9
    for mode, s in zip(summary["complex_modes"], values):
        assert abs(mode["growth_by_friction"] + mode["growth_by_damping"] - s.real) < 1e-8 * abs(s), mode
    return values


def expect_same(values, expected, tolerance, what):
    """Both hold the same numbers."""
    assert len(values) == len(expected), (what, values, expected)
    for s in expected:
        distance = abs(values - s).min() / abs(s)
        assert distance < tolerance, (what, s, distance)


def all_of(pin, keep, shifts):
    """Eigenvalues near the shifts that are to be kept, each once."""
    result = []
    for shift in shifts:
        for s in nearest(pin, shift, 12)[0]:
            if keep(s) and not any(abs(s - other) < 1e-7 * abs(s) for other in result):
                result.append(s)
    return np.array(result)


def wanted(s):
    return s.real >= -20000 and 0 < s.imag <= 2 * math.pi * 1.2e6 and s.imag > -s.real


def check_phases(folder, run, below, shares, motion):
    """What the phases have of each mode, from the nodes' parts and shapes: half a cell on either side of a node, one at the ends."""
    names = ("matrix", "fibre")
    cells = np.array([below == p for p in range(2)], dtype=float)
    weights = np.pad(cells, ((0, 0), (0, 1)), "edge") / 2 + np.pad(cells, ((0, 0), (1, 0)), "edge") / 2
    area = np.full(25, 1.0)
    area[[0, -1]] = 0.5
    summary = folder.summary(run)
    for p, name in enumerate(names):
        assert abs(summary["contact_phases"][name] - weights[p] @ area / area.sum()) < 1e-12, summary["contact_phases"]
    assert 0.05 < summary["contact_phases"]["fibre"] < 0.95, summary["contact_phases"]
    with open(folder(run, "complex_modes.csv"), encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    for mode, row, share, u in zip(summary["complex_modes"], rows, shares, motion):
        for p, name in enumerate(names):
            part, square = mode["phases"][name], area * abs(u)**2
            assert abs(part["growth_by_friction"] - weights[p] @ share) < 1e-8 * mode["frequency"], (mode, name)
            assert abs(part["motion"] - weights[p] @ square / square.sum()) < 1e-8, (mode, name)
            assert float(row[f"growth_by_friction_{name} [1/s]"]) == part["growth_by_friction"], row
            assert float(row[f"motion_{name} [-]"]) == part["motion"], row
    assert any(abs(mode["phases"]["fibre"]["motion"] - summary["contact_phases"]["fibre"]) > 0.01 for mode in summary["complex_modes"])


def expect_same_phases(folder, run, other):
    """Modes that grow, their frequencies apart from those of a slice, have the same phases."""
    one, two = ([mode for mode in folder.summary(name)["complex_modes"] if mode["growth_rate"] > 0] for name in (run, other))
    for mode in two:
        same = min(one, key=lambda m, f=mode["frequency"]: abs(m["frequency"] - f))
        for name, part in mode["phases"].items():
            for key, value in part.items():
                scale = 1 if key == "motion" else mode["frequency"]
                assert abs(same["phases"][name][key] - value) < 1e-6 * scale, (run, mode, same)
    shares = [folder.summary(name)["contact_phases"] for name in (run, other)]
    assert all(abs(shares[0][name] - shares[1][name]) < 1e-9 for name in ("matrix", "fibre")), shares


def check_heterogeneous(folder):
    """All eigenvalues of a pin of two phases as scipy has them from 60 shifts, on any number of ranks."""
    folder.write("rve.prm", PHASES + prm({"Grid/Cells": "24, 8", "Grid/Size": "0.012, 0.004", "Microstructure/Random fibres/Fibre width":
                                          1e-3, "Microstructure/Random fibres/Minimum height": 1e-3, "Microstructure/Random fibres/Maximum height": 1.5e-3,
                                         "Microstructure/Random fibres/Seed": 2}))
    folder.run(0, "rve_homogenization", "rve.prm", "--output", "rve")
    folder.write("pin.prm", prm({**COMMON, "Body/RVE file": "rve/rve.h5", "Body/Material": "heterogeneous"}))
    folder.run(0, "contact_dynamics", "pin.prm", "--output", "pin1")
    with h5py.File(folder("pin1", "complex_modes.h5")) as file:
        ids, phases = file["material/phase_id"][()], file["material/stiffness"][()]
        frequency, real = file["complex_modes/frequency"][()], file["complex_modes/shape_real"][()]
        imaginary = file["complex_modes/shape_imaginary"][()]
        shares = file["complex_modes/contact/growth_by_friction"][()]
    stiffness = [np.array([[d[0], d[1], d[2]], [d[1], d[3], d[4]], [d[2], d[4], d[5]]]) if np.ndim(d) == 1 else d for d in phases]
    pin = SlidingPin.build(ids.reshape(8, 24), stiffness, DENSITY, SIZE, 0.25, 2e-7, BETA)
    shifts = [complex(0, 2 * math.pi * 1e3 * f) for f in np.linspace(20, 1210, 60)]
    expected, values = all_of(pin, wanted, shifts), found(folder, "pin1")
    expect_same(values, expected, 1e-8, "scipy")
    assert sum(values.real > 0) >= 2, values
    size = np.sqrt((real**2 + imaginary**2).sum(axis=-1)).max(axis=(1, 2))
    assert np.abs(size - 1).max() < 1e-12 and np.abs(real[:, 0, :, 1]).max() == 0, size
    assert np.abs(frequency - values.imag[:len(frequency)] / (2 * math.pi)).max() < 1e-6
    for share, mode in zip(shares, folder.summary("pin1")["complex_modes"]):
        assert abs(share.sum() - mode["growth_by_friction"]) < 1e-8 * mode["frequency"]
    check_phases(folder, "pin1", ids.reshape(8, 24)[0], shares, real[:, 0, :, 0] + 1j * imaginary[:, 0, :, 0])
    for ranks in (2, 3):
        folder.run(0, "contact_dynamics", "pin.prm", "--output", f"pin{ranks}", ranks=ranks)
        expect_same(found(folder, f"pin{ranks}"), values, 1e-9, ranks)
        expect_same_phases(folder, f"pin{ranks}", "pin1")
    # The same cells as a mesh in 2D, and extruded in 3D.
    solids = {"Phases/Names": "matrix, fibre", **{f"Phases/{name}/{key}": value for name, modulus in (("matrix", 30e9), ("fibre", 240e9)) for
                                                  key, value in (("Young modulus", modulus), ("Density", DENSITY))}}
    for dim in (2, 3):
        def phase(middle):
            return ("matrix", "fibre")[ids.reshape(8, 24)[int(middle[-1] / 0.5), int(middle[0] / 0.5)]]

        box = Box([12, 0.5, 4] if dim == 3 else [12, 4], [24, 1, 8] if dim == 3 else [24, 8], phase)
        box.name_side("Contact", dim - 1, False).name_side("Top", dim - 1, True)
        if dim == 3:
            box.name_side("Front", 1, False).name_side("Back", 1, True)
        box.write(folder("pin.msh"))
        folder.write("mesh.prm", ("set Dimension = 3\n" if dim == 3 else "") + prm({
            **COMMON, "Mesh/File": "pin.msh", "Mesh/Scale": 0.001, **solids, **({"Supports/Front/Held": "u_y", "Supports/Back/Held": "u_y"} if dim == 3 else {}),
            "Complex modes/Fastest decay": 0}))
        folder.run(0, "contact_dynamics", "mesh.prm", "--output", "mesh", ranks=dim)
        expect_same_phases(folder, "mesh", "pin1")


def check_meshes(folder, flat):
    """The same cells as a mesh, and as a slice in 3D that is held across: its modes are among those of the slice."""
    common = {**COMMON, **flat}
    folder.write("grid.prm", prm({**common, **BODY}))
    folder.run(0, "contact_dynamics", "grid.prm", "--output", "grid")
    values = found(folder, "grid")
    box = Box([12, 4], [24, 8], lambda x: "body")
    box.name_side("Contact", 1, False).name_side("Top", 1, True).write(folder("mesh.msh"))
    folder.write("mesh.prm", prm({**common, "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, "Phases/Names": "body", "Phases/body/Type":
                                  "stiffness", "Phases/body/Stiffness": BODY["Body/Stiffness"], "Phases/body/Density": DENSITY}))
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "mesh.prm", "--output", "mesh", ranks=ranks)
        expect_same(found(folder, "mesh"), values, 1e-8, ("mesh", ranks))
    d11, d12, d22, d33 = STIFFNESS
    solid = [d11, 8e9, d12, 40e9, 9e9, d22, 12e9, d33, 11e9]
    folder.write("slice.prm", "set Dimension = 3\n" + prm({
        **common, **BODY, "Body/Stiffness": ", ".join(map(str, solid)), "Body/Size": "0.012, 0.0005, 0.004", "Body/Cells": "24, 1, 8",
        "Supports/Front/Held": "u_y", "Supports/Back/Held": "u_y"}))
    folder.run(0, "contact_dynamics", "slice.prm", "--output", "slice", ranks=2)
    in_space = found(folder, "slice")
    for s in values:
        assert abs(in_space - s).min() < 1e-8 * abs(s), ("slice", s, in_space)
    # Nothing grows without friction, which is an answer, too.
    stable = ["--set=Friction/Coefficient=0", "--set=Complex modes/Fastest decay=0"]
    for run in ("grid", "mesh", "slice"):
        folder.run(0, "contact_dynamics", run + ".prm", "--output", "stable", *stable)
        assert folder.summary("stable")["complex_modes"] == [], run
        assert not os.path.exists(folder("stable", "complex_modes.xdmf")), run
        shutil.rmtree(folder("stable"))
    folder.run(0, "contact_dynamics", "grid.prm", "--output", "grid", "--set", "Complex modes/Number of shapes=0")
    assert len(folder.summary("grid")["complex_modes"]) == len(values)
    return values


def check_sweep(folder):
    """Without friction s^2 + beta w^2 s + w^2 = 0 with the frequencies w of analysis modal; curves are followed; a law of the slip rate is
    its delta."""
    swept = {**COMMON, **BODY, "Complex modes/Sweep": "friction coefficient", "Complex modes/Sweep values": "0, 0.05, 0.1, 0.15, 0.2, 0.25"}
    folder.write("sweep.prm", prm(swept))
    folder.write("modal.prm", prm({**BODY, "Analysis": "modal", "Supports/Top/Kind": "platen", "Modal/Number of modes": 12, "Modal/Bottom": "held in y",
                                   "Modal/Tolerance": 1e-12}))
    folder.run(0, "contact_dynamics", "modal.prm", "--output", "modal")
    for ranks in (1, 3):
        folder.run(0, "contact_dynamics", "sweep.prm", "--output", f"sweep{ranks}", ranks=ranks)
    for one, other in zip(folder.summary("sweep1")["sweep"], folder.summary("sweep3")["sweep"]):
        expect_same(eigenvalues(one["complex_modes"]), eigenvalues(other["complex_modes"]), 1e-9, "ranks")
    sweep = folder.summary("sweep1")["sweep"]
    omega = 2 * math.pi * np.array(folder.summary("modal")["frequencies"]["held"])
    exact = -BETA * omega**2 / 2 + 1j * omega * np.sqrt(1 - (BETA * omega / 2) ** 2)
    expected = [s for s in exact if s.real >= -20000 and s.imag < 2 * math.pi * 1.2e6]
    assert len(expected) >= 4, exact
    for s in expected:
        assert abs(eigenvalues(sweep[0]["complex_modes"]) - s).min() < 1e-7 * abs(s), s
    expect_same(eigenvalues(sweep[-1]["complex_modes"]), found(folder, "sweep1"), 1e-10, "last of the sweep")
    with open(folder("sweep1", "complex_modes_sweep.csv"), encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    curves = {}
    for row in rows:
        curves.setdefault(row["curve [-]"], []).append((float(row["friction_coefficient [-]"]), float(row["frequency [Hz]"])))
    whole = [curve for curve in curves.values() if len(curve) == 6]
    assert len(whole) >= 4, curves
    for curve in whole:
        assert [mu for mu, _ in curve] == [0, 0.05, 0.1, 0.15, 0.2, 0.25]
        assert np.abs(np.diff([f for _, f in curve])).max() < 40e3, curve
    folder.write("rate.prm", prm({**{k: v for k, v in COMMON.items() if k != "Friction/Regularization time"}, **BODY, "Friction/Law": "slip rate",
                                  "Friction/Length": 4e-7 + 2e-10, "Friction/Reference velocity": 1e-3}))
    folder.run(0, "contact_dynamics", "rate.prm", "--output", "rate")
    expect_same(found(folder, "rate"), found(folder, "sweep1"), 1e-9, "slip rate")


def check_sweep_by_phase(folder):
    """The coefficients of the phases are swept by a factor: each value as a run whose phases have that multiple, on a grid and a mesh."""
    coefficients, factors = {"matrix": 0.1, "fibre": 0.3}, (0.5, 1.5)
    common = {**COMMON, "Friction/Coefficient from": "phases", "Complex modes/Highest frequency": 5e5}
    del common["Friction/Coefficient"]
    sweep = {"Complex modes/Sweep": "friction coefficient", "Complex modes/Sweep values": ", ".join(map(str, factors))}

    def times(factor):
        return {f"Phases/{name}/Friction coefficient": factor * mu for name, mu in coefficients.items()}

    def on_grid(factor, settings):
        folder.write("rve.prm", PHASES + prm({"Grid/Cells": "24, 8", "Grid/Size": "0.012, 0.004", "Microstructure/Random fibres/Fibre width": 1e-3,
                                             "Microstructure/Random fibres/Minimum height": 1e-3, "Microstructure/Random fibres/Maximum height": 1.5e-3,
                                             "Microstructure/Random fibres/Seed": 2, **times(factor)}))
        folder.run(0, "rve_homogenization", "rve.prm", "--output", f"rve-{factor}")
        return prm({**common, **settings, "Body/RVE file": f"rve-{factor}/rve.h5", "Body/Material": "heterogeneous"})

    def on_mesh(factor, settings):
        box = Box([12, 4], [24, 8], lambda x: ("matrix", "fibre")[int(x[0]) % 3 == 1])
        box.name_side("Contact", 1, False).name_side("Top", 1, True).write(folder("halves.msh"))
        solids = {f"Phases/{name}/{key}": value for name, modulus in (("matrix", 30e9), ("fibre", 240e9))
                  for key, value in (("Young modulus", modulus), ("Density", DENSITY))}
        return prm({**common, **settings, "Mesh/File": "halves.msh", "Mesh/Scale": 0.001, "Phases/Names": "matrix, fibre", **solids, **times(factor)})

    for body in (on_grid, on_mesh):
        folder.write("phases.prm", body(1, sweep))
        for ranks in (1, 2):
            folder.run(0, "contact_dynamics", "phases.prm", "--output", f"phases{ranks}", ranks=ranks)
        with open(folder("phases1", "complex_modes_sweep.csv"), encoding="ascii") as file:
            assert {float(row["friction_coefficient_factor [-]"]) for row in csv.DictReader(file)} == set(factors)
        cases = [(1, *(eigenvalues(folder.summary(f"phases{ranks}")["complex_modes"]) for ranks in (1, 2)))]
        cases += [(one["value"], eigenvalues(one["complex_modes"]), eigenvalues(other["complex_modes"]))
                  for one, other in zip(*(folder.summary(f"phases{ranks}")["sweep"] for ranks in (1, 2)))]
        assert [case[0] for case in cases] == [1, *factors], cases
        for factor, swept, on_ranks in cases:
            folder.write("alone.prm", body(factor, {}))
            folder.run(0, "contact_dynamics", "alone.prm", "--output", "alone")
            expect_same(swept, eigenvalues(folder.summary("alone")["complex_modes"]), 1e-9, (body.__name__, factor))
            expect_same(on_ranks, swept, 1e-9, (body.__name__, factor, "ranks"))
        assert max(cases[-1][1].real) > 1.2 * max(cases[0][1].real) > 0, cases


def check_refused(folder):
    memory = {"Friction/Normal stress": "slip rate"}
    for settings, words in (({"Flat/Velocity": 0}, ["Flat/Velocity is 0"]),
                            ({"Supports/Top/Pressure": -1}, ["Supports/Top/Pressure", "static"]),
                            ({"Complex modes/Sweep": "velocity"}, ["Sweep values", "empty"]),
                            ({"Complex modes/Sweep values": "1"}, ["Sweep is none"]),
                            ({"Complex modes/Sweep": "regularization time", "Complex modes/Sweep values": "1e-6", "Friction/Law": "coulomb",
                              "Friction/Regularization time": None}, ["Friction/Law is coulomb"]),
                            ({"Time/End time": 1e-3}, ["Time/End time"]),
                            (memory, ["Friction/Normal stress is slip rate", "linearize", "transient"]),
                            ({**memory, "Analysis": "static contact", "Friction/Regularization time": None, "Complex modes/Highest frequency": None,
                              "Complex modes/Fastest decay": None}, ["Friction/Normal stress has no effect"]),
                            ({"Body/Cells": "200000, 100000"}, ["GB", "Body/Cells"])):
        text = {key: value for key, value in {**COMMON, **BODY, **settings}.items() if value is not None}
        folder.write("bad.prm", prm(text))
        said = folder.run(2, "contact_dynamics", "bad.prm", "--output", "bad")
        assert all(word in said for word in words), (settings, said)


def check_above_all_modes(folder):
    """A search beyond the highest mode of the cells ends there."""
    folder.write("high.prm", prm({**COMMON, **BODY, "Body/Cells": "10, 5", "Complex modes/Highest frequency": 1e9, "Complex modes/Fastest decay": 0}))
    folder.run(0, "contact_dynamics", "high.prm", "--output", "high")
    assert folder.summary("high")["missing_modes"] == 0


with tempfile.TemporaryDirectory() as path:
    scene = Folder(path)
    check_refused(scene)
    check_above_all_modes(scene)
    check_heterogeneous(scene)
    hard = check_meshes(scene, {})
    soft = check_meshes(scene, {"Flat/Normal stiffness": 1e13, "Body/Rayleigh alpha": 2e3})
    assert abs(soft[0] - hard[0]) > 1e-3 * abs(hard[0])
    swept = ["--set=Complex modes/Sweep=normal stiffness", "--set=Complex modes/Sweep values=1e13, 1e15"]
    scene.run(0, "contact_dynamics", "grid.prm", "--output", "swept", "--set=Flat/Normal stiffness=1e14", *swept)
    for ranks in (2, 3):
        scene.run(0, "contact_dynamics", "grid.prm", "--output", "grid", ranks=ranks)
        expect_same(found(scene, "grid"), soft, 1e-9, ("grid on springs", ranks))
    first, last = (eigenvalues(case["complex_modes"]) for case in scene.summary("swept")["sweep"])
    expect_same(first, soft, 1e-9, "first of the sweep")
    assert abs(last - soft[0]).min() > 1e-3 * abs(soft[0])
    assert "Flat/Normal stiffness is auto" in scene.run(2, "contact_dynamics", "grid.prm", "--set=Flat/Normal stiffness=auto", *swept)
    scene.run(0, "contact_dynamics", "grid.prm", "--output", "stiff", "--set", "Flat/Normal stiffness=1e19",
              "--set", "Body/Rayleigh alpha=0")
    expect_same(found(scene, "stiff"), hard, 1e-5, "next to rigid")
    check_sweep(scene)
    check_sweep_by_phase(scene)
