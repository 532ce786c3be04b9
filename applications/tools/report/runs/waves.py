"""What the report says of waves along the contact: the map over time, means by node, and the spectrogram of the reference node."""

from report.base.common_scales import comparable, same_scale
from report.base.page import escape, quantity
from report.runs import space_time


def rows(runs, times):
    """Lists of (function, arguments...) of the parts that the runs call for, a list for each kind of picture; contact surfaces are shown at
    `times` (s), of the last periods if there are none."""
    mapped = [run for run in runs if run.members("/contact_map")]
    surfaces = [run for run in runs if space_time.has_surface_map(run)]
    heard = [run for run in runs if run.members("/reference")]
    summed = [run for run in runs if run.get("/contact/pressure") is not None]
    alike = lambda run: [other for other in summed if other.has_surface() == run.has_surface()]
    return [[(whole_map, run, comparable(run, mapped)) for run in mapped],
            [(last_periods, run, comparable(run, mapped)) for run in mapped],
            [(surface_at_times, run, times, comparable(run, surfaces)) for run in surfaces],
            [(spectrogram, run, comparable(run, heard)) for run in heard],
            [(means, run, comparable(run, alike(run))) for run in summed]]


def shown_nodes(run):
    return "the row of contact nodes along the motion of the flat through the middle" if run.has_surface() else "every contact node"


def caption(run, runs, reduced):
    kept = " Where the map has more samples than the picture, the one farthest from the median stands for its stretch, of the states the " \
           "rarest, so that no extreme is hidden." if reduced else ""
    return f"{shown_nodes(run)} over position and time. Traction acts on the body and the slip velocity is that of the flat relative to " \
           f"the node, both along the motion of the flat. Colour scales end at the 2.5th and 97.5th percentiles.{same_scale(runs, 'They are')}{kept}"


def whole_map(page, run, runs):
    figure, reduced = space_time.space_time(run, runs)
    why = space_time.why_no_zoom(run)
    absent = f" The last periods have no picture of their own, as {why}." if why else ""
    return page.figure(figure, f"Map of the contact of the {escape(run.label)} run: {caption(run, runs, reduced)}{absent}")


def last_periods(page, run, runs):
    if space_time.first_of_last_periods(run) is None:
        return ""  # the caption of the picture of the whole run says why
    figure, reduced = space_time.space_time(run, runs, zoom=True)
    return page.figure(figure, f"The last periods of the map of the {escape(run.label)} run. A line across it is a wave: its speed is "
                               f"the slope, position over time.{' Reduced as above.' if reduced else ''}")


def surface_at_times(page, run, times, runs):
    figure, shown = space_time.surface_at_times(run, times, runs)
    words = [{"traction": "shear traction on the body", "slip_velocity": "slip velocity"}.get(name, name) for name in shown]
    what = words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]
    motion = " Shear traction and slip velocity are those along the motion of the flat." if len(words) > 1 else ""
    when = "the samples nearest to the times that were asked for" if times else "times of the last periods"
    return page.figure(figure, f"{what[0].upper()}{what[1:]} on the contact surface of the {escape(run.label)} run at {when}, each node with "
                               f"its part of the faces around it.{motion} The colour scales end at the 2.5th and 97.5th percentiles.{same_scale(runs, 'They are')}")


def means(page, run, runs):
    nominal = "mean over all time steps of the steady part; the work is that of the whole run"
    if run.has_surface():
        return page.figure(space_time.surface_means(run, runs),
                           f"Pressure and friction work of every contact node of the {escape(run.label)} run: {nominal}. The colour "
                           f"scales end at the 2.5th and 97.5th percentiles.{same_scale(runs, 'They are')}")
    return page.figure(space_time.profile(run, runs),
                       f"Pressure, friction power and friction work of every contact node of the {escape(run.label)} run: {nominal}. "
                       f"Dashed: means over the contact.{same_scale(runs, 'The scales are')}")


def spectrogram(page, run, runs):
    figure, window = space_time.spectrogram(run, runs)
    return page.figure(figure, f"Spectrogram of the tangential velocity of the reference node of the {escape(run.label)} run, from its "
                               f"history, in windows of {quantity(window, 's')}. The power is relative to its largest value in this run.")
