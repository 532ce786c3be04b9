"""Tables 2, 3, 5 and 6: mu_inter of heterogeneous and homogeneous models."""

import dataclasses
import re

import numpy as np

from cases import P1, P2, PUSHED, pushed
from measures import mu, mu_text, regime, slip
from page import fixed, relative
from report.base.figures import BLUE, ORANGE, above, panels
from report.runs import paper_values as paper


@dataclasses.dataclass
class Row:
    """A model of a table: its label, the paper's mu_inter and the name of its run."""
    label: str
    value: float
    name: str


def _short(label):
    """The label without mu, which the text has, and delta, which is 1500 ns in all heterogeneous models."""
    short = re.sub("μ = [^,]*, |δ = ", "", label)
    return short.removesuffix(", 1500 ns") if label.startswith("heterogeneous") else short


def _write(fragment, runs, rows, title):
    found = [runs[row.name] for row in rows]
    fragment.table(["mu_inter (model, δ)", "paper", "ours", "difference [%]", "M slips [%]"],
                   [[_short(row.label), fixed(row.value), mu_text(run), relative(mu(run), row.value), f"{100 * slip(run):.0f}"] for row, run in zip(rows, found)])
    seen = sorted({regime(run) for run in found})
    fragment.text(f"All models are in regime {seen[0]}." if len(seen) == 1 else "The regimes are " + ", ".join(regime(run) for run in found) + ".")
    figure, (axes,) = panels(1, 1.1 + 0.3 * len(rows))
    y = -np.arange(len(rows))
    axes.plot([row.value for row in rows], y, "x", color=ORANGE, ms=9, mew=2.2, label="paper")
    axes.errorbar([mu(run) for run in found], y, xerr=[run.number("global_interface_friction_coefficient_95") or 0 for run in found],
                  fmt="o", color=BLUE, capsize=3, ms=6, mfc="white", mew=1.5, label="ours")
    axes.set(yticks=y, xlabel=r"$\mu_\mathrm{inter}$", ylim=(y[-1] - 0.6, 0.6))
    axes.set_yticklabels([row.label for row in rows])
    above(axes)
    fragment.figure(figure, title)


def _spread(fragment, runs, rows, reference):
    values = [mu(runs[row.name]) for row in rows]
    fragment.text(f"Mean and standard deviation over the {len(values)} morphologies: {np.mean(values):.3f} ± {np.std(values, ddof=1):.3f} "
                  f"(paper: {np.mean(reference):.3f} ± {np.std(reference, ddof=1):.3f}). Ours are seeds 1, 2, 4 and 6; the paper's "
                  "are not published.")


def _models(cases, table, pressure):
    rows = [Row(f"heterogeneous {seed}, δ = 1500 ns", value, cases.heterogeneous(PUSHED, pressure, seed))
            for seed, value in table["heterogeneous"].items()]
    return rows + [Row(f"homogeneous, δ = {delta} ns", value, cases.homogeneous(PUSHED, pressure, delta))
                   for delta, value in table["homogeneous"].items()]


def table_2_runs(cases):
    return _models(cases, paper.TABLE_2, P1)


def table_2(fragment, runs, rows):
    _write(fragment, runs, rows, "mu_inter of table 2")
    reference = paper.TABLE_2["heterogeneous"]
    _spread(fragment, runs, rows[: len(reference)], list(reference.values()))


# m/s; around the push at which 0.4 MPa changes its regime.
PUSHES = (0.42, 0.44, 0.46, 0.48)


def table_3_runs(cases):
    rows = _models(cases, paper.TABLE_3, P2)
    pushes = {v: [cases.heterogeneous(pushed(v), P2, seed) for seed in paper.TABLE_3["heterogeneous"]]
              + [cases.homogeneous(pushed(v), P2, delta) for delta in paper.TABLE_3["homogeneous"]] for v in PUSHES}
    return rows, {**pushes, PUSHED.start: [row.name for row in rows]}


def table_3(fragment, runs, names):
    rows, pushes = names
    _write(fragment, runs, rows, "mu_inter of table 3")
    changes = {_change({v: regime(runs[members[k]]) for v, members in pushes.items()}) for k in range(len(rows))}
    link = fragment.csv(["model", "push [m/s]", "regime", "mu_inter [-]", "from [ms]", "to [ms]"],
                        [[row.label, f"{v:g}", regime(runs[members[k]]), f"{mu(runs[members[k]]):.3f}", *(f"{1e3 * t:g}" for t in _window(v))] for k, row in enumerate(rows) for v, members in pushes.items()])
    fragment.text("In the paper heterogeneous model 1 and the homogeneous model with 1500 ns are in regime 2, the two other models in regime 1. Here the regime changes with the push" + (
        f", {changes.pop()} for all four models ({link}); no push gives these models different regimes." if len(changes) == 1 else f" ({link}): {'; '.join(sorted(changes))}."))


def _window(push):
    """Begin and end (s) of what counts of a run with this push."""
    reading = PUSHED if push == PUSHED.start else pushed(push)
    return reading.steady_from, reading.end


def _change(regimes):
    """Between which pushes the regime changes, as text; `regimes` {push: regime} with rising pushes."""
    found = [f"between {a:g} and {b:g} m/s" for (a, before), (b, after) in zip(regimes.items(), list(regimes.items())[1:]) if before != after]
    return " and ".join(found) or "at none of these"


def by_phase_runs(table, cases):
    rows = [Row("heterogeneous 1, μ = 0.3 and 0.12, δ = 1500 ns", paper.BY_PHASE, cases.heterogeneous(PUSHED, P1, 1, by_phase=True))]
    return rows + [Row(f"homogeneous, μ = {mu_homo:g}, δ = {delta} ns", value, cases.homogeneous(PUSHED, P1, delta, mu_homo))
                   for (mu_homo, delta), value in table.items()]


def by_phase(number, fragment, runs, rows):
    _write(fragment, runs, rows, f"mu_inter of table {number}")
    if number == 5:
        fragment.text("At 0.5 MPa. μ is 0.3 at fibres and 0.12 at the matrix of the heterogeneous pin, mu_homo in the homogeneous pin.")
