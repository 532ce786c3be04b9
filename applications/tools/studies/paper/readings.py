"""What the paper leaves open about the loading: which starts come to which regime."""

import numpy as np

from cases import P1, P2, PUSHED
from measures import frequency, height, mu_text, relative_velocity, slip, within
from page import fixed
from report.base.figures import BLACK, BLUE, GREEN, GREY, ORANGE, above, above_all, lettered, panels, plt
from report.runs import paper_values as paper

PUSHES = {P1: (0, 0.1, 0.2, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.7, 0.8, 0.9, 1, 1.5, 2),  # m/s
          P2: (0, 0.2, 0.3, 0.35, 0.4, 0.45, 0.5, 0.6, 0.7, 0.8, 1, 1.5)}
ALIKE = {1: (0.65, 0.75), 2: (0.15, 0.25)}  # shares of slip of M that count as the paper's 70 and 20 %
LONG, LONG_END = (0, 0.5, 1), 1e-2  # followed for longer (s)
COLOURS = dict(zip(LONG, (GREY, BLUE, ORANGE)))

COLUMNS = (("0.5 MPa, homogeneous", PUSHED, P1, False), ("0.5 MPa, heterogeneous 1", PUSHED, P1, True),
           ("0.4 MPa, homogeneous", PUSHED, P2, False), ("0.4 MPa, heterogeneous 1", PUSHED, P2, True))


def regime_runs(cases):
    columns = [cases.heterogeneous(reading, pressure) if composite else cases.homogeneous(reading, pressure)
               for _, reading, pressure, composite in COLUMNS]
    return columns, {(pressure, v): cases.coarse(v, pressure, end=LONG_END if pressure == P1 and v in LONG else 3e-3)
                     for pressure, pushes in PUSHES.items() for v in pushes}


def regimes(fragment, runs, names):
    columns, pushes = names
    fragment.text(
        "The ratio of push to pressure decides the regime ([why](reading.md#pressure-and-start)). Here **the pressures are the printed "
        f"ones, pressure and flat act from the first step on, and the push is {PUSHED.start:g} m/s**: "
        f"{PUSHED.start * 1e6 / P1:g} (m/s)/MPa at 0.5 MPa leads to regime 1, {PUSHED.start * 1e6 / P2:g} (m/s)/MPa at 0.4 MPa to regime 2.")
    found = {case: runs[name] for case, name in pushes.items()}
    _by_push(fragment, found)
    _in_the_long_run(fragment, found)
    _table(fragment, [runs[name] for name in columns])
    fragment.text(
        "More: [regimes](regimes.md) over pressure, δ and start, [prediction](prediction.md) of δ, [thickness](thickness.md) of the pin.")
    fragment.text(
        "Settings unless a section names others:\n"
        "\n"
        "* load: V = 2 m/s, μ = 0.25, δ = 1500 ns, β = 4.4 ns\n"
        "* body: 560 x 160 cells of 0.1 mm (280 x 80 in the two pictures above), homogeneous: eq. (10)\n"
        f"* time: {1e3 * PUSHED.end:g} ms, the last {1e3 * (PUSHED.end - PUSHED.steady_from):g} ms counts; ± is the 95 % interval of the mean in time\n"
        "* regime: 2 if node M is separated more than half of the time, 1 from 10 % on, none below\n"
        "* top, time step, β₂: [how the paper was read](reading.md)")


def _table(fragment, found):
    both = lambda table, scale=1.0, digits=2: " / ".join(fixed(scale * table[n], digits) for n in (1, 2))
    percent = lambda value: fixed(100 * value, 0)
    fragment.table(["", "paper, regime 1 / 2", *[label for label, *_ in COLUMNS]], [
        ["mu_inter", both(paper.INTERFACE_FRICTION), *[mu_text(run) for run in found]],
        ["main frequency [kHz]", both(paper.MAIN_FREQUENCY, 1e-3, 1), *[fixed(frequency(run) / 1e3, 1) for run in found]],
        ["M slips (else separated) [%]", f"{percent(paper.SLIP[1])} / {percent(paper.SLIP[2])}", *[percent(slip(run)) for run in found]],
        ["largest distance of M from the flat [µm], mean over periods", f"{fixed(1e6 * paper.SEPARATION, 1)} / -", *[fixed(1e6 * height(run), 2) for run in found]],
        ["flat relative to M [m/s]", "{} to {} / -".format(*paper.RELATIVE_VELOCITY),
         *["{:.2f} to {:.2f}".format(*relative_velocity(run)) for run in found]]])


def _by_push(fragment, found):
    """`found` {(pressure, push): run}."""
    end = min(run.number("simulated_time") for run in found.values())
    seen = {case: within(run, end / 3, end) for case, run in found.items()}
    figure, axes = plt.subplots(1, 3, figsize=(9.0, 3.6))
    for axis, quantity, table, label, scale in (
            (axes[0], "slip", paper.SLIP, "share of slip of M (%)", 100), (axes[1], "mu", paper.INTERFACE_FRICTION, r"$\mu_\mathrm{inter}$", 1),
            (axes[2], "frequency", paper.MAIN_FREQUENCY, "main frequency (kHz)", 1e-3)):
        for pressure, mark, colour in ((P1, "o", GREEN), (P2, "s", BLACK)):
            axis.plot([1e6 * push / pressure for push in PUSHES[pressure]], [scale * seen[pressure, push][quantity] for push in PUSHES[pressure]],
                      mark, color=colour, ms=5, mfc="white", mew=1.5, label=f"{pressure / 1e6:g} MPa")
        for n, colour in ((1, BLUE), (2, ORANGE)):
            axis.axhline(scale * table[n], color=colour, lw=1.2, ls="--", label=f"paper, regime {n}")
        axis.set(xlabel="push / P ((m/s)/MPa)", ylabel=label)
    lettered(axes)
    above_all(figure, axes[0].get_legend_handles_labels()[0], columns=4)
    fragment.figure(figure, "Slip of M, mu_inter and main frequency over push / P",
                    f"Homogeneous pin, {1e3 * end / 3:.0f} to {1e3 * end:.0f} ms.", "-pushes")
    _plateaus(fragment, [{**state, "push": 1e6 * push / pressure} for (pressure, push), state in seen.items()])


def _plateaus(fragment, seen):
    """What _by_push shows; `seen` of within(), with the push over the pressure in (m/s)/MPa."""
    first, second = ([state for state in seen if low <= state["slip"] <= high] for low, high in ALIKE.values())
    if not first or not second or max(s["push"] for s in first) > min(s["push"] for s in second):
        fragment.text("At these pushes the two regimes are not apart.")
        return
    span = lambda group, key, scale, digits: f"{scale * min(s[key] for s in group):.{digits}f} to {scale * max(s[key] for s in group):.{digits}f}"
    begin = min(s["push"] for s in second)
    others = sum(s["push"] >= begin for s in seen) - len(second)
    fragment.text(f"{len(first)} starts with {span(first, 'push', 1, 1)} (m/s)/MPa lead to regime 1: M slips {span(first, 'slip', 100, 0)} % of the time, mu_inter is {span(first, 'mu', 1, 3)}. "
                  f"{len(second)} starts from {begin:.4g} (m/s)/MPa on lead to regime 2: M slips {span(second, 'slip', 100, 0)} %, mu_inter is {span(second, 'mu', 1, 3)}, the main frequency "
                  f"{span(second, 'frequency', 1e-3, 1)} kHz; {others} more leave it again.")


def _in_the_long_run(fragment, found):
    figure, (axes,) = panels(1, 3.4)
    shares = {v: _separated(found[P1, v], 2.5e-4) for v in LONG}
    for v, (time, share) in shares.items():
        axes.plot(1e3 * time, 100 * share, color=COLOURS[v], label=f"{v:g} m/s")
    for n, colour in ((1, BLUE), (2, ORANGE)):
        axes.axhline(100 * (1 - paper.SLIP[n]), color=colour, lw=1.2, ls="--", label=f"paper, regime {n}")
    axes.set(xlabel="time (ms)", ylabel="share of separation of M (%)", ylim=(0, 100))
    axes.margins(x=0)
    above(axes, columns=3)
    fragment.figure(figure, "Share of separation of node M over time",
                    f"0.5 MPa, three pushes, {1e3 * LONG_END:g} ms. {_end_of_regime_2(*shares[max(LONG)])}", "-long")


def _end_of_regime_2(time, share):
    high = np.flatnonzero(share > 0.5)
    if len(high) and high[-1] + 1 < len(time):
        left = time[high[-1]]
        return (f"The pin leaves regime 2 for regime 1 after {1e3 * left:.1f} ms, {left * paper.MAIN_FREQUENCY[2]:.0f} periods; its other cycles last.")
    return "The pin leaves none of its cycles."


def _separated(run, width):
    """Time (s) and share of separation of the reference node, over blocks of `width` (s)."""
    time, separated = run.need("/contact/blocks/time", "/contact/blocks/separated")
    n = max(1, int(round(width / (time[1] - time[0]))))
    whole = len(time) // n * n
    return time[:whole].reshape(-1, n).mean(axis=1), separated[:whole, separated.shape[1] // 2].reshape(-1, n).mean(axis=1)
