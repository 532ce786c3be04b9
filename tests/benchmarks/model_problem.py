"""Studies of the program model_problems: a sweep over cells, time step and beta2, and its diagram."""

from fits import cheapest, fitted_order
from plots import curve, legend, logarithmic, panels

# Share of the critical time step and beta2: one curve each.
CURVES = [(0.95, 0.5), (0.475, 0.5), (0.2375, 0.5), (0.95, 0.6), (0.95, 1.0)]


def sweep(bench, problem, sizes, note, curves=None):
    """Rows of all sizes and curves, written to PROBLEM.csv. The fewest cells run first."""
    choices = [f"{n}:{share}:{beta2}" for n in sizes for share, beta2 in curves or CURVES]
    repetitions = 3
    rows = bench.tool("model_problems", problem, repetitions, *choices)
    bench.write(problem, rows, note, repetitions=repetitions)
    return rows


def label(share, beta2):
    return rf"$\Delta t$ = {share:g} $\Delta t_\mathrm{{crit}}$, $\beta_2$ = {beta2:g}"


def draw_curves(axes, rows, error, curves=None):
    """% error over CPU seconds; a curve that falls all the way has its order in h in its label."""
    for k, (share, beta2) in enumerate(curves or CURVES):
        own = [row for row in rows if (row["share"], row["beta2"]) == (share, beta2)]
        errors = [100 * abs(row[error]) for row in own]
        text = label(share, beta2)
        if all(b < a for a, b in zip(errors, errors[1:])):
            text += f": order {fitted_order([1 / row['n'] for row in own[-3:]], errors[-3:]):.2f}"
        curve(axes, k if not curves else CURVES.index((share, beta2)), [row["cpu_s"] for row in own], errors, text)


def draw(bench, name, rows, shown):
    """NAME.svg, a panel for each of `shown`: error, label of its axis, title and, unless all, its curves."""
    figure, all_axes = panels(len(shown))
    for axes, (error, text, title, *curves) in zip(all_axes, shown):
        logarithmic(axes, "CPU seconds (time loop)", text, title)
        draw_curves(axes, rows, error, *curves)
        legend(axes)
    bench.draw(name, figure)


def conclusions(rows, error, quantity):
    found = []
    for target in (0.01, 0.001):
        best = cheapest(rows, error, "cpu_s", target)
        found.append({"quantity": quantity, "target": target,
                      "choice": f"{best['n']:.0f} cells over the height, {best['share']:g} dt_crit, beta2 {best['beta2']:g}"
                      if best else "none of these", "error": abs(best[error]) if best else "",
                      "cpu_s": best["cpu_s"] if best else ""})
    return found
