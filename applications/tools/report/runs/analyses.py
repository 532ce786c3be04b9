"""Sections and figures of the analyses without a history: modes, static contact, homogenized friction law."""

import numpy as np

from report.base.data import Missing
from report.base.figures import BLUE, ORANGE, STRESSES, WIDTH, above, panels, plt, scaled
from report.base.page import escape, number, quantities, quantity, table
from report.bodies import mode_shapes



def bottoms(run):
    """(name in files, title) of the two boundary conditions of modes."""
    return [("free", "bottom free"), ("held", f"bottom held in {'z' if run.is_solid() else 'y'}")]


def modes(page, run):
    """Frequencies by boundary condition, and the shapes of the lowest."""
    listed = run.summary.get("frequencies")
    cases = listed if isinstance(listed, dict) else {"": listed}
    cases = {name: values for name, values in cases.items() if isinstance(values, list) and values}
    if not cases:
        raise Missing(f"the summary of {run.name} holds no frequencies")
    titles = dict(bottoms(run))
    rows = [[str(k + 1), *(quantity(float(values[k]), "Hz") if k < len(values) else "–" for values in cases.values())]
            for k in range(max(len(values) for values in cases.values()))]
    html = f"<h3>{escape(run.name)}</h3>" + table(["mode", *(titles.get(name, escape(name)) for name in cases)], rows)
    if run.members("/modes"):
        html += page.figure(shapes_of_modes(run), f"Lowest modes of {escape(run.name)}: {mode_shapes.caption(run)}")
    return html


def shapes_of_modes(run):
    found = [(title, run.get(f"/modes/{name}/shape"), run.get(f"/modes/{name}/frequency")) for name, title in bottoms(run)]
    found = [case for case in found if case[1] is not None and case[1].ndim > 2 and len(case[1])]
    if not found:
        raise Missing(f"{run.name} holds no shapes of modes")
    return mode_shapes.figure(run, [([f"{title}: {1e-3 * f:.2f} kHz" for f in frequencies], shapes) for title, shapes, frequencies in found])


def static_contact(page, run):
    """Pressures of the phases, the friction that follows, and both tractions along the contact."""
    summary = run.summary
    eq_19 = summary.get("phase_pressures_eq_19") if isinstance(summary.get("phase_pressures_eq_19"), dict) else {}
    pressures = summary.get("phase_contact_pressures")
    pressures = pressures if isinstance(pressures, dict) else {}
    rows = [[f"Contact pressure, {escape(name)}", _pascal(value), _pascal(eq_19.get(name))] for name, value in pressures.items()]
    mu = summary.get("homogenized_friction_coefficient")
    if isinstance(mu, dict):
        rows.append(["Homogenized friction coefficient", number(mu.get("static_contact")), number(mu.get("eq_19"))])
    html = f"<h3>{escape(run.name)}</h3>"
    if rows:
        html += table(["", "this analysis", "eq. (19)"], rows)
    nodes = summary.get("nodes")
    if isinstance(nodes, dict):
        html += f'<p class="lead">Contact nodes: {", ".join(f"{escape(k)} {number(v)}" for k, v in nodes.items())}.</p>'
    if "shear_traction_y" in run.members("/static_contact"):
        html += page.figure(contact_maps(run), f"Static contact of {escape(run.name)}: pressure and shear traction at the contact nodes, "
                            "seen from above.")
    elif run.members("/static_contact"):
        html += page.figure(contact_tractions(run), f"Static contact of {escape(run.name)}: pressure and shear traction along "
                            "the contact. Thin: of the nodes; thick: mean of a node and its neighbours.")
    if not rows and not run.members("/static_contact"):
        raise Missing(f"{run.name} holds no static contact")
    return html


def _pascal(value):
    return quantity(value, "Pa") if isinstance(value, (int, float)) else "–"


def contact_tractions(run):
    x, pressure, shear = run.need(*(f"/static_contact/{name}" for name in ("x", "pressure", "shear_traction")))
    factor, unit = scaled(pressure, shear, units=STRESSES)
    figure, (axes,) = panels(1, 3.3)
    for values, label, c in ((pressure, "pressure", BLUE), (np.abs(shear), "|shear traction|", ORANGE)):
        smooth = np.convolve(np.pad(values, 1, mode="edge"), [0.25, 0.5, 0.25], mode="valid")
        axes.plot(1e3 * x, values / factor, color=c, lw=0.5, alpha=0.6)
        axes.plot(1e3 * x, smooth / factor, color=c, lw=1.8, label=label)
    axes.set(xlabel="position along the contact (mm)", ylabel=f"traction ({unit})", ylim=(0, None))
    axes.margins(x=0)
    above(axes)
    return figure


def contact_maps(run):
    x, y, pressure, *shear = run.need(*(f"/static_contact/{name}" for name in ("x", "y", "pressure", "shear_traction", "shear_traction_y")))
    values = (("pressure", pressure), ("|shear traction|", np.hypot(*shear)))
    factor, unit = scaled(pressure, units=STRESSES)
    below = np.ptp(x) > 2 * np.ptp(y)  # else side by side
    figure, axes = plt.subplots(*((2, 1) if below else (1, 2)), figsize=(WIDTH, 4.6 if below else 3.6), sharex=True, sharey=True)
    for axis, (label, value) in zip(axes, values):
        colours = axis.tripcolor(1e3 * x, 1e3 * y, value / factor, shading="gouraud", vmin=0)
        figure.colorbar(colours, ax=axis, label=f"{label} ({unit})", location="right" if below else "bottom")
        axis.set(aspect="equal")
    for axis in axes[-1:] if below else axes:
        axis.set_xlabel("x (mm)")
    for axis in axes if below else axes[:1]:
        axis.set_ylabel("y (mm)")
    return figure


def friction_law(page, run):
    """All estimates of mu_homo and delta; the proposed pair first."""
    summary = run.summary
    head = "; ".join(f"{words} {text}" for words, text in (
        ("proposed μ<sub>homo</sub> =", number(summary.get("mu_homo")) if run.number("mu_homo") is not None else ""),
        ("δ =", quantity(run.number("delta"), "s") if run.number("delta") is not None else "")) if text)
    rows = []
    for entry in summary["estimates"]:
        if isinstance(entry, dict):
            rows.append([escape(entry.get("pressures", "–")), escape(entry.get("duration_of", "–")), number(entry.get("mu_homo")),
                         *quantities([entry.get(key) for key in ("mean_contact_duration", "delta", "delta_calibrated")], "s")])
    html = f"<h3>{escape(run.name)}</h3>" + (f"<p>{head[0].upper() + head[1:]}.</p>" if head else "")
    html += table(["pressures from", "T<sub>G</sub> of", "μ<sub>homo</sub>", "T<sub>G</sub>", "δ", "δ, calibrated"], rows, (0, 1))
    warning = summary.get("delta_warning")
    return html + (f'<p class="note">Warning: {escape(warning)}.</p>' if isinstance(warning, str) else "")
