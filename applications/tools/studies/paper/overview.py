"""The picture at the top of README.md: morphology, localized stress, apparent friction and frictional energy."""

import os

import numpy as np

from cases import P1, P2, PUSHED, TOP
from figures import BLUE, ORANGE, above, plt
from stress_maps import STRESS_MAP

PICTURE = os.path.join("doc", "pin.png")
PERIODS = 8


def runs(cases):
    return [cases.rve(1), cases.localization(), cases.homogeneous(PUSHED, P1), cases.homogeneous(PUSHED, P2)]


def picture(fragment, results, names):
    morphology, localized, slipping, bouncing = (results[name] for name in names)
    figure = plt.figure(figsize=(11.4, 4.0))
    grid = figure.add_gridspec(2, 2, width_ratios=[1.25, 1])
    fibres, stress, friction, energy = (figure.add_subplot(grid[i % 2, i // 2]) for i in range(4))
    extent = morphology.extent()
    fibres.imshow(morphology.need("/phase/id"), origin="lower", extent=extent, cmap="Greys", vmin=0, vmax=1.0, interpolation="antialiased")
    fibres.set_title("fibres in the matrix", loc="left")
    field = localized.need("/mean_von_mises") / 1e6
    shown = stress.imshow(field, origin="lower", extent=extent, cmap=STRESS_MAP, vmin=0, vmax=np.percentile(field, 99.5))
    stress.set_title("localized von Mises stress, mean over time", loc="left")
    figure.colorbar(shown, ax=[fibres, stress], pad=0.02, aspect=24, extend="max").set_label("von Mises stress (MPa)")
    for axis in (fibres, stress):
        axis.set(ylabel="y (mm)", yticks=(0, 8, 16))
        axis.grid(False)
    stress.set_xlabel("x (mm)")
    for run, label, colour in ((bouncing, "regime 2", ORANGE), (slipping, "regime 1", BLUE)):
        time, ratio, dissipated = run.need("/history/time", "/history/apparent_friction", "/history/friction_energy")
        last = time > time[-1] - PERIODS / slipping.number("main_frequency")
        friction.plot(1e6 * (time[last] - time[last][0]), ratio[last], color=colour, lw=1.3, label=label)
        x = run.need("/contact/x")
        energy.plot(1e3 * time, 1e6 * dissipated / (run.number("pressure") * (x[-1] - x[0])), color=colour, lw=1.6)
    friction.set(xlabel="time (µs)", ylabel=r"$\mu_\mathrm{app}$")
    energy.set(xlabel="time (ms)", ylabel=r"$E_\mathrm{friction}/(P\,S)$ (µm)")
    for axis in (friction, energy):
        axis.margins(x=0)
    above(friction, columns=2)
    figure.savefig(os.path.join(TOP, PICTURE), dpi=100, pil_kwargs={"optimize": True})
    plt.close(figure)
    fragment.text(f"![Morphology, localized stress and apparent friction of the pin](../{os.path.basename(PICTURE)})")
