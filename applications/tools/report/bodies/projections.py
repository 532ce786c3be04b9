"""Polygons or cells of bodies and surfaces in panels, for each field: of a body in 3D sections across its axes, of what is plane the
whole, and enlarged a part of it. The places of all panels are computed in inches, so that bodies of any shape fit."""

from dataclasses import dataclass

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.patches import Rectangle

from report.base.figures import FRAME, WIDTH, legend_columns, plt

# in
LEFT, RIGHT, BELOW, GAP = 0.82, 0.2, 0.64, 0.14  # beside and below a panel with labels; without
PLANE, TITLE, BAR, LEGEND = 0.28, 0.34, 0.8, 0.3  # titles of a panel and of a field, a colour bar, a line of the legend
LEAST = 0.66  # room for a panel, so that its labels fit
TALLEST, TALLER = 7.2, 2.2  # a figure of one field, and more for each other
LETTER = 0.09  # of the title of a field
BAR_LENGTH, SHORTEST, BAR_WIDTH = 4.2, 2.4, 0.15


@dataclass
class View:
    """Polygons in the plane across `axis` (None: nothing is cut), and the numbers of the values that colour them; without polygons the
    cells of a plane grid, numbers [ny][nx]."""
    bounds: np.ndarray  # lower and upper corner of what is shown (mm)
    axis: object
    polygons: object
    numbers: np.ndarray
    whole: object = None  # corners of the body (mm), of which the view is an enlarged part
    magnified: float = 1.0
    beside: bool = False  # the enlarged part stands beside the body instead of below it
    frame: object = None  # corners (mm) of the part that another view shows

    def directions(self):
        return [d for d in range(self.bounds.shape[1]) if d != self.axis][:2]

    def size(self):
        return self.magnified * np.ptp(self.bounds, axis=0)[self.directions()]

    def place(self):
        """Column and row in a technical drawing: x and z, beside it y and z, below it x and y; what is enlarged beside or below."""
        if self.whole is not None:
            return (1, 0) if self.beside else (0, 1)
        return {0: (1, 0), 2: (0, 1)}.get(self.axis, (0, 0))


@dataclass
class Group:
    """One field; groups in a row of the same label share the last one's colour bar."""
    values: np.ndarray
    colours: object
    limits: tuple
    title: str = ""
    label: str = ""


def labels_in_turn(views, groups):
    """How many labels the groups of one view have if each label comes in turn, twice or more often; else 0."""
    labels = [group.label for group in groups]
    n = len(set(labels))
    return n if len(views) == 1 and 1 < n < len(labels) and labels == labels[:n] * (len(labels) // n) else 0


class Layout:
    """Places (in) of the panels: fields one below the other, each a technical drawing, or in columns; four and more of one view in pairs.
    Fields of one view whose labels return in turn, as those at several times, have a column each with one colour bar below it."""

    def __init__(self, views, groups, in_columns):
        self.views, self.groups, self.in_columns = views, groups, in_columns
        turn = labels_in_turn(views, groups)
        self.side_by_side = turn or (2 if len(views) == 1 and len(groups) > 3 and len({group.label for group in groups}) == len(groups) else 1)
        self.stride = turn or 1  # from a field to the next one of its label
        self.bars = [bool(group.label) and (k + self.stride >= len(groups) or groups[k + self.stride].label != group.label)
                     for k, group in enumerate(groups)]
        self.places = {(v, g): (g, v) if in_columns else self._below(views[v], g)
                       for v in range(len(views)) for g in range(len(groups))}
        # Room that panels and their labels need.
        n_columns, n_rows = 1 + np.max(list(self.places.values()), axis=0)
        self.lengths = np.zeros(n_columns), np.zeros(n_rows)  # mm
        for (v, _), place in self.places.items():
            for lengths, at, length in zip(self.lengths, place, views[v].size()):
                lengths[at] = max(lengths[at], length)
        self.left = np.array([LEFT if self.labelled_up(column) else GAP for column in range(n_columns)])
        self.below = np.array([BELOW if self.labelled_across(row) else GAP for row in range(n_rows)])
        self.above = np.full(n_rows, GAP if views[0].axis is None else PLANE)
        for g, group in enumerate(groups):
            rows = [self.places[v, g][1] for v in range(len(views))]
            if group.title:
                self.above[min(rows)] = TITLE + (0 if views[0].axis is None else PLANE)
            if self.bars[g]:
                self.below[max(rows)] = BELOW + BAR
        self._fit()

    def _below(self, view, g):
        column, row = view.place() if len(self.views) > 1 else (0, 0)
        return column + g % self.side_by_side, row + g // self.side_by_side * (2 if len(self.views) > 1 else 1)

    def labelled_up(self, column):
        return not self.in_columns or column == 0

    def labelled_across(self, row):
        first = row * self.stride
        return self.in_columns or len(self.views) > 1 or first + self.stride >= len(self.groups) or self.bars[first]

    def _sizes(self, scale):
        title = LETTER * max(len(group.title) for group in self.groups) if self.in_columns else 0
        return [np.maximum(scale * lengths, least) for lengths, least in zip(self.lengths, (max(LEAST, title), LEAST))]

    def _total(self, scale):
        columns, rows = self._sizes(scale)
        return np.array([(columns + self.left + RIGHT).sum(), (rows + self.above + self.below).sum()])

    def _fit(self):
        """The largest scale (in/mm) at which width and height are kept, or are no larger than they must be."""
        allowed = np.maximum([WIDTH * (1.5 if self.side_by_side > 1 else 1), TALLEST + TALLER * (len(self.groups) // self.side_by_side - 1)],
                             self._total(0)) + 1e-9
        low, high = 0.0, TALLEST / max(lengths.max() for lengths in self.lengths)
        for _ in range(40):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if np.all(self._total(middle) <= allowed) else (low, middle)
        self.scale, (self.columns, self.rows), self.total = low, self._sizes(low), self._total(low)

    def box(self, v, g):
        """Left, bottom (from the top downwards), width and height of a panel."""
        column, row = self.places[v, g]
        return np.array([(self.columns + self.left + RIGHT)[:column].sum() + self.left[column],
                         (self.rows + self.above + self.below)[: row + 1].sum() - self.below[row], *(self.scale * self.views[v].size())])

    def frame(self, g):
        """Left, right, top and bottom of the panels of a field with the room for its title."""
        places = [self.places[v, g] for v in range(len(self.views))]
        boxes = np.array([self.box(v, g) for v in range(len(self.views))])
        right = max(box[0] + self.columns[column] for box, (column, _) in zip(boxes, places))
        top = (self.rows + self.above + self.below)[: min(row for _, row in places)].sum()
        return boxes[:, 0].min(), right, top, boxes[:, 1].max()

    def first_of_bar(self, g):
        """The first field that shares the bar of field g."""
        before = range(g % self.stride, g, self.stride)
        return max((k + self.stride for k in before if self.bars[k]), default=g % self.stride)

    def bar(self, g):
        """Left, bottom, width and height of the colour bar that ends below a field."""
        left, (_, right, _, bottom) = self.frame(self.first_of_bar(g) if self.in_columns else g)[0], self.frame(g)
        room = right - left if self.in_columns or self.stride > 1 else max(right - left, SHORTEST)
        return left, bottom + BELOW + BAR_WIDTH, min(BAR_LENGTH, room), BAR_WIDTH


def draw(views, groups, entries=(), title="", flat=None):
    """Figure of the groups, with a title or a legend above, and an arrow along which the `flat` moves (its direction in x and y)."""
    ways = (False,) if labels_in_turn(views, groups) else (False, True)[: len(groups)]
    arrangements = [Layout(views, groups, in_columns) for in_columns in ways]
    layout = max(arrangements, key=lambda arrangement: arrangement.scale)
    columns = legend_columns(entries, 3)
    legend = LEGEND * (-(-len(entries) // columns) or bool(title))
    wide, high = max(WIDTH, layout.total[0]), layout.total[1] + legend
    figure = plt.figure(figsize=(wide, high), layout="none")
    if entries:
        figure.legend(handles=entries, loc="upper left", ncol=columns, handlelength=1.6, columnspacing=1.3)
    figure.text(layout.frame(0)[0] / wide, 1 - 0.05 / high, title, va="top")
    add_axes = lambda box: figure.add_axes([box[0] / wide, 1 - (legend + box[1]) / high, box[2] / wide, box[3] / high])
    for g, group in enumerate(groups):
        for v in range(len(views)):
            axes = add_axes(layout.box(v, g))
            _panel(axes, layout, v, g)
            if flat is not None:
                _arrow(axes, views[v], flat)
        left, _, top, _ = layout.frame(g)
        figure.text(left / wide, 1 - (legend + top + 0.05) / high, group.title, va="top")
        if layout.bars[g]:
            _bar(add_axes(layout.bar(g)), groups[layout.first_of_bar(g) : g + 1 : layout.stride])
    return figure


def _panel(axes, layout, v, g):
    view, group = layout.views[v], layout.groups[g]
    values = group.values[view.numbers]
    if view.polygons is None:
        (left, low), (right, top) = view.bounds if view.whole is None else view.whole
        axes.imshow(values, origin="lower", extent=[left, right, low, top], aspect="auto", cmap=group.colours, clim=group.limits,
                    interpolation="antialiased" if view.whole is None else "nearest")
    else:  # edges in the colour of the cell close the gaps between polygons
        axes.add_collection(PolyCollection(view.polygons, array=values, cmap=group.colours, clim=group.limits, edgecolors="face",
                                           linewidths=0.5))
    if view.frame is not None:
        (left, low), (right, top) = view.frame
        axes.add_patch(Rectangle((left, low), right - left, top - low, fill=False, color=FRAME, lw=1.6, clip_on=False, zorder=3))
    if view.whole is not None:
        for spine in axes.spines.values():
            spine.set(visible=True, color=FRAME, linewidth=1.6)
    axes.grid(False)
    axes.set_label(", ".join(text for text in (group.title, group.label) if text))  # for the data of the figure
    (across, up), (wide, high), (column, row) = view.directions(), layout.scale * view.size(), layout.places[v, g]
    axes.set(xlim=view.bounds[:, across], ylim=view.bounds[:, up])
    _ticks(axes.xaxis, wide, view.bounds[:, across])
    _ticks(axes.yaxis, high, view.bounds[:, up], upright=True)
    axes.set_xlabel(f"{'xyz'[across]} (mm)", loc="center" if wide >= LEAST else "left")
    axes.set_ylabel(f"{'xyz'[up]} (mm)", loc="center" if high >= LEAST else "bottom")
    axes.tick_params(labelbottom=layout.labelled_across(row), labelleft=layout.labelled_up(column))
    axes.xaxis.label.set_visible(layout.labelled_across(row))
    axes.yaxis.label.set_visible(layout.labelled_up(column))
    if view.axis is not None:
        middle = without_round_off(view.bounds[:, view.axis].mean(), np.ptp(view.bounds))
        axes.set_title(f"{'xyz'[view.axis]} = {middle:.3g} mm", loc="left", fontsize=9.5, pad=3)


def without_round_off(place, length):
    """0 for the middle of a body that a mesh has a little beside 0."""
    return place if abs(place) > 1e-4 * length else 0.0


def _arrow(axes, view, flat):
    """Below the lower edge, at the flat, where there is room for it and the flat moves in the plane of the view."""
    part = 0 if view.axis == 2 or view.whole is not None else flat[view.directions()[0]]
    room = axes.get_position().width * axes.figure.get_figwidth()
    if abs(part) > 0.3 and room > 1.5:
        words = "flat moves" if room > 2.8 else "flat"
        axes.annotate(f"{words} \u2192" if part > 0 else f"\u2190 {words}", (1, 0), (0, -24), "axes fraction", "offset points", ha="right", va="top",
                      fontsize=9.5, color=FRAME)


def _ticks(line, length, ends, upright=False):
    """As many as there is room for (in), so that no label touches the next."""
    if length < 1.0:
        shown = ends if length > 0.55 else ends[1:]
        line.set_ticks(shown, [f"{without_round_off(end, np.ptp(ends)):.3g}" for end in shown])
        return
    for most in range(int(np.clip(length / 0.5, 2, 7)), 0, -1):
        locator = plt.MaxNLocator(most, steps=[1, 2, 2.5, 5, 10])
        inside = [tick for tick in locator.tick_values(*ends) if ends[0] <= tick <= ends[1]]
        letters = 1 if upright else max((len(f"{tick:g}") for tick in inside), default=1)
        if len(inside) * (0.1 * letters + 0.14) <= length:
            break
    line.set_major_locator(locator)


def _bar(axes, groups):
    """Of groups of the same colours and limits; horizontal, pointed where values lie beyond its ends."""
    group, values = groups[-1], np.concatenate([group.values for group in groups])
    low, high = group.limits
    over, under = values.max() > high + 1e-9 * abs(high), values.min() < low - 1e-9 * abs(low)
    extend = "both" if over and under else "max" if over else "min" if under else "neither"
    bar = axes.figure.colorbar(ScalarMappable(Normalize(low, high), group.colours), cax=axes, orientation="horizontal", extend=extend)
    length = axes.get_position().width * axes.figure.get_figwidth()
    _ticks(bar.ax.xaxis, max(length, 1.0), group.limits)
    bar.set_label(group.label, loc="center" if length > 2.6 else "left")
    bar.outline.set_visible(False)
