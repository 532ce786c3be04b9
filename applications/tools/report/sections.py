"""What the report says, in order: headings and the functions that write their parts."""

from report.base import figures
from report.base.common_scales import comparable, same_scale
from report.base.page import escape, quantities, quantity
from report.bodies import contact_surface, field_errors, fields, loads, maps, mesh_maps
from report.bodies import points as volumes
from report.runs import analyses, complex_modes, contact_states, energies, heat, key_numbers, paper, probes, reference_node, sweep_map, verdict, vibrating_modes, waves, what_was_run


def plan(chain, surface_times=()):
    """(heading, [(function, arguments...)]) of every section that the runs of the chain call for, with lists of those parts that stand in a
    row; contact surfaces in 3D are shown at `surface_times` (s), of the last periods if there are none."""
    result = [("In short", [(verdict.verdict, chain)])] if verdict.verdict(None, chain) else []
    result.append(("What was run", [(what_was_run.runs_table, chain)]))
    if chain.transient:
        result.append(("Key numbers", [(key_numbers.side_by_side, chain.transient)]))
    pins = [run for run in chain.transient + chain.modal + chain.static if paper.is_pin(run)]
    if pins:
        result.append(("Beside the paper", [(key_numbers.beside_the_paper, run) for run in pins]))
    if chain.rve:
        result.append(("Stiffness", [(key_numbers.stiffness_table, run) for run in chain.rve]))
    warm = [run for run in chain.rve if heat.is_there(run)]
    if warm:
        result.append(("Expansion and conductivity", [(heat.heat, run) for run in warm]))
    shown = fields.parts(chain)
    if shown:
        result.append(("Morphology and von Mises stress", shown))
    loaded = [run for run in chain.rve if loads.loads_of(run)]
    if loaded:
        result.append(("Macroscopic loads", loads.parts(loaded)))
    if chain.transient:
        result += transient_sections(chain.transient, surface_times)
    alone = lambda runs: [(run,) for run in runs]  # noqa: E731
    for heading, make, parts in [("Map", sweep_map.maps, alone(chain.maps)), ("Modes of vibration", analyses.modes, alone(chain.modal)),
                                 ("Modes of steady sliding", complex_modes.complex_modes, alone(chain.complex)),
                                 ("Modes that vibrate", vibrating_modes.vibrating_modes, vibrating_modes.pairs(chain)),
                                 ("Static contact", analyses.static_contact, alone(chain.static)),
                                 ("Homogenized friction law", analyses.friction_law, alone(chain.friction_law)),
                                 ("Localization", probes.localization, alone(chain.localization))]:
        if parts:
            result.append((heading, [(make, *part) for part in parts]))
    if chain.localization:
        surfaces = [(localized_pressure, run, chain.dynamics) for run in chain.localization
                    if run.is_solid() and run.get("/mean_stress") is not None]
        means = [(mean_von_mises, run, chain.dynamics) for run in chain.localization]
        result.append(("Mean von Mises stress: localized and direct", means + surfaces))
    return result


def transient_sections(runs, surface_times):
    regime = paper.regime(runs[0]) if all(paper.is_pin(run) for run in runs) else None
    return [
        ("Apparent friction", [(apparent_friction, runs, regime)]),
        ("Energy", [(friction_energy, runs), [(energy_balance, run) for run in runs]]),
        ("Phase diagram", [(phase_diagram, runs), [(reference_node.loops, run) for run in runs]]),
        ("Spectrum", [(spectrum, runs, regime)]),
        ("The contact, node by node", contact_parts(runs, surface_times)),
    ]


def contact_parts(runs, surface_times):
    solid = [run for run in runs if run.has_surface()]
    plane = [run for run in runs if run not in solid]
    pressed = [run for run in solid if run.members("/snapshots") and run.get("/contact/pressure") is None]
    rows = [[(contact_shares, run) for run in solid], [(contact_pressure, run, comparable(run, pressed)) for run in pressed],
            [(contact_map, run) for run in runs],
            [(node_fractions, run) for run in runs if "sticking_nodes" in run.members("/history")], *waves.rows(runs, surface_times)]
    return ([(node_statistics, plane)] if plane else []) + [row for row in rows if row]


def apparent_friction(page, runs, regime):
    value, _ = paper.APPARENT_FRICTION.get(regime, (None, None))
    dashed = f" Black: the mean of the paper’s figure 6, {value}, regime {regime}." if value is not None else ""
    return page.figure(figures.apparent_friction(runs, value),
                       "Apparent friction coefficient: tangential over normal force on the top, which vibrates with the body. "
                       f"Dashed in the colour of a run: its mean over the steady part.{dashed}")


def friction_energy(page, runs):
    figure, end = energies.friction_energy(runs)
    common = f" Shown up to {quantity(end, 's')}, the end of the shortest run; the slopes are those of the whole steady parts." if end else ""
    return page.figure(figure,
                       f"Frictional energy{per_thickness(runs)}; its slope over the steady part (dotted) gives the global interface "
                       f"friction coefficient by eq. (9) of the paper.{common}")


def per_thickness(runs):
    return ", per metre of thickness" if any(run.per_thickness() for run in runs) else ""


def energy_balance(page, run):
    figure, left_out = energies.energy_balance(run)
    absent = f" Not drawn, as below 0.01 % of the largest: {', '.join(left_out)}." if left_out else ""
    return page.figure(figure, f"Energy balance of the {escape(run.label)} run{per_thickness([run])}. Every term comes from its own formula; below, "
                               f"the terms that are small beside the largest, and what remains of the balance, over the frictional energy at the "
                               f"end or, where there is hardly any, the largest energy in the body.{absent}{energies.note_on_sampling(run)}")


def phase_diagram(page, runs):
    return page.figure(figures.phase_diagram(runs),
                       "Phase diagram of the reference node, which is in the middle of the contact unless Observation/Reference x says otherwise: its "
                       "velocity along the flat over its displacement along the "
                       "flat, mean over the periods of the steady part. A vibration at one frequency draws an ellipse. Loops come from "
                       "overtones, as of a body that hops.")


def spectrum(page, runs, regime):
    lengths = quantities([run.steady_length() for run in runs], "s", 3)
    windows = ", ".join(f"{escape(run.label)} {length}" for run, length in zip(runs, lengths))
    value, source = paper.MAIN_FREQUENCY.get(regime, (None, None))
    dashed = f" Dashed: the paper’s main frequency ({source})." if value is not None else ""
    return page.figure(figures.spectrum(runs, value),
                       "Amplitude spectrum of the displacement of the reference node along the flat, over the steady part. The highest peak is "
                       f"the main frequency of the key numbers. A peak is about as wide as one over the length of this part, or wider: "
                       f"{windows}.{dashed}")


def node_statistics(page, runs):
    return page.figure(contact_states.node_statistics(runs),
                       "Shares of time each contact node slips, sticks and is separated, over the steady part.")


def contact_shares(page, run):
    figure, absent = contact_surface.shares(run)
    words = f" Not shown, as it never occurs: {', '.join(absent)}." if absent else ""
    return page.figure(figure,
                       f"Shares of time that the contact nodes of the {escape(run.label)} run slip, stick and are separated over the "
                       "steady part, in per cent, on the contact surface seen along z. Each node colours its part of the faces "
                       f"around it; the means are those of the nodes.{words}")


def contact_pressure(page, run, runs):
    figure, count = contact_surface.pressure(run, runs)
    nominal = contact_surface.nominal_pressure(run)
    words = f" The normal force on the contact, mean over all of the steady part, is "\
            f"{quantity(nominal, 'Pa')} per area." if nominal is not None else ""
    return page.figure(figure, f"Pressure on the contact surface of the {escape(run.label)} run, seen along z: the elastic stress "
                               "−σ<sub>zz</sub> in the middle of the cells at the contact, mean over the snapshots of the steady part "
                               f"({count} of them). The colour scale ends at the 0.5th and 99.5th percentiles and holds zero.{same_scale(runs, 'It is')}{words}")


def contact_map(page, run):
    what = "means of strips of the contact surface across the motion of the flat" if run.has_surface() else "every contact node"
    figure, why = contact_states.contact_map(run)
    absent = f" The last periods are not shown enlarged, as {why}." if why else ""
    return page.figure(figure,
                       f"Contact states of the {escape(run.label)} run: {what} over time; colours "
                       "mix where a node changes its state within a block of steps" +
                       (" or the nodes of a strip differ." if run.has_surface() else ".") + absent)


def node_fractions(page, run):
    figure, stretch = contact_states.fractions(run)
    means = f" Over the whole run the curves are means over {quantity(stretch, 's', 3)}." if stretch else ""
    return page.figure(figure, f"Shares of the contact nodes of the {escape(run.label)} run that slip, stick and are separated, over time.{means}")


def mean_von_mises(page, run, dynamics):
    module = mesh_maps if run.is_mesh_like() else maps
    points = page.row(page.figure(module.point_von_mises(run, name),
                                 f"Von Mises stress averaged over time in the volume element at the point {escape(name)} of the body." +
                                 field_errors.window(run, dynamics))
                     for name in run.members("/points"))
    points += volumes.comparison(run, dynamics) if run.members("/points") else ""
    if run.get("/mean_von_mises") is None and run.members("/points"):
        return points
    return points + whole_body(page, run, module, dynamics)


def whole_body(page, run, module, dynamics):
    figure, error = module.mean_von_mises(run)
    words = f" Relative L2 difference over all cells: {100 * error:.1f} %." if error is not None else \
        " No direct run was compared."
    caption = f"Von Mises stress averaged over time{fields.sections_of(run)}{of_runs(run)}.{words}{field_errors.window(run, dynamics)}"
    return page.figure(figure, caption) + field_errors.field_errors(run)


def of_runs(run):
    """What the titles of the panels stand for."""
    if run.get("/direct/mean_von_mises") is None:
        return ", localized from the homogeneous run"
    return ": localized from the homogeneous run, direct from the heterogeneous run, and the difference of both"


def localized_pressure(page, run, dynamics):
    figure, error = contact_surface.localized_pressure(run, dynamics)
    words = f" Relative L2 difference over these cells: {100 * error:.1f} %." if error is not None else ""
    return page.figure(figure, "Pressure on the contact surface, seen along z: the stress −σ<sub>zz</sub> in the cells at the contact, "
                               f"averaged over time{of_runs(run)}. The colour scales end at the 0.5th and 99.5th percentiles."
                               f"{words}{field_errors.window(run, dynamics)}")
