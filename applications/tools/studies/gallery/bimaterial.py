"""The picture of bimaterial.prm: slip velocity along the contact over time, between bodies that differ and between equal ones."""

import os

import h5py
import numpy as np

from report.base.figures import plt

DIFFERENT, EQUAL = "different bodies", "equal bodies"
CHANGES = ((DIFFERENT, {}), (EQUAL, {"Counter body/Stiffness": "3.6e9, 1.2e9, 3.6e9, 1.2e9"}))
BEGIN, PLACE, SPEED = 92.0, 65.0, 0.9932  # of the pulse (us, mm); of generalized Rayleigh waves (mm/us)
WINDOW = 82.0, 138.0  # us


def draw(folder, path):
    """Draws the runs of CHANGES in `folder`."""
    figure, axes = plt.subplots(1, 2, figsize=(6.4, 3.4), sharey=True)
    for axis, (name, _), title in zip(axes, CHANGES, ("(a) the body above is slower", "(b) equal bodies")):
        with h5py.File(os.path.join(folder, name, "dynamics.h5")) as file:
            time, slip = 1e6 * file["contact_map/time"][()], np.abs(file["contact_map/slip_velocity"][()])
        shown = (time > WINDOW[0]) & (time < WINDOW[1])
        x = np.linspace(0, 80, slip.shape[1])
        image = axis.pcolormesh(x, time[shown], slip[shown], cmap="magma_r", vmin=0, vmax=0.25, shading="nearest", rasterized=True)
        axis.set(xlabel="x (mm)", xlim=(5, 80))
        axis.set_title(title, loc="left")
        axis.grid(False)
    axes[0].set_ylabel("time (µs)")
    late = np.array([112.0, WINDOW[1]])
    axes[0].plot(PLACE - SPEED * (late - BEGIN) - 3.0, late, color="0.4", lw=1, ls=(0, (4, 3)))
    axes[0].annotate("generalized\nRayleigh speed", (PLACE - SPEED * (124 - BEGIN) - 3.0, 124), xytext=(7, 103), fontsize=9, arrowprops={"arrowstyle": "-", "color": "0.4", "lw": 0.7})
    figure.colorbar(image, ax=axes, label="slip velocity (m/s)", extend="max", shrink=0.9)
    figure.savefig(path)
    plt.close(figure)
