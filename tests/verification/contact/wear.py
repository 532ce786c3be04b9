"""Wear and flash temperature from the map of a run: closed forms of a half-space, and a layer that slides steadily, on a grid and in 3D."""

import os
import sys
import tempfile

import numpy as np

from scenes import TOOLS, Folder, prm

sys.path.insert(0, os.path.join(TOOLS, "python"))
import mesoslip  # noqa: E402

EFFUSIVITY = (30 * 1770 * 1000.0) ** 0.5
LAYER = {"Body/Stiffness": "36.54e9, 9.1e9, 47.26e9, 13.785e9", "Body/Density": 1770, "Body/Size": "0.004, 0.001", "Body/Cells": "16, 4",
         "Sides/Periodic": "true"}
BOX = {"Dimension": 3, "Body/Stiffness": "269e9, 115e9, 115e9, 269e9, 115e9, 269e9, 77e9, 77e9, 77e9", "Body/Density": 7800,
       "Body/Size": "4e-3, 2e-3, 1e-3", "Body/Cells": "8, 4, 4", "Sides/Periodic": "true", "Sides/Periodic in y": "true"}
SLIDING = {"Flat/Velocity": 2, "Friction/Coefficient": 0.25, "Supports/Top/Pressure": 5e5, "Time/Rayleigh beta": 1e-7, "Time/End time": 4e-4,
           "Contact map/Interval": 2e-6, "Contact map/Fields": "pressure, traction, slip velocity, friction work", "Supports/Top/Kind": "pressure",
           "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 5e-5, "Friction/Law": "coulomb"}


def close(found, expected, tolerance, what):
    error = np.abs(np.asarray(found) / expected - 1).max()
    print(f"{what:70s} {error:.1e}")
    assert error <= tolerance, f"{what}: {found} instead of {expected}"


def check_half_space():
    """A constant flux is exact, one that grows with time converges; the numbers of a contact."""
    flux = 0.25 * 5e5 * 2
    for end, expected in ((1e-3, 1.224), (1.0, 38.72)):
        time = np.linspace(0, end, 1001)
        rise = mesoslip.wear.temperature_of(flux * time[:, None], time, EFFUSIVITY)
        assert rise.unit == "K" and rise.shape == (1001, 1)
        close(rise[1:, 0], 2 * flux * np.sqrt(time[1:] / np.pi) / EFFUSIVITY, 1e-12, f"constant flux over {end:g} s")
        close(rise[-1, 0], expected, 1e-3, "its rise at the end")
        close(mesoslip.wear.temperature_of(flux * time[:, None], time, EFFUSIVITY, 0.5)[-1, 0], expected / 2, 1e-3, "half of the heat")
    errors = []
    for n in (50, 100, 200):
        time = np.linspace(0, 1, n + 1)
        rise = mesoslip.wear.temperature_of(0.5 * flux * time[:, None] ** 2, time, EFFUSIVITY)
        errors.append(abs(rise[-1, 0] / (4 * flux / (3 * EFFUSIVITY * np.sqrt(np.pi))) - 1))
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    print("flux that grows with time: errors", errors, "orders", orders)
    assert (orders > 1.4).all() and errors[-1] < 1e-3
    for what, call in (("effusivity", lambda: mesoslip.wear.temperature_of(np.zeros((3, 1)), [0, 1, 2], 0)),
                       ("share", lambda: mesoslip.wear.temperature_of(np.zeros((3, 1)), [0, 1, 2], 1, 1.5)),
                       ("equally", lambda: mesoslip.wear.temperature_of(np.zeros((3, 1)), [0, 1, 3], 1))):
        try:
            call()
        except ValueError as error:
            assert what in str(error), error
        else:
            raise AssertionError(what)


def check_runs(folder):
    """The top is pressed down, in 0.05 ms, and held along the flat: after some periods pressure and slip are uniform."""
    for name, body, velocity in (("layer", LAYER, 2), ("box", BOX, "2, 0")):
        settings = {**body, **SLIDING, "Flat/Velocity": velocity, "Supports/Top/Held": "u_x" if name == "layer" else "u_x, u_y"}
        keys = {key: value for key, value in settings.items() if "/" in key}
        folder.write(name + ".prm", "".join(f"set {key} = {value}\n" for key, value in settings.items() if "/" not in key) + prm(keys))
        folder.run(0, "contact_dynamics", name + ".prm", "--output", name)
        with mesoslip.open(folder(name)) as run:
            k, work, depth = 1e-15, mesoslip.wear.friction_work(run), mesoslip.wear.depth(run, 1e-15)
            rise = mesoslip.wear.flash_temperature(run, EFFUSIVITY)
            time = np.asarray(run.contact_map.time)
            last = len(time) // 2
            close((work[-1] - work[last]) / (time[-1] - time[last]), 0.25 * 5e5 * 2, 1e-3, f"{name}: power of friction mu p v")
            close((depth[-1] - depth[last]) / (time[-1] - time[last]), k * 5e5 * 2, 1e-3, f"{name}: rate of wear k p v")
            close(rise[-1], 2 * 0.25 * 5e5 * 2 * np.sqrt((time[-1] - 2.5e-5) / np.pi) / EFFUSIVITY, 2e-3, f"{name}: rise of temperature")
            found = mesoslip.wear.coupling(run, depth, rise, expansion=5e-6, modulus=30e9)
            length = 4e-3 if name == "layer" else (4e-3 * 2e-3) ** 0.5
            mean = 5e5 * (1 - 2.5e-5 / 4e-4)  # over the run with its ramp
            close(found.wear, k * mean * 2 * 4e-4 * 30e9 / (mean * length), 3e-3, f"{name}: wear over compliance")
            close(found.temperature, 30e9 * 5e-6 * float(np.max(rise)) / mean, 3e-3, f"{name}: thermal stress over pressure")


def main():
    check_half_space()
    with tempfile.TemporaryDirectory() as path:
        check_runs(Folder(path))


if __name__ == "__main__":
    main()
