#!/usr/bin/env python3
"""Draws the pictures of doc/composites.md from runs.

    /usr/bin/python3 doc/composites/pictures.py build/applications

Runs volume_size.py on prm/examples/voxels/curing.prm and prm/examples/squeal.prm in a folder of their own, which takes some minutes.
"""

import os
import shutil
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
TOOLS = os.path.join(TOP, "applications", "tools")
EXAMPLES = os.path.join(TOP, "prm", "examples")
sys.path[:0] = [TOOLS, os.path.join(TOOLS, "python")]
import mesoslip
from report.base.figures import BLUE, GREY, ORANGE, plt

THICKNESS, YOUNG, POISSON, DENSITY = np.array([0.1, 0.9]), np.array([240e9, 30e9]), 0.2, 1770.0  # shares of a period


def slower(frequency, period):
    """1 - c / c0 of P waves across layers, NaN beyond the first stop band."""
    thickness = THICKNESS * period
    speed = np.sqrt(YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON)) / DENSITY)
    times, r = thickness / speed, speed[0] / speed[1]
    s, omega = (r + 1 / r) / 2, 2 * np.pi * frequency
    a, b = omega * times[0], omega * times[1]
    cosine = np.cos(a) * np.cos(b) - s * np.sin(a) * np.sin(b)
    travel = np.sqrt((times**2).sum() + 2 * s * times.prod())
    first = np.cumsum(np.abs(cosine) >= 1) == 0
    return np.where(first, 1 - omega * travel / np.arccos(np.where(first, cosine, 0)), np.nan)


def picture_dispersion(run):
    """The spectrum of the normal force, and below it the dispersion of layers over the same frequencies."""
    history = run.history
    time, force = np.asarray(history["time"]), np.asarray(history["contact_normal_force"])
    late = time > time[-1] / 2
    signal = (force[late] - force[late].mean()) * np.hanning(late.sum())
    frequency = np.fft.rfftfreq(late.sum(), time[1] - time[0])
    amplitude = np.abs(np.fft.rfft(signal)) * 4 / late.sum() / force[late].mean()
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(7.2, 5.4), sharex=True, layout="constrained")
    top.semilogy(frequency / 1e3, amplitude, color=BLUE, lw=0.9)
    top.set(ylabel="amplitude over mean force", ylim=(1e-6, 2), title="Spectrum of the normal force of the pin that squeals")
    grid = np.linspace(1e3, 1e6, 4000)
    for period, colour in ((1e-3, BLUE), (4e-3, ORANGE), (10e-3, GREY)):
        bottom.semilogy(grid / 1e3, slower(grid, period), color=colour, label=f"period {1e3 * period:g} mm")
    bottom.set(xlabel="frequency (kHz)", ylabel="1 - c / c$_0$", xlim=(0, 1000), ylim=(1e-7, 1), title="How much slower P waves are across layers; lines end where a stop band begins")
    bottom.legend(loc="lower right")
    figure.savefig(os.path.join(HERE, "dispersion.png"), dpi=110)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    programs = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([os.path.join(programs, "contact_dynamics"), os.path.join(EXAMPLES, "squeal.prm"), "--output", os.path.join(folder, "squeal"), "--quiet"], check=True)
        with mesoslip.open(os.path.join(folder, "squeal")) as run:
            picture_dispersion(run)
        subprocess.run([sys.executable, os.path.join(TOOLS, "volume_size.py"), os.path.join(EXAMPLES, "voxels", "curing.prm"), "--sizes", "1,1.5,2", "--members",
                        "24,12,6", "--programs", programs, "--output", os.path.join(folder, "size")], check=True)
        table = os.path.join(folder, "epoxy.csv")
        with open(table, "w", encoding="utf-8") as file:
            file.write("frequency,modulus,loss_factor\n1,2.6e9,0.015\n100,2.9e9,0.025\n1e4,3.4e9,0.04\n1e6,4.2e9,0.03\n")
        subprocess.run([sys.executable, os.path.join(TOOLS, "complex_moduli.py"), os.path.join(EXAMPLES, "voxels", "curing.prm"), "--phase", f"epoxy={table}",
                        "--frequencies", "1,10,100,1e3,1e4,1e5,1e6", "--programs", programs, "--output", os.path.join(folder, "moduli")], check=True)
        shutil.copyfile(os.path.join(folder, "moduli", "complex_moduli.png"), os.path.join(HERE, "complex_moduli.png"))
        shutil.copyfile(os.path.join(folder, "size", "volume_size.png"), os.path.join(HERE, "volume_size.png"))


if __name__ == "__main__":
    main()
