"""The map of the contact over time and means by node of contact_dynamics, against closed forms and the resultants of the same runs: on a
grid, a mesh and voxels, on 1, 2 and 3 ranks, stopped and resumed, and killed.

    contact_map.py <folder with the programs>
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

from mesh_files import Box
from scenes import TOOLS, Folder, prm

FIELDS = "pressure, traction, slip velocity, state, friction work"
MAP = {"Contact map/Interval": 4e-8, "Contact map/Fields": FIELDS, "Observation/Contact means": "true"}
STIFFNESS, DENSITY = "36.54e9, 9.1e9, 47.26e9, 13.785e9", 1770
GRID = {"Body/Stiffness": STIFFNESS, "Body/Density": DENSITY, "Body/Size": "0.012, 0.004", "Body/Cells": "24, 10"}
SLIDING = {"Flat/Velocity": 2, "Flat/Gap": 1e-7, "Supports/Top/Pressure": 5e6, "Friction/Coefficient": 0.4, "Time/Time step": 4e-8,
           "Time/End time": 4e-5, "Observation/History interval": 1, "Observation/Energy interval": 1, **MAP}
SIDES = {"Supports/Left/Held": "u_x"}
SOLID = {"Dimension": 3, "Body/Size": "4e-3, 2e-3, 2e-3", "Body/Cells": "8, 4, 4", "Body/Density": 7800,
         "Body/Stiffness": "269e9, 115e9, 115e9, 269e9, 115e9, 269e9, 77e9, 77e9, 77e9", "Flat/Velocity": "1.5, 0.5",
         "Body/Initial velocity": "0.5, 0.2, -0.5"}


def read(folder, run):
    """{"NAME": values} of all datasets of dynamics.h5."""
    found = {}
    with h5py.File(folder(run, "dynamics.h5")) as file:
        file.visititems(lambda key, item: found.update({key: item[()]} if isinstance(item, h5py.Dataset) else {}))
    return found


def run(folder, name, settings, **keywords):
    keys = {key: value for key, value in settings.items() if "/" in key}
    folder.write(name + ".prm", "".join(f"set {key} = {value}\n" for key, value in settings.items() if "/" not in key) + prm(keys))
    folder.run(0, "contact_dynamics", name + ".prm", "--output", name, **keywords)
    return read(folder, name)


def same(one, other, limit, what):
    scale = max(float(np.abs(one).max()), float(np.abs(other).max()), 1e-300)
    error = float(np.abs(one - other).max()) / scale
    assert one.shape == other.shape and error <= limit, (what, one.shape, other.shape, error)


def check_sums(found, interval, what, direction=(1,), periodic=False):
    """The map against the histories of the same run: forces, numbers of nodes, and energies."""
    once = slice(0, -1) if periodic else slice(None)
    area, history = found["contact/area"], {key: found["history/" + key][::interval] for key in (
        "time", "contact_normal_force", "contact_tangential_force", "sticking_nodes", "slipping_nodes", "friction_energy")}
    field = {key: found["contact_map/" + key] for key in ("pressure", "traction", "slip_velocity", "state", "friction_work")}
    assert len(found["contact_map/time"]) == len(history["time"]) > 10, what
    same(found["contact_map/time"], history["time"], 1e-15, what)
    same(field["pressure"] @ area, history["contact_normal_force"], 1e-13, (what, "F_N"))
    traction = field["traction"] if field["traction"].ndim == 2 else field["traction"] @ np.array(direction)
    same(traction @ area, history["contact_tangential_force"], 1e-13, (what, "F_T"))
    assert np.array_equal((field["state"][:, once] == 1).sum(axis=1), history["sticking_nodes"]), what
    assert np.array_equal((field["state"][:, once] == 2).sum(axis=1), history["slipping_nodes"]), what
    assert ((field["state"] == 0) == (field["pressure"] == 0)).all() and field["state"].dtype == np.uint8, what
    same(field["friction_work"] @ area, history["friction_energy"], 1e-12, (what, "friction work"))
    if interval == 1:  # of every step: traction times slip is what the energy balance counts
        same(found["contact/friction_work"] @ area, history["friction_energy"][-1], 1e-12, (what, "work of the run"))
        power = field["traction"] * field["slip_velocity"]
        power = power if power.ndim == 2 else power.sum(axis=2)
        step = history["time"][1] - history["time"][0]
        same(step * np.cumsum(power @ area), history["friction_energy"], 1e-11, (what, "power"))


def check_uniform(folder):
    """A layer with held sides under pressure, and periodic ones that slide steadily: everything is known in closed form."""
    body = {**GRID, "Body/Size": "0.004, 0.001", "Body/Cells": "16, 4", "Time/Rayleigh beta": 1e-7, "Time/End time": 4e-4,
            "Contact map/Fields": FIELDS, "Contact map/Interval": 1e-5, "Observation/Contact means": "true", "Observation/Blocks": 10,
            "Supports/Top/Pressure": 5e6, "Friction/Coefficient": 0.3, "Observation/Steady from": 2e-4, "Observation/History interval": 10}
    pressed = run(folder, "pressed", {**body, "Flat/Velocity": 0, "Supports/Left/Held": "u_x", "Supports/Right/Held": "u_x",
                                      "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 5e-5})
    same(pressed["contact_map/pressure"][-1], np.full(17, 5e6), 1e-9, "pressed")
    same(pressed["contact/blocks/pressure"][-1], np.full(17, 5e6), 1e-9, "pressed, block")
    assert np.abs(pressed["contact/friction_work"]).max() < 1e-9, "nothing slides"
    sliding = run(folder, "sliding", {**body, "Flat/Velocity": 2, "Sides/Periodic": "true", "Supports/Top/Kind": "pressure", "Supports/Top/Held": "u_x",
                                      "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 5e-5, "Friction/Law": "coulomb"})
    check_sums(sliding, step_ratio(sliding), "sliding", periodic=True)
    same(sliding["contact_map/traction"][-1], np.full(17, 0.3 * 5e6), 1e-8, "mu p")
    same(sliding["contact_map/slip_velocity"][-1], np.full(17, 2.0), 1e-8, "V")
    assert (sliding["contact_map/state"][-1] == 2).all()
    same(sliding["contact/blocks/friction_power"][-1], np.full(17, 0.3 * 5e6 * 2), 1e-8, "mu p V")
    times, work = sliding["contact_map/time"], sliding["contact_map/friction_work"]
    same(work[-1] - work[-5], np.full(17, 0.3 * 5e6 * 2 * (times[-1] - times[-5])), 1e-8, "mu p V t")


def step_ratio(found):
    """Samples of the history between two of the map."""
    ratio = (found["contact_map/time"][1] - found["contact_map/time"][0]) / (found["history/time"][1] - found["history/time"][0])
    assert abs(ratio - round(ratio)) < 1e-9
    return int(round(ratio))


def check_bodies(folder):
    """A grid and the same cells as a mesh; a box of voxels: on 1, 2 and 3 ranks."""
    grid = run(folder, "grid", {**GRID, **SLIDING, **SIDES})
    check_sums(grid, 1, "grid")
    box = Box([12, 4], [24, 10], lambda x: "body")
    box.name_side("Contact", 1, False).name_side("Top", 1, True).name_side("wall", 0, False).write(folder("mesh.msh"))
    mesh = {**SLIDING, "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, "Supports/wall/Held": "u_x", "Phases/Names": "body",
            "Phases/body/Type": "stiffness", "Phases/body/Stiffness": STIFFNESS, "Phases/body/Density": DENSITY}
    solid = {**SLIDING, **SOLID, "Time/Time step": "auto", "Time/End time": 1e-5, "Snapshots/Interval": 2e-6}
    for name, settings in (("grid", {**GRID, **SLIDING, **SIDES}), ("mesh", mesh), ("solid", solid)):
        one = grid if name == "grid" else run(folder, name, settings)
        if name == "mesh":
            for key in one:
                if key.startswith("contact_map/") or key in ("contact/pressure", "contact/friction_work", "contact/blocks/pressure"):
                    if key != "contact_map/state":
                        same(one[key], grid[key], 1e-9, key)
                    else:
                        assert np.array_equal(one[key], grid[key])
        if name == "solid":
            assert one["contact_map/traction"].shape[1:] == (45, 2), one["contact_map/traction"].shape
            check_sums(one, 1, name, np.array([1.5, 0.5]) / np.hypot(1.5, 0.5))
        for ranks in (2, 3):
            many = run(folder, f"{name}{ranks}", settings, ranks=ranks)
            for key in one:
                if key.startswith(("contact_map/", "contact/")):  # parts of a mesh are summed up in another order
                    same(1.0 * one[key], 1.0 * many[key], 0 if name == "grid" else 1e-9, (name, ranks, key))


def check_laws(folder):
    """Nodes that slip have the traction that state of the law and remembered pressure give, to round-off; on a grid and in 3D."""
    weakening = {"Friction/Law": "coulomb", "Friction/Coefficient law": "linear slip weakening", "Friction/Coefficient": 0.5,
                 "Friction/Kinetic coefficient": 0.2, "Friction/Critical slip": 2e-6, "Friction/Normal stress": "constant time",
                 "Friction/Normal stress time": 1e-6, "Contact map/Fields": "pressure, traction, state, law state, remembered pressure"}
    solid = {**SLIDING, **SOLID, "Time/Time step": "auto", "Time/End time": 1e-5}
    for name, settings in (("law", {**GRID, **SLIDING, **SIDES}), ("periodic", {**GRID, **SLIDING, "Sides/Periodic": "true"}), ("solid_law", solid)):
        fields = {}
        for ranks in (1, 2, 3):
            found = run(folder, f"{name}{ranks}", {**settings, **weakening}, ranks=ranks)
            for key in ("pressure", "traction", "state", "law_state", "remembered_pressure"):
                value = 1.0 * found["contact_map/" + key]
                same(fields.setdefault(key, value), value, 0 if settings is not solid else 1e-9, (name, ranks, key))
        slip, slid = fields["law_state"], fields["state"] == 2
        size = np.linalg.norm(fields["traction"], axis=-1) if fields["traction"].ndim == 3 else np.abs(fields["traction"])
        limit = (0.2 + 0.3 * np.maximum(0, 1 - slip / 2e-6)) * fields["remembered_pressure"]
        assert slid.sum() > 100 and slip.max() > 2e-6 and slip[slid].min() < 1e-6, (name, slid.sum(), slip.max())
        assert np.abs(size - limit)[slid].max() < 1e-12 * limit.max(), (name, np.abs(size - limit)[slid].max(), limit.max())
        assert np.abs(fields["remembered_pressure"] - fields["pressure"])[slid].max() > 0.01 * limit.max()
        with h5py.File(folder(name + "1", "dynamics.h5")) as file:
            attributes = file["contact_map/law_state"].attrs
            assert attributes["unit"] == b"m" and attributes["meaning"] == b"slip", dict(attributes)
    theta = {**GRID, **SLIDING, "Contact map/Fields": "law state, state, slip velocity", "Friction/Coefficient law": "rate and state", "Friction/Coefficient": 0.4,
             "Friction/Rate and state/Direct effect": 0.01, "Friction/Rate and state/Evolution effect": 0.02,
             "Friction/Rate and state/Length": 1e-7, "Friction/Regularization time": 0, "Time/End time": 4e-5}
    found = run(folder, "theta", theta)
    with h5py.File(folder("theta", "dynamics.h5")) as file:
        assert file["contact_map/law_state"].attrs["unit"] == b"s"
    state, slid = found["contact_map/law_state"], found["contact_map/state"] == 2
    share = state[slid] * np.abs(found["contact_map/slip_velocity"][slid]) / 1e-7  # 1 in steady sliding
    assert state.min() > 0 and abs(np.median(share) - 1) < 0.15, np.median(share)  # theta follows V with a lag


def check_window(folder):
    """From, To and Interval; a long map is handed on in several pieces, here with 1024 rows and more."""
    whole = run(folder, "whole", {**GRID, **SLIDING, "Body/Cells": "6, 2", "Time/End time": 1.2e-4})
    check_sums(whole, 1, "whole")
    part = run(folder, "part", {**GRID, **SLIDING, "Body/Cells": "6, 2", "Time/End time": 1.2e-4, "Contact map/Interval": 3.9e-7,
                                "Contact map/From": 2e-5, "Contact map/To": 6e-5, "Contact map/Fields": "traction, state"})
    assert "contact_map/pressure" not in part and len(part["contact_map/time"]) == 101
    for key in ("time", "traction", "state"):
        assert np.array_equal(part["contact_map/" + key], whole["contact_map/" + key][500:1501:10]), key


def stop_early(folder, output, words, stop):
    """Begins the run and stops it soon after its first checkpoint. On a busy machine it may end before: then it is begun again."""
    ends = {signal.SIGTERM: 130, signal.SIGKILL: -signal.SIGKILL}
    for _ in range(20):
        child = folder.start("contact_dynamics", *words)
        while child.poll() is None and not os.path.exists(folder(output, "contact_dynamics.checkpoint")):
            time.sleep(0.002)
        child.send_signal(stop)
        child.communicate()
        if child.returncode == ends[stop] and (stop == signal.SIGTERM or os.path.exists(folder(output, "dynamics.h5.part"))):
            return
        assert child.returncode in (0, ends[stop]), (output, child.returncode)
        shutil.rmtree(folder(output))
    raise AssertionError("the run always ended before it could be stopped")


def check_resume(folder):
    """A run that is stopped and resumed, on a grid and on voxels; one that is killed leaves a file that can be gone on with."""
    rare = {"Observation/History interval": 50, "Observation/Energy interval": 500, "Contact map/Interval": 4e-7}
    grid = {**GRID, **SLIDING, **SIDES, **rare, "Body/Cells": "96, 40", "Time/Time step": 1e-8, "Time/End time": 1e-3}
    solid = {**SLIDING, **SOLID, **rare, "Body/Cells": "16, 8, 8", "Time/Time step": 2e-8, "Time/End time": 1e-3}
    for name, settings in (("grid_r", grid), ("solid_r", solid)):
        whole = run(folder, name, settings)
        for how, stop in (("stopped", signal.SIGTERM), ("killed", signal.SIGKILL)):
            output = f"{name}_{how}"
            words = [name + ".prm", "--output", output, "--set=Checkpoints/Interval=0.003"]
            stop_early(folder, output, words, stop)
            folder.run(0, "contact_dynamics", *words, "--resume")
            again = read(folder, output)
            assert set(again) == set(whole), set(again) ^ set(whole)
            for key in whole:
                assert np.array_equal(whole[key], again[key]), (output, key)


def check_refused(folder):
    def refuse(settings, *words):
        settings = {**GRID, **SLIDING, **settings}
        folder.write("bad.prm", prm({key: value for key, value in settings.items() if value is not None}))
        text = folder.run(2, "contact_dynamics", "bad.prm", "--output", "bad")
        for word in words:
            assert word in text, (word, text)
        assert not os.path.exists(folder("bad")), "a run that is refused creates nothing"

    refuse({"Contact map/From": 1}, "Contact map/From", "set it earlier")
    refuse({"Contact map/Fields": "law state"}, "Contact map/Fields", "law state", "has none")
    refuse({"Contact map/Fields": "remembered pressure"}, "Contact map/Fields", "Normal stress")
    refuse({"Contact map/Fields": "speed"}, "Contact map/Fields", "slip velocity")
    refuse({"Contact map/Interval": None, "Contact map/From": 1e-6}, "Contact map/Interval is 0")
    refuse({"Time/End time": 1e3, "Observation/History interval": 1000000000, "Observation/Energy interval": 0}, "Contact map/Interval",
           "samples of the map")
    text = folder.run(0, "contact_dynamics", "whole.prm", "--validate")
    assert "a map of the contact with 3000 samples" in text, text
    # 1 kHz: two samples in a period of what the reference node does.
    text = folder.run(0, "contact_dynamics", "grid.prm", "--output", "coarse", "--set=Contact map/Interval=1e-4",
                      "--set=Time/End time=4e-3", "--set=Observation/History interval=100")
    assert "the map of the contact has samples every" in text, text


def check_tools(folder):
    """The report and the Python module on a plane run and one in 3D."""
    sys.path.insert(0, os.path.join(TOOLS, "python"))
    import mesoslip
    for name, figures in (("grid", ("Map of the contact of", "Spectrogram of", "friction power and friction work")),
                          ("solid", ("Map of the contact of", "Pressure, shear traction on the body and slip velocity", "Spectrogram of", "Pressure and friction work"))):
        done = subprocess.run([sys.executable, "-B", os.path.join(TOOLS, "report", "make_report.py"), folder(name), "--output",
                               folder("report.html")], text=True, capture_output=True)
        page = folder.read("report.html").decode()
        assert done.returncode == 0, done.stdout + done.stderr
        for words in figures:
            assert words in page, (name, words)
        if name == "grid":  # the other is no longer than its last periods
            assert "has no more than its last periods" not in page, name
        with mesoslip.open(folder(name)) as file:
            found = file.contact_map
            unit = "N/m" if name == "grid" else "N"
            assert "pressure (Pa)" in repr(found) and "state (number)" in repr(found) and f"{len(found.time)} samples" in repr(found)
            assert file.history["contact_normal_force"].unit == unit and found["pressure"].unit == "Pa"
            same(found["pressure"] @ np.asarray(found.area), np.asarray(file.history["contact_normal_force"]), 1e-13, name)
            assert np.array_equal(found.rows("traction", slice(2, 4)), found["traction"][2:4]) and "time" not in found
    with mesoslip.open(folder("coarse")) as file:
        assert set(file.contact_map) == {"friction_work", "pressure", "slip_velocity", "state", "traction"}


def check_pictures(folder):
    """Shares of the nodes over time are those of the map; the surface is shown at the times that are asked for, field by field."""
    from report.runs import contact_states, space_time
    from report.base.data import Chain, Missing
    run, = Chain([folder("solid")]).runs
    found = read(folder, "solid")
    times, shares = contact_states.fractions_of_nodes(run)
    same(times, found["contact_map/time"], 1e-15, "times of the shares")
    for state, name in enumerate(("separated", "stick", "slip")):
        same(shares[name], 100 * (found["contact_map/state"] == state).mean(axis=1), 1e-13, name)
    rows, step = [60, 100], times[1] - times[0]
    figure, names = space_time.surface_at_times(run, [times[rows[1]] - 0.4 * step, times[rows[0]] + 0.4 * step])
    panels = [axes for axes in figure.axes if not hasattr(axes, "_colorbar")]
    assert names == ["pressure", "traction", "slip_velocity"] and len(panels) == 6 and len(figure.axes) == 9, (names, len(panels))
    direction = np.array([1.5, 0.5]) / np.hypot(1.5, 0.5)
    for panel, axes in enumerate(panels):
        values = found["contact_map/" + names[panel % 3]][rows[panel // 3]]
        expected, shown = values @ direction if values.ndim == 2 else values, np.asarray(axes.collections[0].get_array())
        expected, shown = expected / np.abs(expected).max(), shown / np.abs(shown).max()  # each node colours several polygons
        distance = np.abs(expected[:, None] - shown)
        assert max(distance.min(axis=0).max(), distance.min(axis=1).max()) < 1e-12, (panel, names[panel % 3])
    try:
        space_time.surface_at_times(run, [1.0])
        raise AssertionError("a time beyond the map is shown")
    except Missing as missing:
        assert "without the time 1 s of --surface-times" in str(missing), missing


def check_reduction():
    """A long map is reduced for its picture without losing what is short."""
    from report.runs import space_time
    values = np.full((5000, 3), 1.0)
    values[1234, 1], values[4321, 2] = 9.0, -7.0
    shown = space_time.farthest(values, 1.0, 900, 0)
    assert shown.shape == (900, 3) and shown[:, 1].max() == 9 and shown[:, 2].min() == -7 and (shown[:, 0] == 1).all()


def main():
    sys.path.insert(0, TOOLS)
    check_reduction()
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        for check in (check_uniform, check_bodies, check_laws, check_window, check_resume, check_refused, check_tools, check_pictures):
            check(folder)
            print(check.__name__, "passed", flush=True)


if __name__ == "__main__":
    main()
