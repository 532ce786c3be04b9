"""What the paper leaves open about the loading: which starts come to which regime."""

import numpy as np

import paper_values as paper
from cases import P1, P2, PUSHED, TENFOLD
from figures import BLUE, GREEN, GREY, ORANGE, above, panels, plt
from measures import frequency, height, mu_text, relative_velocity, separation, slip, within
from page import fixed

PUSHES = (0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1, 2)  # m/s
LONG, LONG_END = (0, 0.5, 1), 1e-2  # followed for longer (s)
COLOURS = dict(zip(LONG, (GREY, BLUE, ORANGE)))

COLUMNS = (("0.5 MPa, homogeneous", PUSHED, P1, False), ("0.5 MPa, heterogeneous 1", PUSHED, P1, True),
           ("0.4 MPa, homogeneous", PUSHED, P2, False), ("0.4 MPa, heterogeneous 1", PUSHED, P2, True),
           ("5 MPa from rest, homogeneous", TENFOLD, P1, False))


def regime_runs(cases):
    columns = [cases.heterogeneous(reading, pressure) if composite else cases.homogeneous(reading, pressure)
               for _, reading, pressure, composite in COLUMNS]
    return columns, {v: cases.coarse(v, end=LONG_END if v in LONG else 3e-3) for v in PUSHES}


def regimes(fragment, runs, names):
    columns, pushes = names
    fragment.text(
        "The paper does not say how the motion starts, and that decides. As long as no node sticks or turns back, the motion scales with the pressure "
        "(P and V count by P/V alone), so that 0.5 and 0.4 MPa could not give two regimes to pins that start alike but for P. A pin that is pushed along x at "
        "the start is another matter: the push over the pressure counts. Below, the printed 0.5 MPa and pushes from 0 to 2 m/s.")
    _plateaus(fragment, {v: runs[name] for v, name in pushes.items()})
    fragment.text(
        f"So the reading of this page is: **pressures as printed, pressure and flat act at once, and the pin starts with {PUSHED.start:g} m/s along x**, "
        "the one number that is ours. It lies where 0.5 MPa leads to regime 1 and 0.4 MPa, for which the push counts 5/4, to regime 2. The regimes "
        "themselves do not depend on it: they are the plateaus of the figure. The paper's two pressures then differ for the reason that its "
        "heterogeneous models do: which cycle a start falls to. Without a push a third cycle is reached, of small amplitude.")
    _table(fragment, [runs[name] for name in columns])
    fragment.reading(
        "Rigid platen on top, 560 x 160 cells of 0.1 mm (figures above: 0.2 mm), μ = 0.25, δ = 1500 ns, V = 2 m/s, β = 4.4 ns, β₂ = 1/2, 95 % of the critical time step, "
        f"{1e3 * PUSHED.end:g} ms of which the last {1e3 * (PUSHED.end - PUSHED.steady_from):g} ms count. The last column is another reading, ten times the printed pressure from rest.")
    fragment.text("Maps over pressure, velocity, δ and start: [regimes](regimes.md); how δ can be predicted: [prediction](prediction.md).")


def _table(fragment, found):
    both = lambda table, scale=1.0, digits=2: " / ".join(fixed(scale * table[n], digits) for n in (1, 2))
    percent = lambda value: fixed(100 * value, 0) + " %"
    fragment.table(["", "paper, regime 1 / 2", *[label for label, *_ in COLUMNS]], [
        ["mu_inter", both(paper.INTERFACE_FRICTION), *[mu_text(run) for run in found]],
        ["main frequency in kHz", both(paper.MAIN_FREQUENCY, 1e-3, 1), *[fixed(frequency(run) / 1e3, 1) for run in found]],
        ["node M slips", f"{percent(paper.SLIP[1])} / {percent(paper.SLIP[2])}", *[percent(slip(run)) for run in found]],
        ["node M is separated", f"{percent(1 - paper.SLIP[1])} / {percent(1 - paper.SLIP[2])}",
         *[percent(separation(run)) for run in found]],
        ["it leaves the flat by, µm (largest of a period)", f"{fixed(1e6 * paper.SEPARATION, 1)} / -", *[fixed(1e6 * height(run), 2) for run in found]],
        ["flat relative to M, m/s", "{} to {} / -".format(*paper.RELATIVE_VELOCITY),
         *["{:.2f} to {:.2f}".format(*relative_velocity(run)) for run in found]]])


def _plateaus(fragment, found):
    pushes = np.array(sorted(found))
    end = min(run.number("simulated_time") for run in found.values())
    seen = {v: within(found[v], end / 3, end) for v in pushes}
    figure, axes = plt.subplots(1, 3, figsize=(10.4, 3.1))
    for axis, quantity, table, label, scale in (
            (axes[0], "slip", paper.SLIP, "M slips, %", 100), (axes[1], "mu", paper.INTERFACE_FRICTION, r"$\mu_\mathrm{inter}$", 1),
            (axes[2], "frequency", paper.MAIN_FREQUENCY, "main frequency in kHz", 1e-3)):
        axis.plot(pushes, [scale * seen[v][quantity] for v in pushes], "o-", color=GREEN, ms=5)
        for n, colour in ((1, BLUE), (2, ORANGE)):
            axis.axhline(scale * table[n], color=colour, lw=1.2, ls="--", label=f"paper, regime {n}")
        axis.set(xlabel="push in m/s", ylabel=label)
    above(axes[0], columns=2)
    fragment.figure(figure, f"Homogeneous pin, P = 0.5 MPa, against the velocity with which it starts; from {1e3 * end / 3:.0f} to {1e3 * end:.0f} ms.", "-pushes")
    figure, (axes,) = panels(1, 3.0)
    shares = {v: _separated(found[v], 2.5e-4) for v in LONG}
    for v, (time, share) in shares.items():
        axes.plot(1e3 * time, 100 * share, color=COLOURS[v], label=f"{v:g} m/s")
    for n, colour in ((1, BLUE), (2, ORANGE)):
        axes.axhline(100 * (1 - paper.SLIP[n]), color=colour, lw=1.2, ls="--", label=f"paper, regime {n}")
    axes.set(xlabel="time in ms", ylabel="M separated, %", ylim=(0, 100))
    axes.margins(x=0)
    above(axes, columns=3)
    fragment.figure(figure, "Share of time in which node M is separated, in the long run. " + _end_of_regime_2(*shares[max(LONG)]), "-long")


def _end_of_regime_2(time, share):
    high = np.flatnonzero(share > 0.5)
    if len(high) and high[-1] + 1 < len(time):
        left = time[high[-1]]
        return (f"Regime 2 is left for regime 1 after {1e3 * left:.1f} ms, {left * paper.MAIN_FREQUENCY[2]:.0f} periods; the other cycles last.")
    return "No cycle is left."


def _separated(run, width):
    """Time (s) and share of separation of the middle node, over blocks of `width` (s)."""
    time, separated = run.need("/contact/blocks/time", "/contact/blocks/separated")
    n = max(1, int(round(width / (time[1] - time[0]))))
    whole = len(time) // n * n
    return time[:whole].reshape(-1, n).mean(axis=1), separated[:whole, separated.shape[1] // 2].reshape(-1, n).mean(axis=1)
