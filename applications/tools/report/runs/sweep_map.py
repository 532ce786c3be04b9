"""Section on maps: what happens at each point of a sweep, over its axes."""

import os

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch
from matplotlib.patheffects import Normal, Stroke
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from report.base.data import Missing
from report.base.figures import BLACK, BLUE, GREEN, GREY, ORANGE, PINK, SKY, STICK, STRESSES, VIOLET, YELLOW, above, above_all, lettered, panels, scaled
from report.base.page import escape, note, number, table

SKIPPED = "steady sliding, not run"
# In the order from rest to flight.
REGIMES = {"permanent stick": YELLOW, "stick-slip": ORANGE, "stick-slip-separation": PINK, "stick-separation": VIOLET, "permanent slip": BLUE,
           "slip-separation, regime 1 (mostly slipping)": SKY, "slip-separation, regime 2 (mostly separated)": GREEN,
           "permanent separation": GREY, SKIPPED: "#cfe2ee"}
GROWTH = "complex_modes.largest_growth_rate"
# Name in the map, words, factor, unit.
QUANTITIES = [("global_interface_friction_coefficient", "global interface friction coefficient", 1, ""), ("main_frequency", "main frequency", 1e-3, "kHz"),
              ("reference_velocity_amplitude", "amplitude of the velocity of the reference node", 1, "m/s"),
              ("slip_fraction", "share of slip", 100, "%"), ("stick_fraction", "share of stick", 100, "%"),
              ("separation_fraction", "share of separation", 100, "%"), (GROWTH, "growth rate of the fastest complex mode", 1, "1/s"),
              ("largest_strain", "largest strain", 100, "%")]


def plain_ticks(axis):
    """Of a logarithmic axis, in numbers and not in powers."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


class Map:
    """What map.h5 of a run holds, as arrays over its points."""

    def __init__(self, run):
        self.run = run
        self.shape = [int(n) for n in np.atleast_1d(run.attribute("/axes", "shape"))]
        self.names = sorted(run.members("/axes"), key=lambda name: int(run.attribute(f"/axes/{name}", "number")))
        self.branches = self.take_branches()
        self.values, self.units, self.factors = zip(*(self.scaled_axis(name) for name in self.names))
        self.status = np.array([text.decode() for text in run.need("/status").ravel()])

    def take_branches(self):
        """Names of the branches of a map that was gone through up and down, whose first axis they are; else none. The other axes remain."""
        if self.names[0] != "branch":
            return []
        self.names, self.shape = self.names[1:], self.shape[1:]
        return ["up", "down"]

    def is_grid(self):
        return len(self.shape) == len(self.names)

    def scaled_axis(self, name):
        """Values along an axis in a readable unit, the unit, and the factor that they were divided by."""
        values, unit = self.run.need(f"/axes/{name}"), self.run.attribute(f"/axes/{name}", "unit").item()
        unit = unit.decode() if isinstance(unit, bytes) else str(unit)
        factor, unit = scaled(values, units=STRESSES) if unit == "Pa" else (1.0, unit)
        return values / factor, unit, factor

    def label(self, axis):
        return self.names[axis] + (f" ({self.units[axis]})" if self.units[axis] != "-" else "")

    def scales(self, axes, numbers="xy"):
        """Sets labels and scales of axes, x of the first axis and y of the second one."""
        for k, letter in enumerate(numbers):
            axis = getattr(axes, letter + "axis")
            getattr(axes, f"set_{letter}label")(self.label(k))
            if self.is_logarithmic(k):
                getattr(axes, f"set_{letter}scale")("log")
                plain_ticks(axis)

    def is_logarithmic(self, axis):
        values = self.values[axis]
        ratio = np.diff(np.log(np.unique(values))) if values.min() > 0 else np.ones(1)
        marked = self.run.attribute(f"/axes/{self.names[axis]}", "logarithmic")
        return bool(marked) or (len(ratio) > 2 and np.ptp(ratio) < 1e-6 * ratio.mean())

    def number(self, name):
        """NaN where a point has none; None if no point has one."""
        found, known = self.run.get(f"/numbers/{name}"), self.run.get(f"/known/{name}")
        return np.where(known.astype(bool), found, np.nan) if found is not None and known is not None and known.any() else None

    def border(self):
        """Points of the border of growth in a row each, along the axes; None if the map has none."""
        if not self.run.members("/border"):
            return None
        return np.stack([np.atleast_1d(self.run.need(f"/border/{name}")) / factor for name, factor in zip(self.names, self.factors)], axis=1)

    def regime(self):
        """Of each point; empty where it is not known."""
        texts = self.run.get("/texts/regime")
        return np.array([text.decode() for text in texts.ravel()]) if texts is not None else np.array([""] * len(self.status))

    def slices(self):
        """Title, and numbers of the points in rows of the second axis, of each map over the first two axes; of one axis a single row."""
        if len(self.shape) == 1:
            return [("", np.arange(self.shape[0])[None, :])]
        numbers = np.arange(len(self.status)).reshape(-1, *self.shape[:2], int(np.prod(self.shape[2:])))
        result = []
        for branch, of_branch in zip(self.branches or [""], numbers):
            for k in range(of_branch.shape[2]):
                first = of_branch[0, 0, k]
                words = ([f"branch {branch}"] if branch else []) + [f"{self.label(a)} = {self.values[a][first]:.4g}" for a in range(2, len(self.names))]
                result.append((", ".join(words), of_branch[:, :, k].T))
        return result


def maps(page, run):
    """What was computed, the regimes, numbers over the axes, and the points that failed."""
    found = Map(run)
    n, failed = len(found.status), np.flatnonzero(found.status == "failed")
    done, skipped = int(np.sum(found.status == "done")), int(np.sum(found.status == "skipped"))
    not_run = f" At {skipped} others all complex modes of steady sliding up to their highest frequency decay, so that they were not run." if skipped else ""
    html = (f"<h3>{escape(run.name)}</h3>" if run.title else "") + f'<p class="lead">{done} of {n} points over {escape(", ".join(found.names))} are done.{not_run} ' \
           f"{page.link(run.file_path('map.csv'), 'map.csv')} has a row for each point with the folder of its run.</p>"
    html += failures(found, failed)
    if not done + skipped:
        raise Missing(f"no point of {run.name} is done")
    for title, points in found.slices()[:6] if found.is_grid() else []:
        html += pictures(page, found, title, points)
    if found.is_grid() and len(found.slices()) > 6:
        html += note(f"Six of {len(found.slices())} maps over the first two axes are shown.")
    if not found.is_grid():
        html += page.figure(scattered(found), f"Points of {escape(run.name)} over their first two axes, coloured by the regime of the reference node.")
    return html + points_table(page, found)


def points_table(page, found, most=1000):
    """A folded table of the points, each with a link to the summary of its run."""
    axes = [np.atleast_1d(found.run.need(f"/axes/{name}")) for name in (["branch"] if found.branches else []) + found.names]
    folders = [text.decode() for text in found.run.need("/folder").ravel()]
    mu = found.number(QUANTITIES[0][0])
    rows = []
    for k, folder in enumerate(folders[:most]):
        link = page.link(found.run.file_path(os.path.join(folder, "summary.json")), "summary.json") or escape(found.status[k])
        rows.append([*(number(float(values[k])) for values in axes), escape(found.regime()[k]), number(float(mu[k])) if mu is not None else "n/a", link])
    headings = [*(["branch"] if found.branches else []), *(escape(name) for name in found.names), "regime", "mu_inter", "run"]
    more = note(f"The first {most} of {len(folders)} points.") if len(folders) > most else ""
    return f"<details><summary>All points, with links to their runs</summary>{table(headings, rows, (len(headings) - 3, len(headings) - 1))}{more}</details>"


def failures(found, failed):
    if not len(failed):
        return ""
    messages = [text.decode() for text in found.run.need("/message").ravel()]
    rows = [[", ".join(f"{escape(found.label(a))} = {number(float(values[k]))}" for a, values in enumerate(found.values)), escape(messages[k])] for k in failed[:10]]
    more = note(f"{len(failed) - 10} more failed.") if len(failed) > 10 else ""
    return f"<p>{len(failed)} points failed:</p>" + table(["point", "why"], rows, (0, 1)) + more


def pictures(page, found, title, points):
    where = f" at {escape(title)}" if title else ""
    if len(found.shape) == 1:
        return page.figure(along(found), "Regime of the reference node (colours of the points) and numbers of the runs over what changes from run to run.")
    modes = " Black line: the fastest complex mode neither grows nor decays." if found.border() is not None else ""
    html = page.figure(regime_map(found, points), f"Regime of the reference node over {escape(found.names[0])} and {escape(found.names[1])}{where}.{modes} White: "
                                                  "no run that was done.")
    known = [entry for entry in QUANTITIES if found.number(entry[0]) is not None and np.isfinite(found.number(entry[0])[points]).any()]
    return html + page.row(page.figure(number_map(found, points, *entry), f"{entry[1][0].upper()}{entry[1][1:]} over {escape(found.names[0])} and "
                                                                      f"{escape(found.names[1])}{where}.{modes}") for entry in known)


def edges(values, logarithmic):
    """Borders between the values of an axis."""
    values = np.log(values) if logarithmic else np.asarray(values, float)
    middle = 0.5 * (values[1:] + values[:-1])
    ends = np.concatenate([[2 * values[0] - middle[0]], middle, [2 * values[-1] - middle[-1]]]) if len(values) > 1 else values[0] + np.array([-0.5, 0.5])
    return np.exp(ends) if logarithmic else ends


def prepared(found, points, height=3.6):
    """Figure, axes, and borders of the cells of a map over the first two axes, whose values may fall."""
    figure, (axes,) = panels(1, height)
    x, y = found.values[0][points[0]], found.values[1][points[:, 0]]
    logs = [found.is_logarithmic(axis) for axis in range(2)]
    order = np.argsort(y)[:, None], np.argsort(x)[None, :]
    found.scales(axes)
    axes.grid(False)
    return figure, axes, points[order], edges(np.sort(x), logs[0]), edges(np.sort(y), logs[1])


def border(found, axes, points):
    """The line where the fastest complex mode neither grows nor decays."""
    known = found.border()
    if known is not None:
        others = [found.values[axis][points[0, 0]] for axis in range(2, len(found.names))]
        draw_border(axes, known[np.all(known[:, 2:] == others, axis=1), :2], found.values[0][points[0]], found.values[1][points[:, 0]])


def draw_border(axes, known, x, y):
    """Pieces between the points of a border, a row each, that lie on the sides of each cell between the rising values x and y."""
    pieces = []
    for left, right in zip(x[:-1], x[1:]):
        for lower, upper in zip(y[:-1], y[1:]):
            corners = known[(known[:, 0] >= left) & (known[:, 0] <= right) & (known[:, 1] >= lower) & (known[:, 1] <= upper)]
            pieces += [corners[k:k + 2] for k in range(0, len(corners) - 1, 2)]
    line = LineCollection(pieces, colors=BLACK, linewidths=1.6, capstyle="round", path_effects=[Stroke(linewidth=3.2, foreground="white"), Normal()])
    axes.add_collection(line, autolim=False)


def regime_map(found, points):
    figure, axes, points, x, y = prepared(found, points)
    regime = found.regime()[points]
    names = [name for name in REGIMES if name in regime]
    colours = np.full(regime.shape, np.nan)
    for k, name in enumerate(names):
        colours[regime == name] = k
    axes.pcolormesh(x, y, np.ma.masked_invalid(colours), cmap=ListedColormap([REGIMES[name] for name in names]), vmin=-0.5, vmax=len(names) - 0.5)
    border(found, axes, points)
    above(axes, [Patch(color=REGIMES[name], label=name) for name in names], 2)
    return figure


def number_map(found, points, name, words, factor, unit):
    figure, axes, points, x, y = prepared(found, points)
    values = np.ma.masked_invalid(factor * found.number(name)[points])
    drawn = axes.pcolormesh(x, y, values, cmap="viridis")
    border(found, axes, points)
    figure.colorbar(drawn, label=words + (f" ({unit})" if unit else ""))
    return figure


def along(found):
    """Numbers over the only axis, one panel each."""
    known = [entry for entry in QUANTITIES if found.number(entry[0]) is not None and not entry[0].endswith(("slip_fraction", "stick_fraction", "separation_fraction"))]
    figure, axes = panels(len(known) + 1, 1.9 * (len(known) + 1), sharex=True)
    x, regime = found.values[0], found.regime()
    lines = [k[np.argsort(x[k])] for k in np.arange(len(x)).reshape(-1, found.shape[0])]  # of each branch
    styles = ["-", (0, (4, 2))]
    for axis, (name, words, factor, unit) in zip(axes, known):
        values = factor * found.number(name)
        for order, dashes in zip(lines, styles):
            axis.plot(x[order], values[order], color=GREY, lw=0.9, ls=dashes)
        for kind, colour in REGIMES.items():
            picked = regime == kind
            if picked.any():
                axis.plot(x[picked], values[picked], "o", ms=4, color=colour, label=kind)
        if name == GROWTH:
            axis.axhline(0, color=BLACK, lw=0.8)
        for (value,) in [] if found.border() is None else found.border():
            axis.axvline(value, color=BLACK, lw=0.8, ls=":")
        axis.set_title(words + (f" ({unit})" if unit else ""), loc="left")
    shares = axes[-1]
    for name, colour, words in (("slip_fraction", BLUE, "slip"), ("stick_fraction", STICK, "stick"), ("separation_fraction", GREY, "separation")):
        if found.number(name) is not None:
            for order, dashes in zip(lines, styles):
                shares.plot(x[order], 100 * found.number(name)[order], "o", ls=dashes, ms=3, color=colour, label=words if dashes == "-" else None)
    shares.set_title("shares of all contact nodes (%)", loc="left")
    shares.legend(loc="lower right", bbox_to_anchor=(1, 0.97), ncol=3, borderaxespad=0, handlelength=1.4)
    found.scales(shares, "x")
    lettered(axes)
    branches = [plt.Line2D([], [], color=GREY, ls=dashes, label=f"branch {name}") for name, dashes in zip(found.branches, styles)]
    handles = branches + [plt.Line2D([], [], marker="o", ls="", color=colour, label=kind) for kind, colour in REGIMES.items() if (regime == kind).any()]
    if handles:
        above_all(figure, handles, 2)
    return figure


def scattered(found):
    figure, (axes,) = panels(1, 3.8)
    regime = found.regime()
    second = found.values[1] if len(found.values) > 1 else np.zeros(len(regime))
    for name, colour in REGIMES.items():
        picked = regime == name
        if picked.any():
            axes.plot(found.values[0][picked], second[picked], "o", ms=6, color=colour, mec="white", mew=0.5, label=name)
    unknown = regime == ""
    axes.plot(found.values[0][unknown], second[unknown], "x", ms=5, color=GREY, label="not done") if unknown.any() else None
    found.scales(axes, "xy"[:len(found.values)])
    above(axes, columns=2)
    return figure
