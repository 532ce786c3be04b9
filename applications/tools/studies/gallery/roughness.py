"""The picture of roughness/hysteresis.prm: the pressure on a profile, and the loop of the force over the displacement of the flat."""

import os

import h5py
import numpy as np

from chain.inputs import settings
from report.base.figures import BLACK, BLUE, GREY, ORANGE, plt

FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), *[".."] * 4, "prm", "examples", "roughness", "hysteresis.prm")
BEGIN, AMPLITUDE, FREQUENCY = 4e-4, 1e-6, 5e3  # of the flat's swing (s, m, Hz)
PERIODS = 3  # shown, the last ones


def constants():
    """Pressure (Pa), coefficient, and the stiffness of tangential springs and sheared pin in series (Pa/m)."""
    given = dict(settings(FILE))
    height, shear = float(given["Size"].split(",")[1]), float(given["Stiffness"].split(",")[3])
    stiffness = 1 / (1 / float(given["Tangential stiffness"]) + height / shear)
    return float(given["Pressure"]), float(given["Coefficient"]), stiffness


def draw_pressure(axis, file):
    """The profile, and the pressure of the pin on it before the flat swings."""
    sample = np.searchsorted(file["contact_map/time"][:], BEGIN)
    x, pressure = 1e3 * file["contact/x"][:], file["contact_map/pressure"][sample]
    place, height = np.loadtxt(os.path.join(os.path.dirname(FILE), "profile.csv"), delimiter=",", skiprows=1, unpack=True)
    axis.plot(x, 1e-6 * pressure, color=BLUE)
    axis.set(xlabel="x (mm)", xlim=(0, x[-1]), ylim=(0, None))
    axis.set_ylabel("pressure (MPa)", color=BLUE)
    below = axis.twinx()
    below.spines["right"].set_visible(True)
    below.grid(False)
    below.plot(1e3 * place, 1e6 * height, color=GREY, lw=1.2, ls=(0, (4, 2)))
    below.set_ylabel("height of the flat (µm)", color=GREY)
    axis.set_title("(a) pressure on the profile (dashed)", loc="left")


def draw_loop(axis, file):
    """The tangential force for the area over the displacement of the flat, beside a rigid block on the springs in series."""
    pressure, coefficient, stiffness = constants()
    time, force = file["history/time"][:], file["history/contact_tangential_force"][:] / file["contact/area"][:].sum()
    last = time > time[-1] - PERIODS / FREQUENCY
    limit = coefficient * pressure
    stretch = 2 * limit / stiffness
    block = np.array([(0, -limit), (stretch, limit), (2 * AMPLITUDE, limit), (2 * AMPLITUDE - stretch, -limit), (0, -limit)])
    axis.plot(1e6 * block[:, 0], 1e-6 * block[:, 1], color=BLACK, lw=1, ls=(0, (4, 3)), label="block on springs in series")
    axis.plot(1e6 * AMPLITUDE * (1 - np.cos(2 * np.pi * FREQUENCY * (time[last] - BEGIN))), 1e-6 * force[last], color=ORANGE, label="run")
    axis.set(xlabel="displacement of the flat (µm)", ylabel="traction (MPa)", ylim=(-1.45, 1.95))
    axis.legend(loc="upper left")
    axis.set_title("(b) hysteresis", loc="left")


def draw(folder, path):
    """Draws the run in `folder`."""
    figure, axes = plt.subplots(2, 1, figsize=(6.4, 6.2))
    with h5py.File(os.path.join(folder, "hysteresis", "dynamics.h5")) as file:
        draw_pressure(axes[0], file)
        draw_loop(axes[1], file)
    figure.savefig(path)
    plt.close(figure)
