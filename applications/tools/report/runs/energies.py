"""Figures of energies: the frictional one of several runs, and the balance of one."""

import numpy as np

from report.base.data import Missing, thinned
from report.base.figures import BLACK, BLUE, BROWN, GREEN, GREY, ORANGE, PINK, SKY, VIOLET, YELLOW, above, panels, rescaled, scaled, style

SLOPE = {"color": BLACK, "lw": 2.4, "ls": (0, (1, 2.5)), "zorder": 5}  # dots on top of the curves
POWERS_OF_J = [(1e-9, "nJ"), (1e-6, "µJ"), (1e-3, "mJ"), (1.0, "J"), (1e3, "kJ")]


def units_of(run):
    """Of energies: J in three dimensions, J per metre of the thickness in two."""
    return [(factor, unit + run.per_thickness()) for factor, unit in POWERS_OF_J]


def friction_energy(runs):
    """Over the time that all runs have; (figure, end (s) of that time, None if no run is longer)."""
    series = [(run, run.get("/history/time"), run.get("/history/friction_energy")) for run in runs]
    series = [entry for entry in series if entry[1] is not None and entry[2] is not None
              and len(entry[1])]
    if not series:
        raise Missing("/history/friction_energy is in none of the dynamics files")
    figure, (axes,) = panels(1, 3.3)
    end = min(time[-1] for _, time, _ in series)
    longer = any(time[-1] > 1.001 * end for _, time, _ in series)
    factor, unit = scaled(*[energy[time <= 1.001 * end] for _, time, energy in series], units=units_of(series[0][0]))
    for run, time, energy in series:
        mu = run.number("global_interface_friction_coefficient")
        label = run.label + (rf", $\mu_\mathrm{{inter}}$ = {mu:.3f}" if mu is not None else "")
        axes.plot(*rescaled(*thinned(time, energy), 1e3, 1 / factor), **style(runs, run), label=label)
        begin = run.number("window_begin")
        steady = time >= (run.steady_from() if begin is None else begin)
        if steady.sum() > 2:
            slope, offset = np.polyfit(time[steady], energy[steady], 1)
            line = np.array([min(time[steady][0], end), end])
            axes.plot(1e3 * line, (slope * line + offset) / factor, **SLOPE)
    axes.plot([], [], **SLOPE, label="slope used")
    axes.set(xlabel="time (ms)", ylabel=rf"$E_\mathrm{{friction}}$ ({unit})")
    axes.margins(x=0)
    if longer:
        axes.set_xlim(0, 1e3 * end)
        axes.set_ylim(0, 1.05 * max(np.max(energy[time <= 1.001 * end], initial=0.0) for _, time, energy in series) / factor or 1)
    above(axes, columns=2)
    return figure, end if longer else None


ENERGIES = [("external_work", "external work", BLACK), ("friction", "friction", ORANGE),
            ("elastic", "elastic", BLUE), ("kinetic", "kinetic", PINK), ("damping", "damping", GREEN),
            ("scheme", "time scheme", GREY), ("impact", "impacts", YELLOW), ("contact", "springs of the contact", SKY),
            ("supports", "springs and masses of supports", VIOLET), ("dashpots", "dashpots", BROWN)]


NEGLIGIBLE, SMALL = 1e-4, 0.2  # of the largest term: not drawn; drawn on a scale of its own


def terms(run):
    """(label, values, colour) of the terms of the balance in three lists: large, small, and not drawn."""
    time = run.need("/energy/time")
    parts = [(label, run.get(f"/energy/{name}"), c) for name, label, c in ENERGIES]
    parts = [part for part in parts if part[1] is not None and len(part[1]) == len(time)]
    if not parts:
        raise Missing("/energy holds no energies of the length of /energy/time")
    sizes = [np.nanmax(np.abs(values)) for _, values, _ in parts]
    top = max(sizes) or 1.0
    pick = lambda low, high: [part for part, size in zip(parts, sizes) if low * top <= size < high * top]
    return pick(SMALL, np.inf), pick(NEGLIGIBLE, SMALL), pick(0, NEGLIGIBLE)


def energy_balance(run):
    """(figure, names of the terms that are not drawn)."""
    time = run.need("/energy/time")
    large, small, left_out = terms(run)
    residual = run.get("/energy/residual")
    scale, of = _residual_scale(run, len(time))
    figure, axes = panels(3 if small else 2, 6.6 if small else 5.0, sharex=True,
                          gridspec_kw={"height_ratios": [2.2, 1.6, 1] if small else [2.4, 1]})
    _energies(axes[0], time, large, "energy", units_of(run), run.title)
    if small:
        _energies(axes[1], time, small, "smaller terms", units_of(run))
    if residual is not None and len(residual) == len(time):
        x, y = thinned(time, np.abs(residual) / scale)
        axes[-1].semilogy(1e3 * x, np.where(y > 0, y, np.nan), color=GREY, lw=1)
        if np.nanmedian(y) > 0:
            axes[-1].set_ylim(bottom=1e-2 * np.nanmedian(y))
    axes[-1].set(xlabel="time (ms)", ylabel=f"|residual| /\n{of}")
    for axis in axes:
        axis.margins(x=0)
    figure.align_ylabels()
    return figure, [label for label, *_ in left_out]


ROWS_A_PERIOD = 8  # elastic and kinetic energy oscillate twice in a period


def note_on_sampling(run):
    """A sentence if the rows of energy.csv are too far apart for the vibration; else nothing."""
    frequency, time = run.number("main_frequency"), run.need("/energy/time")
    if not frequency or len(time) < 3:
        return ""
    rows = 1 / (frequency * float(np.median(np.diff(time))))
    return "" if rows >= ROWS_A_PERIOD else (
        f" Energies are recorded {rows:.1f} times in a period of the vibration: irregular oscillations or slow beats of the elastic and the kinetic energy "
        "come from that; a smaller Observation/Energy interval shows them as they are.")


def _residual_scale(run, count):
    """What the log and summary.json relate the residual to (J, in 2D J/m), and its name: frictional energy unless there is hardly any."""
    friction, kinetic, elastic = (run.get(f"/energy/{name}") for name in ("friction", "kinetic", "elastic"))
    if any(values is None or len(values) != count for values in (friction, kinetic, elastic)):
        return 1.0, "1 J" + run.per_thickness()
    body, work = np.nanmax(kinetic + elastic), abs(friction[-1])
    return (work, "frictional energy") if work > 1e-3 * body else (body or 1.0, "energy in the body")


def _energies(axes, time, parts, name, units, title=None):
    factor, unit = scaled(*[values for _, values, _ in parts], units=units)
    for label, values, c in parts:
        wide = {"lw": 3.2, "alpha": 0.45} if c == BLACK else {}  # the work of the flat, which friction covers else
        axes.plot(*rescaled(*thinned(time, values), 1e3, 1 / factor), color=c, label=label, **wide)
    axes.set_ylabel(f"{name}\n({unit})")
    above(axes, columns=4, title=title)
