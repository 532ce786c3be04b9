"""Derivatives of frequencies with respect to the stiffness of phases, and standard deviations of frequencies.

Bodies of every kind (plane grid, box of voxels with orientations, meshes of simplices and of quadrilaterals or hexahedra, a pair of
bodies), with isotropic, nearly incompressible, turned orthotropic and full phases: the change of each frequency between two runs whose
constants all change a little along a random direction is that of the derivatives, and, as frequencies are of degree 1/2 in the stiffness,
the sum of derivatives times stiffness is half the frequency. With a deviation of one constant, the standard deviation of a frequency is
half the difference of the frequencies one deviation above and below, for phases, effective stiffnesses and groups of a mesh. One, two and
three ranks agree.
"""

import csv
import tempfile

import h5py
import numpy as np

from derivatives import box_of_voxels, constants, moved, plane_volume, settings_of, voxel_volume
from macroscopic_loads import close, run

from mesh_files import Box
from scenes import Folder, prm

STEP = 2e-5
MODAL = {"Analysis": "modal", "Modal/Number of modes": 4, "Modal/Tolerance": 1e-12, "Modal/Derivatives": "true", "Supports/Top/Kind": "held"}
HETEROGENEOUS = {"Body/Material": "heterogeneous"}
DENSITIES = {f"Phases/{name}/Density": density for name, density in (("soft", 1770), ("wood", 900), ("crystal", 3000))}


def modal(folder, name, settings, ranks=1):
    """Frequencies by bottom, one after the other."""
    folder.write(name + ".prm", prm({**MODAL, **settings}))
    folder.run(0, "contact_dynamics", name + ".prm", "--output", name, "--quiet", ranks=ranks)
    return np.concatenate(list(folder.summary(name)["frequencies"].values()))


def table(folder, name, what):
    with open(folder(name, f"frequency_{what}.csv"), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def derivatives(folder, name, n):
    """G of each mode and phase: symmetric matrices whose scalar product with a change of the stiffness is the change of the frequency."""
    found = {}
    for row in table(folder, name, "derivatives"):
        G = np.zeros((n, n))
        for i, j in zip(*np.triu_indices(n)):
            G[i, j] = G[j, i] = float(row[f"dD{i + 1}{j + 1} [Hz/Pa]"]) / (1 if i == j else 2)
        found.setdefault((row["bottom"], int(row["mode [-]"])), []).append(G)
    return np.array(list(found.values()))


def phases_in(folder, name):
    with h5py.File(folder(name, "rve.h5")) as file:
        return file["phase/stiffness"][()]


def check(folder, name, dim, stiffness, frequencies, settings, ranks):
    """@p stiffness and @p frequencies of the body itself and of those with constants above and below."""
    for of_ranks in ranks:
        here = modal(folder, name, settings, of_ranks)
        G = derivatives(folder, name, 3 * dim - 3)
        close(np.einsum("kpij,pij->k", G, stiffness[0]), here / 2, 1e-8, f"{name}, {of_ranks} ranks: degree 1/2")
        change = np.einsum("kpij,pij->k", G, stiffness[1] - stiffness[2])
        close(change, frequencies[0] - frequencies[1], 1e-5, f"{name}, {of_ranks} ranks: derivatives and differences")


def check_heterogeneous(folder, name, dim, volume, body, ratio=0.3, ranks=(1,)):
    phases = constants(dim, ratio)
    stiffness, frequencies = [], []
    for k, some in enumerate((phases, moved(phases, STEP), moved(phases, -STEP))):
        run(folder, f"rve{k}", settings_of(some, {**volume, **DENSITIES, "Homogenization/Derivatives": "false", "Homogenization/Boundary conditions": "KUBC",
                                                  "Homogenization/Effective": "KUBC"}))
        stiffness.append(phases_in(folder, f"rve{k}1"))
        if k:
            frequencies.append(modal(folder, name, {**HETEROGENEOUS, "Body/RVE file": f"rve{k}1/rve.h5", **body}))
    check(folder, name, dim, stiffness, frequencies, {**HETEROGENEOUS, "Body/RVE file": "rve01/rve.h5", **body}, ranks)


def check_kinds(folder):
    check_heterogeneous(folder, "grid", 2, plane_volume(folder), {}, 0.499, (1, 2))
    check_heterogeneous(folder, "box", 3, voxel_volume(folder), {"Dimension": 3}, 0.499, (1, 2, 3))
    for dim, kind in ((2, "cube"), (2, "simplex"), (3, "cube"), (3, "simplex")):
        box = box_of_voxels((5, 4, 3)[:dim], kind)
        box.name_side("Contact", dim - 1, False)
        box.name_side("Top", dim - 1, True)
        box.write(folder("mesh.msh"))
        mesh = {"Dimension": dim, "Mesh/File": "mesh.msh", "Mesh/Scale": 1e-3}
        check_heterogeneous(folder, f"{kind}{dim}", dim, mesh, mesh, 0.4, (1, 3))


def check_deviations(folder):
    """Deviation of one constant of the phases, for a body with its phases, one with the effective stiffness, and the groups of a mesh."""
    deviation = 1e-3
    plane = plane_volume(folder)
    phases = constants(2, 0.3)
    kind, values, more = phases["wood"]
    which = list(values).index("E2")
    deviations = ", ".join(str(deviation if k == which else 0) for k in range(len(values)))

    def with_modulus(factor):
        return {**phases, "wood": (kind, {**values, "E2": values["E2"] * factor}, more)}

    for k, factor in enumerate((1, 1 + deviation, 1 - deviation)):
        run(folder, f"rve{k}", {**settings_of(with_modulus(factor), plane), **DENSITIES, "Homogenization/Derivatives": "false",
                                **({} if k else {"Phases/wood/Relative deviation": deviations})})
    for name, body in (("phases", HETEROGENEOUS), ("effective", {"Body/Cells": "5, 12"}), ("SUBC", {"Body/Cells": "5, 12", "Body/Stiffness from": "SUBC"})):
        above, below = (modal(folder, name, {"Body/RVE file": f"rve{k}1/rve.h5", **body}) for k in (1, 2))
        modal(folder, name, {"Body/RVE file": "rve01/rve.h5", **body})
        rows = table(folder, name, "uncertainty")
        close([float(row["standard_deviation [Hz]"]) for row in rows], np.abs(above - below) / 2, 1e-5, f"standard deviations, {name}")
        assert all(abs(float(row["variance_from_wood_E2 [-]"]) - 1) < 1e-12 for row in rows), rows
        told = folder.summary(name)["frequency_deviations"]
        assert np.allclose(np.concatenate(list(told.values())), [float(row["standard_deviation [Hz]"]) for row in rows], rtol=1e-9)

    box = Box([5.0, 4.0], (5, 4), lambda x: "soft" if x[0] < 2 else "wood", "simplex")
    box.name_side("Contact", 1, False)
    box.name_side("Top", 1, True)
    box.write(folder("groups.msh"))

    def of_groups(factor, more_keys=()):
        keys = settings_of({name: one for name, one in with_modulus(factor).items() if name != "crystal"}, {})
        keys = {key: value for key, value in keys.items() if key.startswith("Phases/")}
        return {"Mesh/File": "groups.msh", "Mesh/Scale": 1e-3, **keys, "Phases/Names": "soft, wood", "Phases/soft/Density": 1770,
                "Phases/wood/Density": 900, **dict(more_keys)}

    above, below = (modal(folder, "groups", of_groups(factor)) for factor in (1 + deviation, 1 - deviation))
    modal(folder, "groups", of_groups(1, {"Phases/wood/Relative deviation": deviations}))
    close([float(row["standard_deviation [Hz]"]) for row in table(folder, "groups", "uncertainty")], np.abs(above - below) / 2, 1e-5,
          "standard deviations, groups of a mesh")


def check_pair(folder):
    """Derivatives of two bodies that touch: half the frequency in all."""
    D = np.array([[36.54e9, 9.1e9, 0], [9.1e9, 47.26e9, 0], [0, 0, 13.785e9]])
    pair = {"Body/Size": "6e-3, 4e-3", "Body/Cells": "6, 4", "Counter body/Stiffness": "36.54e9, 9.1e9, 47.26e9, 13.785e9", "Counter body/Density": 7800,
            "Counter body/Size": "6e-3, 3e-3", "Counter body/Cells": "6, 3", "Counter body/Supports/Bottom/Kind": "held"}
    frequencies = modal(folder, "pair", pair)
    G = derivatives(folder, "pair", 3)
    assert G.shape[1] == 2, G.shape
    close(np.einsum("kpij,ij->k", G, D), frequencies / 2, 1e-8, "pair: degree 1/2")


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_kinds(folder)
        check_deviations(folder)
        check_pair(folder)


if __name__ == "__main__":
    main()
