"""What was run: programs, files, sizes, times, and warnings of runs without key numbers."""

from report.base.data import HDF5_NAMES, HDF5_OF_ANALYSIS, Missing
from report.base.page import escape, number, quantity, table
from report.runs import key_numbers

# Text files that runs leave, and what a link to them says.
FILES = ["original.prm", "log.txt", "summary.json", "history.csv", "energy.csv", "stiffness.csv", "engineering_constants.csv", "probes.csv",
         "field_errors.csv", "complex_modes.csv", "complex_modes_sweep.csv", "loads.csv", "map.csv"]
# HDF5 and ParaView.
FIELDS = ["loads.h5", "counter_body.h5", "rve.xdmf", "dynamics.xdmf", "dynamics-phases.xdmf", "counter_body.xdmf", "localization.xdmf", "loads.xdmf", "modal.xdmf"]


def runs_table(page, chain):
    if not chain.runs:
        raise Missing("no result folder could be read")
    rows, files = [], []
    for run in chain.runs:
        name = f'<span class="name">{escape(run.name)}</span>'
        step = run.number("time_step")
        seconds = run.number("seconds", "total")
        processes, date, prm = run.started() or ("–", "–", "")
        rows.append([name, escape(kind_of(run, chain)), cells_of(run), steps_of(run),
                     quantity(run.number("simulated_time"), "s") if step else "–",
                     f"{number(seconds, 3)} s" if seconds is not None else "n/a",
                     quantity(run.number("peak_memory_bytes"), "B", 3), escape(date)])
        command = f"{escape(run.program)} {escape(prm)}" + (f", {escape(processes)}" if processes != "–" else "")
        listed = [HDF5_OF_ANALYSIS.get(run.summary.get("analysis"), HDF5_NAMES[run.program]), *FILES, *FIELDS]
        links = [page.link(run.file_path(file), file) for file in listed if file]
        files.append([name, command if prm else escape(run.program), " · ".join(link for link in links if link) or "–"])
    body = table(["folder", "program", "cells", "steps", "simulated", "wall time", "memory", "begun"], rows, (0, 1))
    body += table(["folder", "command", "files (.xdmf: for ParaView)"], files, (0, 1, 2))
    versions = sorted({str(run.summary.get("version")) for run in chain.runs})
    body += f'<p class="lead">Program version {escape(", ".join(versions))}. Links lead to the folders beside this page.</p>'
    return body + "".join(key_numbers.warnings(run) for run in chain.runs if run not in chain.transient)


def kind_of(run, chain):
    what = run.program.replace("_", " ")
    if run.program == "contact_dynamics":
        material = run.kind if run in chain.transient else run.summary.get("material")
        what += "".join(f", {word}" for word in (material, run.summary.get("analysis")) if word)
    return what


def cells_of(run):
    grid = run.grid()
    return " × ".join(number(int(n)) for n in grid[0]) if grid else number(run.summary["cells"]) if run.summary.get("cells") else "–"


def steps_of(run):
    step, limit = run.number("time_step"), run.number("critical_time_step")
    steps = f"{number(run.number('steps'))} × {quantity(step, 's', 3)}" if step else "–"
    return steps + (f"<br>({100 * step / limit:.0f} % of critical)" if step and limit else "")
