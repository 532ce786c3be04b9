"""Section on the modes of steady sliding: which grow, where, and over what is swept."""

import csv
import os

import numpy as np

from report.base.data import Missing
from report.base.figures import BLUE, GREY, ORANGE, panels
from report.base.page import escape, number, quantity, table
from report.bodies import mode_shapes

LABELS = {"friction_coefficient [-]": "friction coefficient", "friction_coefficient_factor [-]": "factor of all friction coefficients",
          "regularization_time [s]": "regularization time (s)",
          "velocity [m/s]": "velocity (m/s)", "pressure [Pa]": "pressure (Pa)", "normal_stiffness [Pa/m]": "stiffness of the contact (Pa/m)"}


def complex_modes(page, run):
    """Table of the modes, growth along the frequency, and curves of a sweep."""
    modes = run.summary.get("complex_modes")
    if not isinstance(modes, list):
        raise Missing(f"the summary of {run.name} holds no complex modes")
    highest, missing = run.number("highest_frequency"), run.summary.get("missing_modes")
    counted = run.summary.get("largest_growth_rate_counted")
    known = {0: "The argument principle counts no others.",
             None: f"What grows faster than {number(counted)} 1/s was not counted." if counted else "They were not counted."}.get(
                 missing, f"The argument principle counts {missing} more that the search did not find.")
    what = "mode" if len(modes) == 1 else "modes"
    html = f"<h3>{escape(run.name)}</h3>" + (f'<p class="lead">{len(modes)} {what} up to {quantity(highest, "Hz")}. {known}</p>'
                                              if highest is not None else "")
    phases = list(run.summary.get("contact_phases") or {})
    rows = [[str(k + 1), quantity(mode["frequency"], "Hz"), number(mode["growth_rate"]), number(mode.get("growth_by_friction")),
             number(mode.get("growth_by_damping"))] + [text for phase in phases for text in part_of(mode, phase)]
            for k, mode in enumerate(modes[:30])]
    html += table(["mode", "frequency", "growth rate (1/s)", "by friction", "by damping"]
                  + [text for phase in phases for text in (f"by friction of {escape(phase)}", f"motion of {escape(phase)} (%)")], rows)
    if phases:
        shares = ", ".join(f"{escape(phase)} {number(100 * run.summary['contact_phases'][phase])} %" for phase in phases)
        html += f"<p>The contact that slides: {shares}. Motion: share of the mean square motion of the contact along the flat.</p>"
    if modes:
        html += page.figure(spectrum(modes), f"Modes of steady sliding of {escape(run.name)}: growth rate over frequency.")
    if run.members("/complex_modes"):
        html += page.figure(shapes(run), f"Fastest growing modes of {escape(run.name)} at the phase with the most in the real part: {mode_shapes.caption(run)}")
    if isinstance(run.summary.get("sweep"), list):
        html += page.figure(sweep(run), f"Frequency and growth rate of the modes of {escape(run.name)} over what is swept; curves join "
                            "modes of like shapes.")
    return html


def part_of(mode, phase):
    """What the friction of a phase adds to the growth of a mode, and its share of the motion in per cent."""
    part = (mode.get("phases") or {}).get(phase) or {}
    return [number(part.get("growth_by_friction")), number(100 * part["motion"] if "motion" in part else None)]


def spectrum(modes):
    figure, (axes,) = panels(1, 3.0)
    frequency, growth = (np.array([mode[key] for mode in modes]) for key in ("frequency", "growth_rate"))
    for picked, c in ((growth > 0, ORANGE), (growth <= 0, BLUE)):
        axes.vlines(1e-3 * frequency[picked], 0, growth[picked], color=c, lw=1.5)
        axes.plot(1e-3 * frequency[picked], growth[picked], "o", color=c, ms=4)
    axes.axhline(0, color=GREY, lw=0.8)
    axes.set(xlabel="frequency (kHz)", ylabel="growth rate (1/s)", xlim=(0, None))
    return figure


def shapes(run, shown=3):
    """Of the modes that grow fastest; they come first."""
    of_body = lambda body: [body.get(f"/complex_modes/shape_{part}", slice(0, shown)) for part in ("real", "imaginary")]
    parts, lower = of_body(run), run.below()
    frequency, growth = run.need("/complex_modes/frequency", "/complex_modes/growth_rate")
    if any(part is None or part.ndim < 3 or not len(part) for part in parts):
        raise Missing(f"{run.name} holds no shapes of modes")
    titles = [f"{1e-3 * f:.2f} kHz, growth rate {g:.4g} 1/s".replace("-", "−") for f, g in zip(frequency, growth)]
    others = of_body(lower) if lower else []
    below = (lower, others[0] + 1j * others[1]) if lower and all(part is not None for part in others) else None
    return mode_shapes.figure(run, [(titles, parts[0] + 1j * parts[1])], shown, below)


def sweep(run):
    try:
        with open(os.path.join(run.folder, "complex_modes_sweep.csv"), encoding="ascii") as file:
            columns, *rows = list(csv.reader(file))
        rows = [[float(cell) for cell in row] for row in rows]
    except (OSError, ValueError) as error:
        raise Missing(f"the sweep of {run.name} is unreadable ({error})") from error
    if not rows:
        raise Missing(f"the sweep of {run.name} holds no modes")
    value, curve, frequency, growth = np.array(rows)[:, :4].T
    figure, axes = panels(2, 6.0)
    for k in np.unique(curve):
        of_curve = curve == k
        style = {"lw": 1.5, "color": None} if growth[of_curve].max() > 0 else {"lw": 0.8, "color": GREY}
        line, = axes[0].plot(value[of_curve], 1e-3 * frequency[of_curve], ".-", ms=3, **style)
        axes[1].plot(value[of_curve], growth[of_curve], ".-", ms=3, lw=style["lw"], color=line.get_color())
    axes[1].axhline(0, color=GREY, lw=0.8)
    for axis, label in zip(axes, ("frequency (kHz)", "growth rate (1/s)")):
        axis.set(xlabel=LABELS.get(columns[0], columns[0]), ylabel=label, xscale="log" if columns[0].startswith("normal_stiffness") else "linear")
    return figure
