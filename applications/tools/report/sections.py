"""What the report says, in order: headings and the functions that write their parts."""

import numpy as np

import analyses
import complex_modes
import contact_surface
import energies
import figures
import key_numbers
import loads
import maps
import mesh_maps
import paper
import waves
from data import Missing
from page import difference, escape, number, quantity, table


def plan(chain):
    """(heading, [(function, arguments...)]) of every section that the runs of the chain call for."""
    result = [("What was run", [(runs_table, chain)])]
    if chain.transient:
        result.append(("Key numbers", [(key_numbers.side_by_side, chain.transient)]))
    pins = [run for run in chain.transient + chain.modal + chain.static if paper.is_pin(run)]
    if pins:
        result.append(("Beside the paper", [(key_numbers.beside_the_paper, run) for run in pins]))
    if chain.rve:
        result.append(("Stiffness", [(stiffness_table, run) for run in chain.rve]))
    on_mesh = [run for run in chain.rve if run.is_mesh_like()]
    on_grid = [run for run in chain.rve if run not in on_mesh]
    on_plane = [run for run in chain.runs if run.heterogeneous and run.grid() and not run.is_mesh_like()]
    fields = [(morphology, chain)] if on_grid or on_plane else []
    fields += [(rve_stress, run) for run in on_grid if run.members("/concentration")]
    fields += [(make, run) for run in on_mesh for make in (mesh_morphology, mesh_stress)[: 1 + bool(run.members("/concentration"))]]
    if not on_mesh:
        fields += [(phases_of_run, run) for run in chain.dynamics if run.heterogeneous and run.is_mesh_like()]
    fields += [(snapshot, run, chain) for run in chain.transient + chain.static if run.members("/snapshots")]
    if fields:
        result.append(("Morphology and von Mises stress", fields))
    loaded = [run for run in chain.rve if loads.loads_of(run)]
    if loaded:
        result.append(("Macroscopic loads", loads.parts(loaded)))
    if chain.transient:
        result += transient_sections(chain.transient)
    for heading, make, runs in [("Modes of vibration", analyses.modes, chain.modal),
                                ("Modes of steady sliding", complex_modes.complex_modes, chain.complex),
                                ("Static contact", analyses.static_contact, chain.static),
                                ("Homogenized friction law", analyses.friction_law, chain.friction_law)]:
        if runs:
            result.append((heading, [(make, run) for run in runs]))
    probed = [run for run in chain.localization if run.members("/probes") or not run.members("/mesh")]  # probes are of grids
    if probed:
        result.append(("Localization", [(localization, run) for run in probed]))
    if chain.localization:
        surfaces = [(localized_pressure, run, chain.dynamics) for run in chain.localization
                    if run.is_solid() and run.get("/mean_stress") is not None]
        result.append(("Mean von Mises stress: localized and direct", [(mean_von_mises, run) for run in chain.localization] + surfaces))
    return result


def transient_sections(runs):
    regime = paper.regime(runs[0]) if all(paper.is_pin(run) for run in runs) else None
    return [
        ("Apparent friction", [(apparent_friction, runs, regime)]),
        ("Energy", [(friction_energy, runs)] + [(energy_balance, run) for run in runs]),
        ("Phase diagram", [(phase_diagram, runs)]),
        ("Spectrum", [(spectrum, runs, regime)]),
        ("The contact, node by node", contact_parts(runs)),
    ]


def contact_parts(runs):
    solid = [run for run in runs if run.has_surface()]
    plane = [run for run in runs if run not in solid]
    pressed = [run for run in solid if run.members("/snapshots") and run.get("/contact/pressure") is None]
    return ([(node_statistics, plane)] if plane else []) + [(contact_shares, run) for run in solid] + \
        [(contact_pressure, run) for run in pressed] + [(contact_map, run) for run in runs] + waves.parts(runs)


def runs_table(page, chain):
    if not chain.runs:
        raise Missing("no result folder could be read")
    rows = []
    for run in chain.runs:
        summary = run.summary
        grid = run.grid()
        cells = " × ".join(number(int(n)) for n in grid[0]) if grid else number(summary["cells"]) if summary.get("cells") else "–"
        what = run.program.replace("_", " ")
        if run.program == "contact_dynamics":
            material = run.kind if run in chain.transient else summary.get("material")
            what += "".join(f", {word}" for word in (material, summary.get("analysis")) if word)
        step, limit = run.number("time_step"), run.number("critical_time_step")
        steps = f"{number(run.number('steps'))} × {quantity(step, 's', 3)}" if step else "–"
        if step and limit:
            steps += f"<br>({100 * step / limit:.0f} % of critical)"
        seconds = run.number("seconds", "total")
        rows.append([escape(run.name), escape(what), cells, steps,
                     quantity(run.number("simulated_time"), "s") if step else "–",
                     f"{number(seconds, 3)} s" if seconds is not None else "n/a",
                     quantity(run.number("peak_memory_bytes"), "B", 3)])
    body = table(["folder", "program", "cells", "steps", "simulated", "wall time", "memory"], rows, (0, 1))
    versions = sorted({str(run.summary.get("version")) for run in chain.runs})
    body += f'<p class="lead">Program version {escape(", ".join(versions))}.</p>'
    return body + "".join(key_numbers.warnings(run) for run in chain.runs if run not in chain.transient)


def stiffness_matrices(run):
    """{heading: stiffness (Pa)}; of an ensemble the means, as `effective` is the mean of those."""
    ensemble = run.summary.get("ensemble")
    ensemble = ensemble if isinstance(ensemble, dict) else {}
    matrices = {}
    for name in ("KUBC", "MUBC", "PBC", "SUBC", "effective"):
        mean = ensemble[name].get("mean") if isinstance(ensemble.get(name), dict) else None
        value = mean if mean is not None else run.get(f"/stiffness/{name}")
        if value is None:
            listed = run.summary.get("stiffness")
            value = listed.get(name) if isinstance(listed, dict) else None
        value = np.array(value, dtype=float) if value is not None else None
        if value is not None and value.shape in ((3, 3), (6, 6)):
            matrices[f"{name}, mean of {ensemble.get('members')}" if mean is not None else name] = value
    return matrices


def stiffness_entries(matrices):
    """(label, i, j) of the rows: those of an orthotropic body, and of the couplings of shears those that are not round-off."""
    n = len(next(iter(matrices.values())))
    dim = 2 if n == 3 else 3
    coupled = lambda i, j: any(abs(m[i, j]) > 1e-6 * np.sqrt(m[i, i] * m[j, j]) for m in matrices.values())
    shown = [(i, j) for i in range(n) for j in range(i, n)]
    plane = dim == 2 and (coupled(0, 2) or coupled(1, 2))
    return [(f"D<sub>{i + 1}{j + 1}</sub>", i, j) for i, j in shown if i == j or j < dim or plane or (dim == 3 and coupled(i, j))]


def gigapascal(value):
    """With two decimals, and no minus before what rounds to zero."""
    return f"{round(1e-9 * value, 2) + 0.0:.2f}"


def stiffness_table(page, run):
    matrices = stiffness_matrices(run)
    if not matrices:
        raise Missing(f"{run.name} holds no stiffness of 3 × 3 entries")
    compared = paper.is_pin(run)
    rows = []
    for label, i, j in stiffness_entries(matrices):
        reference = paper.STIFFNESS[i][j] if compared else 0.0
        cells = [gigapascal(matrix[i, j]) + f" <small>({difference(matrix[i, j], reference)})</small>" * (compared and reference > 0)
                 for matrix in matrices.values()]
        rows.append([label] + [gigapascal(reference)] * compared + cells)
    shares = [f"{escape(phase.get('name'))} {100 * phase['volume_fraction']:.2f} %"
              for phase in run.summary.get("phases") or []
              if isinstance(phase, dict) and isinstance(phase.get("volume_fraction"), (int, float))]
    extra = [f"Volume fractions: {', '.join(shares)}"] if shares else []
    for words, key in [("Hill–Mandel residual", "hill_mandel_residual"),
                       ("symmetry residual", "symmetry_residual")]:
        if run.number(key) is not None:
            extra.append(f"{words} {number(run.number(key), 2)}")
    order = "1 is xx, 2 is yy, 3 is the shear xy" if len(next(iter(matrices.values()))) == 3 else "1 to 6 are xx, yy, zz, yz, xz, xy"
    extra.insert(0, f"{order} (engineering strain). Theory orders SUBC ≤ PBC ≤ KUBC")
    if compared:
        extra.insert(0, "In brackets: difference from eq. (10)")
    return (f"<h3>{escape(run.name)}</h3>" + table(["GPa"] + ["paper, eq. (10)"] * compared + list(matrices), rows) +
            f'<p class="lead">{". ".join(extra)}.</p>')


def morphology(page, chain):
    return page.figure(maps.morphology(chain),
                       "Morphology of the composite: the whole body and, framed, the middle of the contact surface.")


def rve_stress(page, run):
    return page.figure(maps.rve_von_mises(run),
                       f"Von Mises stress in {escape(run.name)} under a uniform boundary strain whose mean "
                       "stress is 0.5 MPa of vertical compression alone. The colour scale ends at the 99.5th "
                       "percentile.")


def mesh_morphology(page, run):
    return page.figure(mesh_maps.morphology(run), f"Phases of {escape(run.name)}{' on their mesh' if run.members('/mesh') else ''}{sections_of(run)}.")


def phases_of_run(page, run):
    return page.figure(mesh_maps.phases_of_run(run), f"Phases of the body of {escape(run.name)}{sections_of(run)}.")


def mesh_stress(page, run):
    figure, condition = mesh_maps.von_mises(run)
    return page.figure(figure, f"Von Mises stress in {escape(run.name)} under {condition} with a strain whose mean stress is 0.5 MPa of "
                               f"compression along the last axis alone{sections_of(run)}. The colour scale ends at the 99.5th percentile.")


def sections_of(run):
    return ", in the planes through the middle" if run.summary.get("dim") == 3 or run.is_solid() else ""


def snapshot(page, run, chain):
    on_mesh = run.is_mesh_like()
    figure = mesh_maps.snapshot_von_mises(run) if on_mesh else maps.snapshot_von_mises(run, chain)
    time = run.last("/snapshots/time")
    when = f" at t = {quantity(float(time), 's')}" if time is not None else ""
    return page.figure(figure, f"Von Mises stress of the last snapshot of the {escape(run.label)} run{when}" +
                       (sections_of(run) if on_mesh else "; below, the framed part of the contact") +
                       ". The colour scale ends at the 99.5th percentile.")


def apparent_friction(page, runs, regime):
    value, _ = paper.APPARENT_FRICTION.get(regime, (None, None))
    dashed = f" Dashed: the mean of the paper’s figure 6, {value}, regime {regime}." if value is not None else ""
    return page.figure(figures.apparent_friction(runs, value),
                       "Apparent friction coefficient: tangential over normal force on the top. Thick: mean over the "
                       f"steady part.{dashed}")


def friction_energy(page, runs):
    return page.figure(energies.friction_energy(runs),
                       "Frictional energy; its slope over the steady part (dotted) gives the global interface "
                       "friction coefficient by eq. (9) of the paper.")


def energy_balance(page, run):
    return page.figure(energies.energy_balance(run),
                       f"Energy balance of the {escape(run.label)} run. Every term comes from its own formula; "
                       "below, the terms that are small beside it, and what "
                       "remains of the balance.")


def phase_diagram(page, runs):
    return page.figure(figures.phase_diagram(runs),
                       "Mean phase diagram of the tangential motion of the reference node.")


def spectrum(page, runs, regime):
    value, source = paper.MAIN_FREQUENCY.get(regime, (None, None))
    dashed = f" Dashed: the paper’s main frequency ({source})." if value is not None else ""
    return page.figure(figures.spectrum(runs, value),
                       f"Amplitude spectrum of the tangential displacement of the reference node over the steady part.{dashed}")


def node_statistics(page, runs):
    return page.figure(figures.node_statistics(runs),
                       "Shares of time each contact node slips, sticks and is separated, over the steady part.")


def contact_shares(page, run):
    return page.figure(contact_surface.shares(run),
                       f"Shares of time that the contact nodes of the {escape(run.label)} run slip, stick and are separated over the "
                       "steady part, in per cent, on the contact surface seen along z. Each node colours its part of the faces "
                       "around it; the means are those of the nodes.")


def contact_pressure(page, run):
    figure, count = contact_surface.pressure(run)
    nominal = contact_surface.nominal_pressure(run)
    words = f" The normal force on the contact, mean over all of the steady part, is "\
            f"{quantity(nominal, 'Pa')} per area." if nominal is not None else ""
    return page.figure(figure, f"Pressure on the contact surface of the {escape(run.label)} run, seen along z: the elastic stress "
                               "−σ<sub>zz</sub> in the middle of the cells at the contact, mean over the snapshots of the steady part "
                               f"({count} of them). The colour scale ends at the 0.5th and 99.5th percentiles and holds zero.{words}")


def contact_map(page, run):
    what = "means of strips of equal x of the contact surface" if run.has_surface() else "every contact node"
    return page.figure(figures.contact_map(run),
                       f"Contact states of the {escape(run.label)} run: {what} over time; colours "
                       "mix where a node changes its state within a block of steps" +
                       (" or the nodes of a strip differ." if run.has_surface() else "."))


def localization(page, run):
    names = run.members("/probes")
    if not names:
        raise Missing(f"{run.name} holds no /probes")
    listed = {str(probe.get("name")): probe for probe in run.summary.get("probes") or []
              if isinstance(probe, dict)}
    rows, html = [], f"<h3>{escape(run.name)}</h3>"
    for name in names:
        rows += probe_errors(run, name)
    if rows:
        html += table(["probe", "stress", "mean, localized", "mean, direct", "std, localized", "std, direct",
                       "L2 difference"], rows, (0, 1))
        html += '<p class="lead">L2 difference: of the signals as they stand, relative to the direct one; it exceeds 100 % where '\
                "the two runs are out of phase. Mean and standard deviation (std) do not depend on the phase."
        html += (" The paper: L2 below 4 % for σ<sub>yy</sub>, 25 % at most for the others at the surface; mean and "
                 "deviation within 5 %." if paper.is_pin(run) else "") + "</p>"
    for name in names[:6]:
        phase = listed.get(name, {}).get("phase")
        where = f", in the {escape(phase)}" if isinstance(phase, str) else ""
        position = run.probe_position(name)
        if position is not None:
            where += f", at x = {1e3 * position[0]:.2f} mm, y = {1e3 * position[1]:.2f} mm"
        try:
            html += page.figure(figures.localized_stress(run, name),
                                f"Stress at probe {escape(name)}{where}: localized against direct over the last "
                                "periods. Two runs drift out of phase, so compare level and amplitude.")
        except Missing as missing:
            html += f'<p class="note">Left out: {escape(missing)}.</p>'
    return html


def probe_errors(run, name):
    stress, direct = run.get(f"/probes/{name}/stress"), run.get(f"/probes/{name}/direct_stress")
    if stress is None or direct is None or stress.shape != direct.shape or stress.ndim != 2:
        return []
    time = run.get(f"/probes/{name}/time")
    begin = run.number("steady_from")
    if time is not None and begin is not None and len(time) == len(stress) and time[-1] > begin:
        stress, direct = stress[time >= begin], direct[time >= begin]
    rows = []
    for component, label in [(1, "σ<sub>yy</sub>"), (0, "σ<sub>xx</sub>"), (2, "σ<sub>xy</sub>")]:
        ours, theirs = stress[:, component], direct[:, component]
        norm = np.linalg.norm(theirs)
        error = f"{100 * np.linalg.norm(ours - theirs) / norm:.1f} %" if norm > 0 else "n/a"
        rows.append([escape(name), label, *(quantity(float(value), "Pa", 3) for value in
                                            (ours.mean(), theirs.mean(), ours.std(), theirs.std())), error])
    return rows


def mean_von_mises(page, run):
    module = mesh_maps if run.is_mesh_like() else maps
    points = "".join(page.figure(module.point_von_mises(run, name),
                                 f"Von Mises stress averaged over time in the volume element at the point {escape(name)} of the body.")
                     for name in run.members("/points"))
    return points + (whole_body(page, run, module) if run.get("/mean_von_mises") is not None or not points else "")


def whole_body(page, run, module):
    figure, error = module.mean_von_mises(run)
    words = f" Relative L2 difference: {100 * error:.1f} %." if error is not None else \
        " No direct run was compared."
    where = sections_of(run)
    return page.figure(figure, f"Von Mises stress averaged over time{where}{of_runs(run)}.{words}")


def of_runs(run):
    """What the titles of the panels stand for."""
    if run.get("/direct/mean_von_mises") is None:
        return ", localized from the homogeneous run"
    return ": localized from the homogeneous run, direct from the heterogeneous run, and the difference of both"


def localized_pressure(page, run, dynamics):
    figure, error = contact_surface.localized_pressure(run, dynamics)
    words = f" Relative L2 difference over these cells: {100 * error:.1f} %." if error is not None else ""
    return page.figure(figure, "Pressure on the contact surface, seen along z: the stress −σ<sub>zz</sub> in the cells at the contact, "
                               f"averaged over time{of_runs(run)}. The colour scales end at the 0.5th and 99.5th percentiles.{words}")
