"""Section on the modes of steady sliding that a run vibrates in: the modal assurance criterion, and which of them feed the vibration."""

import os
import sys

import numpy as np

from report.base.data import Missing
from report.base.figures import BLUE, GREY, ORANGE, RUN_COLOURS, WIDTH, above_all, plt
from report.base.page import escape, number, quantity

WINDOWS = 12  # of the instability index, where snapshots allow as many
PERIODS = 5  # in a window, at least
LIKE = 0.5  # assurance from which a mode is said to have the shape of the vibration


class Opened:
    """A run of the report as the functions of mesoslip.participation read result files."""

    def __init__(self, run):
        self.run, self.path = run, run.name

    def __contains__(self, name):
        return self.run.get("/" + name) is not None

    def __getitem__(self, name):
        return self.run.get("/" + name)

    def snapshots(self):
        for k, time in enumerate(self["snapshots/time"]):
            yield time, self.run.get("/snapshots/displacement", k)


def pairs(chain):
    """(run, complex modes) with the same nodes: snapshots of at least ten periods, two in each, and the shapes of two modes."""
    found = []
    for run in chain.transient:
        time, frequency = run.get("/snapshots/time"), run.number("main_frequency")
        if time is None or not frequency or len(time) < 3:
            continue
        periods = (time[-1] - time[0]) * frequency
        if periods < 10 or len(time) < 2 * periods:
            continue
        shape = run.file["snapshots/displacement"].shape[1:]
        found += [(run, modes) for modes in chain.complex
                  if "shape_real" in modes.members("/complex_modes") and modes.file["complex_modes/shape_real"].shape[1:] == shape
                  and len(modes.file["complex_modes/shape_real"]) > 1]
    return found


def vibrating_modes(page, run, modes):
    """Assurance of the modes at the main frequency of the run, and their instability index over time."""
    tools = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python")
    if tools not in sys.path:
        sys.path.append(tools)
    from mesoslip.participation import assurance, instability_index, participation

    motion, shapes, frequency = Opened(run), Opened(modes), run.number("main_frequency")
    time = motion["snapshots/time"]
    window = max((time[-1] - time[0]) / WINDOWS, PERIODS / frequency)
    try:
        alike = np.asarray(assurance(motion, shapes, frequency))
        found = participation(motion, shapes, window * (1 - 1e-6))
        index = np.asarray(instability_index(found, shapes))
    except ValueError as error:
        raise Missing(str(error)) from error
    frequencies, growth = (np.asarray(shapes[f"complex_modes/{name}"])[:len(alike)] for name in ("frequency", "growth_rate"))
    best = int(np.argmax(alike))
    verdict = (f"The vibration has the shape of the mode at {quantity(frequencies[best], 'Hz')}, which grows with {number(growth[best])} 1/s."
               if alike[best] >= LIKE else "No mode has the shape of the vibration: nodes that stick or leave the flat have made another one of it.")
    low, high = (100 * bound(np.asarray(found.explained)) for bound in (np.nanmin, np.nanmax))
    return page.figure(figure(alike, frequencies, growth, found.time, index, frequency),
                       f"Modes of steady sliding (run {escape(modes.name)}) in the snapshots of the {escape(run.label)} run. Left: modal assurance criterion of each mode at the main "
                       f"frequency of the run, {quantity(frequency, 'Hz')} (dashed); 1 means the same shape. {verdict} Right: instability index of the modes that "
                       f"feed or brake the vibration most, growth rate times share of the kinetic energy, in windows of {quantity(window, 's')}. The modes together "
                       f"account for {number(low)} to {number(high)} % of the motion about its mean.")


def figure(alike, frequencies, growth, time, index, main_frequency, shown=4):
    result, (left, right) = plt.subplots(1, 2, figsize=(WIDTH, 3.6))
    for grows, colour, label in ((True, ORANGE, "grows"), (False, BLUE, "decays")):
        chosen = (growth > 0) == grows
        if chosen.any():
            left.vlines(1e-3 * frequencies[chosen], 0, alike[chosen], color=colour, lw=1.5)
            left.plot(1e-3 * frequencies[chosen], alike[chosen], "o", color=colour, ms=4, label=label)
    left.axvline(1e-3 * main_frequency, color=GREY, lw=0.8, ls="--")
    left.set(xlabel="frequency of the mode (kHz)", ylabel="modal assurance criterion", ylim=(0, 1.05), xlim=(0, None))
    if (growth > 0).any() and (growth <= 0).any():
        left.legend()
    largest = np.argsort(-np.nanmax(np.abs(index), axis=0))[:shown]
    lines = [right.plot(1e3 * np.asarray(time), index[:, k], ".-", color=colour, label=f"{1e-3 * frequencies[k]:.1f} kHz")[0]
             for k, colour in zip(sorted(largest, key=lambda k: frequencies[k]), RUN_COLOURS * shown)]
    right.axhline(0, color=GREY, lw=0.8)
    right.set(xlabel="time (ms)", ylabel="instability index (1/s)")
    above_all(result, lines, title="right: frequency of the mode")
    return result
