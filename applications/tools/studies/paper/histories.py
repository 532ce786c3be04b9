"""Histories: figures 6, 7, 12 and 13."""

import numpy as np

from cases import P1, P2, PUSHED
from measures import frequency, mu
from page import fixed, relative
from report.base.figures import BLACK, BLUE, ORANGE, above, above_all, lettered, panels
from report.runs import paper_values as paper

PERIODS_SHOWN, PERIODS_AVERAGED = 6, 5


def regime_runs(cases):
    """Regime 1 at 0.5 MPa, regime 2 at 0.4 MPa."""
    return [cases.homogeneous(PUSHED, P1), cases.homogeneous(PUSHED, P2)]


REGIME_LABELS = ("regime 1 (0.5 MPa)", "regime 2 (0.4 MPa)")


def regimes(fragment, runs, names):
    found = [runs[name] for name in names]
    rows = []
    for number, run in zip((1, 2), found):
        ours, reference = run.number("mean_apparent_friction_coefficient"), paper.MEAN_APPARENT_FRICTION[number]
        rows.append((f"mean of mu_app, regime {number}", fixed(reference), fixed(ours), relative(ours, reference)))
    fragment.table(["", "paper", "ours", "difference [%]"], rows)
    fragment.text("The mean of mu_app differs from mu_inter because instants of small normal force have the same weight as all others.")
    fragment.figure(_apparent(found, REGIME_LABELS, (BLUE, ORANGE)), "Apparent friction coefficient in both regimes",
                    "(a) Transient, (b) last periods, (c) means over five periods (pale: over the steady part). Figures 12 and 13 have the same panels.")


def _apparent(found, labels, colours):
    """Three panels: the start, the last periods, and means over a few periods."""
    figure, (start, last, means) = panels(3, 7.6)
    for run, label, colour in zip(found, labels, colours):
        time, friction = run.need("/history/time", "/history/apparent_friction")
        period = 1 / (frequency(run) or paper.MAIN_FREQUENCY[1])
        shown = time < paper.STEADY_FROM
        start.plot(1e3 * time[shown], friction[shown], color=colour, lw=1)
        shown = time > time[-1] - PERIODS_SHOWN * period
        last.plot(1e6 * (time[shown] - time[shown][0]), friction[shown], color=colour, lw=1.2)
        means.plot(*_averaged(time, friction, PERIODS_AVERAGED * period), color=colour, lw=1.2)
        mean, begin = run.number("mean_apparent_friction_coefficient"), run.steady_from()
        means.plot([1e3 * begin, 1e3 * time[-1]], [mean, mean], color=colour, lw=3.5, alpha=0.35, solid_capstyle="butt")
        start.plot([], [], color=colour, lw=2, label=f"{label}: mean {mean:.3f}")
    start.set_xlabel("time (ms)")
    last.set_xlabel("time (µs)")
    means.set_xlabel("time (ms)")
    last.set_title("last periods", loc="left")
    means.set_title(f"means over {PERIODS_AVERAGED} periods", loc="left")
    for axes in (start, last, means):
        axes.set_ylabel(r"$\mu_\mathrm{app}$")
        axes.margins(x=0)
    start.set_title("transient", loc="left")
    lettered((start, last, means))
    above_all(figure, start.get_legend_handles_labels()[0], columns=1)
    return figure


def _averaged(time, values, width):
    """Running means over `width` (s), time in ms."""
    n = min(len(values), max(1, int(round(width / (time[1] - time[0])))))
    sums = np.concatenate([[0.0], np.cumsum(values)])
    means = (sums[n:] - sums[:-n]) / n
    stride = max(1, len(means) // 3000)
    return 1e3 * time[n // 2: n // 2 + len(means): stride], means[::stride]


def energy(fragment, runs, names):
    found = [runs[name] for name in names]
    fragment.text("Energies are divided by pressure and contact length. mu_inter is the slope (least squares over whole periods of the steady part), divided by V.")
    figure, (axes,) = panels(1, 3.6)
    end = 0.0
    for run, label, colour in zip(found, REGIME_LABELS, (BLUE, ORANGE)):
        time, friction = run.need("/history/time", "/history/friction_energy")
        x = run.need("/contact/x")
        scale = run.number("pressure") * (x[-1] - x[0])
        axes.plot(1e3 * time, 1e6 * friction / scale, color=colour, lw=2, label=f"{label}: {mu(run):.3f}")
        end = max(end, time[-1])
    mu_local, speed = found[0].number("friction_coefficient"), found[0].number("flat_velocity")
    axes.plot([0, 1e3 * end], [0, 1e6 * mu_local * speed * end], color=BLACK, lw=1.2, ls="--", label="EPS: 0.250")
    axes.set(xlabel="time (ms)", ylabel=r"$E_\mathrm{friction}/(P\,S)$ (µm)")
    axes.margins(x=0)
    above(axes, columns=1)
    fragment.figure(figure, "Dissipated frictional energy", "EPS: all nodes slide at constant speed under uniform pressure.")


def by_phase_runs(mu_homo, deltas, cases):
    return [cases.heterogeneous(PUSHED, P1, 1, by_phase=True),
            *[cases.homogeneous(PUSHED, P1, delta, mu_homo) for delta in deltas]]


def by_phase(fragment, runs, names):
    found = [runs[name] for name in names]
    labels = [r"heterogeneous 1, $\mu$ = 0.3 and 0.12, $\delta$ = 1500 ns"]
    labels += [rf"homogeneous, $\mu$ = {run.number('friction_coefficient'):g}, $\delta$ = {1e9 * run.number('regularization_time'):.0f} ns" for run in found[1:]]
    fragment.figure(_apparent(found, labels, (BLACK, BLUE, ORANGE)), "Apparent friction coefficient")
