"""Eq. (10) and figure 8."""

import os

import h5py
import numpy as np

from cases import PUSHED, RVE_SEEDS
from measures import frequency
from page import fixed, relative
from report.base.figures import BLACK, BLUE, GREY, ORANGE, above, lettered, panels, plt
from report.runs import paper_values as paper

ENTRIES = {"D11": (0, 0), "D12": (0, 1), "D22": (1, 1), "D33": (2, 2)}
CONDITIONS = ("KUBC", "SUBC")
SCALE = 10  # mm, drawn under a body


def stiffness_runs(cases):
    return [cases.rve(seed) for seed in RVE_SEEDS]


def stiffness(fragment, runs, names):
    tensors = {c: np.array([runs[name].summary["stiffness"][c] for name in names]) for c in CONDITIONS}
    values = {entry: {c: tensors[c][:, i, j] for c in CONDITIONS} for entry, (i, j) in ENTRIES.items()}
    rows, largest = [], 0.0
    for entry, reference in paper.STIFFNESS.items():
        everything = np.concatenate(list(values[entry].values()))
        deviation = everything.std(ddof=1) / everything.mean()
        largest = max(largest, deviation)
        rows.append([f"{entry} [GPa]", fixed(reference / 1e9), fixed(everything.mean() / 1e9),
                     relative(everything.mean(), reference),
                     *[f"{values[entry][c].mean() / 1e9:.3f}" for c in CONDITIONS], f"{100 * deviation:.1f}"])
    covered = [runs[name].summary["phases"][1]["volume_fraction"] for name in names]
    fragment.table(["", "paper", "ours", "difference [%]", "KUBC", "SUBC", "deviation [%]"], rows)
    fragment.text(
        f"Ours: mean over KUBC, SUBC and {len(names)} morphologies with fibres [placed independently](reading.md#placement-of-the-fibres), which cover "
        f"{100 * min(covered):.1f} to {100 * max(covered):.1f} % of the area. Deviation: standard deviation over both conditions and all morphologies, at most "
        f"{100 * largest:.1f} % (paper: {100 * paper.STIFFNESS_DEVIATION:.1f} %).")
    figure, axes = panels(1, 2.9)
    for k, c in enumerate(CONDITIONS):
        for i, entry in enumerate(ENTRIES):
            shown = 100 * (values[entry][c] / paper.STIFFNESS[entry] - 1)
            axes[0].plot(i + 0.16 * (k - 0.5) + np.zeros(len(shown)), shown, "o", ms=5, alpha=0.75,
                         color=(ORANGE, BLUE)[k], label=c if i == 0 else None)
    axes[0].axhline(0, color=GREY, lw=1.2, ls="--", label="eq. (10)")
    axes[0].set(xticks=range(len(ENTRIES)), ylabel="difference (%)")
    axes[0].set_xticklabels([f"$D_{{{entry[1:]}}}$" for entry in ENTRIES])
    above(axes[0])
    fragment.figure(figure, "Entries of the stiffness by morphology, relative to eq. (10)")


def modes_runs(cases):
    return [cases.modes(), cases.modes(seed=1), cases.modes("pressure"), cases.homogeneous(PUSHED)]


def modes(fragment, runs, names):
    homogeneous, heterogeneous, free_top, contact = (runs[name] for name in names)
    first = lambda run, bottom: run.summary["frequencies"][bottom][0]
    rows = []
    for bottom, label in (("free", "BC1: bottom free"), ("held", "BC2: bottom held in y")):
        reference, ours = paper.MODES[bottom], first(homogeneous, bottom)
        rows.append([label, f"{reference:.0f}", f"{ours:.0f}", relative(ours, reference),
                     f"{first(heterogeneous, bottom):.0f}", f"{first(free_top, bottom):.0f}"])
    fragment.table(["first mode [Hz]", "paper", "ours, eq. (10)", "difference [%]", "heterogeneous (1)",
                    "eq. (10), top free in y"], rows)
    fragment.text(
        "The top is a rigid platen. The last column takes the paper's text literally (u_x = 0, free in y) and misses the paper's frequencies. "
        f"In regime 1 the contact vibrates at {frequency(contact):.0f} Hz, close to BC2.")
    figure, axes = plt.subplots(2, 2, figsize=(9.0, 4.2))
    for row, (run, label) in enumerate([(homogeneous, "homogeneous"), (heterogeneous, "heterogeneous")]):
        with h5py.File(os.path.join(run.folder, "modal.h5")) as file:
            spacing = np.broadcast_to(file["grid"].attrs["spacing"], (2,))
            for column, (bottom, condition) in enumerate([("free", "BC1"), ("held", "BC2")]):
                _shape(axes[row, column], file[f"modes/{bottom}/shape"][0], spacing)
                axes[row, column].set_title(f"{condition}, {label}: {first(run, bottom):.0f} Hz", loc="left")
    axes[0, 0].plot([0, SCALE], [-2.5, -2.5], color=BLACK, lw=2.5, solid_capstyle="butt", clip_on=False)
    axes[0, 0].text(SCALE + 1, -2.5, f"{SCALE} mm", va="center")
    lettered(axes.flat)
    fragment.figure(figure, "First modes", "Grey: undeformed outline.")


def _shape(axes, shape, spacing, every=20, scale=2.0):
    """Deformed grid lines; mm."""
    ny, nx = np.array(shape.shape[:2]) - 1
    x, y = np.meshgrid(1e3 * spacing[0] * np.arange(nx + 1), 1e3 * spacing[1] * np.arange(ny + 1))
    shape = shape * np.sign(shape[0, nx // 2, 0] or 1.0)
    dx, dy = x + scale * shape[..., 0], y + scale * shape[..., 1]
    for j in range(0, ny + 1, every):
        axes.plot(dx[j], dy[j], color=BLUE, lw=0.7)
    for i in range(0, nx + 1, every):
        axes.plot(dx[:, i], dy[:, i], color=BLUE, lw=0.7)
    right, top = x[0, -1], y[-1, 0]
    axes.plot([0, right, right, 0, 0], [0, 0, top, top, 0], color=GREY, lw=1)
    axes.set_aspect("equal")
    axes.axis("off")
