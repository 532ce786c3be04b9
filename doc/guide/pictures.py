#!/usr/bin/env python3
"""Draws the pictures of doc/guide.md and doc/guide/squeal.md from runs of their examples.

    /usr/bin/python3 doc/guide/pictures.py build/applications

Runs prm/examples/micrograph, complex_modes.prm and squeal.prm in a folder of their own, which takes a minute.
"""

import os
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
TOOLS = os.path.join(TOP, "applications", "tools")
EXAMPLES = os.path.join(TOP, "prm", "examples")
sys.path[:0] = [os.path.join(TOOLS, "python"), os.path.join(TOOLS, "studies")]
import mesoslip
from report_pictures import report_figures, save

WIDTH, HEIGHT = 8, 4  # mm


def draw_body(axes, phases):
    """The phases as a body on the flat, with its loads."""
    axes.imshow(phases, cmap="gray", extent=(0, WIDTH, 0, HEIGHT), vmin=-0.6, vmax=1.2)
    axes.fill_between([-0.3, WIDTH + 0.3], -0.5, -0.05, facecolor="white", edgecolor="0.4", hatch="////", lw=0.5)
    axes.annotate("", (WIDTH / 2 + 1.2, -0.85), (WIDTH / 2 - 1.2, -0.85), arrowprops={"arrowstyle": "-|>", "color": "C3"})
    axes.text(WIDTH / 2 + 1.4, -0.85, "V", color="C3", va="center")
    axes.fill_between([0, WIDTH], HEIGHT + 0.02, HEIGHT + 0.2, color="0.4")
    for x in np.linspace(0.6, WIDTH - 0.6, 6):
        axes.annotate("", (x, HEIGHT + 0.22), (x, HEIGHT + 0.9), arrowprops={"arrowstyle": "-|>", "color": "C0"})
    axes.text(WIDTH / 2, HEIGHT + 0.95, "P", color="C0", ha="center", va="bottom")
    axes.set(xlim=(-0.3, WIDTH + 0.3), ylim=(-1.1, HEIGHT + 1.5))
    axes.axis("off")


def picture_body_stress(results):
    """A grey picture, the body that it becomes, and the stress in its phases."""
    folder = os.path.join(EXAMPLES, "micrograph")
    figure, axes = plt.subplots(1, 3, figsize=(11, 2.7), gridspec_kw={"width_ratios": [1, 1.05, 1]}, layout="constrained")
    box = (0, WIDTH, 0, HEIGHT)
    axes[0].imshow(np.asarray(Image.open(os.path.join(folder, "micrograph.png"))), cmap="gray", extent=box)
    draw_body(axes[1], np.asarray(Image.open(os.path.join(folder, "phases.png"))) > 127)
    with mesoslip.open(os.path.join(results, "40-stress_localization")) as run:
        stress = run["mean_von_mises"].to("MPa")
    image = axes[2].imshow(stress, origin="lower", extent=box, vmin=0, vmax=np.quantile(stress, 0.995))
    figure.colorbar(image, ax=axes[2], label="von Mises stress in MPa", shrink=0.62, extend="max")
    for a, title in zip(axes, ("(a) micrograph", "(b) body on the flat", "(c) stress in its phases")):
        a.set_title(title, fontsize=10, loc="left")
    for a in (axes[0], axes[2]):
        a.set(xticks=range(0, 9, 2), yticks=range(0, 5, 2), xlabel="x in mm", ylabel="y in mm")
    figure.savefig(os.path.join(HERE, "picture_body_stress.png"), dpi=110)


def amplitude(time, force, frequency, window=2e-4):
    """Times and the amplitude of `force` at `frequency` in Hann windows [s] that overlap by half."""
    n = int(window / (time[1] - time[0]))
    weight, wave = np.hanning(n), np.exp(-2j * np.pi * frequency * time)
    starts = range(0, len(time) - n, n // 2)
    parts = [force[k:k + n] - force[k:k + n].mean() for k in starts]
    sums = [abs((weight * part * wave[k:k + n]).sum()) for k, part in zip(starts, parts)]
    return np.array([time[k + n // 2] for k in starts]), 2 * np.array(sums) / weight.sum()


def growth(modes, squeal):
    """The fastest mode in the force of the transient run, and its exponential; returns the fitted rate in 1/s."""
    with mesoslip.open(squeal) as run:
        time, force = (np.asarray(run.history[name]) for name in ("time", "contact_tangential_force"))
    mode = modes["complex_modes"][0]
    times, size = amplitude(time, force, mode["frequency"])
    straight = (times > 0.8e-3) & (times < 1.5e-3)
    rate = np.polyfit(times[straight], np.log(size[straight]), 1)[0]
    figure, axes = plt.subplots(figsize=(6.5, 3), layout="constrained")
    axes.semilogy(1e3 * times, size, label=f"transient run, at {mode['frequency'] / 1e3:.1f} kHz")
    line = np.array([0.6e-3, 2.6e-3])
    start = np.exp(np.interp(1e-3, times, np.log(size)))
    axes.semilogy(1e3 * line, start * np.exp(mode["growth_rate"] * (line - 1e-3)), "--", color="C1",
                  label=f"mode: exp({mode['growth_rate']:.0f} t / s)")
    axes.set(xlabel="time in ms", ylabel="amplitude of the\ntangential force in N/m", xlim=(0, 8))
    axes.legend(frameon=False)
    figure.savefig(os.path.join(HERE, "squeal_growth.png"), dpi=110)
    return rate


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    programs = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        chain = os.path.join(folder, "micrograph")
        subprocess.run([sys.executable, os.path.join(TOOLS, "run_chain.py"), os.path.join(EXAMPLES, "micrograph"), "--programs", programs,
                        "--output", chain, "--no-report"], check=True)
        picture_body_stress(chain)
        pin = os.path.join(folder, "pin")
        for prm, name in (("complex_modes", "modes"), ("squeal", "squeal")):
            subprocess.run([os.path.join(programs, "contact_dynamics"), os.path.join(EXAMPLES, prm + ".prm"), "--output",
                            os.path.join(pin, name)], check=True)
        with mesoslip.open(os.path.join(pin, "modes")) as run:
            rate = growth(run.summary, os.path.join(pin, "squeal"))
        print(f"growth of the transient run: {rate:.0f} 1/s")
        figures = report_figures(pin)
        for beginning, name in (("Modes of steady sliding", "squeal_modes"), ("The last periods of the map", "squeal_map")):
            save(figures, beginning, os.path.join(HERE, name + ".png"))


if __name__ == "__main__":
    main()
