"""Key numbers: the runs beside one another, and, of the paper's pin, beside the paper."""

import paper
from data import Missing
from page import difference, escape, number, quantity, table

# Heading, place in summary.json, unit; shares become per cent.
QUANTITIES = [
    ("Global interface friction coefficient μ<sub>inter</sub>", ("global_interface_friction_coefficient",), ""),
    ("Mean apparent friction coefficient", ("mean_apparent_friction_coefficient",), ""),
    ("Friction coefficient of the contact nodes", ("friction_coefficient",), ""),
    ("Pressure on the top", ("pressure",), "Pa"),
    ("Velocity of the flat", ("flat_velocity",), "m/s"),
    ("Main frequency", ("main_frequency",), "Hz"),
    ("All contact nodes: slip", ("slip_fraction",), "%"),
    ("All contact nodes: stick", ("stick_fraction",), "%"),
    ("All contact nodes: separated", ("separation_fraction",), "%"),
    ("Reference node: slip", ("reference_node", "slip"), "%"),
    ("Reference node: stick", ("reference_node", "stick"), "%"),
    ("Reference node: separated", ("reference_node", "separation"), "%"),
    ("Mean contact duration T<sub>G</sub>", ("mean_contact_duration",), "s"),
    ("Frictional energy", ("friction_energy",), "J/m"),
    ("Largest strain", ("largest_strain",), "%"),
    ("Residual of the energy balance, relative", ("energy_balance_residual",), ""),
    ("Statistics from", ("steady_from",), "s"),
    ("Means over whole periods from", ("window_begin",), "s"),
    ("Means over whole periods to", ("window_end",), "s"),
]


def side_by_side(page, runs):
    """One column a transient run, its warnings below."""
    rows = []
    for what, place, unit in QUANTITIES:
        values = [run.number(*place) for run in runs]
        if any(value is not None for value in values):
            rows.append([what, *(_cell(run, value, place, unit) for run, value in zip(runs, values))])
    for what, key in (("μ<sub>inter</sub> is the frictional power over", "global_interface_friction_load_meaning"), ("Residual of the energy balance is relative to", "energy_balance_scale"), ("Regime of the reference node", "regime")):
        if any(run.summary.get(key) for run in runs):
            rows.append([what, *(f'<span class="words">{escape(run.summary.get(key) or "–")}</span>' for run in runs)])
    if not rows:
        raise Missing("no summary holds any key number")
    html = table(["", *(escape(run.label) for run in runs)], rows)
    settled = [(run, run.summary.get("limit_cycle")) for run in runs if isinstance(run.summary.get("limit_cycle"), str)]
    html += "".join(f'<p class="lead"><b>{escape(run.label)}</b>: {escape(text)}.</p>' for run, text in settled)
    return html + "".join(warnings(run) for run in runs)


def _cell(run, value, place, unit):
    if value is None:
        return "–"
    if unit == "%":
        return f"{number(100 * value, 3)} %"
    text = quantity(value, "J" + run.per_thickness() if unit == "J/m" else unit)
    if place == ("global_interface_friction_coefficient",):
        half = run.number("global_interface_friction_coefficient_95")
        text += f" <small>± {number(half, 2)} (95 %)</small>" if half is not None else ""
    return text


def warnings(run):
    """Every warning of the run, and that about T_G, which has a key of its own."""
    found = [run.summary[key] for key in ("mean_contact_duration_warning",) if isinstance(run.summary.get(key), str)]
    found += [text for text in run.summary.get("warnings") or [] if isinstance(text, str) and text not in found]
    return "".join(f'<p class="note">{escape(run.label)}. Warning: {escape(text)}.</p>' for text in found)


def beside_the_paper(page, run):
    """What the paper reports of a run like this one; the regime is the one that the run is nearest to."""
    rows = paper.comparison(run) if run.number("global_interface_friction_coefficient") is not None else []
    rows = [row for row in rows if row[1] is not None]
    rows += paper.modes(run) + paper.static_pressures(run)
    if not rows:
        raise Missing(f"the summary of {run.name} holds none of the numbers the paper reports")
    folder = f" <span class=lead>({escape(run.name)})</span>" if run.name != run.label else ""
    pressure = run.number("pressure")
    lead = ""
    if pressure is not None and pressure != paper.PRESSURE[paper.regime(run)]:
        lead = (f'<p class="lead">The paper prints a pressure of {quantity(paper.PRESSURE[paper.regime(run)], "Pa")}; this run: '
                f'{quantity(pressure, "Pa")}.</p>')
    return f"<h3>{escape(run.label)}{folder}</h3>{lead}" + table(
        ["", "this run", "paper", "difference", "where in the paper"],
        [[what, quantity(ours, unit), quantity(value, unit), difference(ours, value), source]
         for what, ours, value, unit, source in rows], (0, 4))
