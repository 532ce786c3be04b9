"""Figures 14 to 16: localized and direct stresses."""

import numpy as np

from cases import PUSHED
from report.base.data import Missing
from report.base.figures import BLACK, ORANGE, STRESSES, panels, scaled, above
from report.bodies import maps
from report.runs import paper_values as paper

PERIODS = 6
EDGE = 1.6e-3  # m; beyond it from the sides the interior begins

READING = ("At 0.5 MPa, seed 1. Localized: homogeneous run (eq. (10), δ = 1700 ns) with the KUBC concentration tensors. Direct: heterogeneous run (δ = 1500 ns). The two runs are not "
           "in phase; therefore the table compares means and standard deviations over the steady part.")


def runs(cases):
    return [cases.localization()]


def field_runs(cases):
    return [cases.localization(), cases.adapted(), cases.heterogeneous(PUSHED)]


def element_a(fragment, results, names):
    _element(fragment, results[names[0]], "element_A", "A, fibre at the contact")


def element_b(fragment, results, names):
    _element(fragment, results[names[0]], "element_B", "B, matrix in the middle")


def _probe(run, name):
    for probe in run.summary.get("probes") or []:
        if probe["name"] == name:
            return probe
    raise Missing(f"no probe {name} in {run.name}")


def _element(fragment, run, name, label):
    probe, rows = _probe(run, name), []
    for component in ("sigma_yy", "sigma_xx", "sigma_xy"):
        values = probe[component]
        surface = name == "element_A" and component != "sigma_yy"
        bound = paper.LOCALIZATION["mean and deviation" if component == "sigma_yy" else "surface" if surface else "volume"]
        rows.append([component, f"< {100 * bound:.0f}",
                     *[f"{values[key] / 1e6:.2f}" for key in ("mean", "direct_mean")], _percent(values["error_mean"]),
                     *[f"{values[key] / 1e6:.2f}" for key in ("std", "direct_std")], _percent(values["error_std"])])
    fragment.table(["stress [MPa]", "paper [%]", "mean, localized", "mean, direct", "difference [%]", "deviation, localized", "deviation, direct", "difference [%]"], rows)
    fragment.text(READING if name == "element_A" else "Runs as in figure 14.")
    figure, (axes,) = panels(1, 3.2)
    time, stress, direct = run.need(f"/probes/{name}/time", f"/probes/{name}/stress", f"/probes/{name}/direct_stress")
    last = time > time[-1] - PERIODS / paper.MAIN_FREQUENCY[1]
    factor, unit = scaled(stress[last, 1], units=STRESSES)
    shown = 1e6 * (time[last] - time[last][0])
    axes.plot(shown, direct[last, 1] / factor, color=BLACK, lw=1.4, label="direct (heterogeneous run)")
    axes.plot(shown, stress[last, 1] / factor, color=ORANGE, lw=1.4, label="localized (homogeneous run)")
    axes.axhline(0, color=BLACK, lw=0.6)
    axes.set(xlabel="time (µs), last periods", ylabel=rf"$\sigma_\mathrm{{yy}}$ ({unit})")
    axes.margins(x=0)
    above(axes, columns=2)
    fragment.figure(figure, f"Normal stress in element {label}")


def _percent(value):
    return "-" if value is None else f"{100 * value:+.1f}".replace("-", "−")


def mean_von_mises(fragment, results, names):
    run, homogeneous, heterogeneous = (results[name] for name in names)
    figure, error = maps.mean_von_mises(run)
    errors = run.summary["field_errors"]
    mean_strain = (run.summary.get("mean_strain_variant") or {}).get("field_errors") or {}
    regions = ("all", *run.summary.get("phases", []), "surface", "interior")
    order = sorted(errors, key=lambda quantity: (quantity != "mean_von_mises", quantity.startswith("deviation")))
    rows = [[quantity.replace("_", " ").replace("mises", "Mises") + variant, *[_share(found[quantity].get(region)) for region in regions]]
            for variant, found in (("", errors), (", eq. (23)", mean_strain)) for quantity in order if quantity in found]
    link = fragment.csv(["relative L2 difference [%]", *regions], rows)
    fragment.table(["relative L2 difference [%]", *regions], [row for row in rows if row[0] == "mean von Mises"])
    fragment.text("Runs as in figure 14, averaged over the ten periods before the end. "
                  f"{link} adds the components, the deviations in time and eq. (23), which localizes the mean strain alone.")
    fragment.figure(figure, "Mean von Mises stress: localized, direct, difference", dpi=100)
    fragment.text(_bias(run, homogeneous, heterogeneous))


def _swing(run, begin, end):
    """N/m; standard deviation of the tangential force on the top from `begin` to `end` (s)."""
    time, force = run.need("/history/time", "/history/top_tangential_force")
    return force[(time >= begin) & (time <= end)].std()


def _bias(run, homogeneous, heterogeneous):
    """Why the localized field lies on one side of the direct one."""
    localized, direct = run.need("/mean_von_mises", "/direct/mean_von_mises")
    time = heterogeneous.need("/snapshots/time")
    begin, end = time[0], time[-1]
    here, there = (_swing(run, begin, end) for run in (homogeneous, heterogeneous))
    factor = np.sum(localized * direct) / np.sum(direct**2)
    error = lambda a, b: 100 * np.linalg.norm(a - b) / np.linalg.norm(b)
    edge = int(round(EDGE / run.grid()[1][0]))
    inside = np.s_[edge:-edge, edge:-edge]
    size, above = ("larger", "above") if here > there else ("smaller", "below")
    return ("In these periods the standard deviation of the tangential force on the top is "
            f"{100 * abs(here / there - 1):.0f} % {size} in the homogeneous run. Therefore the localized stress lies {above} the direct stress nearly everywhere, by "
            f"{100 * abs(factor - 1):.0f} % in the best fit. Divided by this factor, the fields differ by {error(localized / factor, direct):.1f} "
            f"% over all cells and by {error(localized[inside] / factor, direct[inside]):.1f} % beyond {1e3 * EDGE:g} mm from the sides.")


def _share(value):
    return "-" if value is None else f"{100 * value:.1f}"
