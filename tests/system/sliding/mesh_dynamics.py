"""contact_dynamics on meshes: a grid handed in as a mesh, on 1, 2 and 3 ranks; three dimensions; going on from a checkpoint; what is
refused."""

import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import Folder, prm

COMMON = {"Flat/Velocity": 2, "Flat/Gap": 1e-7, "Supports/Top/Pressure": 5e6, "Friction/Coefficient": 0.4, "Time/Time step": 4e-8,
          "Time/End time": 4e-5, "Observation/History interval": 1, "Observation/Energy interval": 1}
STIFFNESS, DENSITY = "36.54e9, 9.1e9, 47.26e9, 13.785e9", 1770
BODY = {"Phases/Names": "body", "Phases/body/Type": "stiffness", "Phases/body/Stiffness": STIFFNESS, "Phases/body/Density": DENSITY}
MESH = prm({"Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, **COMMON})
STEEL = {"Phases/Names": "body", "Phases/body/Young modulus": "210e9", "Phases/body/Poisson ratio": 0.3, "Phases/body/Density": 7800}
SOLID = "set Dimension = 3\n" + MESH + prm({**STEEL, "Supports/Top/Kind": "pressure", "Body/Initial velocity": "0.5, 1, -1",
                                            "Body/Acceleration": "0, 0, -10", "Snapshots/Interval": 4e-6})


def probes(**positions):
    return prm({"Observation/Probes": ", ".join(positions), **{f"Observation/{name}/Position": p for name, p in positions.items()}})


def group(folder, run, name="history"):
    """{"NAME": values} of what is observed, of groups in it as "NAME/NAME"."""
    found = {}
    with h5py.File(folder(run, "dynamics.h5")) as file:
        file[name].visititems(lambda key, item: found.update({key: item[()]} if isinstance(item, h5py.Dataset) else {}))
    return found


# One in a cell, one on an edge between cells and on the contact, one between two contact nodes, one that moves to a corner.
PLANE_PROBES = probes(inside="0.0051, 0.0013", at_node="0.005, 0", contact="0.0094, 0", corner="0.01185, 0.0039") + prm(
    {"Observation/corner/Nearest node": "true"})
STATES = ["friction_coefficient", "slip", "stick", "separated", *("blocks/" + name for name in ("time", "slip", "stick", "separated"))]
OBSERVED = ("history", "energy", "probes", "reference", "contact", "spectrum", "phase_diagram")
# Of these keys of summary.json grid and mesh say what they are, and how fast.
OWN = {"kernel", "ranks", "supports", "seconds", "cell_updates_per_second", "peak_memory_bytes", "critical_time_step", "energy_balance_residual"}
SOLID_PROBES = probes(inside="0.00315, 0.0012, 0.0017", contact="0.0042, 0.0023, 0") + prm({"Observation/Probe interval": 10})


def check_equal(one, other, limit, what):
    assert set(one) == set(other), (what, set(one) ^ set(other))
    for name in sorted(one):
        scale = np.abs(one["displacement" if name == "gap" else name]).max()  # the gap of nodes that touch is rounding
        assert one[name].shape == other[name].shape and len(one[name]) > 10, (what, name)
        assert np.abs(one[name] - other[name]).max() <= limit * scale, (what, name, np.abs(one[name] - other[name]).max() / scale)


def check_same_summary(one, other, limit, what, but=()):
    """Numbers up to a relative difference, everything else as it is; a key that only one has is no number."""
    if isinstance(one, dict) and isinstance(other, dict):
        for key in (set(one) | set(other)) - OWN - set(but):
            check_same_summary(one.get(key, "nothing"), other.get(key, "nothing"), limit, (what, key))
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for pair in zip(one, other):
            check_same_summary(*pair, limit, what)
    elif isinstance(one, float) and isinstance(other, (int, float)):
        assert abs(one - other) <= limit * abs(one), (what, one, other)
    else:
        assert one == other, (what, one, other)


def check_grid_as_mesh(folder):
    folder.write("grid.prm", prm({**COMMON, "Body/Stiffness": STIFFNESS, "Body/Density": DENSITY, "Body/Size": "0.012, 0.004",
                                  "Body/Cells": "24, 10", "Supports/Left/Held": "u_x"}) + PLANE_PROBES)
    folder.run(0, "contact_dynamics", "grid.prm", "--output", "grid")
    box = Box([12, 4], [24, 10], lambda x: "body")
    box.name_side("Contact", 1, False).name_side("Top", 1, True).name_side("wall", 0, False).write(folder("mesh.msh"))
    folder.write("mesh.prm", MESH + prm({**BODY, "Supports/wall/Held": "u_x"}) + PLANE_PROBES)
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "mesh.prm", "--output", f"mesh{ranks}", ranks=ranks)
        for name in OBSERVED:
            of_grid, of_mesh = (group(folder, run, name) for run in ("grid", f"mesh{ranks}"))
            if name == "contact":  # beside what each says of the nodes
                of_grid, of_mesh = ({key: values[key] for key in values if key in STATES} for values in (of_grid, of_mesh))
                assert len(of_grid) == len(STATES)
            if name == "energy":  # rounding of what nearly vanishes
                of_grid, of_mesh = ({key: values[key] for key in values if key not in ("residual", "scheme")} for values in (of_grid, of_mesh))
            check_equal(of_grid, of_mesh, 1e-9, (ranks, name))
        summary, expected = folder.summary(f"mesh{ranks}"), folder.summary("grid")
        assert summary["dim"] == 2 and summary["dofs"] == expected["dofs"] and summary["steps"] == expected["steps"] == 1000
        assert abs(summary["critical_time_step"] / expected["critical_time_step"] - 1) < 5e-3
        check_same_summary(expected, summary, 1e-9, ranks)
        assert summary["global_interface_friction_coefficient"] > 0.01 and summary["main_frequency"] > 1e4 and summary["regime"], summary
        assert summary["energy_balance_residual"] < 1e-11, summary
        assert abs(summary["largest_strain"] / expected["largest_strain"] - 1) < 1e-9


def check_limit_cycle(folder):
    """A run that ends at what passes for a limit cycle does so at the same step as on the grid, and is complete."""
    ends = ("--set=Observation/Stop at limit cycle=true", "--set=Observation/Limit cycle tolerance=10", "--set=Time/End time=4e-3",
            "--set=Observation/History interval=1000", "--set=Observation/Energy interval=1000", "--set=Observation/Reference x=2.2e-3",
            "--set=Observation/Steady from=1e-3")
    small = Box([12, 4], [8, 3], lambda x: "body")
    small.name_side("Contact", 1, False).name_side("Top", 1, True).name_side("wall", 0, False).write(folder("mesh.msh"))
    folder.run(0, "contact_dynamics", "grid.prm", "--output", "grid_cycle", "--set=Body/Cells=8, 3", *ends)
    folder.run(0, "contact_dynamics", "mesh.prm", "--output", "mesh_cycle", *ends)
    summary, expected = folder.summary("mesh_cycle"), folder.summary("grid_cycle")
    assert summary["limit_cycle_reached"] and summary["steps"] == expected["steps"] < 1e5 and summary["steady_from"] == 1e-3, summary
    assert summary["limit_cycle"] == expected["limit_cycle"] and summary["regime"] == expected["regime"]
    with h5py.File(folder("mesh_cycle", "dynamics.h5")) as file, h5py.File(folder("grid_cycle", "dynamics.h5")) as grid:
        assert np.allclose(file["reference"].attrs["position"], [1.5e-3, 0], rtol=0, atol=1e-12)
        assert np.allclose(grid["reference"].attrs["position"], [1.5e-3, 0], rtol=0, atol=1e-12)
        assert file["run"].attrs["limit_cycle_reached"] == grid["run"].attrs["limit_cycle_reached"]
    assert "is complete" in folder.run(0, "contact_dynamics", "mesh.prm", "--output", "mesh_cycle", "--resume", *ends)


def linear_field(box, point):
    """Nodes of the cell that holds a point, their shape functions there, and the derivatives of these (2e-7 m to either side)."""
    for cell in box.cells:
        corners = box.points[cell] * 1e-3
        if box.kind == "cube":
            low, size = corners.min(axis=0), np.ptp(corners, axis=0)

            def shape(at):
                return np.prod(np.where(corners > low + size / 2, at - low, low + size - at) / size, axis=1)
        else:
            inverse = np.linalg.inv(np.hstack([np.ones((4, 1)), corners]))

            def shape(at):
                return np.array([1, *at]) @ inverse
        if shape(point).min() > -1e-9 and (box.kind == "simplex" or np.all((low <= point) & (point <= low + size))):
            step = 2e-7 * np.eye(3)
            return cell, shape(point), np.array([(shape(point + d) - shape(point - d)) / 4e-7 for d in step])
    raise AssertionError("no cell")


def check_solid_probes(folder, run, box):
    """Displacement, strain and stress of the probe within the body are those of the snapshots."""
    probe, snapshots = group(folder, run, "probes/inside"), group(folder, run, "snapshots")["displacement"]
    nodes, shape, gradient = linear_field(box, np.array([0.00315, 0.0012, 0.0017]))
    points = group(folder, run, "mesh")["points"]  # in an order of their own
    of_cell = snapshots[:, [np.abs(points - box.points[node] * 1e-3).sum(axis=1).argmin() for node in nodes]]
    grad = np.einsum("dv,kvc->kcd", gradient, of_cell)
    strain = np.array([grad[:, c, d] + (grad[:, d, c] if c != d else 0) for c, d in ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))]).T
    shear = 210e9 / 2.6
    stress = 2 * shear * strain * [1, 1, 1, .5, .5, .5] + 0.6 / 0.4 * shear * strain[:, :3].sum(axis=1)[:, None] * [1, 1, 1, 0, 0, 0]
    for name, expected in (("displacement", shape @ of_cell), ("strain", strain), ("stress", stress)):
        assert np.abs(probe[name][::10] - expected).max() < 1e-8 * np.abs(expected).max() and np.abs(expected).max() > 0, (run, name)
    assert np.abs(probe["velocity"][0] - [0.5, 1, -1]).max() < 0.2
    contact = group(folder, run, "probes/contact")
    assert contact["traction"].shape == (100, 3) and "traction" not in probe
    pressed = contact["traction"][:, 2] > 1e5
    friction = np.hypot(*contact["traction"][pressed, :2].T) / contact["traction"][pressed, 2]
    assert pressed.sum() > 10 and contact["traction"][:, 2].min() >= 0 and 0.01 < np.median(friction) < 0.4, friction


def check_reference(folder, run):
    """The reference node is that in the middle of the contact; its traction is the contact force on its area."""
    with h5py.File(folder(run, "dynamics.h5")) as file:
        node, snapshots = file["reference"], file["snapshots/displacement"][()]
        assert np.allclose(node.attrs["position"], [3e-3, 2e-3, 0], rtol=0, atol=1e-12), node.attrs["position"]
        here = np.abs(file["mesh/points"][()] - [3e-3, 2e-3, 0]).sum(axis=1).argmin()
        assert np.array_equal(node["displacement"][::100], snapshots[:, here]) and np.abs(snapshots[-1, here]).min() > 0
        assert node["velocity"].shape == node["traction"].shape == (1000, 3)
        motion = (node["displacement"][2:] - node["displacement"][:-2]) / 8e-8
        assert np.abs(node["velocity"][1:-1] - motion).max() < 1e-9 * np.abs(motion).max()
        assert np.bytes_(file["energy"].attrs["unit"]) == b"J" and np.bytes_(file["reference/traction"].attrs["unit"]) == b"Pa"


def check_solid(folder):
    for kind in ("cube", "simplex"):
        box = Box([6, 4, 3], [6, 4, 3], lambda x: "body", kind)
        box.name_side("Contact", 2, False).name_side("Top", 2, True).write(folder("mesh.msh"))
        folder.write("solid.prm", SOLID + SOLID_PROBES)
        said = folder.run(0, "contact_dynamics", "solid.prm", "--validate")
        assert "Contact 'Contact': 35 nodes" in said and "420 degrees of freedom" in said, said
        folder.run(0, "contact_dynamics", "solid.prm", "--output", kind)
        folder.run(0, "contact_dynamics", "solid.prm", "--output", kind + "2", ranks=2)
        for name in ("history", "probes", "reference", "spectrum"):
            check_equal(group(folder, kind, name), group(folder, kind + "2", name), 1e-9, (kind, name))
        check_same_summary(folder.summary(kind), folder.summary(kind + "2"), 1e-9, kind)
        check_reference(folder, kind)
        check_solid_probes(folder, kind, box)
        assert folder.summary(kind)["energy_balance_residual"] < 1e-11
        assert folder.summary(kind)["slip_fraction"] > 0.01
        with h5py.File(folder(kind, "dynamics.h5")) as file, h5py.File(folder(kind + "2", "dynamics.h5")) as two:
            u = file["snapshots/displacement"]
            assert u.shape == (10, 140, 3) and np.allclose(file["snapshots/time"], 4e-6 * np.arange(10))
            assert np.abs(u - two["snapshots/displacement"][()]).max() < 1e-9 * np.abs(u).max() and np.abs(u[-1]).max() > 0
            assert abs(file["contact/area"][()].sum() - 24e-6) < 1e-17
        shown = folder.read(kind, "dynamics.xdmf").decode()
        assert shown.count('Center="Node"') == shown.count("dynamics.h5:/snapshots/displacement") == 10 and "140 3" in shown
        assert 'Center="Cell"' in folder.read(kind, "dynamics-phases.xdmf").decode()


def check_resumed(folder):
    """Half a run, and on to its end: the same bits."""
    whole = group(folder, "simplex")
    half = ("--set=Checkpoints/Keep=true", "--set=Time/End time=2e-5")
    for ranks, name in ((1, "simplex"), (2, "simplex2")):
        folder.run(0, "contact_dynamics", "solid.prm", "--output", "half", *half, ranks=ranks)
        folder.run(0, "contact_dynamics", "solid.prm", "--output", "half", "--resume", ranks=ranks)
        for what in OBSERVED[:-1]:
            for key, values in group(folder, name, what).items():
                assert np.array_equal(values, group(folder, "half", what)[key]) or key.startswith("blocks/"), (ranks, what, key)
        with h5py.File(folder("half", "dynamics.h5")) as file, h5py.File(folder(name, "dynamics.h5")) as straight:
            assert np.array_equal(file["snapshots/displacement"], straight["snapshots/displacement"])
    assert len(whole["time"]) == 1000


def check_warnings(folder):
    """What looks like another unit is warned about as on a grid; a run that no machine can hold is refused as there."""
    def warnings(prm_file, slips):
        out = folder.run(0, "contact_dynamics", prm_file, "--validate", *("--set=" + slip for slip in slips))
        found = [line for line in out.splitlines() if line.startswith("warning: ")]
        return sorted(line.replace("Mesh/Scale", "Body/Size") for line in found if "Body/Size along" not in line)

    slips = (["Supports/Top/Pressure=5", "Flat/Velocity=3000", "Time/End time=1e-6", "Friction/Coefficient=30", "Flat/Gap=1"],
             ["Supports/Top/Pressure=5e9", "Flat/Velocity=1e-9", "Friction/Regularization time=1", "Supports/Top/Platen mass=1e9", "Body/Initial velocity=1000, 0"])
    for some in slips:
        of_grid = warnings("grid.prm", some)
        assert len(of_grid) >= len(some) and warnings("mesh.prm", some) == of_grid, (of_grid, warnings("mesh.prm", some))
    said = folder.run(2, "contact_dynamics", "mesh.prm", "--output", "none", "--set=Time/End time=1e4", "--set=Time/Time step=auto")
    assert "of memory, but the machine has" in said and "Observation/History interval" in said, said


def check_refused(folder):
    def refused(words, *settings, prm_file="solid.prm"):
        said = folder.run(2, "contact_dynamics", prm_file, "--output", "none", *("--set=" + setting for setting in settings))
        assert all(word in said for word in words), said

    refused(["Mesh/Contact boundary", "'floor' is no physical group", "Contact, Top"], "Mesh/Contact boundary=floor")
    refused(["Mesh/Contact boundary", "does not face down"], "Mesh/Contact boundary=Top")
    refused(["Mesh/Top boundary", "does not face up"], "Mesh/Top boundary=Contact")
    refused(["Phases/body/Density", "not given"], "Phases/body/Density=0")
    refused(["Observation/inside/Position: (0.00315, 0.0012, 0.0031) m lies outside the body", "from (0, 0, 0) to (0.006, 0.004, 0.003) m",
             "Nearest node"], "Observation/inside/Position=0.00315, 0.0012, 0.0031")
    refused(["Observation/inside/Position", "lies outside the body"], "Observation/inside/Position=0.1, 0, 0")
    refused(["Observation/inside/Position", "give x, y and z"], "Observation/inside/Position=0.001, 0.002")
    refused(["Observation/inside/Position", "too many", "give x and y"], "Observation/inside/Position=0.001, 0.002, 0", prm_file="grid.prm")
    refused(["Body/Cells", "the body is a mesh"], "Body/Cells=3, 4")
    refused(["Supports/Top/Held", "u_x, u_y"], "Supports/Top/Held=u_z")
    refused(["Snapshots/From: 1 s is after the end of the run (Time/End time = "], "Snapshots/From=1")
    refused(["Time/Time step", "above the critical"], "Time/Time step=1e-6")
    folder.write("friction.prm", prm({"Analysis": "friction homogenization", "Mesh/File": "mesh.msh", **STEEL}))
    refused(["Mesh/File has no effect, as Analysis is 'friction homogenization'"], prm_file="friction.prm")
    refused(["Body/Size: 2 numbers found, three (x, y, z) are needed"], "Dimension=3", prm_file="grid.prm")
    refused(["Body/Acceleration", "three components"], "Body/Acceleration=1, 2, 3", prm_file="grid.prm")


def check_boundaries(folder):
    """Groups with inner edges are refused; points of the contact that are there twice are warned of."""
    def plane():
        return Box([2, 1], [4, 2], lambda x: "body").name_side("Contact", 1, False).name_side("Top", 1, True)

    folder.write("boundaries.prm", MESH + prm(BODY))
    inner, doubled = plane(), plane()
    inner.faces.append(([6, 7], "Contact"))
    inner.write(folder("mesh.msh"))
    said = folder.run(2, "contact_dynamics", "boundaries.prm", "--output", "none")
    assert "Mesh/Contact boundary: of the group 'Contact' 1 of 5 faces are not on the boundary" in said, said
    doubled.points = np.vstack([doubled.points, doubled.points[2]])
    doubled.cells = [[15 if c == 2 and 3 in cell else c for c in cell] for cell in doubled.cells]
    doubled.faces = [([15 if c == 2 and 3 in face else c for c in face], name) for face, name in doubled.faces]
    doubled.write(folder("mesh.msh"))
    said = folder.run(0, "contact_dynamics", "boundaries.prm", "--validate")
    assert "warning: mesh.msh is open where parts touch: 2 points of the boundary coincide" in said and "first at (0.001, 0) m" in said, said


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_grid_as_mesh(folder)
        check_limit_cycle(folder)
        check_warnings(folder)
        check_solid(folder)
        check_resumed(folder)
        check_refused(folder)
        check_boundaries(folder)
    print("contact_dynamics on meshes: as on the grid, on several ranks, in three dimensions, and continued")


if __name__ == "__main__":
    main()
