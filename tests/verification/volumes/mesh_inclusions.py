"""rve_homogenization on meshes that follow round inclusions, in 2D and 3D, against exact solutions.

Equal shear moduli: the effective bulk modulus is exact for any shape (Hill 1964). A coated cylinder or sphere in a medium of its own
bulk modulus: neutral under every boundary condition, with the strains of Lame's ring and shell (Hashin 1962). A single inclusion: the
strain of Eshelby (1957), also, as to shears, in a nearly incompressible matrix (ratio 0.4999).
"""

import tempfile

import h5py
import numpy as np

from meshes import Phase, inclusion, made_irregular, order
from scenes import Folder, prm

GPA = 1e9
CELLS = {2: (8, 16), 3: (2, 4)}  # along an eighth of a circle


def homogenized(folder, dim, mesh, phases, conditions="PBC", **more):
    mesh.write(folder("cell.msh"))
    keys = {key: value for name, phase in phases.items() for key, value in phase.keys(name).items()}
    folder.write("cell.prm", f"set Dimension = {dim}\n" + prm({
        "Mesh/File": "cell.msh", "Mesh/Scale": 1, "Phases/Names": ", ".join(phases), **keys, "Homogenization/Tolerance": 1e-8,
        "Homogenization/Boundary conditions": conditions, "Homogenization/Effective": conditions.split(",")[0], **more}))
    folder.run(0, "rve_homogenization", "cell.prm", "--output", "cell")
    return folder.summary("cell")


def bulk(D, dim):
    """Bulk modulus, in 2D that of plane strain."""
    return np.array(D)[:dim, :dim].sum() / dim**2


def check_equal_shear_moduli(folder, dim):
    G = 12 * GPA
    phases = {"core": Phase(dim, 90 * GPA, G), "rest": Phase(dim, 10 * GPA, G)}
    errors = []
    for n in CELLS[dim]:
        mesh = made_irregular(inclusion(dim, n, [0.6], [n, n], list(phases)))
        summary = homogenized(folder, dim, mesh, phases, **{"Homogenization/Write concentration": "false"})
        D = np.array(summary["stiffness"]["PBC"])
        share = [phase["volume_fraction"] for phase in summary["phases"]]
        eta = phases["core"].eta
        exact = 1 / sum(s / (phase.k + eta) for s, phase in zip(share, phases.values())) - eta
        # Shear knows of no inclusion, whatever the mesh.
        shear = np.diag(D).copy()
        shear[:dim] = [(D[i, i] - D[i, (i + 1) % dim]) / 2 for i in range(dim)]
        assert np.abs(shear / G - 1).max() < 1e-9 and np.abs(D[:dim, dim:]).max() < 1e-9 * exact, D
        errors.append(bulk(D, dim) / exact - 1)
    errors = np.array(errors)
    print(f"{dim}D, equal shear moduli: bulk modulus off by {errors}, order {order(errors, CELLS[dim])}")
    assert abs(errors[-1]) < 5e-3 and np.all(errors > 0) and np.all(np.abs(order(errors, CELLS[dim]) - 2) < 0.35), errors


def shell_strain(dim, core, coat, inner, outer, points):
    """Strains (Voigt, engineering shear) at points of the shell for the strain 1 along every axis outside, u = A r + B / r^(dim - 1)."""
    # Core: u = r a; continuous displacement and traction at the inner radius; u = r at the outer one.
    stress = lambda A, B: dim * coat.k * A - 2 * coat.G * (dim - 1) * B / inner**dim
    rows = [[1, outer**-dim], [dim * (core.k - coat.k), dim * core.k / inner**dim + 2 * coat.G * (dim - 1) / inner**dim]]
    A, B = np.linalg.solve(rows, [1, 0])
    assert abs(stress(A, B) - dim * core.k * (A + B / inner**dim)) < 1e-9 * coat.k
    r = np.linalg.norm(points, axis=1)[:, None, None]
    tensor = (A + B / r**dim) * np.eye(dim) - dim * B / r**dim * points[:, :, None] * points[:, None, :] / r**2
    pairs = [(0, 1)] if dim == 2 else [(1, 2), (0, 2), (0, 1)]
    return np.stack([tensor[:, i, i] for i in range(dim)] + [2 * tensor[:, i, j] for i, j in pairs], axis=1)


def check_neutral(folder, dim, core):
    inner, outer = 0.35, 0.7
    coat = Phase(dim, 10 * GPA, 4 * GPA)
    share = (inner / outer) ** dim
    k = 1 / (share / (core.k + coat.eta) + (1 - share) / (coat.k + coat.eta)) - coat.eta
    phases = {"core": core, "coat": coat, "rest": Phase(dim, k, 0.6 * coat.G)}
    conditions, sizes = ("KUBC", "SUBC", "PBC") if dim == 2 else ("KUBC",), CELLS[dim]
    errors, strain_errors = [], []
    for n in sizes:
        mesh = inclusion(dim, n, [inner, outer], [n // 2, n, n // 2], list(phases))
        summary = homogenized(folder, dim, mesh, phases, ", ".join(conditions))
        errors.append([bulk(summary["stiffness"][of], dim) / k - 1 for of in conditions])
        with h5py.File(folder("cell", "rve.h5")) as file:
            coated = file["phase/id"][()] == 1
            corners = file["mesh/topology"][()].reshape(len(coated), -1)[coated, 1:]
            middle = file["mesh/points"][()][corners].mean(axis=1)
            found = file["concentration/KUBC"][()][coated][:, :, :dim].sum(axis=2)
        exact = shell_strain(dim, core, coat, inner, outer, middle)
        strain_errors.append(np.sqrt(np.mean((found - exact) ** 2) / np.mean(exact**2)))
    errors, strain_errors = np.array(errors), np.array(strain_errors)
    orders = [order(error, sizes) for error in errors.T]
    print(f"{dim}D, coated, k of the core {core.k:g} Pa: {dict(zip(conditions, zip(errors.T.tolist(), orders)))}; "
          f"strains {strain_errors}, order {order(strain_errors, sizes)}")
    assert np.abs(errors[-1]).max() < 2e-3 and np.all(np.abs(np.array(orders) - 2) < 0.35), (errors, orders)
    assert strain_errors[-1] < 0.04 and np.all(order(strain_errors, sizes) > 1.5), strain_errors


def strain_in_single(folder, dim, radius, core, rest):
    """Fraction of volume, and the strain in the inclusion over the mean one: volume change and both shears. Two meshes, extrapolated."""
    strains = []
    for n in CELLS[dim]:
        mesh = inclusion(dim, n, [radius], [n, n if dim == 2 else 2 * n], ["core", "rest"])
        summary = homogenized(folder, dim, mesh, {"core": core, "rest": rest}, **{"Homogenization/Write concentration": "false"})
        D = np.array(summary["stiffness"]["PBC"])
        f = summary["phases"][0]["volume_fraction"]
        excess = np.array([bulk(D, dim) - rest.k, (D[0, 0] - D[0, 1]) / 2 - rest.G, D[-1, -1] - rest.G])
        strains.append(excess / f / np.array([core.k - rest.k, core.G - rest.G, core.G - rest.G]))
    return f, strains[1] + (strains[1] - strains[0]) / 3


def check_single(folder, dim, rest):
    """From the stiffness, the strain in the inclusion over the mean one; what is linear in the fraction of volume falls out of two."""
    core = Phase(dim, 50 * GPA, 30 * GPA)
    k, G = rest.k, rest.G
    # Eshelby's tensor of a sphere; of a cylinder across its axis in plane strain.
    beta = (k + 2 * G) / (2 * (k + G)) if dim == 2 else 6 * (k + 2 * G) / (5 * (3 * k + 4 * G))
    exact = np.array([1 / (1 + (core.k / k - 1) * k / (k + rest.eta))] + 2 * [1 / (1 + beta * (core.G / G - 1))])
    shares, strains = zip(*(strain_in_single(folder, dim, radius, core, rest) for radius in ((0.3, 0.15) if dim == 2 else (0.4, 0.25))))
    limit = (strains[1] * shares[0] - strains[0] * shares[1]) / (shares[0] - shares[1])
    print(f"{dim}D, single inclusion: strains over Eshelby's {strains / exact} at fractions {shares}; in the limit {limit / exact}")
    first = 0 if rest.k < 10 * rest.G else 1  # the change of volume drowns in that of the matrix
    assert np.abs(strains[0] / exact - 1).max() > 0.01 and np.all(np.abs(limit / exact - 1)[first:] < 4e-3), limit / exact


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        for dim in (2, 3):
            check_equal_shear_moduli(folder, dim)
            for core in (Phase(dim, 80 * GPA, 50 * GPA), Phase(dim, 1e-5 * GPA, 1e-5 * GPA)):
                check_neutral(folder, dim, core)
            for rest in (Phase(dim, 5 * GPA, 3 * GPA), Phase(dim, 50000 * GPA, 10 * GPA)):
                check_single(folder, dim, rest)


if __name__ == "__main__":
    main()
