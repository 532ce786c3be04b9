"""The picture of damping_layer: modes of steady sliding with equal damping of both phases and with a layer that damps more."""

import os

import numpy as np

from report.base.figures import BLACK, BLUE, ORANGE, plt

RUNS = (("20-contact_dynamics-equal", "equal damping in pin and layer", ORANGE, "o"), ("30-contact_dynamics-lossy", "lossy layer", BLUE, "s"))


def draw(folder, path):
    """Draws the runs in `folder`."""
    figure, axis = plt.subplots(figsize=(6.4, 3.8))
    axis.axhline(0, color=BLACK, lw=0.9)
    for run, label, colour, marker in RUNS:
        modes = np.genfromtxt(os.path.join(folder, run, "complex_modes.csv"), delimiter=",", names=True, deletechars="")
        frequency, growth = (modes[modes.dtype.names[column]] for column in (1, 2))
        axis.plot(1e-3 * frequency, 1e-3 * growth, marker, ms=6.5, mfc="none", mew=1.6, ls="", color=colour, label=label)
    axis.annotate("grow", (5, 1.2), fontsize=10)
    axis.annotate("decay", (5, -2.6), fontsize=10)
    axis.set(xlabel="frequency (kHz)", ylabel="growth rate (1000 1/s)", xlim=(0, 132))
    axis.legend(loc="lower left")
    figure.savefig(path)
    plt.close(figure)
