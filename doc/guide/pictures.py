#!/usr/bin/env python3
"""Draws the pictures of doc/guide.md, doc/guide/tomogram.md, doc/guide/squeal.md and doc/loads.md from runs of their examples.

    /usr/bin/python3 doc/guide/pictures.py build/applications

Runs prm/examples/micrograph, tomogram, squeal.prm, complex_modes.prm and loads.prm in a folder of their own, which takes some minutes.
Other pictures of examples are those of the gallery, which `./run.sh gallery` draws.
"""

import os
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
TOOLS = os.path.join(TOP, "applications", "tools")
EXAMPLES = os.path.join(TOP, "prm", "examples")
sys.path[:0] = [TOOLS, *(os.path.join(TOOLS, name) for name in ("python", "studies"))]
import mesoslip
from report.base.figures import BLUE, GREY, ORANGE, above, panels, plt
from report_pictures import report_figures, save

WIDTH, HEIGHT = 8, 4  # mm


def draw_body(axes, phases):
    """The phases as a body on the flat, with its loads."""
    axes.imshow(phases, cmap="gray", extent=(0, WIDTH, 0, HEIGHT), vmin=-0.6, vmax=1.2)
    axes.fill_between([-0.3, WIDTH + 0.3], -0.5, -0.05, facecolor="white", edgecolor=GREY, hatch="////", lw=0.5)
    axes.annotate("", (WIDTH / 2 + 1.2, -0.95), (WIDTH / 2 - 1.2, -0.95), arrowprops={"arrowstyle": "-|>", "color": ORANGE})
    axes.text(WIDTH / 2 + 1.4, -0.95, "V", color=ORANGE, va="center")
    axes.fill_between([0, WIDTH], HEIGHT + 0.02, HEIGHT + 0.2, color=GREY)
    for x in np.linspace(0.6, WIDTH - 0.6, 6):
        axes.annotate("", (x, HEIGHT + 0.22), (x, HEIGHT + 0.9), arrowprops={"arrowstyle": "-|>", "color": BLUE})
    axes.text(WIDTH / 2, HEIGHT + 0.95, "P", color=BLUE, ha="center", va="bottom")
    axes.set(xlim=(-0.3, WIDTH + 0.3), ylim=(-1.3, HEIGHT + 1.6))
    axes.axis("off")


def picture_body_stress(results):
    """A grey picture, the body that it becomes, and the stress in its phases."""
    folder = os.path.join(EXAMPLES, "micrograph")
    figure, axes = plt.subplot_mosaic("ab;cc", figsize=(7.2, 6.3), height_ratios=(1.3, 1.7))
    box = (0, WIDTH, 0, HEIGHT)
    axes["a"].imshow(np.asarray(Image.open(os.path.join(folder, "micrograph.png"))), cmap="gray", extent=box)
    draw_body(axes["b"], np.asarray(Image.open(os.path.join(folder, "phases.png"))) > 127)
    with mesoslip.open(os.path.join(results, "40-stress_localization")) as run:
        stress = run["mean_von_mises"].to("MPa")
    image = axes["c"].imshow(stress, origin="lower", extent=box, vmin=0, vmax=np.quantile(stress, 0.995))
    figure.colorbar(image, ax=axes["c"], label="von Mises stress (MPa)", extend="max")
    for name, title in (("a", "micrograph"), ("b", "body on the flat"), ("c", "stress in its phases")):
        axes[name].set_title(f"({name}) {title}", loc="left")
        axes[name].grid(False)
    for name in "ac":
        axes[name].set(xticks=range(0, 9, 2), yticks=range(0, 5, 2), xlabel="x (mm)", ylabel="y (mm)")
    figure.savefig(os.path.join(HERE, "picture_body_stress.png"))


def picture_tomogram(results):
    """The plane y = 0.625 mm of the body in the scan, of its phases and of the mean stress in them, localized and direct."""
    h, rim, row = 0.05, 6, 12  # mm a voxel, voxels cut off, voxel along y in the body
    grey = np.load(os.path.join(EXAMPLES, "tomogram", "tomogram.npy"))[:, rim + row]
    with mesoslip.open(os.path.join(results, "10-rve_homogenization")) as run:
        phases = np.asarray(run["phase/id"])[:, row]
    with mesoslip.open(os.path.join(results, "40-stress_localization")) as run:
        localized, direct = (run[name].to("MPa")[:, row] for name in ("mean_von_mises", "direct/mean_von_mises"))
    figure, axes = plt.subplot_mosaic("ab;cd", figsize=(7.2, 5.6))
    nz, nx = phases.shape
    whole, body = (-rim * h, (grey.shape[1] - rim) * h, -rim * h, (grey.shape[0] - rim) * h), (0, nx * h, 0, nz * h)
    axes["a"].imshow(grey, origin="lower", cmap="gray", extent=whole)
    axes["a"].add_patch(plt.Rectangle((0, 0), nx * h, nz * h, fill=False, color=ORANGE, lw=1.5))
    axes["b"].imshow(phases, origin="lower", cmap="gray", extent=body, vmin=-0.6, vmax=1.2)
    top = np.quantile(direct, 0.995)
    for name, stress in (("c", localized), ("d", direct)):
        image = axes[name].imshow(stress, origin="lower", extent=body, vmin=0, vmax=top)
    titles = {"a": "scan and what is cut out", "b": "phases", "c": "von Mises stress, localized", "d": "with every grain"}
    for name, title in titles.items():
        axes[name].set(xticks=range(0, 3), yticks=range(0, 2), xlabel="x (mm)", ylabel="z (mm)")
        axes[name].set_title(f"({name}) {title}", loc="left")
        axes[name].grid(False)
    figure.colorbar(image, ax=[axes["c"], axes["d"]], label="MPa", extend="max")
    figure.savefig(os.path.join(HERE, "tomogram.png"))


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
    figure, (axes,) = panels(1, 3.4)
    axes.semilogy(1e3 * times, size, color=BLUE, lw=1.8, label=f"transient run, at {mode['frequency'] / 1e3:.1f} kHz")
    line = np.array([0.6e-3, 2.6e-3])
    start = np.exp(np.interp(1e-3, times, np.log(size)))
    axes.semilogy(1e3 * line, start * np.exp(mode["growth_rate"] * (line - 1e-3)), "--", color=ORANGE, lw=1.8,
                  label=f"mode: exp({mode['growth_rate']:.0f} t / s)")
    axes.set(xlabel="time (ms)", ylabel="amplitude of the\ntangential force (N/m)", xlim=(0, 8))
    above(axes)
    figure.savefig(os.path.join(HERE, "squeal_growth.png"))
    return rate


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    programs = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        for name, draw in (("micrograph", picture_body_stress), ("tomogram", picture_tomogram)):
            chain = os.path.join(folder, name)
            subprocess.run([sys.executable, os.path.join(TOOLS, "run_chain.py"), os.path.join(EXAMPLES, name), "--programs", programs,
                            "--output", chain, "--no-report"], check=True)
            draw(chain)
        pin = os.path.join(folder, "pin")
        for prm, name in (("complex_modes", "modes"), ("squeal", "squeal")):
            subprocess.run([os.path.join(programs, "contact_dynamics"), os.path.join(EXAMPLES, prm + ".prm"), "--output",
                            os.path.join(pin, name)], check=True)
        with mesoslip.open(os.path.join(pin, "modes")) as run:
            rate = growth(run.summary, os.path.join(pin, "squeal"))
        print(f"growth of the transient run: {rate:.0f} 1/s")
        figures = report_figures(pin)
        save(figures, "The last periods of the map", os.path.join(HERE, "squeal_map.png"))
        loads = os.path.join(folder, "loads")
        subprocess.run([os.path.join(programs, "rve_homogenization"), os.path.join(EXAMPLES, "loads.prm"), "--output", loads], check=True)
        save(report_figures(loads), "How stresses of the cells are distributed in each phase under shear under pressure", os.path.join(TOP, "doc", "loads", "histograms.png"))


if __name__ == "__main__":
    main()
