"""A block on springs pulled over the flat, with friction that falls with the slip velocity: it vibrates where the
dashpot beside the springs takes less than friction feeds, z < -p dmu/dV. This border, and growth and decay on both
sides of it, by the formula, by the complex modes, and in runs; of a plane block, and of a box on two ranks.

A rigid block of the mass m for the area, that of the body and that on the springs, grows at -(z + p dmu/dV)/(2 m)
along the motion and at -(z + p mu/V)/(2 m) across it. What is elastic moves the border by the order of k H/G, here
0.6 %. A periodic box is a column in shear: with f = p dmu/dV or p mu/V, q = s/(c r), Z = rho c r, r^2 = 1 + beta s

    u = cosh(q y) + f/Z sinh(q y),     s Z (sinh(q H) + f/Z cosh(q H)) + (k + z s + M s^2) u(H) = 0

so that the border is 0.05 % higher, by the share (w H/c)^2: the node on the flat moves more than the top. In runs the
step, (w dt)^2 = 1e-5, and the velocity of the vibration, a thousandth of V, change rates by less than 1e-5.

Friction that falls with the slip, from mu_s to mu_k over a critical one: stick and slip of the block of the tribometer
of prm/examples. It sticks while the flat takes the spring from (2 mu_k - mu_s) p to mu_s p, 2 (mu_s - mu_k) p/(k V),
and slides while it swings about mu_k p from the speed of the flat to this speed. The shorter the critical slip, the
sooner it lets go."""

import math
import os
import tempfile

import h5py
import numpy as np
from scipy.optimize import least_squares

from scenes import TOP, Folder, prm, sets

HEIGHT, DENSITY, SHEAR, BETA = 1e-3, 1770.0, 13.785e9, 1e-8
MASS, OMEGA = 20.0, 2e4 * math.pi  # kg/m^2 on the springs, 1/s
WHOLE = MASS + DENSITY * HEIGHT
SPRING, NORMAL_DASHPOT = WHOLE * OMEGA**2, 1e7  # Pa/m; Pa s/m, ends what the pressure starts along the normal
PRESSURE, VELOCITY, RATIOS = 1e5, 0.8, (0.6, 0.9, 1.1, 1.4)  # of the dashpot to that of the border
RAMP, WINDOW = 1e-4, (3e-4, 2e-3)  # s
STATIC, KINETIC, CRITICAL, VISCOUS = 0.35, 0.05, 1.0, 0.01
COMMON = {"Body/Density": DENSITY, "Time/Rayleigh beta": BETA, "Supports/Top/Kind": "springs",
          "Supports/Top/Mass": MASS, "Supports/Top/Pressure": PRESSURE, "Friction/Law": "coulomb",
          "Friction/Coefficient": STATIC, "Friction/Kinetic coefficient": KINETIC,
          "Friction/Critical velocity": CRITICAL}
PLANE = {"Friction/Coefficient law": "Stribeck", "Friction/Stribeck exponent": 2,
         "Friction/Viscous coefficient": VISCOUS, "Body/Stiffness": f"36.54e9, 9.1e9, 47.26e9, {SHEAR}",
         "Body/Size": f"{6 * HEIGHT}, {HEIGHT}", "Body/Cells": "12, 3"}
BOX = {"Friction/Coefficient law": "static and kinetic", "Sides/Periodic": "true", "Sides/Periodic in y": "true",
       "Body/Stiffness": f"36.54e9, 9e9, 9.1e9, 36.54e9, 9.1e9, 47.26e9, {SHEAR}, {SHEAR}, 12e9",
       "Body/Size": f"{HEIGHT}, {HEIGHT}, {HEIGHT}", "Body/Cells": "2, 2, 3"}
MODES = {"Analysis": "complex modes", "Complex modes/Highest frequency": OMEGA / 4, "Complex modes/Fastest decay": 2e3}
RUN = {"Time/End time": WINDOW[1], "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": RAMP,
       "Observation/Energy interval": 0, "Observation/History interval": 4}


def words(values):
    return ", ".join(repr(float(value)) for value in values)


class Block:
    """Plane with free sides, below which the flat moves; or a periodic box that the far end of its springs pulls over
    a flat at rest, at an angle to its sides. Rates (1/s) are those along the motion and, of a box, across it."""

    def __init__(self, folder, dim, ranks):
        self.folder, self.dim, self.ranks = folder, dim, ranks
        self.axes = np.array([[1.0]] if dim == 2 else [[0.6, 0.8], [-0.8, 0.6]])  # along the motion, across it
        n, viscous = (2, VISCOUS) if dim == 2 else (1, 0)
        falling = (STATIC - KINETIC) * math.exp(-((VELOCITY / CRITICAL) ** n))
        self.friction = PRESSURE * (KINETIC + falling + viscous * VELOCITY)  # Pa
        slope = PRESSURE * (viscous - falling * n / CRITICAL * (VELOCITY / CRITICAL) ** (n - 1))
        self.border, self.drags = -slope, [slope, self.friction / VELOCITY][:dim - 1]  # Pa s/m

    def rigid(self, dashpot):
        return [-(dashpot + drag) / (2 * WHOLE) for drag in self.drags]

    def column(self, dashpot):
        """In closed form, by the secant method."""
        def top(s, drag):
            r = np.sqrt(1 + BETA * s)
            angle, impedance = s * HEIGHT / math.sqrt(SHEAR / DENSITY) / r, math.sqrt(SHEAR * DENSITY) * r
            a, b = np.cosh(angle), np.sinh(angle)
            return s * (impedance * b + drag * a) + (SPRING + dashpot * s + MASS * s * s) * (a + drag / impedance * b)

        found = []
        for drag in self.drags:
            before, s = 1j * OMEGA, 1.0001j * OMEGA
            while abs(s - before) > 1e-13 * OMEGA:
                before, s = s, s - top(s, drag) * (s - before) / (top(s, drag) - top(before, drag))
            found.append(s.real)
        return found

    def made(self, name, dashpot, keys):
        self.folder.write(name + ".prm", f"set Dimension = {self.dim}\n" + prm({
            **COMMON, **(PLANE if self.dim == 2 else BOX), **keys,
            "Supports/Top/Spring stiffness": words([SPRING] * (self.dim - 1)),
            "Supports/Top/Dashpot": words([dashpot] * (self.dim - 1) + [NORMAL_DASHPOT])}))
        self.folder.run(0, "contact_dynamics", name + ".prm", "--output", name, ranks=self.ranks)
        return self.folder.summary(name)

    def modes(self, dashpot):
        summary = self.made("modes", dashpot, {**MODES, "Flat/Velocity": words(VELOCITY * self.axes[0])})
        found = sorted((mode["growth_rate"] for mode in summary["complex_modes"]), reverse=True)
        assert summary["missing_modes"] == 0 and summary["separated_nodes"] == 0 and len(found) == self.dim - 1, summary
        return found

    def run(self, dashpot):
        """Of displacement and friction of a node, in a run that begins with the springs stretched by a tenth less than
        friction wants, and by that tenth across the motion."""
        grown = f"if(t < {RAMP}, (1 - cos({math.pi / RAMP!r}*t))/2, 1)"
        stretch = self.friction / SPRING * (0.1 * self.axes.sum(0) - self.axes[0])
        if self.dim == 2:
            keys = {"Flat/Velocity": VELOCITY, "Supports/Top/Motion": f"{float(stretch[0])!r}*{grown}"}
        else:
            pull = -VELOCITY * self.axes[0]
            far_end = [f"{float(x)!r}*{grown} + {float(v)!r}*t" for x, v in zip(stretch, pull)]
            keys = {"Flat/Velocity": 0, "Body/Initial velocity": words([*pull, 0]),
                    "Supports/Top/Motion": "; ".join(far_end)}
        self.made("run", dashpot, {**RUN, **keys})
        with h5py.File(self.folder("run", "dynamics.h5")) as file:
            time, moved, traction = (file["reference"][name][()] for name in ("time", "displacement", "traction"))
            lost = file["history/sticking_nodes"][()] + file["history/separated_nodes"][()]
        seen = [self.axes @ values.T[:self.dim - 1] for values in (moved, traction)]
        if self.dim == 3:
            seen[0][0] += VELOCITY * time
        inside = time > WINDOW[0]
        assert len(lost) == len(time) and not lost[inside].any(), lost
        return [[growth(time[inside], line[inside], rest) for line in lines] for lines, rest in zip(seen, (1e-4, 0.02))]


def growth(time, values, rest):
    """Of a vibration about a mean; what else there is stays below `rest` of the deviation."""
    values = (values - values.mean()) / values.std()

    def left(s):
        wave = np.exp((s[0] + 1j * s[1]) * (time - time[0]))
        shapes = np.stack([np.ones_like(time), wave.real, wave.imag], 1)
        return shapes @ np.linalg.lstsq(shapes, values, rcond=None)[0] - values

    fit = least_squares(left, [0, OMEGA], x_scale=[100, 100], xtol=1e-12, ftol=1e-12, gtol=1e-12)
    assert np.abs(fit.fun).max() < rest, np.abs(fit.fun).max()
    return fit.x[0]


def check(folder, dim, ranks):
    block = Block(folder, dim, ranks)
    dashpots = [ratio * block.border for ratio in RATIOS]
    rates = {name: np.array([way(z) for z in dashpots]) for name, way in
             {"rigid": block.rigid, "column": block.column, "modes": block.modes, "run": block.run}.items()}
    displacement, friction = np.swapaxes(rates.pop("run"), 0, 1)
    rates |= {"displacement": displacement, "friction": friction}
    if dim == 2:
        del rates["column"]
    borders = {name: np.polyval(np.polyfit(found[:, 0], dashpots, 2), 0) for name, found in rates.items()}
    for name, found in rates.items():
        print(f"{dim}D, {name}: " + ", ".join(f"{rate:.3f}" for rate in found.T.ravel())
              + f" 1/s; border {borders[name]:.2f} Pa s/m, {borders[name] / block.border - 1:+.3%}")
    size = block.border / (2 * WHOLE)  # the growth without a dashpot
    for name, found in rates.items():
        assert found[1, 0] > 0 > found[2, 0] and abs(borders[name] / block.border - 1) < 0.002, (name, borders)
        assert np.abs(found - rates["rigid"]).max() < 0.002 * size, (name, found, rates["rigid"])
        close = {"rigid": 0.002, "friction": 1e-3}.get(name, 1e-5)
        assert np.abs(found - rates["modes"]).max() < close * size, (name, found, rates["modes"])


def check_stick_time(folder):
    """Of a periodic block, all of whose nodes stick and slide at once, on a softer spring than that of the example."""
    spring, pressure, velocity, fall = 1e9, 1e6, 0.05, 0.3 - 0.2
    omega = math.sqrt(spring / (50 + DENSITY * 4e-3))
    stick = 2 * fall * pressure / (spring * velocity)
    slide = 2 / omega * (math.pi - math.atan(fall * pressure * omega / (spring * velocity)))
    errors = []
    for critical in (1e-6, 1e-7, 1e-8):
        folder.run(0, "contact_dynamics", os.path.join(TOP, "prm", "examples", "tribometer.prm"), "--output", "tribometer", *sets({
            "Sides/Periodic": "true", "Body/Cells": "4, 2", "Supports/Top/Spring stiffness": spring, "Friction/Critical slip": critical,
            "Time/Rayleigh beta": 2e-6, "Time/End time": 0.025, "Observation/Energy interval": 0, "Observation/History interval": 10}))
        with h5py.File(folder("tribometer", "dynamics.h5")) as file:
            time, sticking = (file["history"][name][()] for name in ("time", "sticking_nodes"))
        assert set(sticking) == {0, 4}, sticking
        begins, ends = (time[1:][np.diff(sticking) == change] for change in (4, -4))
        begins, ends = begins[1:], ends[1:]  # the first time from no stretch on
        times = [(ends - begins[:len(ends)]).mean(), (begins[1:] - ends[:len(begins) - 1]).mean()]
        errors.append([found / due - 1 for found, due in zip(times, (stick, slide))])
        print(f"critical slip {critical:g} m: {len(ends)} times, sticks {1e3 * times[0]:.4f} ({1e3 * stick:.4f}) ms, "
              f"slides {1e3 * times[1]:.4f} ({1e3 * slide:.4f}) ms")
    errors = np.array(errors)
    assert np.all(errors[1:] < 0.5 * errors[:-1]) and np.all(np.abs(errors[-1]) < [0.003, 0.012]), errors


def main():
    with tempfile.TemporaryDirectory() as path:
        check(Folder(path + "/plane"), 2, 1)
        check(Folder(path + "/box"), 3, 2)
        check_stick_time(Folder(path))


if __name__ == "__main__":
    main()
