"""Localized stresses at the probes, beside those of the direct run."""

import numpy as np

from report.base import figures
from report.base.data import Missing
from report.base.page import difference, escape, quantities, table
from report.runs import paper


NOT_SAID = " The error of the mean is – where the direct mean is nearly zero or has the other sign."


def localization(page, run):
    names = run.members("/probes")
    if not names:
        return f'<p class="note">{escape(run.name)} has no probes, at which stresses would be shown over time: its .prm and those of the runs that it reads name none.</p>'
    listed = {str(probe.get("name")): probe for probe in run.summary.get("probes") or []
              if isinstance(probe, dict)}
    rows, html = [], f"<h3>{escape(run.name)}</h3>"
    for name in names:
        rows += probe_errors(run, name)
    if rows:
        rows = in_one_unit(rows)
        html += table(["probe", "stress", "mean, localized", "mean, direct", "error of the mean", "std, localized", "std, direct",
                       "error of the std", "error over time"], rows, (0, 1))
        html += '<p class="lead">Errors are those of the localized stress, relative to the direct one: a positive error says that the localized stress is larger, in compression and tension alike. Mean and standard deviation (std) '\
                "over time do not depend on the phase of the vibration: what differs there is wrong, or the two runs vibrate differently. "\
                "The error over time (relative L2 difference of the signals as they stand) also counts a difference of phase, which alone "\
                "can bring it to 141 % of the part that vibrates."
        html += NOT_SAID if any(row[4] == "–" for row in rows) else ""
        html += (" The paper: L2 below 4 % for σ<sub>yy</sub>, 25 % at most for the others at the surface; mean and "
                 "deviation within 5 %." if paper.is_pin(run) else "") + "</p>"
    pictures = []
    for name in names[:6]:
        phase = listed.get(name, {}).get("phase")
        where = f", in the {escape(phase)}" if isinstance(phase, str) else ""
        position = run.probe_position(name)
        if position is not None:
            where += ", at " + ", ".join(f"{axis} = {1e3 * x:.5g} mm" for axis, x in zip("xyz", position))
        try:
            compared = run.get(f"/probes/{name}/direct_stress") is not None
            pictures.append(page.figure(figures.localized_stress(run, name),
                                        f"Stress at probe {escape(name)}{where} over the last periods: localized" +
                                        (" and direct. Two runs drift out of phase, so compare level and amplitude." if compared else ".")))
        except Missing as missing:
            pictures.append(f'<p class="note">Left out: {escape(missing)}.</p>')
    return html + page.row(pictures)


def probe_errors(run, name):
    """Cells of the table; stresses are numbers (Pa)."""
    stress, direct = run.get(f"/probes/{name}/stress"), run.get(f"/probes/{name}/direct_stress")
    if stress is None or direct is None or stress.shape != direct.shape or stress.ndim != 2 or stress.shape[1] not in (3, 6):
        return []
    time = run.get(f"/probes/{name}/time")
    begin = run.number("steady_from")
    if time is not None and begin is not None and len(time) == len(stress) and time[-1] > begin:
        stress, direct = stress[time >= begin], direct[time >= begin]
    rows = []
    for component, of in figures.shown_components(stress.shape[1]):
        label = f"σ<sub>{of}</sub>"
        ours, theirs = stress[:, component], direct[:, component]
        means, deviations = (ours.mean(), theirs.mean()), (ours.std(), theirs.std())
        rows.append([escape(name), label, *map(float, means), error_of_mean(*means, deviations[1]), *map(float, deviations), difference(*map(float, deviations)),
                     percent(np.linalg.norm(ours - theirs), np.linalg.norm(theirs))])
    return rows


def in_one_unit(rows):
    """Rows of probe_errors() with their stresses (Pa) as texts, of all rows in the same unit."""
    texts = iter(quantities([cell for row in rows for cell in row if isinstance(cell, float)], "Pa", 3))
    return [[next(texts) if isinstance(cell, float) else cell for cell in row] for row in rows]


def error_of_mean(ours, theirs, deviation):
    """Of the direct mean, unless that is small beside its standard deviation or has the other sign."""
    return "–" if ours * theirs < 0 or abs(theirs) < 0.1 * deviation else difference(float(ours), float(theirs))


def percent(part, whole):
    return f"{100 * part / whole:.1f} %" if whole > 0 else "n/a"
