"""Key numbers: the runs beside one another, and, of the paper's pin, beside the paper; effective stiffnesses."""

import numpy as np

from report.base.data import Missing
from report.base.figures import STRESSES, scaled
from report.base.page import difference, escape, number, quantities, quantity, table
from report.base.words import CONDITIONS
from report.runs import paper

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
    ("Largest residual of the energy balance, relative", ("energy_balance_residual",), ""),
    ("Statistics from", ("steady_from",), "s"),
    ("Means over whole periods from", ("window_begin",), "s"),
    ("Means over whole periods to", ("window_end",), "s"),
]
# Rows below a number: what it is relative to.
EXPLAINED = {("global_interface_friction_coefficient",): ("… which is the frictional power over", "global_interface_friction_load_meaning"),
             ("energy_balance_residual",): ("… which is relative to", "energy_balance_scale")}


def side_by_side(page, runs):
    """One column a transient run, its warnings below."""
    rows = []
    for what, place, unit in QUANTITIES:
        values = [run.number(*place) for run in runs]
        if any(value is not None for value in values):
            rows.append([what, *_cells(runs, values, place, unit)])
        rows += _explained(runs, place)
        rows += frictional_power(runs) if place == ("friction_energy",) else []
    rows += _words(runs, "Regime of the reference node", "regime")
    if not rows:
        raise Missing("no summary holds any key number")
    html = table(["", *(escape(run.label) for run in runs)], rows)
    settled = [(run, run.summary.get("limit_cycle")) for run in runs if isinstance(run.summary.get("limit_cycle"), str)]
    html += "".join(f'<p class="lead"><b>{escape(run.label)}</b>: {escape(text)}.</p>' for run, text in settled)
    return html + "".join(warnings(run) for run in runs)


def frictional_power(runs):
    """A row that runs of different length can be compared by, if there are such."""
    times = [run.get("/history/time") for run in runs]
    ends = [float(time[-1]) if time is not None and time.size else None for time in times]
    known = [end for end in ends if end]
    if not known or max(known) <= 1.001 * min(known):
        return []
    energies = [run.number("friction_energy") for run in runs]
    powers = [energy / end if end and energy is not None else None for end, energy in zip(ends, energies)]
    return [["… over the duration of its run, as the runs differ in it", *quantities(powers, "W" + runs[0].per_thickness())]]


def _words(runs, what, key):
    """A row of texts of the summaries, if one has it."""
    if not any(run.summary.get(key) for run in runs):
        return []
    return [[what, *(f'<span class="words">{escape(run.summary.get(key) or "–")}</span>' for run in runs)]]


def _explained(runs, place):
    """A row on what the number above it is relative to."""
    what, key = EXPLAINED.get(place, ("", ""))
    return _words(runs, what, key) if key else []


def _cells(runs, values, place, unit):
    """Texts of a row, in the same unit."""
    if unit == "%":
        return ["–" if value is None else f"{number(100 * value, 3)} %" for value in values]
    texts = quantities(values, "J" + runs[0].per_thickness() if unit == "J/m" else unit)
    if place == ("global_interface_friction_coefficient",):
        halves = [run.number("global_interface_friction_coefficient_95") for run in runs]
        texts = [text if half is None else f"{text} <small>± {number(half, 2)} (95 %)</small>" for text, half in zip(texts, halves)]
    return texts


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
        [[what, *quantities((ours, value), unit), difference(ours, value), source]
         for what, ours, value, unit, source in rows], (0, 4))


def stiffness_matrices(run):
    """{heading: stiffness (Pa)}; of an ensemble the means, as `effective` is the mean of those."""
    ensemble = run.summary.get("ensemble")
    ensemble = ensemble if isinstance(ensemble, dict) else {}
    matrices = {}
    for name in (*CONDITIONS, "effective"):
        mean = ensemble[name].get("mean") if isinstance(ensemble.get(name), dict) else None
        value = mean if mean is not None else run.get(f"/stiffness/{name}")
        if value is None:
            listed = run.summary.get("stiffness")
            value = listed.get(name) if isinstance(listed, dict) else None
        value = np.array(value, dtype=float) if value is not None else None
        if value is not None and value.shape in ((3, 3), (6, 6)):
            matrices[f"{name}, mean of {ensemble.get('members')}" if mean is not None else name] = value
    return matrices


def stiffness_entries(matrices, scale):
    """(label, i, j) of the rows: those of an orthotropic body, and of the couplings of shears those that do not round to zero; and the largest
    coupling that is left out (Pa)."""
    n = len(next(iter(matrices.values())))
    dim = 2 if n == 3 else 3
    largest = {(i, j): max(abs(matrix[i, j]) for matrix in matrices.values()) for i in range(n) for j in range(i, n)}
    shown = [(i, j) for i, j in largest if i == j or j < dim or round(largest[i, j] / scale[0], scale[2])]
    left_out = max((size for place, size in largest.items() if place not in shown), default=0.0)
    return [(f"D<sub>{i + 1}{j + 1}</sub>", i, j) for i, j in shown], left_out


def scale_of(matrices):
    """(Pa, name, decimals) of the unit in which the largest entry reads well."""
    largest = max(np.abs(matrix).max() for matrix in matrices.values())
    factor, unit = scaled(np.array([largest]), units=STRESSES)
    return factor, unit, 2 if largest / factor >= 10 else 3


def entry(value, scale):
    """With the decimals of its table, and no minus before what rounds to zero."""
    factor, _, decimals = scale
    return f"{round(value / factor, decimals) + 0.0:.{decimals}f}".replace("-", "−")


def stiffness_under(condition, matrices):
    """That of one volume or the mean of an ensemble; None where it was not computed."""
    return next((matrix for name, matrix in matrices.items() if name.split(",")[0] == condition), None)


def gaps(matrices):
    """How far KUBC lies above SUBC on the diagonal, as shares; empty without both."""
    upper, lower = (stiffness_under(condition, matrices) for condition in ("KUBC", "SUBC"))
    return [] if upper is None or lower is None else (np.diag(upper) / np.diag(lower) - 1).tolist()


def apart(matrices):
    listed = ", ".join(f"{number(100 * gap, 2)} % in D<sub>{i}{i}</sub>" for i, gap in enumerate(gaps(matrices), 1))
    return listed and f"; here KUBC lies above SUBC by {listed}. The closer they are, the better this piece stands for the material"


def stiffness_table(page, run):
    matrices = stiffness_matrices(run)
    if not matrices:
        raise Missing(f"{run.name} holds no stiffness of 3 × 3 entries")
    compared, scale = paper.is_pin(run), scale_of(matrices)
    rows = []
    entries, left_out = stiffness_entries(matrices, scale)
    for label, i, j in entries:
        reference = paper.STIFFNESS[i][j] if compared else 0.0
        cells = [entry(matrix[i, j], scale) + f" <small>({difference(matrix[i, j], reference)})</small>" * (compared and reference > 0)
                 for matrix in matrices.values()]
        rows.append([label] + [entry(reference, scale)] * compared + cells)
    shares = [f"{escape(phase.get('name'))} {100 * phase['volume_fraction']:.2f} %"
              for phase in run.summary.get("phases") or []
              if isinstance(phase, dict) and isinstance(phase.get("volume_fraction"), (int, float))]
    extra = [f"Volume fractions: {', '.join(shares)}"] if shares else []
    for words, key in [("Hill–Mandel residual", "hill_mandel_residual"),
                       ("symmetry residual", "symmetry_residual")]:
        if run.number(key) is not None:
            extra.append(f"{words} {number(run.number(key), 2)}")
    order = "1 is xx, 2 is yy, 3 is the shear xy" if len(next(iter(matrices.values()))) == 3 else "1 to 6 are xx, yy, zz, yz, xz, xy"
    ordered = [name for name in CONDITIONS if name != "MUBC" and stiffness_under(name, matrices) is not None]
    theory = f". On the diagonal theory orders {' ≤ '.join(ordered)}{apart(matrices)}" if len(ordered) > 1 else ""
    extra.insert(0, f"{order} (engineering strain){theory}")
    if left_out > 1e-9 * scale[0]:
        extra.append(f"Entries that are not shown are at most {quantity(float(left_out), 'Pa', 2)}")
    if compared:
        extra.insert(0, "In brackets: difference from eq. (10)")
    return (f"<h3>{escape(run.name)}</h3>" + table([scale[1]] + ["paper, eq. (10)"] * compared + list(matrices), rows) +
            f'<p class="lead">{". ".join(extra)}.</p>')
