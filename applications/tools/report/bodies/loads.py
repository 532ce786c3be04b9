"""Macroscopic loads of rve_homogenization: stresses in the volume under each load, and how they are distributed in the phases."""

import os

import h5py
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from report.base.data import Missing
from report.base.figures import BLACK, DASHES, RUN_COLOURS, STRESSES, above_all, panels, scaled
from report.base.page import escape, number, quantities, table
from report.base.words import CONDITIONS
from report.bodies import mesh_maps
from report.bodies.maps import whole_view
from report.bodies.projections import Group, draw
from report.bodies.stress_maps import DIFFERENCE_MAP, STRESS_MAP

COMPONENTS = {2: ("xx", "yy", "xy"), 3: ("xx", "yy", "zz", "yz", "xz", "xy")}
COLOURS = [BLACK, *RUN_COLOURS]


def symbol(component, of="σ"):
    return f"{of}<sub>{component}</sub>"


def loads_of(run):
    """The entries of the summary that are as they should be, of each load the conditions from the softest to the stiffest."""
    loads = run.summary.get("loads") if isinstance(run.summary.get("loads"), list) else []
    loads = [load for load in loads if isinstance(load, dict) and {"name", "condition", "strain", "stress", "phases"} <= set(load)]
    names = [load["name"] for load in loads]
    return sorted(loads, key=lambda load: (names.index(load["name"]), CONDITIONS.index(load["condition"]) if load["condition"] in CONDITIONS else 9))


def state(load, of, unit, factor):
    values = without_round_off(load[of])
    return ", ".join(f"{symbol(c, 'ε' if of == 'strain' else 'σ')} {number(values[c] / factor + 0.0, 4)}" for c in
                     COMPONENTS[2 if len(values) == 3 else 3]) + f" {unit}"


def without_round_off(components):
    """{component: value} with 0 for what is below 1e-12 of the largest."""
    largest = max(abs(value) for value in components.values())
    return {name: value if abs(value) >= 1e-12 * largest else 0.0 for name, value in components.items()}


def tables(page, run):
    """Macroscopic states, and what they do to the phases."""
    states, phases = [], []
    for load in loads_of(run):
        label = [escape(load["name"]), escape(load["condition"])]
        residual = max(load.get(f"{of}_residual") or 0 for of in ("mean_strain", "mean_stress", "hill_mandel"))
        states.append(label + [state(load, "strain", "10<sup>−3</sup>", 1e-3), state(load, "stress", "MPa", 1e6), number(residual, 2)])
        for phase, of_phase in load["phases"].items():
            mises = (of_phase or {}).get("von_mises")
            if not mises:
                continue
            share = ((load.get("share_beyond_limit") or {}).get("von_mises") or {}).get(phase)
            place = ", ".join(number(1e3 * x, 3) for x in mises["maximum_at"])
            phases.append(label + [escape(phase), *(mises[key] for key in ("mean", "standard_deviation", "maximum")), place,
                                   of_phase["principal_1"]["maximum"], f"{100 * share:.2f} %" if share is not None else "–"])
    for column in (3, 4, 5, 7):  # each in one unit
        for row, shown in zip(phases, quantities([row[column] for row in phases], "Pa", 3)):
            row[column] = shown
    text = table(["load", "condition", "macroscopic strain", "macroscopic stress", "residual"], states, (0, 1, 2, 3))
    if phases:
        text += table(["load", "condition", "phase", "von Mises: mean", "deviation", "maximum", "there (mm)", "σ<sub>1</sub>: maximum",
                       "beyond the limit"], phases, (0, 1, 2))
    return f"<h3>{escape(run.name)}</h3>" + text + (
        '<p class="lead">Means, standard deviations and extremes of cell means. The residual is the largest of those of the mean strain, the '
        "mean stress and Hill’s condition. In plane strain σ<sub>zz</sub> counts in von Mises and principal stresses.</p>")


def fields_of(run, load):
    """{dataset: values} of a load: the cells in their order, in one row; and the histograms {phase: (edges, shares)} of the von Mises
    stress."""
    path = os.path.join(run.folder, "loads.h5")
    try:
        with h5py.File(path, "r") as file:
            group = file["loads"][load["name"]][load["condition"]]
            n = file["phase/id"].size
            fields = {name: group[name][()].reshape(n, -1) for name in ("stress", "von_mises") if name in group}
            names = [name.decode().rstrip("\0") for name in file["quantity/stress"][()]]
            histograms = {}
            for phase, values in group.get("histogram", {}).items():
                histograms[phase] = {name: (values["stress_edges"][k], values["stress_share"][k]) for k, name in enumerate(names)}
    except (OSError, KeyError) as error:
        raise Missing(f"{path} has no fields of {load['name']}, {load['condition']} ({error})") from error
    return fields, histograms


def signed_limits(values):
    """Symmetric about zero where both signs are there, and the map of colours."""
    low, high = np.percentile(values, [0.5, 99.5])
    if low < 0 < high:
        return (-max(-low, high), max(-low, high)), DIFFERENCE_MAP
    return (low, high) if low < high else (low - 0.5, low + 0.5), STRESS_MAP


def maps(run, load):
    """Of a plane grid all components and the von Mises stress, of others the one that the load is largest in and the von Mises stress."""
    fields, _ = fields_of(run, load)
    if "stress" not in fields:
        raise Missing(f"loads.h5 of {run.name} holds no fields (Write fields = false)")
    dim = run.summary.get("dim")
    names = COMPONENTS[dim]
    shown = [(f"$\\sigma_{{{name}}}$", fields["stress"][:, k]) for k, name in enumerate(names)]
    if dim == 3 or run.members("/mesh"):
        shown = [shown[max(range(len(names)), key=lambda k: abs(load["stress"][names[k]]))]]
    if "von_mises" in fields:
        shown.append(("von Mises", fields["von_mises"][:, 0]))
    groups = []
    for title, values in shown:
        limits, colours = ((0, np.percentile(values, 99.5)), STRESS_MAP) if title == "von Mises" else signed_limits(values)
        factor, unit = scaled(np.array(limits), units=STRESSES)
        groups.append(Group(values / factor, colours, tuple(limit / factor for limit in limits), "", f"{title} ({unit})"))
    return draw(mesh_maps.views(run) if run.is_mesh_like() else [whole_view(run)], groups)


def histograms(run, load):
    """Densities of the von Mises and the largest principal stress in each phase."""
    _, found = fields_of(run, load)
    names = [name for name in ("von_mises", "principal_1") if all(name in of for of in found.values())] or [
        f"stress_{c}" for c in COMPONENTS[run.summary.get("dim")]]
    if not found:
        raise Missing(f"loads.h5 of {run.name} holds no histograms (Histogram bins = 0)")
    figure, axes = panels(len(names), 2.6 * len(names))
    titles = {"von_mises": "von Mises stress", "principal_1": "largest principal stress"}
    for axis, name in zip(axes, names):
        factor, unit = scaled(*(of[name][0] for of in found.values()), units=STRESSES)
        for k, (phase, of) in enumerate(found.items()):
            edges, share = of[name]
            axis.stairs(share / np.diff(edges) * factor, edges / factor, color=COLOURS[k % len(COLOURS)], ls=DASHES[k % len(DASHES)], lw=1.5)
        axis.set(xlabel=f"{titles.get(name, name.replace('_', ' '))} ({unit})", ylabel=f"density (1/{unit})")
        axis.set_ylim(bottom=0)
        axis.xaxis.set_major_locator(MaxNLocator(6))
    above_all(figure, [Line2D([], [], color=COLOURS[k % len(COLOURS)], ls=DASHES[k % len(DASHES)], lw=1.5, label=phase)
                       for k, phase in enumerate(found)])
    return figure


def load_maps(page, run, load):
    middle = ", in the planes through the middle" if run.summary.get("dim") == 3 else ""
    return page.figure(maps(run, load), f"Stresses in {escape(run.name)} under the load {escape(load['name'])}, {escape(load['condition'])}{middle}: "
                                        f"{state(load, 'stress', 'MPa', 1e6)} on average. Colour scales end at the 0.5th and 99.5th percentile.")


def load_histograms(page, run, load):
    return page.figure(histograms(run, load), f"How stresses of the cells are distributed in each phase under {escape(load['name'])}, "
                                              f"{escape(load['condition'])}, by volume; the area under each line is 1.")


def parts(runs):
    """(function, arguments...) of the section."""
    result = []
    for run in runs:
        result.append((tables, run))
        for load in loads_of(run):
            result += [(load_maps, run, load), (load_histograms, run, load)]
    return result
