"""Time/Precision = single: the same bits over ranks, several steps in a sweep and a resumed run; growth of the fastest complex mode; what is said of
rounding, against the displacements of the run; what is refused."""

import math
import tempfile

import h5py
import numpy as np

from scenes import Folder, prm, sets

BODY = {"Body/Stiffness": "36.54e9, 9.1e9, 47.26e9, 13.785e9", "Body/Density": 1770, "Supports/Top/Pressure": 5e6}
PIN = {**BODY, "Body/Size": "7e-3, 4e-3", "Body/Cells": "35, 20", "Body/Initial velocity": "0.3, 0", "Friction/Law": "constant time",
       "Friction/Coefficient": 0.25, "Friction/Regularization time": 1e-6, "Flat/Velocity": 2, "Supports/Top/Kind": "platen",
       "Supports/Left/Kind": "absorbing", "Time/End time": 6e-5, "Observation/Energy interval": 50, "Snapshots/Interval": 2e-5, "Time/Precision": "single"}
BLOCK = {**BODY, "Body/Size": "7e-3, 4e-3", "Body/Cells": "35, 20", "Friction/Coefficient": 0.1, "Flat/Velocity": 0, "Supports/Top/Kind": "pressure",
         "Time/End time": 2e-3, "Snapshots/Interval": 5e-5, "Time/Precision": "single"}


def run(folder, name, settings, *options, ranks=1):
    folder.write(name + ".prm", prm(settings))
    folder.run(0, "contact_dynamics", name + ".prm", "--output", name, *options, ranks=ranks)
    return folder.summary(name)


def differing(folder, name, other):
    """Datasets of dynamics.h5 that are not the same bits; energies are sums over ranks."""
    found = []
    with h5py.File(folder(name, "dynamics.h5")) as a, h5py.File(folder(other, "dynamics.h5")) as b:
        def compare(path, item):
            if isinstance(item, h5py.Dataset) and not path.startswith("energy/"):
                x, y = item[()], b[path][()]
                same = np.array_equal(x, y, equal_nan=True) if getattr(x, "dtype", np.dtype("O")).kind == "f" else np.array_equal(x, y)
                found.extend([] if same else [path])
        a.visititems(compare)
        assert len(a["snapshots/time"]) >= 3
    return found


def check_bits(folder):
    run(folder, "whole", PIN)
    for ranks in (2, 3):
        run(folder, "ranks", PIN, ranks=ranks)
        assert not differing(folder, "whole", "ranks"), (ranks, differing(folder, "whole", "ranks"))
    for steps in (1, 7):
        run(folder, "steps", {**PIN, "Performance/Temporal blocking": steps})
        assert not differing(folder, "whole", "steps"), steps
    # The second half from a checkpoint; blocks of statistics keep the length of the first half.
    run(folder, "half", {**PIN, "Checkpoints/Keep": "true", "Time/End time": 3e-5})
    run(folder, "half", {**PIN, "Checkpoints/Keep": "true"}, "--resume")
    blocks = [path for path in differing(folder, "whole", "half") if not path.startswith(("contact/blocks", "snapshots"))]
    assert not [path for path in blocks if path.startswith("history")], blocks
    with h5py.File(folder("whole", "dynamics.h5")) as whole, h5py.File(folder("half", "dynamics.h5")) as half:
        assert np.array_equal(whole["snapshots/displacement"][-1], half["snapshots/displacement"][-1])
    run(folder, "double", {**PIN, "Time/Precision": "double"})
    assert "snapshots/displacement" in differing(folder, "whole", "double")
    assert folder.summary("double")["single_precision_rounding"] is None


def check_rounding(folder):
    """A block that slides to rest: 2^-24 of the largest displacement over the edge of a cell, as a share of the largest strain."""
    for speed, doubtful in ((1, False), (20, True)):
        summary = run(folder, "block", {**BLOCK, "Body/Initial velocity": f"{speed}, 0"})
        with h5py.File(folder("block", "dynamics.h5")) as file:
            farthest = np.abs(file["snapshots/displacement"][()]).max()
        expected = 2**-24 * farthest / 2e-4 / summary["largest_strain"]
        print(f"{speed} m/s: {summary['single_precision_rounding']:.3e}, from the snapshots {expected:.3e}")
        assert abs(summary["single_precision_rounding"] / expected - 1) < 0.02, (summary["single_precision_rounding"], expected)
        said = [warning for warning in summary["warnings"] if "single precision" in warning]
        assert len(said) == doubtful and all("Time/Precision = double" in warning for warning in said), summary["warnings"]
    # Where rounding takes more than a hundredth of the strains, the run stops.
    fast = {**BLOCK, "Body/Initial velocity": "200, 0", "Time/End time": 4e-3}
    folder.write("fast.prm", prm(fast))
    said = folder.run(2, "contact_dynamics", "fast.prm", "--output", "fast")
    assert "Time/Precision is single, but rounding takes up to" in said and "set Time/Precision = double" in said, said
    folder.run(0, "contact_dynamics", "fast.prm", "--output", "fast", "--set", "Time/Precision=double")


def check_growth(folder):
    """The vibration that grows, over half a millisecond, as its complex mode and as the run in double precision."""
    body = {**BODY, "Body/Size": "0.012, 0.004", "Body/Cells": "24, 8", "Flat/Velocity": 50, "Supports/Top/Kind": "platen", "Friction/Coefficient": 0.3,
            "Friction/Regularization time": 4e-7, "Time/Rayleigh beta": 4.4e-9}
    run(folder, "modes", {**body, "Analysis": "complex modes", "Complex modes/Highest frequency": 1.2e6})
    growth = folder.summary("modes")["largest_growth_rate"]
    settings = {**body, "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 1e-4, "Time/End time": 1.3e-3, "Time/Time step": 1e-8,
                "Observation/Reference x": 0.002}
    for precision in ("double", "single"):
        run(folder, precision, {**settings, "Time/Precision": precision}, *sets({"Observation/History interval": 16}))
        with h5py.File(folder(precision, "dynamics.h5")) as file:
            time, u = file["reference/time"][()], file["reference/displacement"][:, 0]
        starts, window = np.arange(9e-4, 1.28e-3, 2e-5), 2e-5
        amplitudes = [np.std(u[(time >= start) & (time < start + window)]) for start in starts]
        found = np.polyfit(starts, np.log(amplitudes), 1)[0]
        print(f"{precision}: growth {found:.1f} 1/s, of the mode {growth:.1f} 1/s")
        assert abs(found / growth - 1) < 0.01, (precision, found, growth)


def check_refused(folder):
    box = {"Dimension": 3, **BODY, "Body/Stiffness": "36e9, 9e9, 9e9, 36e9, 9e9, 36e9, 13e9, 13e9, 13e9", "Body/Size": "1e-3, 1e-3, 1e-3",
           "Body/Cells": "4, 4, 4", "Time/Precision": "single"}
    folder.write("box.prm", prm(box))
    said = folder.run(2, "contact_dynamics", "box.prm", "--validate")
    assert "Time/Precision" in said and "no plane grid" in said, said
    folder.write("modes.prm", prm({**BODY, "Analysis": "modal", "Body/Size": "7e-3, 4e-3", "Body/Cells": "35, 20", "Time/Precision": "single"}))
    said = folder.run(2, "contact_dynamics", "modes.prm", "--validate")
    assert "Time/Precision" in said and "transient" in said, said


assert math.isclose(2**-24, np.finfo(np.float32).eps / 2)
with tempfile.TemporaryDirectory() as path:
    scene = Folder(path)
    check_refused(scene)
    check_bits(scene)
    check_rounding(scene)
    check_growth(scene)
