"""What the report says of waves along the contact: the map over time, means by node, and the spectrogram of the reference node."""

import space_time
from page import escape, quantity


def parts(runs):
    """(function, arguments...) of the parts that the runs call for."""
    result = []
    for run in runs:
        if run.members("/contact_map"):
            result += [(whole_map, run), (last_periods, run)]
            result += [(surface_at_times, run)] if run.has_surface() and "pressure" in run.members("/contact_map") else []
            result += [(spectrogram, run)]
        if run.get("/contact/pressure") is not None:
            result.append((means, run))
    return result


def shown_nodes(run):
    return "the row of contact nodes along the motion of the flat through the middle" if run.has_surface() else "every contact node"


def caption(run, reduced):
    kept = " Where the map has more samples than the picture, the one farthest from the median stands for its stretch, of the states the " \
           "rarest, so that no extreme is hidden." if reduced else ""
    return f"{shown_nodes(run)} over position and time. Traction acts on the body and the slip velocity is that of the flat relative to " \
           f"the node, both along the motion of the flat. Colour scales end at the 2.5th and 97.5th percentiles.{kept}"


def whole_map(page, run):
    figure, reduced = space_time.space_time(run)
    return page.figure(figure, f"Map of the contact of the {escape(run.label)} run: {caption(run, reduced)}")


def last_periods(page, run):
    if space_time.first_of_last_periods(run) is None:
        return ""  # the picture of the whole run shows them
    figure, reduced = space_time.space_time(run, zoom=True)
    return page.figure(figure, f"The last periods of the map of the {escape(run.label)} run. A line across it is a wave: its speed is "
                               f"the slope, position over time.{' Reduced as above.' if reduced else ''}")


def surface_at_times(page, run):
    figure, _ = space_time.surface_at_times(run)
    return page.figure(figure, f"Pressure on the contact surface of the {escape(run.label)} run at times of the last periods, each node with "
                               "its part of the faces around it. The colour scale ends at the 2.5th and 97.5th percentiles.")


def means(page, run):
    nominal = "mean over all time steps of the steady part; the work is that of the whole run"
    if run.has_surface():
        return page.figure(space_time.surface_means(run),
                           f"Pressure and friction work of every contact node of the {escape(run.label)} run: {nominal}. The colour "
                           "scales end at the 2.5th and 97.5th percentiles.")
    return page.figure(space_time.profile(run),
                       f"Pressure, friction power and friction work of every contact node of the {escape(run.label)} run: {nominal}. "
                       "Dashed: means over the contact.")


def spectrogram(page, run):
    figure, window = space_time.spectrogram(run)
    return page.figure(figure, f"Spectrogram of the tangential velocity of the reference node of the {escape(run.label)} run, from its "
                               f"history, in windows of {quantity(window, 's')}.")
