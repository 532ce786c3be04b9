"""What maps of grids and of meshes share: colours, the field of one stress, and localized beside direct stresses."""

import numpy as np
from matplotlib.patches import Patch

from report.base.figures import STRESSES, scaled
from report.bodies.phase_colours import colours_of
from report.bodies.projections import Group, draw

STRESS_MAP, DIFFERENCE_MAP = "viridis", "PuOr_r"


def phase_names(run, n):
    names = run.get("/phase/name")
    names = run.get("/material/name") if names is None else names
    if names is not None and len(names) >= n:
        return [name.decode() if isinstance(name, bytes) else str(name) for name in names]
    listed = [phase.get("name") for phase in run.summary.get("phases") or [] if isinstance(phase, dict)]
    return listed if len(listed) >= n else [f"phase {i}" for i in range(n)]


def phase_figure(views, run, ids, remarks):
    """Phases of the cells, and a legend of their names and what is remarked of each."""
    n = len(remarks)
    colours = colours_of(run, n)
    entries = [Patch(facecolor=colours(i), edgecolor="#adb5bd", label=name + remark)
               for i, (name, remark) in enumerate(zip(phase_names(run, n), remarks))]
    return draw(views, [Group(ids, colours, (-0.5, n - 0.5))], entries)


def highest(field):
    """Pa; end of the colour scale of a stress that is never negative."""
    return float(np.nanpercentile(field, 99.5)) or 1.0


def stress_group(field, label="von Mises stress", title="", limit=None):
    """One field of stresses (Pa), from zero on to `limit` (Pa)."""
    limit = highest(field) if limit is None else limit
    factor, unit = scaled(np.array([limit]), units=STRESSES)
    return Group(field / factor, STRESS_MAP, (0, limit / factor), title, f"{label} ({unit})")


def compared(seen, localized, direct, label):
    """Localized and, if there are any, direct stresses on one scale and their difference; (figure, relative L2 difference over the values)."""
    fields = [localized] if direct is None else [localized, direct]
    low, high = np.percentile(np.stack(fields), (0.5, 99.5))
    factor, unit = scaled(np.array([low, high]), units=STRESSES)
    low, high = low / factor, high / factor
    titles = ["localized", "direct"]
    groups = [Group(field / factor, STRESS_MAP, (min(low, 0) if low < -0.05 * high else 0, high), title, f"{label} ({unit})")
              for field, title in zip(fields, titles)]
    if direct is None:
        return draw(seen, groups), None
    gap = (localized - direct) / factor
    bound = np.percentile(np.abs(gap), 99.5) or 1.0
    groups.append(Group(gap, DIFFERENCE_MAP, (-bound, bound), "localized − direct", f"difference ({unit})"))
    return draw(seen, groups), float(np.linalg.norm(localized - direct) / np.linalg.norm(direct))
