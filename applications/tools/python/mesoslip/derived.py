"""Quantities that follow from the stresses and strains of a file: von Mises, principal values, means by phase.

The functions take plain arrays with a last axis of 3 components (2D: xx, yy, xy) or 6 (3D: xx, yy, zz, yz, xz, xy);
ResultFile has them as methods that know units and phases. In 2D the body is in plane strain, so that there is a
sigma_zz besides: nu (sigma_xx + sigma_yy) in an isotropic material.
"""

import numpy as np

from .array import Array

PLACES = {3: ((0, 2), (2, 1)), 6: ((0, 5, 4), (5, 1, 3), (4, 3, 2))}  # of the components in the tensor


def _components(values):
    values = np.asarray(values, dtype=float)
    if values.ndim == 0 or values.shape[-1] not in PLACES:
        raise ValueError(f"the last axis has to have 3 components (xx, yy, xy) or 6 (xx, yy, zz, yz, xz, xy), the shape is {values.shape}")
    return values


def von_mises(stress, stress_zz=None):
    """sqrt(3/2 s:s) [...], s the deviator of `stress` [...][3 or 6] (Pa), in 2D with `stress_zz` [...]."""
    values = _components(stress)
    if values.shape[-1] == 3:
        if stress_zz is None:
            raise ValueError("in 2D von Mises' stress needs stress_zz, as the body is in plane strain")
        xx, yy, xy = np.moveaxis(values, -1, 0)
        zz, shear = np.asarray(stress_zz, dtype=float), xy**2
    else:
        xx, yy, zz, yz, xz, xy = np.moveaxis(values, -1, 0)
        shear = yz**2 + xz**2 + xy**2
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * shear)


def principal(values, stress_zz=None, strain=False):
    """Principal stresses, or strains of engineering shear with `strain`, the largest first: [...][3]; in 2D without `stress_zz` the two
    in the plane [...][2], of which the directions turn about z."""
    values = _components(values).copy()
    n = values.shape[-1]
    if strain:
        values[..., 2 if n == 3 else slice(3, None)] *= 0.5
    tensors = values[..., np.array(PLACES[n])]
    found = np.linalg.eigvalsh(tensors)
    if stress_zz is not None and n == 3:
        found = np.concatenate([found, np.broadcast_to(np.asarray(stress_zz, dtype=float), found.shape[:-1])[..., None]], axis=-1)
    return np.sort(found, axis=-1)[..., ::-1]


def stress_zz(stress, poisson_ratio):
    """nu (sigma_xx + sigma_yy) [...] of plane strain (Pa), for `stress` [...][3] and `poisson_ratio` [...]."""
    values = _components(stress)
    if values.shape[-1] != 3:
        raise ValueError("stresses with 6 components have their zz component among them")
    return poisson_ratio * (values[..., 0] + values[..., 1])


def poisson_ratio_of(stiffness):
    """nu = C12 / (C11 + C12) [n] of isotropic stiffness matrices of plane strain [n][3][3] (Pa); NaN of the others."""
    c = np.asarray(stiffness, dtype=float)
    lamb, mu = c[:, 0, 1], c[:, 2, 2]
    isotropic = np.zeros_like(c)
    isotropic[:, 0, 0] = isotropic[:, 1, 1] = lamb + 2 * mu
    isotropic[:, 0, 1] = isotropic[:, 1, 0] = lamb
    isotropic[:, 2, 2] = mu
    same = np.abs(c - isotropic).max(axis=(1, 2)) <= 1e-9 * np.abs(c).max(axis=(1, 2))
    return np.where(same, lamb / (c[:, 0, 0] + lamb), np.nan)


def measures_of(mesh):
    """Area (m^2) or volume (m^3) of each cell of a Mesh [cells], by Gauss points of order two in its corners' coordinates."""
    measures = np.empty(sum(len(numbers) for numbers in mesh.numbers.values()))
    points = np.asarray(mesh.points)
    for kind, corners in mesh.cells.items():
        x = points[corners]
        if kind in ("triangle", "tetrahedron"):
            edges = x[:, 1:] - x[:, :1]
            measures[mesh.numbers[kind]] = np.abs(np.linalg.det(edges)) / (2 if kind == "triangle" else 6)
        else:
            measures[mesh.numbers[kind]] = _measure_of_boxes(x)
    return measures


def _measure_of_boxes(x):
    """Of quadrilaterals [n][4][2] or hexahedra [n][8][3], the corners around their faces."""
    dim = x.shape[2]
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], dtype=float)
    if dim == 3:
        corners = np.array([(*c, z) for z in (-1, 1) for c in corners], dtype=float)
    total = np.zeros(len(x))
    for gauss in corners / np.sqrt(3):
        factors = 1 + corners * gauss
        gradient = np.stack([corners[:, d] * np.prod(np.delete(factors, d, axis=1), axis=1) for d in range(dim)], axis=1) / 2**dim
        total += np.abs(np.linalg.det(np.einsum("nci,cj->nij", x, gradient)))
    return total


class Derived:
    """Methods of ResultFile. `volume` is the file that has the phases of the cells, such as rve.h5 for a localization.h5; without it
    the file itself."""

    def phase_id(self):
        """Phase of each cell, [ny][nx] or [cells]. Raises KeyError where the file has none."""
        for name in ("phase/id", "material/phase_id"):
            if name in self:
                return self[name]
        raise KeyError(f"{self.path} holds no phases of cells; rve.h5 does: open it and give it as `volume`")

    def phase_names(self):
        """Names of the phases, in the order of their numbers."""
        return self["phase/name" if "phase/name" in self else "material/name"]

    def material_axes(self):
        """Axes of the material of each cell of a box of voxels whose orientations came from a file, as columns of [nz][ny][nx][3][3], before
        what its phase's own keys turn: sigma in these axes is R^T sigma R. Raises KeyError where the file has none."""
        (c1, c, c2), (s1, s, s2) = ((f(np.radians(np.asarray(self["orientation/euler_angles"])))).T for f in (np.cos, np.sin))
        rotation = np.stack([c1 * c2 - s1 * s2 * c, -c1 * s2 - s1 * c2 * c, s1 * s, s1 * c2 + c1 * s2 * c, -s1 * s2 + c1 * c2 * c, -c1 * s,
                             s2 * s, c2 * s, c], axis=-1).reshape(-1, 3, 3)
        return Array(rotation[np.asarray(self["orientation/id"])], "-", "material axes")

    def cell_measures(self):
        """Area (m^2) or volume (m^3) of each cell, as phase_id()."""
        if "grid" in self:
            grid = self.grid
            return Array(np.full(grid.cells[::-1], np.prod(grid.spacing)), f"m^{len(grid.cells)}")
        mesh = self.mesh
        return Array(measures_of(mesh), f"m^{np.shape(mesh.points)[1]}")

    def stress_zz(self, name, volume=None):
        """sigma_zz of plane strain, for stresses in 2D of all cells or of a probe: [...], Pa.

        Taken from the dataset beside them where there is one, else nu (sigma_xx + sigma_yy). Raises ValueError when a phase is not
        isotropic."""
        beside = name[: -len("stress")] + "stress_zz"
        if name.endswith("/stress") and beside in self:
            return self[beside]
        of = volume or self
        ratios = poisson_ratio_of(of["phase/stiffness" if "phase/stiffness" in of else "material/stiffness"])
        group = name.rpartition("/")[0]
        if group.startswith("probes/"):
            ratio = ratios[int(self.attributes(group)["phase"])]
        else:
            ratio = ratios[np.asarray(of.phase_id())]
        if np.isnan(ratio).any():
            raise ValueError(f"{self.path}: sigma_zz of {name} is not known, as a phase is not isotropic; use mesoslip.von_mises with a stress_zz")
        return Array(stress_zz(self[name], ratio), self.unit(name), f"stress_zz of {name}")

    def von_mises(self, name, volume=None):
        """Von Mises' stress of a dataset of stresses, as "mean_stress": [...], Pa. Of a mean it is that of the mean, not the mean."""
        stress = self[name]
        return Array(von_mises(stress, self._zz(name, stress, volume)), stress.unit, f"von Mises of {name}")

    def principal(self, name, volume=None):
        """The three principal stresses of a dataset of stresses, the largest first: [...][3], Pa."""
        stress = self[name]
        return Array(principal(stress, self._zz(name, stress, volume)), stress.unit, f"principal values of {name}")

    def _zz(self, name, stress, volume):
        return self.stress_zz(name, volume) if stress.shape[-1] == 3 else None

    def phase_means(self, values, volume=None):
        """Mean over the cells of each phase, weighted with their size, of a field of the cells: a dataset's name, or an array [ny][nx]...,
        in 3D [nz][ny][nx]..., on a mesh [cells]...: {name of the phase: number or array}."""
        of = volume or self
        values = self[values] if isinstance(values, str) else values
        unit, name = getattr(values, "unit", ""), getattr(values, "name", "")
        phase, weight = np.asarray(of.phase_id()), np.asarray(of.cell_measures())
        if np.shape(values)[: phase.ndim] != phase.shape:
            raise ValueError(f"{name or 'the field'} has the shape {np.shape(values)}, but there are {phase.shape} cells")
        flat = np.asarray(values, dtype=float).reshape(phase.size, *np.shape(values)[phase.ndim:])
        means = {}
        for number, phase_name in enumerate(of.phase_names()):
            own = phase.ravel() == number
            if own.any():
                means[phase_name] = Array(np.average(flat[own], axis=0, weights=weight.ravel()[own]), unit, f"mean of {name} over {phase_name}")
        return means
