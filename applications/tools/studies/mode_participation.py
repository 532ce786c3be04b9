"""Which of the modes of steady sliding runs of the paper's pin pick: amplitudes of the modes in their snapshots over time."""

import os
import subprocess
import sys

import numpy as np

from pages import plt, save_picture

sys.path += [os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", name) for name in ("", "python")]
import mesoslip  # noqa: E402
from mesoslip.participation import participation  # noqa: E402
from report.base.figures import BLACK, RUN_COLOURS, above_all, lettered  # noqa: E402

WINDOW = 1e-4  # s
# What is not set is the paper's pin by default.
RUN = {"Analysis": "transient", "Time/End time": 4e-3, "Snapshots/Interval": 1e-6, "Observation/Energy interval": 0}
STARTS = {"smooth": {"Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 2e-4}, "at-once": {}}
COLOURS = [*RUN_COLOURS, BLACK]  # of modes that grow, by frequency
TITLES = {"smooth": "pressure that grows within 0.2 ms", "at-once": "pressure at once"}


def transient(programs, folder, name, cells):
    """The folder of a finished run."""
    output = os.path.join(folder, name)
    if not os.path.exists(os.path.join(output, "summary.json")):
        prm = os.path.join(folder, name + ".prm")
        with open(prm, "w", encoding="utf-8") as file:
            file.write("set Analysis = transient\n")
        settings = {**RUN, **STARTS[name], "Body/Cells": cells}
        subprocess.run([os.path.join(programs, "contact_dynamics"), prm, "--output", output, "--quiet",
                        *(f"--set={key}={value}" for key, value in settings.items())], check=True)
    return output


def first_change(run, after):
    """When a node first sticks or leaves the flat (s), or None."""
    time, slipping = np.asarray(run["history/time"]), np.asarray(run["history/slipping_nodes"])
    changed = (time > after) & (slipping < slipping.max())
    return float(time[np.argmax(changed)]) if changed.any() else None


def draw(axes, found, modes, change):
    frequency, growth = (np.asarray(modes[f"complex_modes/{name}"]) for name in ("frequency", "growth_rate"))
    colours = iter(COLOURS)
    for k in np.argsort(frequency):
        grows = growth[k] > 0
        axes[0].semilogy(1e3 * found.time, 1e6 * found.amplitude[:, k], lw=1.6 if grows else 0.7, color=next(colours) if grows else "0.75",
                         zorder=3 if grows else 2, label=f"{1e-3 * frequency[k]:.1f} kHz" if grows else None)
    axes[1].plot(1e3 * found.time, found.explained, color="0.3")
    for axis in axes:
        if change is not None:
            axis.axvline(1e3 * change, color=BLACK, lw=1, ls=":")
    axes[1].set(xlabel="time (ms)", ylim=(0, 1.05))


def picture(programs, runs, modes_folder, cells, folder):
    """The name of the picture, and of each start {start: (when nodes first stick or leave the flat, growth rate of the fastest mode up to
    then, largest modes at the end [(Hz, m)], explained share at the end)}."""
    figure, axes = plt.subplots(2, len(STARTS), figsize=(8.2, 6.4), sharex=True, sharey="row",
                                gridspec_kw={"height_ratios": (3, 1)})
    facts = {}
    with mesoslip.open(modes_folder) as modes:
        for column, start in zip(axes.T, STARTS):
            with mesoslip.open(transient(programs, runs, start, cells)) as run:
                found = participation(run, modes, WINDOW)
                change = first_change(run, 3e-4) if start == "smooth" else None  # else from the beginning on
            draw(column, found, modes, change)
            column[0].set_title(TITLES[start], loc="left")
            facts[start] = (change, growth_before(found, change) if change else None, *at_the_end(found, modes))
    axes[0, 0].set(ylabel="amplitude (µm)", ylim=(1e-7, 20))
    axes[1, 0].set(ylabel="explained share")
    lettered(axes[0])
    above_all(figure, axes[0, 0].get_legend_handles_labels()[0], 6)
    return save_picture(figure, folder, "participation.png", 128, dpi=110), facts


def growth_before(found, change):
    """Growth rate (1/s) of the fastest mode from 0.3 ms to the change; NaN within three windows."""
    linear = (found.time > 3e-4) & (found.time + WINDOW / 2 < change)
    return float(np.polyfit(found.time[linear], np.log(found.amplitude[linear, 0]), 1)[0]) if linear.sum() > 3 else np.nan


def at_the_end(found, modes):
    """Frequency (Hz) and amplitude (m) of the two largest modes over the last millisecond, and the explained share there."""
    last = found.time > found.time[-1] - 1e-3
    amplitude = np.asarray(found.amplitude)[last].mean(axis=0)
    largest = np.argsort(amplitude)[:-3:-1]
    frequency = np.asarray(modes["complex_modes/frequency"])
    return [(float(frequency[k]), float(amplitude[k])) for k in largest], float(np.asarray(found.explained)[last].mean())
