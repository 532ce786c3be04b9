"""Maps over the pin: morphology, von Mises stress of the RVE, of a snapshot and of the localization."""

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch, Rectangle

from data import Missing
from figures import RUN_COLOURS, STRESSES, WIDTH, above, panels, scaled

STRESS_MAP, DIFFERENCE_MAP = "viridis", "PuOr_r"
PHASE_COLOURS = ["#dfe3e8", "#30343b", *RUN_COLOURS]


def von_mises(stress, poisson):
    """Of plane strain stresses [..., 3] in Pa; poisson gives sigma_zz = nu (sigma_xx + sigma_yy)."""
    xx, yy, xy = np.moveaxis(stress, -1, 0)
    zz = poisson * (xx + yy)
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * xy**2)


def poisson_ratio(stiffness):
    """Of plane strain stiffnesses [..., 3, 3] that are isotropic (close to it: the effective one)."""
    return stiffness[..., 0, 1] / (stiffness[..., 1, 1] + stiffness[..., 0, 1])


def cell_strain(displacement, spacing):
    """Strain at the cell centres [ny][nx][3] of nodal displacements [ny+1][nx+1][2]."""
    hx, hy = np.broadcast_to(spacing, (2,))
    dx = np.diff(displacement, axis=1) / hx
    dy = np.diff(displacement, axis=0) / hy
    dx, dy = 0.5 * (dx[1:] + dx[:-1]), 0.5 * (dy[:, 1:] + dy[:, :-1])
    return np.stack([dx[..., 0], dy[..., 1], dx[..., 1] + dy[..., 0]], axis=-1)


def _draw(axes, image, extent, **options):
    picture = axes.imshow(image, origin="lower", extent=extent, aspect="equal", **options)
    axes.grid(False)
    axes.set_ylabel("y in mm")
    return picture


def _bar(figure, picture, axes, label):
    """Colour bar beside one or several axes; pointed where values lie beyond its ends."""
    image, (low, high) = picture.get_array(), picture.get_clim()
    over, under = np.nanmax(image) > high * (1 + 1e-12), np.nanmin(image) < low
    extend = "both" if over and under else "max" if over else "min" if under else "neither"
    many = np.size(axes) > 1
    bar = figure.colorbar(picture, ax=axes, pad=0.015, aspect=26 if many else 12, extend=extend)
    bar.set_label(label)
    bar.outline.set_visible(False)


def _height(extent, maps, more):
    """in; of a figure with that many maps of the extent one above the other."""
    ratio = (extent[3] - extent[2]) / (extent[1] - extent[0])
    return maps * (0.78 * WIDTH * min(ratio, 1.2) + 0.42) + more


def _window(extent, shape):
    """Left, right, bottom, top (mm) of the part of the contact that is shown enlarged: a seventh of the width, but
    30 cells at least."""
    left, right, bottom, top = extent
    half = min(0.5 * (right - left), max((right - left) / 14, 15 * (right - left) / shape[1]))
    middle = 0.5 * (left + right)
    return middle - half, middle + half, bottom, bottom + min(top - bottom, 0.62 * half)


def _pair(extent, shape, more):
    """Figure and axes of the whole body and, below, of the window, framed in both."""
    window = _window(extent, shape)
    heights = [0.78 * WIDTH * min((e[3] - e[2]) / (e[1] - e[0]), 1.2) + 0.42 for e in (extent, window)]
    figure, (axes, zoom) = panels(2, sum(heights) + more, gridspec_kw={"height_ratios": heights})
    axes.add_patch(Rectangle((window[0], window[2]), window[1] - window[0], window[3] - window[2], fill=False,
                             color="#D55E00", lw=1.6, clip_on=False, zorder=3))
    for spine in zoom.spines.values():
        spine.set(visible=True, color="#D55E00", linewidth=1.6)
    return figure, axes, zoom, window


def _show_window(zoom, window):
    zoom.set(xlim=window[:2], ylim=window[2:], xlabel="x in mm")


def _phase_map(chain):
    """(run, ids [ny][nx], names, stiffnesses) of the first run that knows the morphology."""
    for run in chain.rve:
        ids = run.get("/phase/id")
        if ids is not None and ids.ndim == 2 and run.extent():
            return run, ids
    for run in chain.dynamics:
        ids = run.get("/material/phase_id")
        if ids is not None and ids.ndim == 2 and run.extent():
            return run, ids
    raise Missing("no /phase/id in an rve.h5 and no /material/phase_id in a dynamics.h5")


def phase_names(run, n):
    names = run.get("/phase/name")
    names = run.get("/material/name") if names is None else names
    if names is not None and len(names) >= n:
        return [name.decode() if isinstance(name, bytes) else str(name) for name in names]
    listed = [phase.get("name") for phase in run.summary.get("phases") or []
              if isinstance(phase, dict)]
    return listed if len(listed) >= n else [f"phase {i}" for i in range(n)]


def morphology(chain):
    run, ids = _phase_map(chain)
    extent = run.extent()
    n = int(ids.max()) + 1
    colours = ListedColormap((PHASE_COLOURS * (n // len(PHASE_COLOURS) + 1))[:n])
    figure, axes, zoom, window = _pair(extent, ids.shape, 0.5)
    for axis in (axes, zoom):
        _draw(axis, ids, extent, cmap=colours, vmin=-0.5, vmax=n - 0.5,
              interpolation="nearest")
    _show_window(zoom, window)
    shares = [100 * np.mean(ids == i) for i in range(n)]
    above(axes, [Patch(facecolor=colours(i), edgecolor="#adb5bd", label=f"{name} ({share:.1f} %)")
                 for i, (name, share) in enumerate(zip(phase_names(run, n), shares))], columns=4)
    return figure


def rve_von_mises(run, pressure=0.5e6):
    """Von Mises stress under the uniform strain that a mean sigma_yy = -pressure alone needs (KUBC)."""
    ids, stiffness, concentration = run.need("/phase/id", "/phase/stiffness", "/concentration/KUBC")
    effective = run.get("/stiffness/KUBC")
    effective = effective if effective is not None else run.need("/stiffness/effective")
    strain = np.linalg.solve(effective, [0.0, -pressure, 0.0])
    local = np.einsum("yxij,j->yxi", concentration, strain)
    stress = np.einsum("yxij,yxj->yxi", stiffness[ids], local)
    return _stress_figure(von_mises(stress, poisson_ratio(stiffness)[ids]), run.extent())


def snapshot_von_mises(run, chain):
    """Von Mises stress of the last snapshot."""
    displacement = run.last("/snapshots/displacement")
    grid = run.grid()
    if displacement is None or displacement.ndim != 3 or grid is None:
        raise Missing(f"/snapshots/displacement is not in the HDF5 file of {run.name}")
    ids = run.get("/material/phase_id")
    stiffness = _stiffness(run, chain, ids)
    strain = cell_strain(displacement, grid[1])
    by_cell = stiffness[ids] if ids is not None else stiffness
    subscripts = "yxij,yxj->yxi" if ids is not None else "ij,yxj->yxi"
    stress = np.einsum(subscripts, by_cell, strain)
    return _stress_figure(von_mises(stress, poisson_ratio(by_cell)), run.extent())


def _stiffness(run, chain, ids):
    """Stiffnesses [n][3][3] of the phases, or the one [3][3] of a homogeneous body: the run's own, else the RVE's."""
    own = run.get("/material/stiffness")
    candidates = [own if ids is not None or own is None else own[0]]
    candidates += [source.get("/phase/stiffness" if ids is not None else "/stiffness/effective") for source in chain.rve]
    for stiffness in candidates:
        if stiffness is not None and stiffness.shape[-2:] == (3, 3) and (ids is None or len(stiffness) > ids.max()):
            return stiffness
    raise Missing("the stiffnesses of the phases are in no file of the chain")


def _stress_figure(field, extent):
    if extent is None:
        raise Missing("the run has no uniform grid")
    factor, unit = scaled(field, units=STRESSES)
    limit = float(np.nanpercentile(field, 99.5)) / factor
    figure, axes, zoom, window = _pair(extent, field.shape, 0.1)
    for axis, sampling in ((axes, "antialiased"), (zoom, "nearest")):
        picture = _draw(axis, field / factor, extent, cmap=STRESS_MAP, vmin=0, vmax=limit,
                        interpolation=sampling)
    _bar(figure, picture, [axes, zoom], f"von Mises stress in {unit}")
    _show_window(zoom, window)
    return figure


def mean_von_mises(run):
    """Localized, direct and difference, one above the other; (figure, relative L2 difference)."""
    localized = run.need("/mean_von_mises")
    extent = run.extent()
    if extent is None or localized.ndim != 2:
        raise Missing(f"{run.name} has no /grid for /mean_von_mises")
    direct = run.get("/direct/mean_von_mises")
    direct = direct if direct is not None and direct.shape == localized.shape else None
    factor, unit = scaled(localized, units=STRESSES)
    both = localized if direct is None else np.stack([localized, direct])
    limit = float(np.nanpercentile(both, 99.5)) / factor
    fields = [("localized (homogeneous run)", localized)]
    if direct is not None:
        fields.append(("direct (heterogeneous run)", direct))
    rows = 3 if direct is not None else 1
    figure, axes = panels(rows, _height(extent, rows, 0.4), sharex=True)
    for axis, (title, field) in zip(axes, fields):
        picture = _draw(axis, field / factor, extent, cmap=STRESS_MAP, vmin=0, vmax=limit)
        axis.set_title(title, loc="left")
    _bar(figure, picture, list(axes[: len(fields)]), f"mean von Mises stress in {unit}")
    error = None
    if direct is not None:
        gap = (localized - direct) / factor
        bound = float(np.nanpercentile(np.abs(gap), 99.5)) or 1.0
        picture = _draw(axes[2], gap, extent, cmap=DIFFERENCE_MAP, vmin=-bound, vmax=bound)
        _bar(figure, picture, [axes[2]], f"difference in {unit}")
        axes[2].set_title("localized − direct", loc="left")
        error = float(np.linalg.norm(localized - direct) / np.linalg.norm(direct))
    axes[-1].set_xlabel("x in mm")
    return figure, error


def point_von_mises(run, name):
    return _stress_figure(run.need(f"/points/{name}/mean_von_mises"), run.extent())
