"""When a rupture arrives along a fault: two equal half-spaces with the material, stresses and slip weakening of SCEC's benchmark TPV3 as a plane problem, in which friction falls
within 2 km at once, against a spectral boundary integral code written apart (mode II, Geubelle and Rice 1995), extrapolated from two meshes.

tau = tau_0 - G V/(2 c_s) + f, f_q = -(G |q|/2) int C_II(|q| c_s t') D_q(t - t') |q| c_s dt', in the Fourier transform of the slip D along the fault; bodies whose far sides
absorb waves do not see that the fault of the code repeats itself."""

import tempfile

import h5py
import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.special import j0, j1

from interface_pulse import sheared
from scenes import Folder, prm

DENSITY, FAST, SLOW = 2670.0, 6000.0, 3464.0  # kg/m^3, m/s
SHEAR = DENSITY * SLOW**2
PRESSURE, TRACTION, STATIC, KINETIC, WEAK, CRITICAL_SLIP = 120e6, 70e6, 0.677, 0.525, 0.53, 0.4
LENGTH, HEIGHT, RISE, BEGIN, END = 60e3, 15e3, 20, 54, 60
PLACES = np.array([4e3, 5e3, 6e3, 8e3, 10e3, 12e3])  # from the middle (m)


def kernel(T):
    k = FAST / SLOW
    grid = np.linspace(0, k * T.max() + 1, 1000000)
    integral = cumulative_trapezoid(np.where(grid > 0, j1(grid) / np.maximum(grid, 1e-300), 0.5), grid, initial=0)
    W = lambda x: 1 - np.interp(x, grid, integral)
    return j1(T) / T + 4 * T * (W(k * T) - W(T)) - 4 / k * j0(k * T) + 3 * j0(T)


def of_code(n, pressure, traction):
    """Times at PLACES, in the middle of time steps, of a fault of @p n points."""
    h = LENGTH / n
    dt = 0.3 * h / SLOW
    steps, x = int((END - BEGIN) / dt), (np.arange(n) - n // 2) * h
    q = 2 * np.pi * np.fft.rfftfreq(n, h)
    C = np.zeros((len(q), steps))
    C[1:] = kernel(np.outer(q[1:], SLOW * dt * (np.arange(steps) + 0.5))) * (q[1:] * SLOW * dt)[:, None]
    peak = WEAK + (STATIC - WEAK) * np.clip((abs(x) - 1500) / 1000, 0, 1)
    slip, history, arrival = np.zeros(n), np.zeros((len(q), steps), complex), np.full(n, np.inf)
    for m in range(steps):
        history[:, m] = np.fft.rfft(slip)
        f = np.fft.irfft(-SHEAR / 2 * q * (C[:, m::-1] * history[:, :m + 1]).sum(axis=1), n)
        rate = 2 * SLOW / SHEAR * np.maximum(0, traction + f - pressure * (peak - (peak - KINETIC) * np.minimum(slip / CRITICAL_SLIP, 1)))
        arrival[(rate > 1e-3) & np.isinf(arrival)] = (m + 0.5) * dt
        slip = slip + dt * rate
    right = x >= 0
    return np.interp(PLACES, x[right], arrival[right])


def of_bodies(folder, cells):
    """Times at PLACES to both sides, and the pressure and traction of the middle before the rupture."""
    peak = f"{WEAK} + {STATIC - WEAK}*min(max((abs(x-{LENGTH / 2})-1500)/1000, 0), 1)"
    peak = f"if(t<{BEGIN}, {STATIC}, {peak})"
    bodies = [sheared(section, DENSITY * FAST**2, SHEAR, DENSITY, (LENGTH, HEIGHT), PRESSURE, TRACTION, RISE) for section in ("Body", "Counter body")]
    folder.write("rupture.prm", prm({
        **bodies[0], **bodies[1], "Body/Cells": f"{cells}, {cells // 4}", "Counter body/Cells": f"{cells}, {cells // 4}",
        "Flat/Velocity": 0, "Time/End time": END, "Friction/Law": "coulomb", "Friction/Coefficient law": "expression", "Observation/Steady from": BEGIN,
        # Ends that are dragged before they are pressed do not slip.
        "Friction/Coefficient expression": f"if(t<{BEGIN - 4}, 5, {peak} - ({peak}-{KINETIC})*min(D/{CRITICAL_SLIP}, 1))",
        "Contact map/Interval": 0.01, "Contact map/From": BEGIN - 0.1}))
    folder.run(0, "contact_dynamics", "rupture.prm", "--output", "rupture", "--quiet")
    with h5py.File(folder("rupture", "dynamics.h5")) as file:
        time, slips = file["contact_map/time"][()] - BEGIN, np.abs(file["contact_map/slip_velocity"][()]) > 1e-3
        before = [file[f"contact_map/{name}"][0][[cells // 2 - cells // 6, cells // 2, cells // 2 + cells // 6]] for name in ("pressure", "traction")]
    assert not slips[time < 0].any() and all(np.ptp(values) < 1e-3 * np.abs(values).max() for values in before), before
    arrival, x = time[slips.argmax(axis=0)] - 0.5 * (time[1] - time[0]), np.linspace(-LENGTH / 2, LENGTH / 2, cells + 1)
    right = x >= 0
    return [np.interp(PLACES, x[right], times[right]) for times in (arrival, arrival[::-1])], [abs(values[1]) for values in before]


def main():
    with tempfile.TemporaryDirectory() as path:
        for cells, allowed in ((300, 0.012), (600, 0.006)):
            (right, left), (pressure, traction) = of_bodies(Folder(path), cells)
            coarse, fine = (of_code(n, pressure, traction) for n in (400, 800))
            wanted = 2 * fine - coarse
            errors = np.abs(right / wanted - 1)
            print(f"{cells} cells, {1e-6 * pressure:.2f} and {1e-6 * traction:.2f} MPa: arrival after {np.round(right, 3)} s, of the code {np.round(wanted, 3)} s, within {errors.max():.2%}")
            assert np.isfinite(wanted).all() and errors.max() < allowed and np.abs(right - left).max() < 0.02, (right, left, wanted)


if __name__ == "__main__":
    main()
