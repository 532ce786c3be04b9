"""The picture of disc.prm: how pin and disc move in a limit cycle, and what discs of other thickness and material do to the squeal."""

import json
import os

import h5py
import numpy as np

from report.base.figures import BLACK, BLUE, GREEN, ORANGE, plt

STEEL, ALUMINIUM = (282.69e9, 121.15e9, 282.69e9, 80.77e9), (103.7e9, 51.1e9, 103.7e9, 26.3e9)
CELL = 0.4e-3  # m: height of the cells


def keys(stiffness, density, thickness):
    return {"Counter body/Stiffness": ", ".join(f"{number:g}" for number in stiffness), "Counter body/Density": density,
            "Counter body/Size": f"56e-3, {thickness:g}", "Counter body/Cells": f"140, {round(thickness / CELL)}"}


RIGID = "1000 times as stiff"
CHANGES = ((RIGID, keys([1e3 * number for number in STEEL], 7.8e6, 10e-3)),
           *((f"steel {1e3 * h:g} mm", keys(STEEL, 7800, h)) for h in (5e-3, 10e-3, 15e-3)),
           ("aluminium 10 mm", keys(ALUMINIUM, 2700, 10e-3)))
SHOWN = "steel 10 mm"


def motion(path, component):
    """Displacement along `component` in the last snapshot less its mean over the last ones, and the extent (mm)."""
    with h5py.File(path) as file:
        u = file["snapshots/displacement"][..., "xy".index(component)]
        grid = file["grid"].attrs
        low = np.asarray(grid["origin"])
        high = low + np.asarray(grid["spacing"]) * np.asarray(grid["cells"])
    return u[-1] - u.mean(axis=0), 1e3 * np.array([low[0], high[0], low[1], high[1]])


def draw_motion(axis, folder, run, component, title):
    """The vibration of both bodies of a run."""
    both = [motion(os.path.join(folder, run, name), component) for name in ("dynamics.h5", "counter_body.h5")]
    largest = 1e9 * max(np.abs(u).max() for u, _ in both)
    for u, extent in both:
        image = axis.imshow(1e9 * u, origin="lower", extent=extent, cmap="RdBu_r", vmin=-largest, vmax=largest, interpolation="bilinear", aspect="equal")
    axis.axhline(0, color=BLACK, lw=0.8)
    axis.set(xlabel="x (mm)", ylabel="y (mm)", ylim=(both[1][1][2], both[0][1][3]))
    axis.set_title(title, loc="left")
    axis.grid(False)
    plt.colorbar(image, ax=axis, label="nm", shrink=0.85)


def draw(folder, path):
    """Draws the runs of CHANGES in `folder`."""
    figure, (above, below) = plt.subplots(2, 1, figsize=(6.4, 5.6), height_ratios=[1.25, 1])
    draw_motion(above, folder, SHOWN, "y", "(a) vibration along y of the pin and a disc of steel, 10 mm")
    for number, (name, _) in enumerate(CHANGES):
        with open(os.path.join(folder, name, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
        squeals = summary["stick_fraction"] > 0 or summary["slip_fraction"] < 0.999
        mu = summary["global_interface_friction_coefficient"]
        colour = BLACK if name == RIGID else BLUE if name.startswith("steel") else ORANGE
        below.bar(number, mu, color=colour if squeals else GREEN, width=0.6)
        text = f"{1e-3 * summary['main_frequency']:.1f} kHz" if squeals else "quiet"
        below.text(number, mu + 0.008, text, ha="center", fontsize=9.5)
    below.axhline(0.25, color=BLACK, lw=0.8, ls=(0, (4, 3)))
    below.set_xticks(range(len(CHANGES)), [name.replace(" ", "\n", 1) if name != RIGID else "as good as\nrigid" for name, _ in CHANGES], fontsize=9.5)
    below.set(ylim=(0, 0.29), ylabel=r"$\mu_\mathrm{inter}$")
    below.set_title("(b) friction measured from outside, and frequency of the squeal", loc="left")
    figure.savefig(path)
    plt.close(figure)
