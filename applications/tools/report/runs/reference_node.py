"""Motion of the reference node of a run: its orbit, and the loop of friction and displacement."""

import collections

import numpy as np

from report.base.data import Missing
from report.base.figures import BLUE, LENGTHS, ORANGE, STRESSES, WIDTH, plt, scaled, zoom_window
from report.base.page import escape, number, quantity
from report.runs.contact_states import along_flat

Motion = collections.namedtuple("Motion", "time along normal velocity shear")
Motion.__doc__ = """Motion of the reference node: time (s), displacements along the motion of the flat and along the normal (m), velocity along the motion
(m/s), and friction on the body along the motion (Pa), each [samples]."""


def motion(run):
    """The Motion over the steady part."""
    time, u, v, traction = run.need(*(f"/reference/{name}" for name in ("time", "displacement", "velocity", "traction")))
    found = Motion(time, along_flat(run, u), u[:, -1], along_flat(run, v), along_flat(run, traction))
    steady = since(found, run.steady_from())
    if len(steady.time) < 8:
        raise Missing(f"/reference of {run.name} has fewer than 8 samples in the steady part")
    return steady


def since(found, begin):
    """The Motion from `begin` (s) on."""
    late = found.time >= begin
    return Motion(*(values[late] for values in found))


def phase(found, frequency):
    """By how many degrees the motion along the normal is ahead of the motion along the flat at the frequency (Hz), from -180 to 180, and the ratio of
    both amplitudes; Hann's window keeps what the record cuts off from leaking in."""
    wave = np.hanning(len(found.time)) * np.exp(-2j * np.pi * frequency * found.time)
    along, normal = (np.sum((values - values.mean()) * wave) for values in (found.along, found.normal))
    return float(np.degrees(np.angle(normal / along))), float(abs(normal) / abs(along))


def work_of_a_period(found, frequency):
    """J/m^2: what friction adds to the vibration of the node in a period, the area of the loop, mean over whole periods at the end of the record."""
    period = 1 / frequency
    count = int((found.time[-1] - found.time[0]) / period)
    if count < 1:
        raise Missing("the steady part is shorter than a period")
    last = since(found, found.time[-1] - count * period)
    return float(np.mean(last.shear * (last.velocity - last.velocity.mean())) * period)


def loops(page, run):
    """Orbit, and loop of friction over displacement, of the last periods."""
    frequency = run.number("main_frequency")
    if not frequency:
        raise Missing(f"{run.name} has no main frequency, so that there are no periods to draw")
    steady = motion(run)
    angle, ratio = phase(steady, frequency)
    work = work_of_a_period(steady, frequency)
    figure = loops_figure(since(steady, zoom_window(run, steady.time[-1])))
    feeds, ahead = "feeds" if work > 0 else "brakes", "ahead of" if angle > 0 else "behind"
    samples = 1 / (frequency * float(np.median(np.diff(steady.time))))
    coarse = f" There are {samples:.0f} samples in a period; with a smaller Observation/History interval corners become round." if samples < 40 else ""
    return page.figure(figure, f"Reference node of the {escape(run.label)} run over the last periods. Left: its displacement into the body over its displacement along the "
                       f"flat. At {quantity(frequency, 'Hz')} the normal motion has {number(ratio)} times the amplitude of the tangential motion and is {ahead} it "
                       f"by {number(abs(angle))}°. Right: friction on the body over displacement along the flat. The area of the loop is what friction adds to the "
                       f"vibration in a period: {quantity(abs(work), 'J/m²')} in the mean; friction {feeds} the vibration of this node.{coarse}")


def loops_figure(shown):
    length, unit = scaled(shown.along - shown.along.mean(), shown.normal - shown.normal.mean(), units=LENGTHS)
    stress, of_stress = scaled(shown.shear, units=STRESSES)
    figure, axes = plt.subplots(1, 2, figsize=(WIDTH, 3.3))
    for axis, values, label, colour in ((axes[0], shown.normal / length, f"displacement into the body ({unit})", BLUE),
                                        (axes[1], shown.shear / stress, f"friction on the body ({of_stress})", ORANGE)):
        axis.plot(shown.along / length, values, ".-", color=colour, lw=0.9, ms=3)
        axis.set(xlabel=f"displacement along\nthe flat ({unit})", ylabel=label)
    return figure
