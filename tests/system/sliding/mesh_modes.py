"""Analysis modal of contact_dynamics on meshes: a grid handed in as a mesh, on 1 and 3 ranks; a free cylinder in 3D and a ring in 2D
against exact frequencies; a column under a platen in 3D and 2D; what is refused."""

import csv
import math
import tempfile

import h5py
import numpy as np
from scipy.optimize import brentq
from scipy.special import jv, yv

from mesh_files import Box, disc, extruded, mesh_of_blocks
from scenes import Folder, prm

STIFFNESS, DENSITY = "36.54e9, 9.1e9, 47.26e9, 13.785e9", 1770
MODAL = {"Analysis": "modal", "Modal/Number of modes": 6}
FREE = {**MODAL, "Supports/Top/Kind": "pressure", "Modal/Bottom": "free"}


def material(young, nu, density):
    return {"Phases/Names": "body", "Phases/body/Young modulus": young, "Phases/body/Poisson ratio": nu, "Phases/body/Density": density}


def modes(folder, run, bottom):
    with h5py.File(folder(run, "modal.h5")) as file:
        group = file["modes/" + bottom]
        return group["frequency"][()], group["modal_mass"][()], group["shape"][()]


def points_of(folder, run):
    with h5py.File(folder(run, "modal.h5")) as file:
        assert file.attrs["dim"] == file["mesh/points"].shape[1]
        return file["mesh/points"][()]


def table(folder, run):
    with open(folder(run, "modes.csv"), encoding="ascii") as file:
        return list(csv.DictReader(file))


def check_grid_as_mesh(folder):
    """Frequencies, masses and shapes under a platen with mass, one side held, to 1e-9."""
    common = {**MODAL, "Supports/Top/Kind": "platen", "Supports/Top/Platen mass": 0.05, "Modal/Tolerance": 1e-12}
    folder.write("grid.prm", prm({**common, "Body/Stiffness": STIFFNESS, "Body/Density": DENSITY, "Body/Size": "0.012, 0.004",
                                  "Body/Cells": "24, 10", "Supports/Left/Held": "u_x"}))
    folder.run(0, "contact_dynamics", "grid.prm", "--output", "grid")
    box = Box([12, 4], [24, 10], lambda x: "body")
    box.name_side("Contact", 1, False).name_side("Top", 1, True).name_side("wall", 0, False).write(folder("mesh.msh"))
    folder.write("mesh.prm", prm({**common, "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, "Supports/wall/Held": "u_x", "Phases/Names": "body",
                                  "Phases/body/Type": "stiffness", "Phases/body/Stiffness": STIFFNESS, "Phases/body/Density": DENSITY}))
    for ranks in (1, 3):
        run = f"mesh{ranks}"
        folder.run(0, "contact_dynamics", "mesh.prm", "--output", run, ranks=ranks)
        summary, expected = folder.summary(run), folder.summary("grid")
        for key in ("rigid_motions", "dofs", "cells", "analysis", "material", "dim"):
            assert summary[key] == expected[key], (key, summary[key], expected[key])
        for bottom in ("free", "held"):
            grid, mesh = modes(folder, "grid", bottom), modes(folder, run, bottom)
            for one, other in zip(grid[:2], mesh[:2]):
                assert np.abs(other / one - 1).max() < 1e-9, (ranks, bottom, one, other)
            rows = np.lexsort(np.round(points_of(folder, run), 9).T)  # as on the grid, x fastest
            shapes, others = grid[2].reshape(6, -1, 2), mesh[2][:, rows]
            signs = np.sign(np.sum(shapes * others, axis=(1, 2)))[:, None, None]
            assert np.abs(signs * others - shapes).max() < 1e-6, (ranks, bottom)
        for one, other in zip(table(folder, "grid"), table(folder, run)):
            for column in ("effective_mass_x [-]", "effective_mass_y [-]"):
                assert abs(float(one[column]) - float(other[column])) < 1e-8, (ranks, one, other)


def check_free_cylinder(folder):
    """With nu = 0 the lowest longitudinal mode is that of a chain of masses, c / (pi h) sin(pi h / 2 L) with c^2 = E / rho on any mesh of
    layers; torsion has f = sqrt(G / rho) / (2 L) for every radius, which refinement approaches with order two."""
    length, radius, young, density = 3.0, 0.5, 2.0, 1.5
    speed, errors = math.sqrt(young / density), []
    for n in (1, 2, 4):
        layers = 6 * n
        extruded(disc(n, radius, "body"), length, layers).write(folder("cylinder.msh"))
        folder.write("cylinder.prm", "set Dimension = 3\n" + prm({**FREE, **material(young, 0, density), "Mesh/File": "cylinder.msh",
                                                                  "Mesh/Scale": 1, "Modal/Number of modes": 8}))
        folder.run(0, "contact_dynamics", "cylinder.prm", "--output", "cylinder", ranks=min(n, 2))
        assert folder.summary("cylinder")["rigid_motions"]["free"] == 6
        frequency, _, shape = modes(folder, "cylinder", "free")
        x, y, z = points_of(folder, "cylinder").T
        wave, layer = np.cos(math.pi * z / length), length / layers

        def nearest(field):
            """The number of the mode that is most like it."""
            field = np.stack(field, axis=-1)
            likeness = np.abs(np.sum(shape * field, axis=(1, 2))) / np.sqrt(np.sum(shape**2, axis=(1, 2)) * np.sum(field**2))
            assert likeness.max() > 0.99, likeness
            return likeness.argmax()

        chain = speed / (math.pi * layer) * math.sin(math.pi * layer / (2 * length))
        assert abs(frequency[nearest((0 * z, 0 * z, wave))] / chain - 1) < 1e-8
        errors.append(frequency[nearest((-y * wave, x * wave, 0 * z))] / (speed / math.sqrt(2) / (2 * length)) - 1)
    print("torsion of a free cylinder: relative errors", errors)
    assert abs(errors[-1]) < 7e-3 and all(3.6 < coarse / fine < 4.4 for coarse, fine in zip(errors, errors[1:])), errors
    rows = table(folder, "cylinder")
    assert len(rows) == 8 and all(float(row["effective_mass_z [-]"]) < 1e-12 for row in rows), "a free body is at rest in the mean"


def breathing(inner, outer, nu):
    """k of the radial mode u = A J1(k r) + B Y1(k r) of a ring in plane strain without traction: omega = k c_L."""
    ratio = nu / (1 - nu)  # lambda / (lambda + 2 mu)

    def traction(bessel, k, r):
        return k * bessel(0, k * r) - (1 - ratio) / r * bessel(1, k * r)

    def determinant(k):
        return traction(jv, k, inner) * traction(yv, k, outer) - traction(jv, k, outer) * traction(yv, k, inner)

    return brentq(determinant, 0.5 * 2 / (inner + outer), 1.5 * 2 / (inner + outer), xtol=1e-14)


def check_ring(folder):
    """A quarter of a ring whose ends are held along the circle: the breathing mode, of order two on quadrilaterals and triangles."""
    inner, outer, young, nu, density = 0.6, 1.0, 3.0, 0.3, 2.0
    speed = math.sqrt(young * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / density)
    exact = breathing(inner, outer, nu) * speed / (2 * math.pi)
    settings = {**FREE, **material(young, nu, density), "Mesh/File": "ring.msh", "Mesh/Scale": 1, "Supports/upright/Held": "u_x",
                "Supports/lying/Held": "u_y"}
    for kind in ("cube", "simplex"):
        errors = []
        for n in (4, 8, 16):
            radius = np.linspace(inner, outer, n + 1)[None, :, None]
            angle = np.linspace(0, math.pi / 2, 4 * n + 1)[:, None]
            block = radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
            block[-1, :, 0] = block[0, :, 1] = 0
            ring = mesh_of_blocks(kind, [block], "body")
            ring.name_side("upright", 0, False).name_side("lying", 1, False).write(folder("ring.msh"))
            folder.write("ring.prm", prm(settings))
            folder.run(0, "contact_dynamics", "ring.prm", "--output", "ring")
            assert folder.summary("ring")["rigid_motions"]["free"] == 0
            frequency, _, shape = modes(folder, "ring", "free")
            points = points_of(folder, "ring")
            outward = points / np.hypot(*points.T)[:, None]
            swirl = np.abs(np.sum(shape * outward[:, ::-1] * [-1, 1], axis=2)).max(axis=1)
            errors.append(frequency[swirl.argmin()] / exact - 1)
        print("breathing mode of a ring,", kind, "relative errors", errors)
        assert abs(errors[-1]) < 1e-3 and all(3.6 < coarse / fine < 4.4 for coarse, fine in zip(errors, errors[1:])), (kind, errors)


def check_free_disc(folder):
    """A disc, which has no lower side to stand on: its breathing mode, J0(k R) k R = (1 - lambda / (lambda + 2 mu)) J1(k R)."""
    young, nu, density = 3.0, 0.3, 2.0
    k = brentq(lambda x: x * jv(0, x) - (1 - nu / (1 - nu)) * jv(1, x), 1, 3, xtol=1e-14)
    exact = k * math.sqrt(young * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / density) / (2 * math.pi)
    disc(8, 1.0, "body").write(folder("disc.msh"))
    folder.write("disc.prm", prm({**FREE, **material(young, nu, density), "Mesh/File": "disc.msh", "Mesh/Scale": 1,
                                  "Modal/Number of modes": 12}))
    folder.run(0, "contact_dynamics", "disc.prm", "--output", "disc")
    assert folder.summary("disc")["rigid_motions"]["free"] == 3
    frequency = modes(folder, "disc", "free")[0]
    assert np.abs(frequency / exact - 1).min() < 0.01, (frequency, exact)


def check_column(folder):
    """A column between walls under a platen with mass: 3D, on two ranks, gives the frequencies of a grid."""
    platen = {**MODAL, "Modal/Number of modes": 3, "Supports/Top/Kind": "platen"}
    lame, shear = 1e9 * 0.3 / (1.3 * 0.4), 1e9 / 2.6
    stiffness = ", ".join(map(repr, [lame + 2 * shear, lame, lame + 2 * shear, shear]))
    folder.write("column.prm", prm({**platen, "Supports/Top/Platen mass": 0.02, "Body/Stiffness": stiffness, "Body/Density": 1000,
                                    "Body/Size": "0.0005, 0.016", "Body/Cells": "2, 16", "Supports/Left/Held": "u_x", "Supports/Right/Held": "u_x"}))
    folder.run(0, "contact_dynamics", "column.prm", "--output", "column")
    box = Box([0.5, 0.5, 16], [2, 2, 16], lambda x: "body")
    for axis in range(3):
        for upper in (False, True):
            box.name_side(("lower_", "upper_")[upper] + "xyz"[axis], axis, upper)
    box.write(folder("solid.msh"))
    # The platen of the plane column weighs 0.02 kg/m on a width of 0.5 mm.
    solid = {**platen, **material(1e9, 0.3, 1000), "Mesh/File": "solid.msh", "Mesh/Scale": 0.001}
    folder.write("solid.prm", "set Dimension = 3\n" + prm({
        **solid, "Supports/Top/Platen mass": 0.02 * 0.0005, "Mesh/Contact boundary": "lower_z", "Mesh/Top boundary": "upper_z",
        "Supports/lower_x/Held": "u_x", "Supports/upper_x/Held": "u_x", "Supports/lower_y/Held": "u_y", "Supports/upper_y/Held": "u_y"}))
    folder.run(0, "contact_dynamics", "solid.prm", "--output", "solid", ranks=2)
    for bottom in ("free", "held"):
        plane, solid = modes(folder, "column", bottom), modes(folder, "solid", bottom)
        assert np.abs(solid[0] / plane[0] - 1).max() < 1e-8, (bottom, plane[0], solid[0])
        assert np.abs(solid[1] / (0.0005 * plane[1]) - 1).max() < 1e-7, (bottom, plane[1], solid[1])
    assert [row["effective_mass_z [-]"] for row in table(folder, "solid")] and folder.summary("solid")["rigid_motions"] == {
        "free": 1, "held": 0}
    shown = folder.read("solid", "modal.xdmf").decode()
    assert shown.count("modal.h5:/modes/held/shape") == 3 and 'Center="Node"' in shown
    assert 'Center="Cell"' in folder.read("solid", "modal-phases.xdmf").decode()


def check_refused(folder):
    def refused(words, *settings):
        said = folder.run(2, "contact_dynamics", "solid.prm", "--output", "none", *("--set=" + setting for setting in settings))
        assert all(word in said for word in words) and said.count("\n") == 1, said

    refused(["Modal/Bottom", "'held in y'", "use 'held in z'"], "Modal/Bottom=held in y")
    refused(["Modal/Number of modes", "500 modes of only"], "Modal/Number of modes=500")
    refused(["Performance/Static solver", "ml"], "Performance/Static solver=jacobi")
    refused(["Mesh/Contact boundary", "'sole' is no physical group"], "Mesh/Contact boundary=sole")
    refused(["Supports/upper_z", "it is Mesh/Top boundary"], "Supports/upper_z/Held=u_z")
    # What is neither held nor loaded need not be there.
    folder.run(0, "contact_dynamics", "solid.prm", "--validate", "--set=Mesh/Contact boundary=sole", "--set=Modal/Bottom=free")


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_grid_as_mesh(folder)
        check_column(folder)
        check_refused(folder)
        check_ring(folder)
        check_free_disc(folder)
        check_free_cylinder(folder)
    print("modes on meshes: as on the grid, and exact ones with order two")


if __name__ == "__main__":
    main()
