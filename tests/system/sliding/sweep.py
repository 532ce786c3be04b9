"""Maps (section Sweep of contact_dynamics): points equal single runs bit for bit, whatever the order of points, the number of processes
and of ranks, and however often a map is stopped, resumed and extended; points that fail are told and do not stop the others."""

import csv
import os
import signal
import shutil
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

from scenes import PROGRAMS, TOOLS, Folder, prm

PIN = {"Body/Size": "14e-3, 4e-3", "Body/Cells": "28, 8", "Supports/Top/Pressure": 5e6, "Flat/Velocity": 2, "Friction/Coefficient": 0.25,
       "Friction/Regularization time": 1.5e-6, "Time/End time": 1e-4, "Observation/Blocks": 10}
PRESSURES, FRICTION = (1e6, 3e6, 5e6), (0.1, 0.4)
AXES = {"Sweep/Axes": "pressure, friction", "Sweep/pressure/Key": "Supports/Top/Pressure", "Sweep/pressure/From": 1e6, "Sweep/pressure/To": 5e6,
        "Sweep/pressure/Number": 3, "Sweep/friction/Key": "Friction/Coefficient", "Sweep/friction/Values": "0.1, 0.4"}


def content(folder, name="map"):
    """Everything in map.h5, and the rows of map.csv."""
    found = {}
    with h5py.File(folder(name + "/map.h5")) as file:
        file.visititems(lambda path, item: found.update({path: (item[()], dict(item.attrs))}) if isinstance(item, h5py.Dataset) else None)
        found["shape"] = file["axes"].attrs["shape"]
    with open(folder(name + "/map.csv"), encoding="utf-8") as file:
        found["rows"] = list(csv.DictReader(file))
    return found


def alone(folder):
    """Words of Folder.run() that start the program itself, which starts more of it, and not a fork of the server of the tests."""
    return {"cwd": folder.path}


def equal(one, other):
    np.testing.assert_equal(one, other)


def check_single_runs(folder):
    folder.write("map.prm", prm({**PIN, **AXES}))
    said = folder.run(0, "contact_dynamics", "map.prm", "--output", "map", **alone(folder))
    assert "6 of 6 points are done" in said, said
    found = content(folder)
    rows = found["rows"]
    assert list(found["shape"]) == [3, 2] and [float(row["pressure [Pa]"]) for row in rows] == [p for p in PRESSURES for _ in FRICTION]
    for k, row in enumerate(rows):
        pressure, friction = PRESSURES[k // 2], FRICTION[k % 2]
        folder.write("one.prm", prm({**PIN, "Supports/Top/Pressure": pressure, "Friction/Coefficient": friction}))
        folder.run(0, "contact_dynamics", "one.prm", "--output", "one")
        summary = folder.summary("one")
        for name in ("global_interface_friction_coefficient", "slip_fraction", "separation_fraction", "friction_energy", "largest_strain", "time_step"):
            assert found["numbers/" + name][0][k] == summary[name], (name, k)
        assert row["regime"] == summary["regime"] and row["status"] == "done", row
        assert sorted(os.listdir(folder("map/" + row["folder"]))) == ["log.txt", "original.prm", "parameters.prm", "point.json", "summary.json"]
        folder.run(0, "contact_dynamics", "map/" + row["folder"] + "/parameters.prm", "--output", "again")
        assert folder.summary("again")["friction_energy"] == summary["friction_energy"]
    return found


def check_ways(folder, due):
    for name, options, ranks in (("one process", ["--set", "Sweep/Processes=1"], 1), ("three", ["--set", "Sweep/Processes=3"], 1)):
        folder.run(0, "contact_dynamics", "map.prm", "--output", "other", *options, ranks=ranks, **alone(folder))
        equal(content(folder, "other"), due)
        shutil.rmtree(folder("other"))
    folder.run(0, "contact_dynamics", "map.prm", "--output", "other", ranks=2)
    np.testing.assert_allclose(content(folder, "other")["numbers/friction_energy"][0], due["numbers/friction_energy"][0], rtol=1e-6)
    shutil.rmtree(folder("other"))
    # The other way round, with points that are there already, in the same folder and in another one.
    turned = {**PIN, **AXES, "Sweep/Axes": "friction, pressure", "Sweep/friction/Values": "0.4, 0.2, 0.1"}
    folder.write("turned.prm", prm(turned))
    said = folder.run(0, "contact_dynamics", "turned.prm", "--output", "map")
    assert "6 of 9 runs are there already" in said, said
    found = content(folder)
    order = [3 * j + i for i in range(3) for j in (2, 0)]
    for name in ("numbers/friction_energy", "folder", "axes/pressure"):
        equal(found[name][0][order], due[name][0])
    folder.run(0, "contact_dynamics", "map.prm", "--output", "map")
    equal(content(folder), due)


def told_by_points(folder):
    """How much the logs of the points say so far."""
    logs = (os.path.join(path, name) for path, _, names in os.walk(os.path.join(folder, "points")) for name in names if name == "log.txt")
    return sum(os.path.getsize(log) for log in logs)


def check_interruptions(folder, due):
    """Stopped again and again, soon after its points began."""
    long = {**PIN, **AXES, "Time/End time": 2e-2}
    folder.write("long.prm", prm(long))
    folder.run(0, "contact_dynamics", "long.prm", "--output", "whole")
    random = np.random.default_rng(1)
    stops = maps = 0
    while stops < 20:
        told = told_by_points(folder("stopped"))
        process = folder.start("contact_dynamics", "long.prm", "--output", "stopped", "--quiet")
        while process.poll() is None and told_by_points(folder("stopped")) == told:
            time.sleep(0.01)
        try:
            process.wait(0.5 * random.random())
        except subprocess.TimeoutExpired:
            process.send_signal((signal.SIGINT, signal.SIGTERM)[stops % 2])
        error = process.communicate(timeout=120)[1]
        if process.returncode == 0:
            equal(content(folder, "stopped"), content(folder, "whole"))
            shutil.rmtree(folder("stopped"))
            maps += 1
            continue
        stops += 1
        assert process.returncode < 0 or (process.returncode == 130 and "the same command computes the rest" in error), (process.returncode, error)
    folder.run(0, "contact_dynamics", "long.prm", "--output", "stopped", **alone(folder))
    print(f"stopped {stops} times in {maps + 1} maps")
    equal(content(folder, "stopped"), content(folder, "whole"))


def check_killed(folder):
    """A process that is killed fails its point, which is computed when the map is started again."""
    process = folder.start("contact_dynamics", "long.prm", "--output", "killed", "--quiet", "--set", "Sweep/Processes=2")
    children = lambda: subprocess.run(["ps", "--no-headers", "-o", "pid", "--ppid", str(process.pid)], capture_output=True, text=True, check=False).stdout.split()  # noqa: E731
    while len(children()) < 2 or not os.path.exists(folder("killed", "points")) or len(os.listdir(folder("killed", "points"))) < 2:
        assert process.poll() is None, "it ended before"
    os.kill(int(children()[0]), signal.SIGKILL)
    errors = process.communicate(timeout=120)[1]
    rows = content(folder, "killed")["rows"]
    killed = [row for row in rows if "ended by signal 9" in row["message"]]
    assert process.returncode == 0 and len(killed) == 1 and "1 of 6 points failed" in errors, (process.returncode, errors, rows)
    folder.run(0, "contact_dynamics", "long.prm", "--output", "killed", **alone(folder))
    equal(content(folder, "killed"), content(folder, "whole"))

    # The map itself is killed: the processes of its points stop, and the same command continues them.
    process = folder.start("contact_dynamics", "long.prm", "--output", "orphans", "--quiet", "--set", "Sweep/Processes=2")
    while told_by_points(folder("orphans")) == 0:
        assert process.poll() is None, "it ended before"
    process.kill()
    process.communicate(timeout=120)
    folder.run(0, "contact_dynamics", "long.prm", "--output", "orphans", **alone(folder))
    equal(content(folder, "orphans"), content(folder, "whole"))


def check_entries(folder):
    """Numbers of a list: points are the single runs with that list, in the same folders whatever axis changes which number."""
    widths, heights = (14e-3, 12e-3), (4e-3, 5e-3)
    axes = {"Sweep/Axes": "width, height", "Sweep/width/Key": "Body/Size[1]", "Sweep/width/Values": "14e-3, 12e-3",
            "Sweep/height/Key": "Body/Size[2]", "Sweep/height/Values": "4e-3, 5e-3"}
    folder.write("entries.prm", prm({**PIN, **axes}))
    folder.run(0, "contact_dynamics", "entries.prm", "--output", "entries")
    found = content(folder, "entries")
    for k, row in enumerate(found["rows"]):
        size = (widths[k // 2], heights[k % 2])
        assert (float(row["width [m]"]), float(row["height [m]"])) == size, row
        folder.write("one.prm", prm({**PIN, "Body/Size": "{}, {}".format(*size)}))
        folder.run(0, "contact_dynamics", "one.prm", "--output", "one")
        assert found["numbers/friction_energy"][0][k] == folder.summary("one")["friction_energy"], row
    said = folder.run(0, "contact_dynamics", "entries.prm", "--output", "entries", "--set", "Sweep/Axes=height, width")
    assert "4 of 4 runs are there already" in said, said
    for change, sentence in (({"Sweep/width/Key": "Body/Size[3]"}, "Body/Size has 2 values in the file, and [3] is none of them"),
                             ({"Sweep/width/Key": "Body/Size[2]"}, "width and height both set Body/Size[2]"),
                             ({"Sweep/width/Key": "Body/Size"}, "width and height both set Body/Size[2]"),
                             ({"Sweep/width/Values": "-1, 1"}, "Body/Size cannot be -1, 4e-3")):
        folder.write("refused.prm", prm({**PIN, **axes, **change}))
        said = folder.run(2, "contact_dynamics", "refused.prm", "--validate")
        assert sentence in said, (sentence, said)


def check_failed_neighbour(folder):
    """A point that starts from one that failed is computed when that one is there."""
    folder.write("chain.prm", prm({**PIN, "Sweep/Axes": "beta", "Sweep/beta/Key": "Time/Rayleigh beta", "Sweep/beta/Values": "0, 1e-7, 1e-9",
                                   "Sweep/Continue": "up", "Time/Time step": 9.1e-8, "Time/End time": 2e-5}))
    folder.run(0, "contact_dynamics", "chain.prm", "--output", "chain")
    rows = content(folder, "chain")["rows"]
    assert [row["status"] for row in rows] == ["done", "failed", "failed"], rows
    assert "it starts from the end of beta = 1e-07, which failed" in rows[2]["message"], rows
    # As if the cause were gone: the end of another run stands for that of the point.
    failed, done = (folder("chain", rows[k]["folder"]) for k in (1, 0))
    for name in ("contact_dynamics.end", "summary.json", "point.json"):
        shutil.copy(os.path.join(done, name), failed)
    folder.run(0, "contact_dynamics", "chain.prm", "--output", "chain")
    assert [row["status"] for row in content(folder, "chain")["rows"]] == ["done"] * 3


def check_failures(folder):
    # Too long a time step is refused at the points with a soft damping only.
    folder.write("bad.prm", prm({**PIN, "Sweep/Axes": "beta", "Sweep/beta/Key": "Time/Rayleigh beta", "Sweep/beta/Values": "0, 1e-9, 4e-9",
                                 "Time/Time step": 9.4e-8}))
    said = folder.run(0, "contact_dynamics", "bad.prm", "--output", "bad")
    rows = content(folder, "bad")["rows"]
    assert [row["status"] for row in rows].count("failed") >= 1 and rows[0]["status"] == "done", rows
    assert "critical" in rows[-1]["message"] and "points failed" in said, (rows, said)


def check_refusals(folder):
    for change, sentence in (({"Sweep/pressure/Key": "Supports/Top/Presure"}, "there is no key Supports/Top/Presure"),
                             ({"Sweep/friction/Values": "0.1, -1"}, "Friction/Coefficient cannot be -1"),
                             ({"Sweep/Points": "pairs"}, "pairs need as many values"),
                             ({"Sweep/pressure/Number": 1}, "at least 2 values"),
                             ({"Sweep/pressure/Values": "1e6, 2e6"}, "the values are listed"),
                             ({"Sweep/Seed": 3}, "the points are not random"),
                             ({"Sweep/friction/Key": "Supports/Top/Pressure"}, "both set Supports/Top/Pressure"),
                             ({"Sweep/Axes": ""}, "Sweep"),
                             ({"Complex modes/Fastest decay": 100}, "as Sweep/Complex modes is false; remove it, or set it to true"),
                             ({"Sweep/Continue": "up", "Flat/Expression": "t"}, "Time/Continue from"),
                             ({"Sweep/Skip stable": "true"}, "no complex modes are computed"),
                             ({"Sweep/Skip stable": "true", "Sweep/Complex modes": "true", "Sweep/Continue": "up"}, "have to be run"),
                             ({"Body/Cells": "28, 8", "Sweep/friction/Key": "Time/Beta2", "Sweep/friction/Values": "0.5, 2"}, "Beta2")):
        folder.write("refused.prm", prm({**PIN, **AXES, **change}))
        said = folder.run(2, "contact_dynamics", "refused.prm", "--validate")
        assert sentence in said, (sentence, said)
    said = folder.run(2, "contact_dynamics", "map.prm", "--validate", "--ignore-unused", "--set", "Analysis=modal")
    assert "maps (Sweep/Axes) are of transient runs" in said, said


def check_random(folder):
    keys = {**PIN, "Sweep/Axes": "pressure, friction", "Sweep/Points": "random", "Sweep/Seed": 4, "Sweep/pressure/Key": "Supports/Top/Pressure",
            "Sweep/pressure/From": 1e5, "Sweep/pressure/To": 1e7, "Sweep/pressure/Spacing": "logarithmic", "Sweep/friction/Key": "Friction/Coefficient",
            "Sweep/friction/From": 0.1, "Sweep/friction/To": 0.4, "Sweep/Complex modes": "true"}
    tables = []
    for n in (3, 5):
        folder.write("random.prm", prm({**keys, "Sweep/Random points": n}))
        said = folder.run(0, "contact_dynamics", "random.prm", "--output", "random")
        tables.append(content(folder, "random"))
    assert "6 of 10 runs are there already" in said, said
    equal(tables[1]["numbers/friction_energy"][0][:3], tables[0]["numbers/friction_energy"][0])
    pressure = tables[1]["axes/pressure"][0]
    assert np.all((pressure > 1e5) & (pressure < 1e7)) and len(set(pressure)) == 5
    k = 4
    folder.write("modes.prm", prm({**PIN, "Supports/Top/Pressure": pressure[k], "Friction/Coefficient": tables[1]["axes/friction"][0][k]}))
    folder.run(0, "contact_dynamics", "modes.prm", "--output", "modes", "--set", "Analysis=complex modes", "--ignore-unused")
    summary = folder.summary("modes")
    numbers = {name: value for name, value in summary.items() if isinstance(value, float)}
    assert numbers
    for name, value in numbers.items():
        if "numbers/complex_modes." + name in tables[1]:
            assert tables[1]["numbers/complex_modes." + name][0][k] == value, name


def check_branches(folder):
    """Up and down, each point from the end of its neighbour: as runs that are started one after the other by hand."""
    keys = {**PIN, "Time/End time": 5e-5, "Sweep/Axes": "friction", "Sweep/friction/Key": "Friction/Coefficient", "Sweep/friction/Values": "0.1, 0.2, 0.4",
            "Sweep/Continue": "both"}
    folder.write("branches.prm", prm(keys))
    folder.run(0, "contact_dynamics", "branches.prm", "--output", "branches", **alone(folder))
    found = content(folder, "branches")
    assert list(found["shape"]) == [2, 3] and list(found["axes/branch"][0]) == [1, 1, 1, -1, -1, -1], found["shape"]
    energies = []
    for k, friction in enumerate((0.1, 0.2, 0.4, 0.4, 0.2, 0.1)):
        more = {"Time/Continue from": f"by_hand{k - 1}"} if k else {}
        folder.write("by_hand.prm", prm({**PIN, "Time/End time": 5e-5, "Friction/Coefficient": friction, "Checkpoints/Write end": "true", **more}))
        folder.run(0, "contact_dynamics", "by_hand.prm", "--output", f"by_hand{k}")
        energies.append(folder.summary(f"by_hand{k}")["friction_energy"])
    equal(found["numbers/friction_energy"][0], np.array(energies)[[0, 1, 2, 5, 4, 3]])
    # Longer, and in one process: the points of the way up are there.
    folder.write("branches.prm", prm({**keys, "Sweep/friction/Values": "0.1, 0.2, 0.4, 0.5", "Sweep/Continue": "up"}))
    said = folder.run(0, "contact_dynamics", "branches.prm", "--output", "branches", "--set", "Sweep/Processes=1")
    assert "3 of 4 runs are there already" in said, said
    equal(content(folder, "branches")["numbers/friction_energy"][0][:3], np.array(energies)[:3])


def grown(folder, run, frequency):
    """Growth rate (1/s) of the vibration of the reference node at the frequency (Hz), over the second half of the run."""
    with h5py.File(folder("border", run, "dynamics.h5")) as file:
        time, u = file["reference/time"][()], file["reference/displacement"][:, 0]
        assert file["history/separated_nodes"][-1] == 0 and file["history/sticking_nodes"][-1] == 0, "it slides everywhere"
    n = len(time) // 20
    pieces = [slice(k * n, (k + 1) * n) for k in range(10, 20)]
    wave = np.hanning(n)[None, :] * np.stack([(u[piece] - u[piece].mean()) * np.exp(-2j * np.pi * frequency * time[piece]) for piece in pieces])
    return np.polyfit([time[piece].mean() for piece in pieces], np.log(np.abs(wave.sum(axis=1))), 1)[0]


SMOOTH = {**PIN, "Supports/Top/Kind": "platen", "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 1e-4, "Time/Rayleigh beta": 1.5e-9,
          "Sweep/Axes": "friction", "Sweep/friction/Key": "Friction/Coefficient", "Sweep/Complex modes": "true"}


def check_skip(folder):
    """Points of which all vibrations decay are not run, and are when they are wanted later."""
    folder.write("skip.prm", prm({**SMOOTH, "Time/End time": 2e-4, "Sweep/friction/Values": "0.3, 0.28, 0.1", "Sweep/Skip stable": "true"}))
    for name, ranks, how in (("skip", 1, {}), ("skip2", 2, {}), ("skip", 1, alone(folder))):
        said = folder.run(0, "contact_dynamics", "skip.prm", "--output", name, ranks=ranks, **how)
        assert "1 of 3 points are done, 2 are not run" in said, said
        rows = content(folder, name)["rows"]
        assert [row["status"] for row in rows] == ["done", "skipped", "skipped"] and rows[1]["regime"] == "steady sliding, not run", rows
        assert rows[1]["complex_modes.missing_modes [-]"] == "0" and float(rows[1]["complex_modes.largest_growth_rate [1/s]"] or -1) < 0, rows[1]
        assert folder.summary(name)["points_skipped"] == 2
    borders = [content(folder, name)["border/friction"][0] for name in ("skip", "skip2")]  # on one and two ranks
    np.testing.assert_allclose(*borders, rtol=1e-9)
    assert len(borders[0]) == 1 and 0.28 < borders[0][0] < 0.3, borders
    said = folder.run(0, "contact_dynamics", "skip.prm", "--output", "skip", "--set", "Sweep/Skip stable=false")
    assert "4 of 6 runs are there already" in said and "3 of 3 points are done:" in said, said
    folder.run(0, "contact_dynamics", "skip.prm", "--output", "skip")
    assert [row["status"] for row in content(folder, "skip")["rows"]] == ["done"] * 3, "what is known is shown"


def check_border(folder):
    """Where growth of the complex modes is zero, vibrations of the runs neither grow nor decay."""
    values = np.array([0.27, 0.28, 0.3, 0.31])
    folder.write("border.prm", prm({**SMOOTH, "Time/End time": 0.02, "Observation/History interval": 8, "Observation/Energy interval": 0,
                                    "Sweep/friction/Values": ", ".join(map(str, values)), "Sweep/Keep results": "true", "Complex modes/Fastest decay": 5000, "Sweep/Border tolerance": 1e-3}))
    folder.run(0, "contact_dynamics", "border.prm", "--output", "border")
    found = content(folder, "border")
    due = found["numbers/complex_modes.largest_growth_rate"][0]
    frequencies = found["numbers/complex_modes.frequency_of_largest_growth"][0]
    rates = np.array([grown(folder, row["folder"], frequency) for row, frequency in zip(found["rows"], frequencies)])
    zero = lambda growth: np.polyval(np.polyfit(growth, values, 2), 0.0)  # noqa: E731
    print(f"border at a friction of {zero(due):.5f} by complex modes, {zero(rates):.5f} by runs; growth {due}, {rates}")
    assert due[0] < 0 < due[-1] and abs(zero(rates) / zero(due) - 1) < 2e-3, (due, rates)
    # The border that the map finds by itself: complex modes just beside it decay and grow.
    border = found["border/friction"][0]
    assert len(border) == 1 and found["border/along"][0].tolist() == [b"friction"] and abs(border[0] / zero(due) - 1) < 2e-3, (border, zero(due))
    with open(folder("border", "border.csv"), encoding="utf-8") as file:
        assert [(float(row["friction [-]"]), row["along"]) for row in csv.DictReader(file)] == [(border[0], "friction")]
    for beside, grows in ((0.999, False), (1.001, True)):
        folder.write("beside.prm", prm({key: value for key, value in SMOOTH.items() if not key.startswith("Sweep")}))
        folder.run(0, "contact_dynamics", "beside.prm", "--output", "beside", "--ignore-unused", "--set", "Analysis=complex modes",
                   "--set", "Complex modes/Fastest decay=5000", "--set", f"Friction/Coefficient={beside * border[0]!r}")
        assert (folder.summary("beside")["largest_growth_rate"] > 0) == grows, (beside, border)
    assert np.abs(rates - due).max() < 3, (due, rates)


def check_python(folder, due):
    sys.path.insert(0, os.path.join(TOOLS, "python"))
    import mesoslip

    with mesoslip.open(folder("border")) as run:
        assert list(run.map.border) == ["friction", "along"] and list(run.map.border["along"]) == ["friction"], run.map.border
    with mesoslip.open(folder("map")) as run:
        assert run.map.border is None

    folder.write("plain.prm", prm(PIN))
    axes = {"Supports/Top/Pressure": PRESSURES, "mu": ("Friction/Coefficient", FRICTION)}
    with mesoslip.sweep(folder("plain.prm"), axes, output=folder("python"), programs=PROGRAMS) as run:
        found = run.map
        assert found.shape == (3, 2) and list(found.axes) == ["pressure", "mu"] and found.axes["pressure"].unit == "Pa", found
        equal(np.asarray(found["friction_energy"]).ravel(), due["numbers/friction_energy"][0])
        assert list(found["regime"].ravel()) == [row["regime"] for row in due["rows"]] and (found.status == "done").all()
        with mesoslip.open(folder("python", found.folders[2, 1])) as point:
            assert point.summary["pressure"] == 5e6


def check_run_sh(folder, due):
    """./run.sh with the file: the same map and its report, also after Ctrl-C; what it refuses."""
    command = [sys.executable, "-B", os.path.join(TOOLS, "run_chain.py"), "--programs", os.path.abspath(PROGRAMS)]
    files = {"stderr": subprocess.STDOUT, "stdout": subprocess.PIPE, "text": True, "cwd": folder.path}
    done = subprocess.run([*command, "map.prm", "--output", "sh"], check=False, **files)
    assert done.returncode == 0 and os.path.isfile(folder("sh", "report.html")), done.stdout
    equal(content(folder, "sh"), due)
    with subprocess.Popen([*command, "long.prm", "--no-report"], start_new_session=True, **files) as process:
        while told_by_points(folder("output", "long")) == 0:
            assert process.poll() is None, process.stdout.read()
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGINT)
        said = process.communicate(timeout=120)[0]
    assert process.returncode == 130 and "with --resume" in said, said
    done = subprocess.run([*command, "long.prm", "--resume", "--no-report"], check=False, **files)
    assert done.returncode == 0, done.stdout
    equal(content(folder, "output/long"), content(folder, "whole"))
    folder.write("some.txt", "")
    folder.write("bad.prm", "set Grid = 3\n")
    for words, sentence in ((["some.txt"], "is no .prm file"), (["map.prm", "--jobs=2"], "--jobs is for the runs of a chain"),
                            (["bad.prm"], "none of the programs accepts bad.prm")):
        done = subprocess.run([*command, *words], check=False, **files)
        assert done.returncode == 2 and sentence in done.stdout and len(done.stdout.splitlines()) == 1, done.stdout


def check_report(folder):
    for name, due in (("map", "Regime of the reference node over"), ("skip2", "At 2 others all complex modes"), ("branches", "numbers of the runs over what changes"), ("random", "Points of random"), ("bad", "points failed")):
        done = subprocess.run([sys.executable, "-B", os.path.join(TOOLS, "report", "make_report.py"), folder(name), "--output", folder(name + ".html"),
                               *(["--pictures", folder("pictures")] if name == "map" else [])],
                              capture_output=True, text=True, check=False)
        with open(folder(name + ".html"), encoding="utf-8") as file:
            text = file.read()
        assert done.returncode == 0 and due in text and "Left out" not in text and text.count("data:image/png") > 0, (name, done.stdout, done.stderr)
        if name == "map":
            links = [f'href="map/{row["folder"]}/summary.json"' in text for row in content(folder, name)["rows"]]
            assert len(links) == 6 and all(links) and len(os.listdir(folder("pictures"))) == text.count("data:image/png"), links


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        due = check_single_runs(folder)
        check_ways(folder, due)
        check_interruptions(folder, due)
        check_killed(folder)
        check_entries(folder)
        check_failed_neighbour(folder)
        check_failures(folder)
        check_refusals(folder)
        check_random(folder)
        check_branches(folder)
        check_skip(folder)
        check_border(folder)
        check_python(folder, due)
        check_run_sh(folder, due)
        check_report(folder)


if __name__ == "__main__":
    main()
