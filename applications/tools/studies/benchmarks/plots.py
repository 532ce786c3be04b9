"""Work-precision diagrams: error against seconds, logarithmic, one curve for each choice. Colours and settings are those of the report."""

import os
import sys
import textwrap

import numpy as np

from common import TOP

sys.path.insert(0, os.path.join(TOP, "applications", "tools"))

from matplotlib.ticker import FuncFormatter, LogFormatter  # noqa: E402

from report.base.figures import BLACK, BLUE, GREEN, GREY, ORANGE, PINK, SKY, YELLOW, plt  # noqa: E402

COLOURS = [BLUE, ORANGE, GREEN, PINK, SKY, YELLOW, BLACK]
MARKERS = "os^Dvp*"

plt.rcParams["svg.hashsalt"] = "mesoslip"
plt.rcParams["svg.fonttype"] = "none"


class PlainLogFormatter(LogFormatter):
    """0.02 instead of 2e-02."""

    def _num_to_string(self, x, vmin, vmax):
        return f"{x:g}"


def panels(columns, width=None, height=5.3, **options):
    figure, axes = plt.subplots(1, columns, figsize=(width or (6.8 if columns == 1 else 4.6 * columns), height),
                                squeeze=False, **options)
    return figure, axes[0]


def plain(value, _=None):
    """10^6 where digits would be many, 0.02 instead of 2e-02."""
    power = np.log10(value) if value > 0 else 0.0
    return f"$10^{{{power:.0f}}}$" if abs(power) > 3.5 and abs(power - round(power)) < 1e-9 else f"{value:g}"


def wrapped(label, width=32):
    """A label of an axis in lines that are shorter than the axis."""
    return textwrap.fill(label, width)


def logarithmic(axes, xlabel, ylabel, title=None, percent=True):
    """Both axes logarithmic; with errors in percent the two targets are marked."""
    axes.set(xscale="log", yscale="log", xlabel=wrapped(xlabel, 40), ylabel=wrapped(ylabel))
    axes.grid(True, which="major")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(plain))
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
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=columns, borderaxespad=0.2, handlelength=1.8,
                columnspacing=1.2, **options)


def shared_legend(figure, axes, columns):
    """One legend below all panels, of what `axes` shows."""
    rows = -(-len(axes.get_legend_handles_labels()[1]) // columns)
    bottom = 0.04 + 0.055 * rows
    figure.get_layout_engine().set(rect=(0, bottom, 1, 1 - bottom))
    figure.legend(*axes.get_legend_handles_labels(), loc="lower center", ncol=columns, handlelength=1.8)
