"""Work-precision diagrams: error against seconds, logarithmic, one curve a choice."""

import os
import sys

import numpy as np

from common import TOP

sys.path.insert(0, os.path.join(TOP, "applications", "tools", "report"))

from matplotlib.ticker import FuncFormatter, LogFormatter  # noqa: E402

from figures import BLACK, BLUE, GREEN, GREY, ORANGE, PINK, SKY, YELLOW, plt  # noqa: E402

COLOURS = [BLUE, ORANGE, GREEN, PINK, SKY, YELLOW, BLACK]
MARKERS = "os^Dvp*"

plt.rcParams["svg.hashsalt"] = "mesoslip"
plt.rcParams["svg.fonttype"] = "none"


class PlainLogFormatter(LogFormatter):
    """0.02 instead of 2e-02."""

    def _num_to_string(self, x, vmin, vmax):
        return f"{x:g}"


def panels(columns, width=None, height=5.3, **options):
    figure, axes = plt.subplots(1, columns, figsize=(width or (6.4 if columns == 1 else 5.2 * columns), height),
                                squeeze=False, **options)
    return figure, axes[0]


def logarithmic(axes, xlabel, ylabel, title=None, percent=True):
    """Both axes logarithmic; with errors in percent the two targets are marked."""
    axes.set(xscale="log", yscale="log", xlabel=xlabel, ylabel=ylabel)
    axes.grid(True, which="major")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(PlainLogFormatter(labelOnlyBase=False, minor_thresholds=(1.2, 0.5)))
    if title:
        axes.set_title(title, loc="left")
    if percent:
        for target in (1.0, 0.1):
            axes.axhline(target, color=GREY, lw=0.9, ls=(0, (2, 3)), zorder=0)


def curve(axes, index, x, y, label, low_high=None, **style):
    """One choice; `low_high`: two lists beside y that give error bars."""
    c = COLOURS[index % len(COLOURS)]
    x, y = np.asarray(x, float), np.asarray(y, float)
    options = {"color": c, "marker": MARKERS[index % len(MARKERS)], "ms": 5, "lw": 1.3, "label": label, **style}
    if low_high is None:
        axes.plot(x, y, **options)
    else:
        bars = np.abs(np.vstack([y - low_high[0], np.asarray(low_high[1]) - y]))
        axes.errorbar(x, y, yerr=bars, capsize=2.5, elinewidth=1, **options)


def legend(axes, columns=1, **options):
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncol=columns, borderaxespad=0.2, handlelength=1.8,
                columnspacing=1.2, **options)


def shared_legend(figure, axes, columns):
    """One legend below all panels, of what `axes` shows."""
    rows = -(-len(axes.get_legend_handles_labels()[1]) // columns)
    bottom = 0.04 + 0.055 * rows
    figure.get_layout_engine().set(rect=(0, bottom, 1, 1 - bottom))
    figure.legend(*axes.get_legend_handles_labels(), loc="lower center", ncol=columns, handlelength=1.8)
