"""Normal stress at node M (figure 9) and mu_inter against the regularization time (figure 11, eq. 13)."""

import numpy as np

from cases import P1, P2, PUSHED
from measures import contact_time, frequency, mu, reference, regime, slip, spectrum_of
from page import fixed
from report.base.figures import BLACK, BLUE, GREY, ORANGE, above, lettered, panels
from report.runs import paper_values as paper

PERIODS = 4
SWEEP = (500, 750, 1000, 1250, 1500, 1750, 2000, 2500, 3000, 4000)  # ns, on cells of 0.2 mm
FINE = {P1: (1500, 1700), P2: (1500, 1750)}  # on 0.1 mm, from tables 2 and 3
LABELS = {P1: "0.5 MPa", P2: "0.4 MPa"}


def normal_runs(cases):
    return {pressure: cases.homogeneous(PUSHED, pressure) for pressure in LABELS}


def normal(fragment, runs, names):
    figure, axes = panels(2, 4.8, sharex=True)
    shown = min(PERIODS / frequency(runs[name]) for name in names.values())
    rows = []
    for axis, pressure, colour in zip(axes, names, (BLUE, ORANGE)):
        run = runs[names[pressure]]
        time, _, _, traction = reference(run)
        last = time > time[-1] - shown
        axis.plot(1e6 * (time[last] - time[last][0]), traction[last, 1] / 1e6, color=colour, lw=1.3)
        axis.set(ylabel=r"$|\sigma_n|$ (MPa)")
        axis.set_title(LABELS[pressure], loc="left")
        axis.margins(x=0)
        f, a = spectrum_of(traction[:, 1], time)
        main = a[(f > 1e4) & (f < 1e5)].max()
        rows.append([LABELS[pressure], f"{paper.HIGHEST_FREQUENCY / 1e3:.0f}", f"{f[a > 0.1 * main].max() / 1e3:.0f}",
                     f"{1e6 * run.number('mean_contact_duration'):.2f}"])
    axes[1].set_xlabel("time (µs)")
    lettered(axes)
    fragment.table(["", "highest frequency above 10 % of the main amplitude, paper (section 3.2) [kHz]", "ours [kHz]", "T_G [µs]"], rows)
    fragment.text("T_G, over all nodes, counts every short touch; the paper prints none.")
    fragment.figure(figure, f"Normal contact stress at node M, last {1e6 * shown:.0f} µs")


def sweep_runs(cases):
    return {pressure: ([cases.coarse(PUSHED.start, pressure, delta) for delta in SWEEP],
                       [cases.homogeneous(PUSHED, pressure, delta) for delta in FINE[pressure]]) for pressure in LABELS}


def mean_friction(mu_local, delta, duration):
    """Eq. (13)."""
    return mu_local * (1 + delta / duration * (np.exp(-duration / delta) - 1))


def sweep(fragment, runs, names):
    figure, axes = panels(2, 6.2, sharex=True)
    kept = []
    for axis, pressure in zip(axes, names):
        found, fine = ([runs[name] for name in members] for members in names[pressure])
        deltas, inter, error = _columns(found)
        mu_local = found[0].number("friction_coefficient")
        times = {"node M": np.array([contact_time(run) for run in found]),
                 "all nodes": np.array([run.number("mean_contact_duration") or np.nan for run in found])}
        axis.errorbar(1e9 * deltas, inter, yerr=error, fmt="o-", color=BLUE, capsize=3, label=r"$\mu_\mathrm{inter}$, 0.2 mm")
        at, values, spread = _columns(fine)
        axis.errorbar(1e9 * at, values, yerr=spread, fmt="D", color=BLACK, capsize=3, mfc="white", label="0.1 mm")
        for (whose, duration), style in zip(times.items(), ("s--", "s:")):
            axis.plot(1e9 * deltas, mean_friction(mu_local, deltas, duration), style, color=ORANGE, mfc=ORANGE if whose == "node M" else "white",
                      label=rf"$\bar\mu$, eq. (13), $T_G$ of {whose}")
        axis.axvline(1e9 * paper.SLOPE_CHANGE, color=GREY, lw=1, ls=":", label="paper: slope changes")
        axis.set(ylabel="friction coefficient", ylim=(None, mu_local + 0.008))
        axis.text(0.99, 0.95, f"({'ab'[list(names).index(pressure)]}) {LABELS[pressure]}", transform=axis.transAxes, ha="right", va="top")
        columns = [[fixed(m) for m in inter]]
        for duration in times.values():
            columns += [[fixed(m) for m in mean_friction(mu_local, deltas, duration)], [fixed(1e6 * t, 1) for t in duration]]
        columns.append([f"{100 * slip(run):.0f}" for run in found])
        kept += [[f"{pressure / 1e6:g}", f"{1e9 * d:.0f}", *line] for d, line in zip(deltas, zip(*columns))]
    axes[1].set_xlabel(r"$\delta$ (ns)")
    above(axes[0], columns=2)
    link = fragment.csv(["P [MPa]", "delta [ns]", "mu_inter [-]", "eq. (13), T_G of node M [-]", "T_G of node M [µs]", "eq. (13), T_G of all nodes [-]", "T_G of all nodes [µs]", "M slips [%]"], kept)
    fragment.text(
        "Homogeneous pin on cells of 0.2 mm; the second half of each run of 3 ms counts. In the paper the slope changes sign near 1500 ns, where regime 2 changes to regime 1. Here "
        f"the regime does not depend on δ (0.5 MPa: regime {_regimes(runs, names[P1])}, 0.4 MPa: regime {_regimes(runs, names[P2])}), and both curves fall. Eq. (13) lies below "
        f"mu_inter, with T_G of node M (as in the paper) and of all nodes, because a period has several contacts of different length. {link} has the values.")
    fragment.figure(figure, "mu_inter and eq. (13) over δ")


def _regimes(runs, names):
    return " or ".join(sorted({regime(runs[name]) for members in names for name in members}))


def _columns(found):
    """delta (s), mu_inter and its error of runs."""
    error = [run.number("global_interface_friction_coefficient_95") or 0.0 for run in found]
    return np.array([run.number("regularization_time") for run in found]), np.array([mu(run) for run in found]), error
