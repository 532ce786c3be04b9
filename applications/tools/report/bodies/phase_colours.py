"""Colours of phases. Where a picture or a file of voxels made them, the phase with the higher value in it is the lighter one, as in the picture.
Otherwise the phase that is named first is light, the second one dark, and others are coloured."""

import os

import matplotlib
import numpy as np
from matplotlib.colors import ListedColormap

from report.base.data import settings
from report.base.figures import RUN_COLOURS

DARK, LIGHT = "#30343b", "#dfe3e8"
LISTED = [LIGHT, DARK, *RUN_COLOURS]
MOST_GREYS = 5  # more cannot be told apart


def origin(run):
    """Settings of the homogenization that made the phases of a run: its own, or those of the run whose rve.h5 it read."""
    own = settings(run.folder)
    made = own.get("Body/RVE file")
    if not made:
        return own
    made = made if made.endswith(".h5") else os.path.join(made, "rve.h5")  # or its folder
    beside = [os.path.dirname(os.path.join(os.path.abspath(run.folder), *up, made)) for up in ([".."], [])]
    beside.append(os.path.join(run.folder, "..", os.path.basename(os.path.dirname(made))))  # results that were moved together
    return next((read for read in map(settings, beside) if read), own)


def values_of(run, n):
    """The file that made n phases, and their values in it, ascending where it does not say them; None without such a file."""
    made = origin(run)
    if made.get("Microstructure/Type") not in ("image", "voxels") or not made.get("Microstructure/File"):
        return None
    try:
        values = [int(word) for word in made.get("Microstructure/Image values", "").split(",") if word.strip()]
    except ValueError:
        values = []
    return os.path.basename(made["Microstructure/File"]), np.array(values) if len(values) == n else np.arange(n)


def colours_of(run, n):
    """The ListedColormap of n phases."""
    made = values_of(run, n)
    if made is None or n < 2:
        return ListedColormap((LISTED * (n // len(LISTED) + 1))[:n])
    ramp = matplotlib.colors.LinearSegmentedColormap.from_list("greys", [DARK, LIGHT]) if n <= MOST_GREYS else matplotlib.colormaps["cividis"]
    return ListedColormap([ramp(rank / (n - 1)) for rank in np.argsort(np.argsort(made[1], kind="stable"))])


def words_on_colours(run, n):
    """A sentence for captions; empty where the legend says enough."""
    made = values_of(run, n)
    return f" The higher the value of a phase in {made[0]}, the lighter it is drawn." if made and n > 1 else ""
