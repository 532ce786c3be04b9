"""States of the contact nodes: their shares of time, their numbers over time, and how they change along the contact over time."""

import matplotlib
import numpy as np
from matplotlib.patches import Patch

from report.base.data import Missing, settings, thinned
from report.base.figures import GREY, SEPARATED, SLIP, STICK, above, panels, zoom_window

LEAST_BLOCKS = 8  # in a period
MOST_STRETCHES, FEW_PERIODS = 400, 40  # of a curve over time

STATES = [Patch(facecolor=SLIP, label="slip"), Patch(facecolor=STICK, label="stick"),
          Patch(facecolor=SEPARATED, edgecolor="#adb5bd", label="separated")]


def states_with(*shares):
    """Entries of a legend for the states of which these arrays, in the order of STATES, are not zero everywhere."""
    return [state for state, share in zip(STATES, shares) if np.any(share)]


def direction_of_flat(run):
    """Unit vector along x and y in which the flat moves."""
    parts = [run.attribute("/run", f"flat_direction_{axis}") for axis in "xy"]
    return np.array([1.0, 0.0]) if None in [part if part is None else 1 for part in parts] else np.array(parts, dtype=float).ravel()


def along_flat(run, vectors):
    """Components of vectors [n][2 or 3] along the motion of the flat."""
    return vectors[:, :2] @ direction_of_flat(run) if vectors.shape[1] == 3 else vectors[:, 0]


def contact_positions(run):
    """Places of the contact nodes along the motion of the flat (m); of bodies in 3D many nodes may share one."""
    position = run.get("/contact/position")
    if position is None:
        return run.get("/contact/x")
    return along_flat(run, position)


def node_statistics(runs):
    series = []
    for run in runs:
        arrays = [contact_positions(run), *(run.get(f"/contact/{name}") for name in ("slip", "stick", "separated"))]
        if all(array is not None and array.shape == arrays[0].shape and array.size
               for array in arrays):
            order = np.argsort(arrays[0], kind="stable")
            series.append((run, [array[order] for array in arrays]))
    if not series:
        raise Missing("/contact/{x, slip, stick, separated} is in none of the dynamics files")
    figure, axes = panels(len(series), 1.1 + 2.0 * len(series), sharex=True)
    for axis, (run, (x, slip, stick, separated)) in zip(axes, series):
        axis.stackplot(1e3 * x, 100 * slip, 100 * stick, 100 * separated,
                       colors=[SLIP, STICK, SEPARATED], linewidth=0)
        axis.set(ylim=(0, 100), ylabel="share of time\n(%)")
        axis.margins(x=0)
        axis.set_title(run.label, loc="right", color=GREY)
    axes[-1].set_xlabel("x (mm)")
    above(axes[0], states_with(*(np.concatenate(shares) for shares in list(zip(*(arrays for _, arrays in series)))[1:])))
    return figure


def fractions_of_nodes(run):
    """Times (s) of the history, and {state: share (%) of the contact nodes}."""
    names = ("slipping", "sticking", "separated")
    time, *numbers = run.need("/history/time", *(f"/history/{name}_nodes" for name in names))
    total = sum(numbers)
    if any(array.shape != time.shape for array in numbers) or not np.all(total > 0):
        raise Missing(f"/history of {run.name} does not tell the state of the contact nodes")
    return time, {state: 100 * array / total for state, array in zip(("slip", "stick", "separated"), numbers)}


def averaged(run, time, values):
    """Means over stretches of a long series, of a period or more where the run has many: parts of a period would beat with it."""
    n, frequency = len(time), run.number("main_frequency")
    periods = frequency * (time[-1] - time[0]) if frequency else 0
    most = min(MOST_STRETCHES, int(periods)) if periods > FEW_PERIODS else MOST_STRETCHES
    starts = np.unique(np.linspace(0, n, min(n, most), endpoint=False).astype(int))
    count = np.diff(np.append(starts, n))
    return np.add.reduceat(time, starts) / count, np.add.reduceat(values, starts) / count


def fractions(run):
    """Shares of the nodes in each state over the time of the run, and over the last periods; (figure, length (s) of the stretches whose
    means the first shows, None if it shows all samples)."""
    time, shares = fractions_of_nodes(run)
    begin = int(np.searchsorted(time, zoom_window(run, time[-1])))
    windows = [0] + ([begin] if begin > 0 and len(time) - begin >= 12 else [])
    figure, axes = panels(len(windows), 1.2 + 2.0 * len(windows))
    stretch = None
    for axis, start in zip(axes, windows):
        for (state, share), colour in zip(shares.items(), (SLIP, STICK, GREY)):
            x, y = averaged(run, time, share) if start == 0 else thinned(time[start:], share[start:])
            if start == 0 and len(x) < len(time):
                stretch = (time[-1] - time[0]) / len(x)
            axis.plot(1e3 * x, y, color=colour, lw=1.4, label=state)
        axis.set(ylim=(-2, 102), ylabel="share of nodes\n(%)")
        axis.margins(x=0)
    if len(windows) > 1:
        axes[1].set_title("last periods", loc="left", color=GREY)
    axes[-1].set_xlabel("time (ms)")
    above(axes[0], title=run.title)
    return figure, stretch


def in_order(x, *shares):
    """Positions in order and shares [blocks][nodes] there."""
    if x is None:
        return (x, *shares)
    order = np.argsort(x, kind="stable")
    return (x[order], *(share[:, order] for share in shares))


def in_strips(x, *shares):
    """Positions in order and means of shares [blocks][nodes] over strips of a contact surface in 3D across the motion."""
    places, strip = np.unique(np.round(x, 9), return_inverse=True)
    if len(places) ** 2 > 4 * len(x):  # of a mesh without rows of nodes
        edges = np.linspace(x.min(), x.max(), 1 + max(1, int(np.sqrt(len(x)))))
        filled, strip = np.unique(np.clip(np.searchsorted(edges, x, "right"), 1, len(edges) - 1), return_inverse=True)
        places = 0.5 * (edges[filled] + edges[filled - 1])
    count = np.bincount(strip)
    mean = lambda share: np.stack([np.bincount(strip, row) for row in share]) / count
    return (places, *(mean(share) for share in shares))


def why_no_zoom(run, time, begin):
    """Why blocks of a run that end at `time` (s) have no picture of the last periods, from `begin` (s) on; empty if they have one."""
    if time[0] >= begin:
        return "the run is hardly longer than these"
    count = np.count_nonzero(time > begin)
    if count >= 6 * LEAST_BLOCKS:  # of six periods; with fewer blocks in a period the picture shows steps and no waves
        return ""
    blocks = int(settings(run.folder).get("Observation/Blocks") or len(time))
    needed = 6 * LEAST_BLOCKS * blocks * np.median(np.diff(time)) / (time[-1] - begin)
    return f"Observation/Blocks is {blocks}; with {10 * int(np.ceil(0.1 * needed))} or more they would show waves"


def contact_map(run):
    """(figure, why the last periods are not enlarged; empty if they are)."""
    time, slip, stick, separated = run.need(*[f"/contact/blocks/{name}" for name in
                                              ("time", "slip", "stick", "separated")])
    if slip.ndim != 2 or slip.shape != stick.shape or slip.shape != separated.shape:
        raise Missing(f"/contact/blocks of {run.name} has arrays of different shapes")
    x = contact_positions(run)
    solid = run.has_surface()
    x, slip, stick, separated = (in_strips if solid else in_order)(x, slip, stick, separated)
    bottom, top = (1e3 * x[0], 1e3 * x[-1]) if x is not None and len(x) > 1 else (0, slip.shape[1])
    rgb = [np.array(matplotlib.colors.to_rgb(c)) for c in (SLIP, STICK, SEPARATED)]
    image = sum(np.clip(np.nan_to_num(share), 0, 1)[..., None] * c
                for share, c in zip((slip, stick, separated), rgb))
    first = time[0] - (time[1] - time[0]) if len(time) > 1 else 0.0
    begin = zoom_window(run, time[-1])
    why = why_no_zoom(run, time, begin)
    n_panels = 1 if why else 2
    figure, axes = panels(n_panels, 0.9 + 2.6 * n_panels)
    for axis in axes:
        shown = axis.imshow(np.clip(image, 0, 1).transpose(1, 0, 2), origin="lower", aspect="auto",
                    extent=[1e3 * first, 1e3 * time[-1], bottom, top], interpolation="nearest")
        shown.shares = {"slip": slip.T, "stick": stick.T, "separated": separated.T} if axis is axes[0] else {}
        axis.grid(False)
        axis.set_ylabel("contact node" if x is None else "position along\nthe motion (mm)" if solid else "x (mm)")
    if n_panels > 1:
        axes[1].set_xlim(1e3 * begin, 1e3 * time[-1])
        axes[1].set_title("last periods", loc="left", color=GREY)
    axes[-1].set_xlabel("time (ms)")
    above(axes[0], states_with(slip, stick, separated), title=run.title)
    return figure, why
