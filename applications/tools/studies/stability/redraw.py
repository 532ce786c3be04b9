"""The pictures from the tables beside them, and the tables of curves that are kept for that alone."""

import csv
import os
import types

import limit
import numpy as np
import plots
import sensitivity
from pages import save_picture, write_csv

POINTS = 500  # of a curve that is kept


def rows_of(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def draw(folder, name, figure):
    save_picture(figure, folder, name, colours=64, dpi=100)


def keep_drift(folder, curves):
    """Writes million_steps_drift.csv: `curves` {case: (step [k], residual [k])} at steps whose logarithms are equally far apart; returns it as
    it is read."""
    count = min(len(step) for step, _ in curves.values())
    picked = np.unique(np.geomspace(1, count - 1, POINTS).astype(int))
    steps = next(iter(curves.values()))[0][picked]
    write_csv(folder, "million_steps_drift.csv", ["step [-]", *curves],
              [[step, *(f"{residual[k]:.4g}" for _, residual in curves.values())] for step, k in zip(steps, picked)])
    return kept_drift(folder)


def kept_drift(folder):
    rows = rows_of(folder, "million_steps_drift.csv")
    steps = np.array([float(row["step [-]"]) for row in rows])
    return {case: (steps, np.array([float(row[case]) for row in rows])) for case in rows[0] if case != "step [-]"}


def keep_figure_five(folder, nodes):
    """Writes figure_5.csv and figure_5_spectrum.csv: the last part of the record of `nodes` {(delta, h): refinement.Node}, thinned, and their
    spectra; returns them as they are read."""
    series, spectra = [], []
    for (delta, h), node in nodes.items():
        late = np.flatnonzero(node.time > node.time[-1] - plots.LAST)
        for k in late[:: max(1, len(late) // POINTS)]:
            series.append([delta, h, f"{node.time[k]:.9g}", f"{node.displacement[k]:.5g}", f"{node.velocity[k]:.5g}"])
        frequency, amplitude = node.spectrum
        spectra += [[delta, h, f"{f:.7g}", f"{a:.4g}"] for f, a in zip(frequency, amplitude) if f < plots.SPECTRUM_TO]
    write_csv(folder, "figure_5.csv", ["delta [s]", "h [mm]", "time [s]", "u_x [m]", "v_x [m/s]"], series)
    write_csv(folder, "figure_5_spectrum.csv", ["delta [s]", "h [mm]", "frequency [Hz]", "amplitude of u_x [m]"], spectra)
    return kept_figure_five(folder)


def kept_figure_five(folder):
    nodes = {}
    for file in ("figure_5.csv", "figure_5_spectrum.csv"):
        for row in rows_of(folder, file):
            values = [float(value) for value in row.values()]
            nodes.setdefault((values[0], values[1]), {}).setdefault(file, []).append(values[2:])
    found = {}
    for case, tables in nodes.items():
        time, displacement, velocity = np.array(tables["figure_5.csv"]).T
        found[case] = types.SimpleNamespace(time=time, displacement=displacement, velocity=velocity,
                                            spectrum=np.array(tables["figure_5_spectrum.csv"]).T)
    return found


def pictures(folder):
    """Redraws what there are tables for."""
    known = lambda text: float(text) if text else None
    sweep = {(float(row["beta2 [-]"]), float(row["time step / critical [-]"])): row["outcome"] for row in rows_of(folder, "time_step_sweep.csv")}
    limits = [limit.Limit(row["body"], *(float(row[key]) for key in ("beta2 [-]", "beta [s]", "predicted [s]")),
                          *(float(row[key]) / float(row["predicted [s]"]) for key in ("largest stable [s]", "smallest unstable [s]")))
              for row in rows_of(folder, "time_step.csv")]
    draw(folder, "time_step.png", plots.time_step(sweep, limits))
    draw(folder, "energy.png", plots.energy_residuals([(row["group"], row["outcome"], known(row["energy balance error [-]"])) for row in rows_of(folder, "stress.csv")]))
    numbers = {(1e-9 * float(row["beta [ns]"]), 1e-9 * float(row["delta [ns]"]), float(row["h [mm]"])):
               {name: known(value) for name, value in row.items()} for row in rows_of(folder, "refinement.csv")}
    draw(folder, "refinement.png", plots.refinement_numbers(numbers))
    draw(folder, "sensitivity.png", plots.sensitivity(_sensitivity(folder), sensitivity.PAPER))
    if os.path.exists(os.path.join(folder, "million_steps_drift.csv")):
        draw(folder, "million_steps.png", plots.drift(kept_drift(folder)))
    if os.path.exists(os.path.join(folder, "figure_5.csv")):
        draw(folder, "figure_5.png", plots.figure_five(kept_figure_five(folder)))


def _sensitivity(folder):
    """{(parameter, value): {result: (mean, half of the range)}}"""
    with open(os.path.join(folder, "sensitivity.csv"), encoding="utf-8", newline="") as file:
        headings, *rows = csv.reader(file)
    return {(row[0], float(row[1])): {headings[k]: (float(row[k]), float(row[k + 1])) for k in range(2, len(row), 2)} for row in rows}
