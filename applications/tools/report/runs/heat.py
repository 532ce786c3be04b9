"""Section on the thermal expansion and the conductivity of a volume, by boundary condition."""

from report.base.page import escape, number, table

AXES = {2: ("xx", "yy", "xy"), 3: ("xx", "yy", "zz", "yz", "xz", "xy")}
BOUNDS = {"wiener": "Wiener (mixtures in series and in parallel)", "hashin_shtrikman": "Hashin and Shtrikman (isotropic)"}


def is_there(run):
    return any(isinstance(run.summary.get(key), dict) for key in ("expansion", "conductivity"))


def heat(page, run):
    """Tables of the expansion (1e-6/K) and of the conductivity with its bounds."""
    dim = 3 if run.is_solid() else 2
    html = f"<h3>{escape(run.name)}</h3>"
    expansion, conductivity = (run.summary.get(key) for key in ("expansion", "conductivity"))
    if isinstance(expansion, dict):
        rows = [[axis, *(number(1e6 * values[k]) for values in expansion.values())] for k, axis in enumerate(AXES[dim])]
        html += table(["expansion (1e-6/K)", *map(escape, expansion)], rows)
        if dim == 2:
            html += "<p>In plane strain, in which the body does not expand along z. xy is the engineering shear.</p>"
    if isinstance(conductivity, dict):
        entries = [(axis, *place) for axis, place in zip(AXES[dim], ((0, 0), (1, 1), (0, 1)) if dim == 2 else ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)))]
        rows = [[axis, *(number(matrix[i][j]) for matrix in conductivity.values())] for axis, i, j in entries]
        html += table(["conductivity (unit of the phases)", *map(escape, conductivity)], rows)
        bounds = run.summary.get("conductivity_bounds")
        if isinstance(bounds, dict):
            said = [f"{BOUNDS.get(name, escape(name))}: {number(low)} to {number(high)}" for name, (low, high) in bounds.items()]
            html += f'<p class="lead">Bounds. {"; ".join(said)}.</p>'
    return html
