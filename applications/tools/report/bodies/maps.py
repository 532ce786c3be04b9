"""Maps of bodies on plane grids: morphology, von Mises stress of the RVE, of a snapshot and of the localization."""

import numpy as np

from report.base.data import Missing
from report.bodies.projections import View, draw
from report.bodies.stress_maps import compared, phase_figure, stress_group

TALL = 1.2  # height over width from which what is enlarged stands beside the body


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


def window_of(bounds, columns):
    """Corners (mm) of the part of the contact that is enlarged: a seventh of the width, but 30 of the columns of cells at least; None where
    that is most of the body."""
    (left, bottom), (right, top) = bounds
    width, height = right - left, top - bottom
    tall = height > TALL * width
    half = 0.5 * min(width, max(width / 7, 30 * width / columns))
    if 2 * half > 0.6 * width and not tall:
        return None
    middle = 0.5 * (left + right)
    return np.array([[middle - half, bottom], [middle + half, bottom + min(height, (2.0 if tall else 0.62) * half)]])


def whole_view(run):
    """The body on its grid."""
    extent = run.extent()
    if extent is None:
        raise Missing(f"{run.name} has no uniform grid")
    nx, ny = run.grid()[0].astype(int)
    bounds = np.array([extent[::2], extent[1::2]])
    return View(bounds, None, None, np.arange(nx * ny).reshape(ny, nx))


def views(run):
    """The body and, framed in it, the middle of the contact enlarged."""
    whole = whole_view(run)
    window = window_of(whole.bounds, whole.numbers.shape[1])
    if window is None:
        return [whole]
    if run.attribute("/run", "contact_side") is not None:  # the upper one, of a counter body
        window[:, 1] = whole.bounds[:, 1].sum() - window[::-1, 1]
    (width, height), part = np.ptp(whole.bounds, axis=0), np.ptp(window, axis=0)
    tall = height > TALL * width
    whole.frame = window
    return [whole, View(window, None, None, whole.numbers, whole.bounds, 0.6 * height / part[1] if tall else width / part[0], tall)]


def enlarged(run):
    """Whether pictures of the run have an enlarged part."""
    return len(views(run)) > 1


def phase_map(chain):
    """The first run that knows the morphology, and its phases [ny][nx]."""
    for runs, name in ((chain.rve, "/phase/id"), (chain.dynamics, "/material/phase_id")):
        for run in runs:
            ids = run.get(name)
            if ids is not None and ids.ndim == 2 and run.extent():
                return run, ids
    raise Missing("no /phase/id in an rve.h5 and no /material/phase_id in a dynamics.h5")


def morphology(run, ids):
    shares = np.bincount(ids.ravel()) / ids.size
    return phase_figure(views(run), run, ids.ravel(), [f" ({100 * share:.1f} %)" for share in shares])


def rve_von_mises(run, pressure):
    """Under a uniform strain whose mean stress is a compression (Pa) along y alone."""
    ids, stiffness = run.need("/phase/id", "/phase/stiffness")
    name = "KUBC" if "KUBC" in run.members("/concentration") else next(iter(run.members("/concentration")), "KUBC")
    effective, tensors = run.need("/stiffness/effective" if run.get("/stiffness/" + name) is None else "/stiffness/" + name,
                                  "/concentration/" + name)
    strain = np.linalg.solve(effective, [0.0, -pressure, 0.0])
    stress = np.einsum("yxij,yxjk,k->yxi", stiffness[ids], tensors, strain, optimize=True)
    return draw(views(run), [stress_group(von_mises(stress, poisson_ratio(stiffness[ids])).ravel())]), name


def snapshot_von_mises(run, chain):
    """Pa [cells]; of the last snapshot."""
    displacement, grid = run.last("/snapshots/displacement"), run.grid()
    if displacement is None or displacement.ndim != 3 or grid is None:
        raise Missing(f"/snapshots/displacement is not in the HDF5 file of {run.name}")
    ids = run.get("/material/phase_id")
    stiffness = _stiffness(run, chain, ids)
    strain = cell_strain(displacement, grid[1])
    by_cell = stiffness[ids] if ids is not None else stiffness
    subscripts = "yxij,yxj->yxi" if ids is not None else "ij,yxj->yxi"
    stress = np.einsum(subscripts, by_cell, strain)
    return von_mises(stress, poisson_ratio(by_cell)).ravel()


def _stiffness(run, chain, ids):
    """Stiffnesses [n][3][3] of the phases, or the one [3][3] of a homogeneous body: the run's own, else the RVE's."""
    own = run.get("/material/stiffness")
    candidates = [own if ids is not None or own is None else own[0]]
    candidates += [source.get("/phase/stiffness" if ids is not None else "/stiffness/effective") for source in chain.rve]
    for stiffness in candidates:
        if stiffness is not None and stiffness.shape[-2:] == (3, 3) and (ids is None or len(stiffness) > ids.max()):
            return stiffness
    raise Missing("the stiffnesses of the phases are in no file of the chain")


def mean_von_mises(run):
    """Localized, direct and difference; (figure, relative L2 difference)."""
    localized, direct = run.need("/mean_von_mises"), run.get("/direct/mean_von_mises")
    if run.extent() is None or localized.ndim != 2:
        raise Missing(f"{run.name} has no /grid for /mean_von_mises")
    direct = direct.ravel() if direct is not None and direct.shape == localized.shape else None
    return compared([whole_view(run)], localized.ravel(), direct, "mean von Mises stress")


def point_von_mises(run, name):
    return draw(views(run), [stress_group(run.need(f"/points/{name}/mean_von_mises").ravel())])
