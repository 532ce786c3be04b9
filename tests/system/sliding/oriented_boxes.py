"""contact_dynamics and stress_localization on a box of voxels whose orientations come from a file: as on a mesh of the same cells, in which
each grain is a phase with its Euler angles, on 1, 2 and 3 ranks; with more materials than fit a byte; refined as from voxels of that size;
modes and static contact; localized and direct stresses are those of the turned stiffnesses."""

import re
import tempfile

import boxes
import h5py
import numpy as np
from boxes import BOX, CELLS, COMMON, PROBES, SIDES, SIZE, displacements
from mesh_dynamics import check_equal, check_same_summary, group
from mesh_files import Box
from scenes import Folder, prm

GRAINS = 12
FINE = tuple(2 * n for n in CELLS)  # of a body that is refined
SEARCH = ("rve_digest", "inputs", "iterations", "state_changes", "solver_iterations", "residual", "friction_change")  # how statics were found
CRYSTAL = {"Type": "orthotropic", "Young moduli": "240e9, 60e9, 90e9", "Poisson ratios": "0.2, 0.25, 0.3", "Shear moduli": "40e9, 30e9, 50e9",
           "Density": 2600, "Friction coefficient": 0.5}
MATRIX = {"Young modulus": "30e9", "Poisson ratio": 0.2, "Density": 1800}
PHASES = {"Phases/Names": "matrix, crystal", **{f"Phases/matrix/{key}": value for key, value in MATRIX.items()},
          **{f"Phases/crystal/{key}": value for key, value in CRYSTAL.items()}}


def prepare(folder):
    """The volume of grains in a matrix, three times: with the number of the grain, with finer voxels, and with angles that all differ a
    little; and the mesh."""
    random = np.random.default_rng(11)
    voxels = np.where(random.random(CELLS[::-1]) < 0.03, -1, random.integers(0, GRAINS, CELLS[::-1]))
    angles = np.round(random.uniform((0, 0, 0), (360, 180, 360), (GRAINS, 3)), 3)
    np.save(folder("phases.npy"), (voxels >= 0).astype(np.uint8))
    np.save(folder("grains.npy"), voxels)
    np.save(folder("fine_phases.npy"), refined((voxels >= 0).astype(np.uint8)))
    np.save(folder("fine_grains.npy"), refined(voxels))
    folder.write("grains.csv", "grain,phi1 [degrees],Phi [degrees],phi2 [degrees]\n"
                 + "".join("%d,%r,%r,%r\n" % (n, *map(float, a)) for n, a in enumerate(angles)))
    np.save(folder("angles.npy"), angles[voxels] + 1e-12 * np.arange(voxels.size).reshape(*voxels.shape, 1))
    volume = {"Dimension": 3, "Grid/Cells": "%d, %d, %d" % CELLS, "Grid/Size": "%g, %g, %g" % SIZE, "Microstructure/Type": "voxels",
              "Microstructure/File": "phases.npy", **PHASES}
    grains = {"Microstructure/Orientation file": "grains.npy", "Microstructure/Orientation table": "grains.csv"}
    folder.write("rve.prm", prm({**volume, **grains}))
    folder.write("fine.prm", prm({**volume, **grains, "Grid/Cells": "%d, %d, %d" % FINE, "Microstructure/File": "fine_phases.npy",
                                  "Microstructure/Orientation file": "fine_grains.npy"}))
    folder.write("many.prm", prm({**volume, "Microstructure/Orientation file": "angles.npy"}))
    for name in ("rve", "fine", "many"):
        folder.run(0, "rve_homogenization", f"{name}.prm", "--output", name)

    def phase(middle):
        i, j, k = (int(x / length * n) for x, length, n in zip(middle, SIZE, CELLS))
        return "matrix" if voxels[k, j, i] < 0 else f"grain{voxels[k, j, i]}"

    mesh = Box(SIZE, CELLS, phase)
    for name, (axis, upper) in SIDES.items():
        mesh.name_side(name, axis, upper)
    mesh.write(folder("mesh.msh"))
    settings = {"Phases/Names": ", ".join(["matrix", *(f"grain{n}" for n in range(GRAINS))]),
                **{f"Phases/matrix/{key}": value for key, value in MATRIX.items()}}
    for n, euler in enumerate(angles):
        settings |= {f"Phases/grain{n}/{key}": value for key, value in CRYSTAL.items()} | {f"Phases/grain{n}/Euler angles": "%r, %r, %r" % tuple(map(float, euler))}
    return settings


def refined(values):
    """Of cells [z][y][x], those that each is cut into."""
    for axis, (n, fine) in enumerate(zip(values.shape, FINE[::-1])):
        values = np.repeat(values, fine // n, axis=axis)
    return values


def check_refined(folder):
    """A body with finer cells than its volume is that of a volume of such cells, whichever rank reads which of them."""
    shorter = ("--set=Time/Time step=6e-9", "--set=Time/End time=1.8e-6", "--set=Snapshots/Interval=6e-7")
    finer = ("--set=Body/Cells=%d, %d, %d" % FINE,)
    for name in boxes.SUPPORTS:
        folder.run(0, "contact_dynamics", f"{name}.prm", "--output", "of_fine", *shorter, "--set=Body/RVE file=fine/rve.h5")
        for of, ranks in (("rve", 1), ("rve", 2), ("rve", 3), ("rve", 7), ("many", 3)):
            folder.run(0, "contact_dynamics", f"{name}.prm", "--output", "refined", *shorter, *finer, f"--set=Body/RVE file={of}/rve.h5", ranks=ranks)
            with h5py.File(folder("of_fine", "dynamics.h5")) as one, h5py.File(folder("refined", "dynamics.h5")) as other, \
                 h5py.File(folder(of, "rve.h5")) as volume:
                u, v = (file["snapshots/displacement"][()] for file in (one, other))
                assert u.shape == v.shape and np.abs(u - v).max() < 1e-9 * np.abs(u).max() > 0, (name, of, ranks)
                for of_body, of_volume in (("material/phase_id", "phase/id"), ("orientation/id", "orientation/id")):
                    assert np.array_equal(other[of_body][()], refined(volume[of_volume][()])), (name, of, ranks, of_body)
                    assert other[of_body].dtype == volume[of_volume].dtype == one[of_body].dtype, (name, of, ranks, of_body)


def by_grain(settings):
    """Damping by phase of the mesh, in which each grain is a phase."""
    return settings.replace("2e-9, 7e-9", "2e-9" + GRAINS * ", 7e-9").replace("4e4, 1e4", "4e4" + GRAINS * ", 1e4")


def check_as_mesh(folder, of_mesh):
    for name, (of_box, mesh_sides) in boxes.SUPPORTS.items():
        mesh_sides = by_grain(mesh_sides)
        folder.write("mesh.prm", "set Dimension = 3\n" + prm({"Mesh/File": "mesh.msh", **of_mesh, **COMMON}) + mesh_sides + PROBES)
        folder.run(0, "contact_dynamics", "mesh.prm", "--output", "mesh")
        folder.write(f"{name}.prm", BOX + of_box + PROBES)
        for ranks, more in ((1, ()), (2, ()), (3, ()), (2, ("--set=Body/RVE file=many/rve.h5",))):
            run = f"{name}{ranks}"
            said = folder.run(0, "contact_dynamics", f"{name}.prm", "--output", run, *more, ranks=ranks)
            pairs = int(re.search(r"Orientations: (\d+) different pairs of phase and orientation", said)[1])
            assert pairs > 255 if more else pairs == GRAINS + 1, said
            for what in ("history", "energy", "probes", "reference"):
                one, two = ({key: v for key, v in group(folder, r, what).items() if key not in ("residual", "scheme", "potential")}
                            for r in (run, "mesh"))
                check_equal(one, two, 1e-9, (name, ranks, what))
            check_same_summary(folder.summary(run), folder.summary("mesh"), 1e-8, (name, ranks),
                               but=("inputs", "critical_time_step", "rayleigh_beta_of_phases", "rayleigh_alpha_of_phases"))
            with h5py.File(folder(run, "dynamics.h5")) as file, h5py.File(folder("mesh", "dynamics.h5")) as other:
                u, v = displacements(file), displacements(other)
                assert u.shape == v.shape and np.abs(u - v).max() < 1e-9 * np.abs(v).max() > 0, (name, ranks)
                assert set(np.unique(file["material/phase_id"][()])) == {0, 1} and file.attrs["format_version"] == 2
        assert folder.summary(f"{name}1")["slip_fraction"] > 0.01


def check_other_analyses(folder, of_mesh):
    common = {"Supports/Top/Pressure": 5e7, "Flat/Velocity": 1}
    for name, settings in (("modal", prm({"Analysis": "modal", "Modal/Number of modes": 3})),
                           ("static", prm({**common, "Analysis": "static contact", "Friction/Coefficient from": "constant", "Friction/Coefficient": 0.2}))):
        of_box, mesh_sides = boxes.SUPPORTS["platen"]
        folder.write("box_other.prm", "set Dimension = 3\n" + prm({"Body/Material": "heterogeneous", "Body/RVE file": "rve/rve.h5"}) + of_box + settings)
        folder.write("mesh_other.prm", "set Dimension = 3\n" + prm({"Mesh/File": "mesh.msh", **of_mesh}) + mesh_sides + settings)
        for run in ("box", "mesh"):
            folder.run(0, "contact_dynamics", f"{run}_other.prm", "--output", f"{run}_{name}")
        box, mesh = ({key: value for key, value in folder.summary(f"{run}_{name}").items()
                      if not key.startswith("phase") and not (isinstance(value, dict) and "matrix" in value)} for run in ("box", "mesh"))
        check_same_summary(box, mesh, 1e-6, name, but=SEARCH)


def check_localized(folder):
    """Stresses of the homogeneous and of the direct run: those of the turned stiffnesses, taken from loads of the volume."""
    common = {"Body/RVE file": "rve/rve.h5", "Supports/Top/Kind": "platen", "Supports/Top/Pressure": 5e7, "Time/Time step": 1e-8, "Time/End time": 4e-6, "Snapshots/Interval": 1e-6}
    folder.write("homogeneous.prm", prm({"Dimension": 3, **common}))
    folder.write("direct.prm", prm({"Dimension": 3, **common, "Body/Material": "heterogeneous"}))
    for run in ("homogeneous", "direct"):
        folder.run(0, "contact_dynamics", f"{run}.prm", "--output", run)
    folder.write("localization.prm", prm({"Input/RVE file": "rve/rve.h5", "Input/Homogeneous run": "homogeneous/dynamics.h5",
                                          "Input/Direct run": "direct/dynamics.h5", "Localization/Fields": "mean stress",
                                          "Window/From": 0}))
    for ranks in (1, 2):
        folder.run(0, "stress_localization", "localization.prm", "--output", f"localized{ranks}", ranks=ranks)
    with h5py.File(folder("rve", "rve.h5")) as file:
        phases, stiffness = file["orientation/phase"][()], file["phase/stiffness"][()]
        materials = np.array([turned(stiffness[p], a) for p, a in zip(phases, file["orientation/euler_angles"][()])])
        D, L = materials[file["orientation/id"][()].ravel()], file["concentration/KUBC"][()].reshape(-1, 6, 6)
    with h5py.File(folder("localized1", "localization.h5")) as one, h5py.File(folder("localized2", "localization.h5")) as two:
        for name, run, tensor in (("mean_stress", "homogeneous", D @ L), ("direct/mean_stress", "direct", D)):
            expected = np.einsum("cij,cj->ci", tensor, mean_strain(folder, run))
            found = one[name][()]
            assert np.abs(found - two[name][()]).max() <= 1e-12 * np.abs(found).max() > 0, name
            error = np.abs(found.reshape(-1, 6) - expected).max() / np.abs(expected).max()
            print(name, error)
            assert error < 1e-10, (name, error)


def mean_strain(folder, run):
    """Of the cells, at their middles, over the snapshots [cells][6]."""
    with h5py.File(folder(run, "dynamics.h5")) as file:
        u = file["snapshots/displacement"][()].mean(axis=0)
    h = np.array(SIZE) / CELLS
    corner = lambda i, j, k: u[k:k + CELLS[2], j:j + CELLS[1], i:i + CELLS[0]]  # noqa: E731
    gradient = np.zeros((*CELLS[::-1], 3, 3))
    for i, j, k in np.ndindex(2, 2, 2):
        for axis, end in enumerate((i, j, k)):
            gradient[..., axis] += (2 * end - 1) * corner(i, j, k) / (4 * h[axis])
    gradient = gradient.reshape(-1, 3, 3)
    pairs = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
    return np.stack([gradient[:, c, d] + (c != d) * gradient[:, d, c] for c, d in pairs], axis=1)


def turned(D, angles):
    """Stress and strain turned with Bunge's matrix."""
    phi1, Phi, phi2 = np.radians(angles)
    about_z = lambda a: np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]])  # noqa: E731
    g = about_z(phi2) @ np.array([[1, 0, 0], [0, np.cos(Phi), np.sin(Phi)], [0, -np.sin(Phi), np.cos(Phi)]]) @ about_z(phi1)
    pairs = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
    result = np.zeros((6, 6))
    for column, (c, d) in enumerate(pairs):
        strain = np.zeros((3, 3))
        strain[c, d] = strain[d, c] = 1 if c == d else 0.5
        own = g @ strain @ g.T
        s = D @ [own[p] * (1 if p[0] == p[1] else 2) for p in pairs]
        stress = np.zeros((3, 3))
        for value, (a, b) in zip(s, pairs):
            stress[a, b] = stress[b, a] = value
        result[:, column] = [(g.T @ stress @ g)[p] for p in pairs]
    return result


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        of_mesh = prepare(folder)
        check_localized(folder)
        check_as_mesh(folder, of_mesh)
        check_refined(folder)
        check_other_analyses(folder, of_mesh)
    print("a box with orientations of its cells: as the mesh whose grains are phases, on several ranks, refined, localized")


if __name__ == "__main__":
    main()
