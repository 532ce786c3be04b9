"""A pulse of slip between half spaces (Weertman 1980, Andrews and Ben-Zion 1997): two bodies of equal density, the lower one 1.2 times as fast, whose far sides absorb waves,
are sheared 1.3 % below the limit of friction; where friction falls for a moment a pulse begins, which runs by itself where the slower body slips to, with the generalized
Rayleigh speed, to which it comes the nearer the closer to the limit the load is (2 % of it at 3 %, 0.5 % at 1.3 %). With the bodies exchanged it runs the other way, and between equal bodies weaker ones run to both sides, as mirror images."""

import tempfile

import h5py
import numpy as np

from half_spaces import root
from scenes import Folder, prm

DENSITY, SHEAR, RATIO = 1180.0, 1.2e9, 1.2
PRESSURE, TRACTION, RISE, BEGIN = 5e6, 1.48e6, 3e-5, 9e-5
LENGTH, HEIGHT, START = 64e-3, 12.8e-3, 52e-3  # of the bodies; where the pulse begins, from the side that it leaves (m)
LAW = {"Friction/Law": "coulomb", "Friction/Coefficient law": "expression", "Friction/Normal stress": "constant time", "Friction/Normal stress time": 5e-7}


def sheared(section, modulus, shear, density, size, pressure, traction, rise):
    """A body or counter body of these constants in its plane whose far sides absorb waves, and press it so that it keeps its width; they drag the upper body to the left, the
    lower one to the right, and rise in the time @p rise."""
    lower = section == "Counter body"
    smooth = f"if(t<{rise}, 1-cos(pi*t/{rise}), 2)*{traction / 2}"
    keys = {f"{section}/Stiffness": f"{modulus}, {modulus - 2 * shear}, {modulus}, {shear}", f"{section}/Density": density, f"{section}/Size": "{}, {}".format(*size)}
    tractions = {"Bottom" if lower else "Top": f"{'' if lower else '-'}{smooth}; 0", "Left": f"0; {smooth}", "Right": f"0; -{smooth}"}
    for side, of_side in tractions.items():
        keys |= {f"{'Counter body/' if lower else ''}Supports/{side}/{key}": value for key, value in {
            "Kind": "absorbing", "Pressure": pressure if side in ("Top", "Bottom") else pressure * (1 - 2 * shear / modulus), "Ramp": "smooth", "Ramp time": rise,
            "Traction": of_side}.items()}
    return keys


def slip_velocity(folder, cells, speeds, start):
    """Of each contact node over time, of bodies with shear waves this much faster; the pulse begins at @p start."""
    bodies = [sheared(section, 3 * shear, shear, DENSITY, (LENGTH, HEIGHT), PRESSURE, TRACTION, RISE)
              for section, shear in (("Body", SHEAR * speeds[0]**2), ("Counter body", SHEAR * speeds[1]**2))]
    keys = {**bodies[0], **bodies[1], **LAW, "Flat/Velocity": 0,
            "Body/Cells": f"{cells}, {cells // 5}", "Counter body/Cells": f"{cells}, {cells // 5}", "Time/End time": BEGIN + 4e-5, "Time/Rayleigh beta": 5e-9, "Counter body/Rayleigh beta": 5e-9,
            "Friction/Coefficient expression": f"if(abs(x-{start})<1.45e-3 && t>{BEGIN} && t<{BEGIN + 4e-6}, 0.05, 0.3)", "Observation/Steady from": BEGIN,
            "Contact map/Interval": 4e-7}
    folder.write("pulse.prm", prm(keys))
    folder.run(0, "contact_dynamics", "pulse.prm", "--output", "pulse", "--quiet")
    with h5py.File(folder("pulse", "dynamics.h5")) as file:
        return file["contact_map/time"][()], np.linspace(0, LENGTH, cells + 1), np.abs(file["contact_map/slip_velocity"][()])


def way(folder, cells, speeds, start):
    """Speed of the pulse while it runs by itself, of the mean place of the squared slip velocity around its peak, and the peak at the end."""
    time, x, slip = slip_velocity(folder, cells, speeds, start)
    alone = (time > BEGIN + 1.2e-5) & (time < BEGIN + 3.6e-5)
    near = np.abs(x - x[slip.argmax(axis=1)][:, None]) < 3e-3
    place = (x * slip**2 * near).sum(axis=1)[alone] / (slip**2 * near).sum(axis=1)[alone]
    return np.polyfit(time[alone], place, 1)[0], slip[alone][-1].max()


def main():
    shear_speed = np.sqrt(SHEAR / DENSITY)
    rayleigh = root(RATIO, 0.0, 0.985j).imag * shear_speed
    with tempfile.TemporaryDirectory() as path:
        folder, errors = Folder(path), []
        for cells in (256, 512):
            speed, largest = way(folder, cells, (1.0, RATIO), START)
            errors.append(-speed / rayleigh - 1)
            print(f"{cells} cells: {speed:.1f} m/s, generalized Rayleigh speed {rayleigh:.1f} m/s, {errors[-1]:.2%}, {largest:.3f} m/s of slip")
        assert abs(errors[1]) < 0.01 and abs(errors[1]) < abs(errors[0]), errors
        speed, _ = way(folder, 512, (RATIO, 1.0), LENGTH - START)
        print(f"exchanged: {speed:.1f} m/s")
        assert abs(speed / rayleigh - 1) < 0.01, speed
        time, _, slip = slip_velocity(folder, 256, (1.0, 1.0), LENGTH / 2)
        print(f"equal: {slip[time > BEGIN + 3.2e-5].max():.3f} m/s of slip at the end")
        assert np.abs(slip - slip[:, ::-1]).max() < 1e-6 * slip.max() and slip[time > BEGIN + 3.2e-5].max() < 0.7 * largest, slip.max()


if __name__ == "__main__":
    main()
