#!/usr/bin/env python3
"""Redraws two figures of the report from a run: apparent friction over time, and what each contact node does.

    python3 redraw_friction.py results/30-contact_dynamics-heterogeneous friction.png
"""

import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import mesoslip


def draw(run, figure):
    top, bottom = figure.subplots(2, 1, sharex=True)
    history = run.history
    top.plot(history["time"].to("ms"), history["apparent_friction"], lw=0.6)
    top.axhline(run.summary["global_interface_friction_coefficient"], color="black", lw=1, ls="--", label="mu_inter")
    top.set_ylabel("apparent friction")
    top.legend(frameon=False)

    blocks = run.group("contact/blocks")
    edges = np.concatenate([[0.0], blocks["time"].to("ms")])
    x = run["contact/x"].to("mm")
    between = np.concatenate([[x[0]], 0.5 * (x[1:] + x[:-1]), [x[-1]]])
    image = bottom.pcolormesh(edges, between, blocks["slip"].T, vmin=0, vmax=1, cmap="viridis")
    bottom.set(xlabel="time (ms)", ylabel="x (mm)")
    figure.colorbar(image, ax=[top, bottom], label="share of time slipping")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    figure = plt.figure(figsize=(7, 5))
    with mesoslip.open(sys.argv[1]) as run:
        draw(run, figure)
    figure.savefig(sys.argv[2], dpi=120, bbox_inches="tight")


if __name__ == "__main__":
    main()
