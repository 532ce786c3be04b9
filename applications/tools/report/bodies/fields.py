"""Pictures of phases and of von Mises stress on grids and meshes."""

from report.base.common_scales import comparable, ends, same_scale
from report.base.page import escape, quantity
from report.bodies import maps, mesh_maps
from report.bodies.phase_colours import words_on_colours
from report.bodies.projections import draw
from report.bodies.stress_maps import highest, stress_group

PERCENTILE = "The colour scale ends at the 99.5th percentile."


def parts(chain):
    """(function, arguments...) that the runs call for, in rows."""
    on_mesh = [run for run in chain.rve if run.is_mesh_like()]
    on_grid = [run for run in chain.rve if run not in on_mesh]
    on_plane = [run for run in chain.runs if run.heterogeneous and run.grid() and not run.is_mesh_like()]
    first = [(morphology, chain)] if on_grid or on_plane else []
    rows = [first + [(rve_stress, run, chain) for run in on_grid if run.members("/concentration")]]
    rows += [[(mesh_morphology, run)] + ([(mesh_stress, run, chain)] if run.members("/concentration") else []) for run in on_mesh]
    if not on_mesh:
        rows.append([(phases_of_run, run) for run in chain.dynamics if run.heterogeneous and run.is_mesh_like()])
    return [row for row in [*rows, [(snapshot, run, chain) for run in snapshots(chain)]] if row]


def snapshots(chain):
    return [run for run in chain.transient + chain.static if run.members("/snapshots")]


def pressure_of(chain):
    """Pa; that of the first run with one, and what to call it."""
    pressure = next((run.number("pressure") for run in chain.dynamics if run.number("pressure")), None)
    return (pressure, "the pressure of the runs") if pressure else (1e6, "no run says which pressure is wanted")


def sections_of(run):
    return ", in the planes through the middle" if run.summary.get("dim") == 3 or run.is_solid() else ""


def enlarged(run):
    return "; framed, the middle of the contact, enlarged" if maps.enlarged(run) else ""


def morphology(page, chain):
    run, ids = maps.phase_map(chain)
    return page.figure(maps.morphology(run, ids), f"Phases of {escape(run.name)}: the whole body{enlarged(run)}."
                       f"{escape(words_on_colours(run, 1 + int(ids.max())))}")


def rve_stress(page, run, chain):
    return _stress_of_volume(page, run, chain, maps.rve_von_mises, "compression along y alone" + enlarged(run))


def mesh_stress(page, run, chain):
    return _stress_of_volume(page, run, chain, mesh_maps.von_mises, f"compression along {'z' if run.is_solid() else 'y'} alone" + sections_of(run))


def _stress_of_volume(page, run, chain, draw, load):
    """`draw(run, pressure)` gives the figure and the boundary condition that it shows."""
    pressure, which = pressure_of(chain)
    figure, condition = draw(run, pressure)
    return page.figure(figure, f"Von Mises stress in the volume element of {escape(run.name)} under {escape(condition)}, which does not slide: "
                               f"its mean strain is the one whose mean stress is {quantity(pressure, 'Pa')} ({which}) of {load}. {PERCENTILE}")


def mesh_morphology(page, run):
    count = 1 + int(run.need("/phase/id").max())
    return page.figure(mesh_maps.morphology(run), f"Phases of {escape(run.name)}{' on their mesh' if run.members('/mesh') else ''}{sections_of(run)}."
                       f"{escape(words_on_colours(run, count))}")


def phases_of_run(page, run):
    return page.figure(mesh_maps.phases_of_run(run), f"Phases of the body of {escape(run.name)}{sections_of(run)}."
                       f"{escape(words_on_colours(run, len(run.need('/material/name'))))}")


def field_of(run, chain):
    return mesh_maps.snapshot_von_mises(run) if run.is_mesh_like() else maps.snapshot_von_mises(run, chain)


def bodies_of(run):
    """The body and, if there is one with snapshots, the counter body of a run."""
    below = run.below()
    return [run, below] if below and below.get("/snapshots/time") is not None else [run]


def stress_ends(run, chain):
    return 0.0, max(highest(field_of(body, chain)) for body in bodies_of(run))


def snapshot(page, run, chain):
    """Of the body and, on the same scale, of the counter body."""
    fields = [(body, field_of(body, chain)) for body in bodies_of(run)]  # first of all: what is missing here is said
    others = tuple(other for other in comparable(run, snapshots(chain)) if ends(stress_ends, (other,), chain)[2])
    end = ends(stress_ends, others, chain)[1]
    time = run.last("/snapshots/time")
    when = f" at t = {quantity(float(time), 's')}" if time is not None else ""
    figures = []
    for body, field in fields:
        views = (mesh_maps if body.is_mesh_like() else maps).views(body)
        figure = draw(views, [stress_group(field, limit=end)], title=run.title, flat=run.motion_of_flat() if body is run else None)
        figures.append(page.figure(figure, f"Von Mises stress of the last snapshot of {'' if body is run else 'the counter body in '}the {escape(run.label)} run{when}" +
                                   (sections_of(body) if body.is_mesh_like() else enlarged(body)) + (f". {PERCENTILE}{same_scale(others, 'It is')}" if body is run
                                                                                                    else ", on the same scale.")))
    return "".join(figures)
