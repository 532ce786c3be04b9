"""One scale for the pictures of runs that are compared: those under the same pressure."""

import functools


def comparable(run, runs):
    """Those of the runs whose pictures have the scales of `run`, with it."""
    return tuple(other for other in runs if other is run or other.number("pressure") == run.number("pressure"))


@functools.lru_cache(maxsize=None)
def ends(find, runs, *arguments):
    """Lowest and highest end of the scales `find(run, *arguments)` of the runs; and how many of them have one."""
    found = []
    for run in runs:
        try:
            found.append(find(run, *arguments))
        except Exception:  # its own picture says what is wrong
            continue
    return min((low for low, _ in found), default=None), max((high for _, high in found), default=None), len(found)


def same_scale(runs, what="The colour scale is"):
    """A sentence for captions of a picture that has the scale of several runs."""
    return f" {what} the same for all runs with this pressure." if len(runs) > 1 else ""
