"""A flat that moves along x and y: along y a square block does what it does along x with its axes exchanged, in a transient run and in
static contact, on 1, 2 and 3 ranks; what is reported at an angle; what is refused."""

import tempfile

import h5py
import numpy as np

from mesh_dynamics import COMMON, STEEL, check_equal, check_same_summary, group
from mesh_files import Box
from mesh_static_contact import LOADS, assert_close, columns
from scenes import Folder, prm

CELLS = [6, 6, 4]
MESH = {**COMMON, "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, **STEEL}
BLOCK = {**MESH, "Body/Initial velocity": "0, 0, -1", "Supports/Top/Kind": "platen", "Observation/Probes": "tip"}


def exchanged(vectors):
    """[...][3] or tensors [...][6] in Voigt order xx, yy, zz, yz, xz, xy with x and y exchanged."""
    return vectors[..., [1, 0, 2] if vectors.shape[-1] == 3 else [1, 0, 2, 4, 3, 5]]


def block(mirrored):
    """Two phases in a pattern that knows x from y."""
    def phase(x):
        i, j = (int(v) for v in (x[::-1][1:] if mirrored else x[:2]))
        return "core" if (i, j) in ((0, 0), (1, 4), (3, 2), (5, 1)) else "body"

    box = Box(CELLS, CELLS, phase)
    return box.name_side("Contact", 2, False).name_side("Top", 2, True)


def write_block(folder, mirrored):
    block(mirrored).write(folder("mesh.msh"))
    core = {"Phases/Names": "body, core", "Phases/core/Young modulus": "70e9", "Phases/core/Poisson ratio": 0.2, "Phases/core/Density": 2700}
    tip = "0.0012, 0.0053, 0.0008" if mirrored else "0.0053, 0.0012, 0.0008"
    settings = {**BLOCK, **core, "Flat/Velocity": "0, 2" if mirrored else "2, 0", "Observation/tip/Position": tip}
    folder.write("block.prm", "set Dimension = 3\n" + prm(settings))


def check_along_y(folder):
    write_block(folder, False)
    folder.run(0, "contact_dynamics", "block.prm", "--output", "x")
    write_block(folder, True)
    expected = folder.summary("x")
    assert expected["flat_velocity"] == 2 and expected["flat_direction"] == [1, 0]
    assert expected["mean_apparent_friction_coefficient"] > 0.01 and expected["main_frequency"] > 0, expected
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "block.prm", "--output", "y", ranks=ranks)
        for name in ("history", "energy", "spectrum", "phase_diagram"):
            one, other = (group(folder, run, name) for run in "xy")
            for key in ("residual", "scheme", "potential"):
                one.pop(key, None), other.pop(key, None)
            check_equal({key: values for key, values in one.items() if np.abs(values).max() > 0}, {key: other[key] for key in one if np.abs(
                one[key]).max() > 0}, 1e-8, (ranks, name))
        for name in ("reference", "probes/tip"):
            one, other = (group(folder, run, name) for run in "xy")
            check_equal(one, {key: values if values.ndim == 1 else exchanged(values) for key, values in other.items()}, 1e-8, (ranks, name))
        summary = folder.summary("y")
        assert summary["flat_velocity"] == 2 and summary["flat_direction"] == [0, 1] and summary["energy_balance_residual"] < 1e-11
        check_same_summary(expected, summary, 1e-8, ranks, but=("flat_direction", "limit_cycle", "largest_strain"))
        with h5py.File(folder("y", "dynamics.h5")) as file:
            stated = file["run"].attrs
            assert (stated["velocity"], stated["flat_direction_x"], stated["flat_direction_y"]) == (2, 0, 1), dict(stated)
    with h5py.File(folder("x", "dynamics.h5")) as file:
        assert "flat_direction_x" not in file["run"].attrs


def check_askew(folder):
    """Sliding all the time, friction over pressure is the coefficient along the motion, which is at an angle; a ramp is of the vector."""
    Box(CELLS, [3, 3, 2], lambda x: "body").name_side("Contact", 2, False).name_side("Top", 2, True).write(folder("mesh.msh"))
    folder.write("askew.prm", "set Dimension = 3\n" + prm({
        **MESH, "Supports/Top/Kind": "platen", "Friction/Coefficient": 0.1, "Flat/Velocity": "-12, 16", "Flat/Gap": 0, "Supports/Top/Pressure": 1e6,
        "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 2e-5, "Observation/Steady from": 2e-5}))
    for settings in ((), ("--set=Flat/Ramp=linear", "--set=Flat/Ramp time=4e-5"), ("--set=Flat/Velocity=-0.3, 0.4", "--set=Flat/Expression=20")):
        folder.run(0, "contact_dynamics", "askew.prm", "--output", "askew", *settings, ranks=2)
        summary = folder.summary("askew")
        assert np.allclose(summary["flat_direction"], [-0.6, 0.8], rtol=0, atol=1e-15), summary
        assert abs(summary["flat_velocity"] - (0.5 if len(settings) == 2 and "Expression" in settings[1] else 20)) < 1e-12
        assert summary["slip_fraction"] == 1 and abs(summary["global_interface_friction_coefficient"] - 0.1) < 1e-3, summary
        assert summary["energy_balance_residual"] < 1e-11
        history, node = group(folder, "askew"), group(folder, "askew", "reference")
        steady = history["time"] > 2.5e-5
        ratio = history["contact_tangential_force"][steady] / history["contact_normal_force"][steady]
        assert abs(ratio.mean() - 0.1) < 1e-4 and abs(history["apparent_friction"][steady].mean() - 0.1) < 0.02, ratio.mean()
        traction = node["traction"][steady].mean(axis=0)
        assert np.allclose(traction[:2] / traction[2], [-0.06, 0.08], rtol=0.05), traction


def check_static(folder):
    """Along y as along x; at an angle friction is mu p along the motion."""
    solid = {**LOADS, "Supports/Top/Held": "u_x, u_y", "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, **STEEL}
    names = ("pressure [Pa]", "shear_traction [Pa]", "shear_traction_y [Pa]", "displacement_x [m]", "displacement_y [m]")
    box = Box([4, 4, 2], [4, 4, 3], lambda x: "body").name_side("Contact", 2, False).name_side("Top", 2, True)
    box.write(folder("mesh.msh"))
    found = {}
    for velocity in ("2", "0, 2", "-3, 4"):
        folder.write("static.prm", "set Dimension = 3\n" + prm({**solid, "Flat/Velocity": velocity}))
        for ranks in (1, 2, 3):
            folder.run(0, "contact_dynamics", "static.prm", "--output", "static", ranks=ranks)
            table, states = columns(folder, "static", *names)
            assert_close(found.setdefault(velocity, table), table, 1e-6)
            assert "slip" in states and "stick" not in states
            assert abs(folder.summary("static")["normal_force"] / (1e6 * 16e-6) - 1) < 1e-7
    pressure, *vectors = ([column.reshape(5, 5).T.ravel() for column in found["0, 2"]])
    assert_close(found["2"], [pressure, vectors[1], vectors[0], vectors[3], vectors[2]], 1e-6)
    pressure, shear, shear_y = found["-3, 4"][:3]
    assert_close([-0.6 * 0.2 * pressure, 0.8 * 0.2 * pressure], [shear, shear_y], 1e-6)


def check_refused(folder):
    def refused(words, *settings):
        said = folder.run(2, "contact_dynamics", "static.prm", "--validate", *("--set=" + setting for setting in settings))
        assert all(word in said for word in words), said

    refused(["Flat/Velocity", "two components, but Dimension is 2"], "Dimension=2", "Flat/Velocity=1, 0")
    refused(["Flat/Velocity", "3"], "Flat/Velocity=1, 2, 3")
    free = ["Supports/Top/Held=u_x"]
    refused(["Nothing holds the body", "a group in u_y"], "Flat/Velocity=1, 1", *free)
    folder.run(0, "contact_dynamics", "static.prm", "--validate", "--set=Flat/Velocity=1, 0", *("--set=" + word for word in free))


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_along_y(folder)
        check_askew(folder)
        check_static(folder)
        check_refused(folder)
    print("a flat along y and at an angle: as along x, on several ranks, transient and static")


if __name__ == "__main__":
    main()
