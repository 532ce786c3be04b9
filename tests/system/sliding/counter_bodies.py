"""Counter bodies of every kind. A plane grid, a mesh of its quadrilaterals and a box one cell deep that is held across give the same motion of both bodies, as do
a box and a mesh of its bricks, above and below, in whatever order the mesh has its points; runs are the same on 1, 2 and 3 ranks, close their energy and are
continued bit for bit."""

import tempfile

import h5py
import numpy as np

from four_bodies import PLANE, SOLID, check_ranks_and_restart, histories, refuses
from mesh_files import Box
from scenes import Folder, prm

HEIGHT = 3.0  # of counter bodies (mm)
STEEL, STEEL_3D = "2.8e11, 1.2e11, 2.8e11, 0.8e11", "2.8e11, 1.2e11, 1.2e11, 2.8e11, 1.2e11, 2.8e11, 0.8e11, 0.8e11, 0.8e11"
RUN = {"Flat/Velocity": 2, "Friction/Coefficient": 0.3, "Time/End time": 2e-5, "Time/Time step": 3e-8, "Time/Rayleigh beta": 4.4e-9, "Body/Rayleigh alpha": 1e4,
       "Time/Beta2": 0.6, "Body/Initial velocity": "0.1, -0.2", "Body/Acceleration": "1e4, -2e4", "Observation/Energy interval": 1, "Observation/History interval": 1,
       "Checkpoints/Keep": "true", "Snapshots/Interval": 2e-6, "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 5e6, "Counter body/Rayleigh beta": 2e-9,
       "Counter body/Rayleigh alpha": 2e4, "Counter body/Initial velocity": "-0.1, 0.1", "Supports/Left/Kind": "springs", "Supports/Left/Spring stiffness": "1e12, 2e12"}
BELOW = {"Kind": "springs", "Spring stiffness": "1e13, 2e13", "Dashpot": "1e6, 2e6", "Motion": "1e-7*sin(1e6*t); -1e-3*t"}
LEFT_BELOW = {"Kind": "pressure", "Pressure": 2e6, "Traction": "1e6*y/0.003; 2e6"}
FRICTION = [{"Friction/Law": "coulomb"}, {"Friction/Law": "constant time", "Friction/Regularization time": 1e-6, "Flat/Normal stiffness": 1e14},
            {"Friction/Coefficient law": "static and kinetic", "Friction/Law": "coulomb", "Flat/Velocity": 0.2, "Body/Initial velocity": "0.1, 0.1"}]


def in_3d(value, sep=","):
    """Numbers or formulas along x and y as such along x and z."""
    x, y = value.split(sep)
    return f"{x}{sep} 0{sep}{y}"


def sides_of(prefix, keys, spatial):
    vectors = {"Spring stiffness": ",", "Dashpot": ",", "Motion": ";", "Traction": ";"}
    turned = {key: in_3d(value, vectors[key]).replace("y/", "z/") if spatial and key in vectors else value for key, value in keys.items()}
    return {f"{prefix}/{key}": value for key, value in turned.items()}


def mesh(folder, name, size, cells, below, kind="cube", shuffled=False, position=(0,)):
    """A mesh of a box with names of its sides; a counter body lies below the flat, from @p position (mm) on along it."""
    dim = len(cells)
    box = Box(size, cells, lambda x: "body", kind)
    names = [("Bottom", dim - 1, False), ("Contact", dim - 1, True)] if below else [("Contact", dim - 1, False), ("Top", dim - 1, True)]
    for side, axis, upper in names + [("Left", 0, False), ("Right", 0, True), ("Front", 1, False), ("Back", 1, True)][:2 * dim - 2]:
        box.name_side(side, axis, upper)
    if below:
        box.points[:, dim - 1] -= size[-1]
        box.points[:, :len(position)] += position
    if shuffled:
        order = np.random.default_rng(1).permutation(len(box.points))
        box.points = box.points[order]
        new = np.argsort(order)
        box.cells = [[int(new[c]) for c in cell] for cell in box.cells]
        box.faces = [([int(new[c]) for c in face], group) for face, group in box.faces]
    box.write(folder(name))


def upper(folder, kind, size, cells, element="cube"):
    """Keys of the body: a grid, or a mesh of its cells."""
    dim = len(cells)
    metres = ", ".join(f"{1e-3 * x:.10g}" for x in size)
    if kind == "grid":
        return {"Body/Stiffness": SOLID if dim == 3 else PLANE, "Body/Density": 1770, "Body/Size": metres, "Body/Cells": ", ".join(map(str, cells))}
    mesh(folder, f"upper{dim}.msh", size, cells, False, element)
    return {"Mesh/File": f"upper{dim}.msh", "Mesh/Scale": 0.001, "Phases/Names": "body", "Phases/body/Type": "stiffness", "Phases/body/Density": 1770,
            "Phases/body/Stiffness": SOLID if dim == 3 else PLANE}


def lower(folder, kind, size, cells, element="cube", position=(0,)):
    dim = len(cells)
    keys = {"Counter body/Stiffness": STEEL_3D if dim == 3 else STEEL, "Counter body/Density": 7800}
    if kind == "grid":
        return {**keys, "Counter body/Size": ", ".join(f"{1e-3 * x:.10g}" for x in size), "Counter body/Cells": ", ".join(map(str, cells)),
                "Counter body/Position": ", ".join(f"{1e-3 * x:.10g}" for x in position)}
    mesh(folder, f"lower{dim}.msh", size, cells, True, element, True, position)
    return {**keys, "Counter body/Mesh/File": f"lower{dim}.msh", "Counter body/Mesh/Scale": 0.001}


def scene(bodies, friction, spatial=False, across=False):
    """All keys; in 3D with the loads along x and z."""
    keys = {**RUN, **bodies, **friction, **sides_of("Counter body/Supports/Bottom", BELOW, spatial), **sides_of("Counter body/Supports/Left", LEFT_BELOW, spatial)}
    if spatial:
        for key in ("Body/Initial velocity", "Body/Acceleration", "Counter body/Initial velocity", "Supports/Left/Spring stiffness"):
            keys[key] = in_3d(keys[key])
    if across:
        for body in ("", "Counter body/"):
            for side in ("Front", "Back"):
                keys[f"{body}Supports/{side}/Held"] = "u_y"
    return ("set Dimension = 3\n" if spatial else "") + prm(keys)


def points_and_motion(folder, run, name, scale=1.0):
    """Displacements of all times at the nodes of a file in the order of z, then y, then x."""
    with h5py.File(folder(run, name)) as file:
        u = file["snapshots/displacement"][()]
        dim = u.shape[-1]
        u = u.reshape(len(u), -1, dim)
        if "mesh" in file:
            x = file["mesh/points"][()]
        else:
            grid = file["grid"].attrs
            axes = [o + h * np.arange(n + 1) for o, h, n in zip(grid["origin"], grid["spacing"], grid["cells"])]
            x = np.stack([a.ravel() for a in np.meshgrid(*axes[::-1], indexing="ij")[::-1]], axis=1)
    order = np.lexsort(np.round(x * 1e9).T)
    return x[order], u[:, order]


def run(folder, name, text):
    folder.write(f"{name}.prm", text)
    folder.run(0, "contact_dynamics", f"{name}.prm", "--output", name, "--quiet")
    return [points_and_motion(folder, name, file) for file in ("dynamics.h5", "counter_body.h5")]


def check_equal(found, wanted, what):
    for (x, u), (y, v) in zip(found, wanted):
        assert np.abs(x - y).max() < 1e-12, what
        error = np.abs(u - v).max() / np.abs(v).max()
        assert error < 1e-10, (what, error)


def plane_of(pair):
    """Of a box one cell deep, which does not move across: its plane."""
    result = []
    for x, u in pair:
        assert np.abs(u[..., 1]).max() == 0
        front = x[:, 1] == x[:, 1].min()
        assert np.abs(u[:, front] - u[:, ~front]).max() < 1e-10 * np.abs(u).max()
        result.append((x[front][:, [0, 2]], u[:, front][..., [0, 2]]))
    return result


def check_kinds(folder, friction, plane=([6, HEIGHT], [9, 4]), base=([3, 2, HEIGHT], [5, 4, 4]), position=(0,)):
    """The same pair in 2D as a grid, a mesh and a box, and in 3D as boxes and meshes of their bricks; counter bodies of these sizes and cells, in 2D and 3D, from
    @p position on."""
    size, cells, deep = ([6, 4], [9, 6]), plane, 0.5
    below_it = lambda kind, body: lower(folder, kind, *body, position=position)
    grid = run(folder, "grid", scene({**upper(folder, "grid", *size), **below_it("grid", cells)}, friction))
    touching = histories(folder, "grid")["history/contact_normal_force"] > 0
    assert 0.3 < touching.mean(), (friction, touching.mean())
    of_mesh = run(folder, "plane", scene({**upper(folder, "mesh", *size), **below_it("mesh", cells)}, friction))
    check_equal(of_mesh, grid, ("plane mesh", friction))
    thick = lambda body: ([body[0][0], deep, body[0][1]], [body[1][0], 1, body[1][1]])
    box = run(folder, "box", scene({**upper(folder, "grid", *thick(size)), **below_it("grid", thick(cells))}, friction, True, True))
    check_equal(plane_of(box), grid, ("box", friction))
    solid = ([3, 2, 4], [5, 4, 6])
    wanted = run(folder, "boxes", scene({**upper(folder, "grid", *solid), **below_it("grid", base)}, friction, True))
    for above, below in (("mesh", "grid"), ("grid", "mesh"), ("mesh", "mesh")):
        found = run(folder, "mixed", scene({**upper(folder, above, *solid), **below_it(below, base)}, friction, True))
        check_equal(found, wanted, (above, below, friction))
        assert folder.summary("mixed")["energy_balance_residual"] < 1e-12


def check_periodic(folder, friction, cells=(9, 5, 8)):
    """Counter bodies of these cells along x, in 3D x and y, as periodic as the bodies above: along x, below a top whose load differs from place to place: a grid and a mesh of its quadrilaterals; and along x and y: a box on a box, also over
    ranks that share its periodic sides, and on a mesh."""
    top = {"Supports/Top/Kind": "springs", "Supports/Left/Kind": "free", "Sides/Periodic": "true", "Counter body/Supports/Left/Kind": "free"}
    load = lambda parts: {"Supports/Top/Spring stiffness": "1e12", "Supports/Top/Traction": "; ".join(parts)}
    keys = {key: value for key, value in RUN.items() if not key.startswith("Supports/")} | {"Supports/Top/Pressure": 5e6} | friction | top
    bottom = lambda spatial: sides_of("Counter body/Supports/Bottom", BELOW, spatial)
    plane = {**keys, **bottom(False), **load(("1e6*sin(2*pi*x/0.006)", "0"))}
    grid = run(folder, "grid", prm({**plane, **upper(folder, "grid", [6, 4], [9, 6]), **lower(folder, "grid", [6, HEIGHT], [cells[0], 4])}))
    del plane["Sides/Periodic"]
    of_mesh = run(folder, "plane", prm({**plane, **upper(folder, "mesh", [6, 4], [9, 6]), **lower(folder, "mesh", [6, HEIGHT], [cells[0], 4]), "Mesh/Periodic in x": "Left, Right",
                                        "Counter body/Mesh/Periodic in x": "Left, Right"}))
    check_equal(of_mesh, grid, ("periodic mesh", friction))
    spatial = {**keys, **bottom(True), **load(("1e6*sin(2*pi*x/0.003)", "1e6*cos(2*pi*y/0.002)", "0")), "Sides/Periodic in y": "true"}
    for key in ("Body/Initial velocity", "Body/Acceleration", "Counter body/Initial velocity"):
        spatial[key] = in_3d(spatial[key])
    body = upper(folder, "grid", [3, 2, 4], [5, 8, 6])
    box = run(folder, "box", "set Dimension = 3\n" + prm({**spatial, **body, **lower(folder, "grid", [3, 2, HEIGHT], [*cells[1:], 4])}))
    for ranks in (2, 3):
        folder.run(0, "contact_dynamics", "box.prm", "--output", "ranks", "--quiet", ranks=ranks)
        check_equal([points_and_motion(folder, "ranks", name) for name in ("dynamics.h5", "counter_body.h5")], box, ("periodic box", ranks))
    on_mesh = run(folder, "mixed", "set Dimension = 3\n" + prm({**spatial, **body, **lower(folder, "mesh", [3, 2, HEIGHT], [*cells[1:], 4]),
                                                                "Counter body/Mesh/Periodic in x": "Left, Right", "Counter body/Mesh/Periodic in y": "Front, Back"}))
    check_equal(on_mesh, box, ("periodic box on a mesh", friction))


def check_ranks(folder, friction, cells=((5, 8), (9,), (4, 3)), more=0.0):
    """On more ranks and after a restart; both bodies are divided. Counter bodies of @p cells along the flat are longer by @p more (mm) at the left."""
    place = {"position": (-more,)}
    for name, spatial, bodies in (("box", True, {**upper(folder, "grid", [3, 2, 4], [5, 8, 6]), **lower(folder, "grid", [3 + more, 2, HEIGHT], [*cells[0], 4], **place)}),
                                  ("mesh2", False, {**upper(folder, "mesh", [6, 4], [9, 8], "simplex"),
                                                    **lower(folder, "mesh", [6 + more, HEIGHT], [*cells[1], 5], "simplex", **place)}),
                                  ("mesh3", True, {**upper(folder, "mesh", [3, 2, 4], [4, 3, 5]), **lower(folder, "mesh", [3 + more, 2, HEIGHT], [*cells[2], 4], **place)})):
        folder.write("run.prm", scene(bodies, friction, spatial))
        folder.run(0, "contact_dynamics", "run.prm", "--output", "run1")
        check_ranks_and_restart(folder, (name, friction))
        assert folder.summary("run1")["energy_balance_residual"] < 1e-12, (name, folder.summary("run1")["energy_balance_residual"])
        one, again = points_and_motion(folder, "run1", "counter_body.h5"), points_and_motion(folder, "half", "counter_body.h5")
        assert np.array_equal(one[1], again[1]), name
        folder.run(0, "contact_dynamics", "run.prm", "--output", "run", ranks=3)
        check_equal([points_and_motion(folder, "run", "counter_body.h5")], [one], (name, "3 ranks"))


def numbers_at_rest(folder, text, of_modes=""):
    """Growth and frequency of the first modes, and normal force, friction and largest displacement of both bodies at rest."""
    folder.write("rest.prm", "set Analysis = static contact\n" + text)
    folder.run(0, "contact_dynamics", "rest.prm", "--output", "rest", "--quiet")
    summary = folder.summary("rest")
    with h5py.File(folder("rest", "dynamics.h5")) as file, h5py.File(folder("rest", "counter_body.h5")) as below:
        largest = [np.abs(one["snapshots/displacement"][()]).max() for one in (file, below)]
    folder.write("modes.prm", "set Analysis = complex modes\n" + text + of_modes)
    folder.run(0, "contact_dynamics", "modes.prm", "--output", "modes", "--quiet")
    modes = [[mode["growth_rate"], mode["frequency"]] for mode in folder.summary("modes")["complex_modes"]]
    return np.array([summary["normal_force"], summary["tangential_force"]]), np.array(largest), modes


def check_at_rest(folder, columns=9):
    """Static contact and complex modes of the same pair as grids, as meshes of their cells, and as boxes one cell deep; the lower body has so many cells along x."""
    size, cells, deep = ([6, 4], [9, 6]), ([6, HEIGHT], [columns, 4]), 0.5
    thick = lambda body: ([body[0][0], deep, body[0][1]], [body[1][0], 1, body[1][1]])
    rest = {"Flat/Velocity": 2, "Friction/Coefficient": 0.3, "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 5e6, "Supports/Top/Held": "u_x",
            "Supports/Left/Kind": "springs", "Counter body/Supports/Bottom/Kind": "springs"}
    found = []
    for dim, above, below in ((2, "grid", "grid"), (2, "mesh", "grid"), (2, "mesh", "mesh"), (3, "grid", "grid"), (3, "mesh", "grid")):
        pair = {**upper(folder, above, *(thick(size) if dim == 3 else size)), **lower(folder, below, *(thick(cells) if dim == 3 else cells))}
        springs = {"Supports/Left/Spring stiffness": "1e12, 2e12", "Counter body/Supports/Bottom/Spring stiffness": "1e13, 2e13"}
        keys = {**rest, **pair, **({key: in_3d(value) for key, value in springs.items()} if dim == 3 else springs)}
        if dim == 3:
            keys |= {f"{body}Supports/{side}/Held": "u_y" for body in ("", "Counter body/") for side in ("Front", "Back")}
        force, largest, modes = numbers_at_rest(folder, ("set Dimension = 3\n" if dim == 3 else "") + prm(keys))
        found.append((force / (1e-3 * deep) if dim == 3 else force, largest, modes))
    for number, (force, largest, modes) in enumerate(found):
        assert np.abs(force / found[0][0] - 1).max() < 1e-7 and np.abs(largest / found[0][1] - 1).max() < 1e-7, (number, force, largest, found[0])
        assert len(modes) == len(found[0][2]) > 0 and np.abs(np.divide(modes, found[0][2]) - 1).max() < 1e-7, (number, modes, found[0][2])


def check_exchanged(folder):
    """A pair on platens upside down, its bodies exchanged, has the same forces, displacements, modes and complex modes: platens at sides, pressed and on
    springs, and one at the far end of either body."""
    left, right = {"Kind": "platen", "Pressure": 2e6}, {"Kind": "platen", "Pressure": 1e6, "Spring stiffness": "1e13, 2e12"}
    for far in ("platen", "springs"):
        supports = [({"Kind": "springs", "Spring stiffness": "1e12, 2e12", "Pressure": 5e6}, right, left),
                    ({"Kind": far, "Spring stiffness": "1e13, 3e13", "Pressure": 5e6}, left, right)]
        for dim, kind in ((2, "grid"), (2, "mesh"), (3, "grid")):
            thick = lambda size, cells: ([size[0], 0.5, size[1]], [cells[0], 1, cells[1]]) if dim == 3 else (size, cells)
            shapes, materials, found = [thick([6, 4], [9, 6]), thick([6, 3], [9, 4])], [(SOLID, 1770), (STEEL_3D, 7800)] if dim == 3 else [(PLANE, 1770), (STEEL, 7800)], []
            for first in (0, 1):
                keys = {**upper(folder, kind, *shapes[first]), **lower(folder, kind, *shapes[1 - first])}
                for body, start in ((first, "Phases/body/" if kind == "mesh" else "Body/"), (1 - first, "Counter body/")):
                    keys |= {start + "Stiffness": materials[body][0], start + "Density": materials[body][1]}
                for body, start, end in ((first, "", "Top"), (1 - first, "Counter body/", "Bottom")):
                    for side, support in zip((end, "Left", "Right"), supports[body]):
                        keys |= sides_of(f"{start}Supports/{side}", support, dim == 3)
                    keys |= {f"{start}Supports/{side}/Held": "u_y" for side in ("Front", "Back") if dim == 3}
                sliding = {"Friction/Coefficient": 0.3, "Flat/Velocity": (-2, 2)[first]}
                text = ("set Dimension = 3\n" if dim == 3 else "") + prm({**keys, **sliding, "Static contact/Tolerance": 1e-11})
                damping = prm({"Time/Rayleigh beta": (4e-9, 1e-9)[first], "Counter body/Rayleigh beta": (1e-9, 4e-9)[first]})
                force, largest, modes = numbers_at_rest(folder, text, damping)
                folder.write("modal.prm", "set Analysis = modal\n" + ("set Dimension = 3\n" if dim == 3 else "") + prm({key: value for key, value in keys.items() if "Pressure" not in key}))
                for ranks in (1, 2, 3):
                    folder.run(0, "contact_dynamics", "modal.prm", "--output", "modal", "--quiet", ranks=ranks)
                    frequencies = folder.summary("modal")["frequencies"]
                    found.append((force * [1, (-1, 1)[first]], largest[::(1, -1)[first]], modes, [*frequencies["free"], *frequencies["held"]]))
            for one in found[1:]:
                for values, wanted in zip(one, found[0]):
                    assert len(values) == len(wanted) > 0 and np.abs(np.divide(values, wanted) - 1).max() < 1e-7, (far, dim, kind, values, wanted)
            print(far, dim, kind, found[0][0], found[0][2][:2], max(np.abs(np.divide(one[2], found[0][2]) - 1).max() for one in found))


def probe(folder, run, name):
    """What a probe of a counter body saw; of a box along x and z, in Voigt order of a plane body."""
    with h5py.File(folder(run, "counter_body.h5")) as file:
        found = {key: data[()] for key, data in file[f"probes/{name}"].items()}
    if found["displacement"].shape[1] == 3:
        found = {key: value if key == "time" else value[:, [0, 2] if value.shape[1] == 3 else [0, 2, 4]] for key, value in found.items()}
    return found


def check_probes(folder, friction):
    """Probes of a counter body see the same in a grid, a mesh and a box, on more ranks and after a restart: at a node what snapshots have, and the stress of the strain."""
    size, below, at, deep = ([6, 4], [9, 6]), ([7, HEIGHT], [10, 4]), {"node": (0.4e-3, -0.75e-3), "inside": (2.11e-3, -1.03e-3)}, 0.5
    thick = lambda body: ([body[0][0], deep, body[0][1]], [body[1][0], 1, body[1][1]])
    found = {}
    for name, kind, spatial in (("grid", "grid", False), ("plane", "mesh", False), ("box", "grid", True)):
        shape = thick if spatial else (lambda body: body)
        keys = {"Counter body/Observation/Probes": "node, inside", "Observation/Probe interval": 1}
        for point, (x, y) in at.items():
            keys[f"Counter body/Observation/{point}/Position"] = f"{x}, {1e-3 * deep / 2}, {y}" if spatial else f"{x}, {y}"
        bodies = {**upper(folder, kind, *shape(size)), **lower(folder, kind, *shape(below), position=(-1,)), **keys}
        pair = run(folder, name, scene(bodies, friction, spatial, spatial))
        found[name] = {point: probe(folder, name, point) for point in at}
        if name == "grid":
            x, u = pair[1]
            node = np.abs(x - at["node"]).sum(axis=1).argmin()
            with h5py.File(folder(name, "counter_body.h5")) as file:
                steps = np.round(file["snapshots/time"][()] / 3e-8).astype(int)
            seen = found[name]["node"]["displacement"][steps[:-1]]
            assert np.abs(x[node] - at["node"]).max() < 1e-15 and len(seen) > 5 and np.abs(seen - u[:-1, node]).max() < 1e-15 * np.abs(u).max()
        with h5py.File(folder(name, "counter_body.h5")) as file:
            assert np.abs(file["probes/inside"].attrs["position"][[0, -1]] - at["inside"]).max() < 1e-12
    a, b, _, d = map(float, STEEL.split(","))
    strain, stress = found["grid"]["inside"]["strain"], found["grid"]["inside"]["stress"]
    law = np.array([[a, b, 0], [b, a, 0], [0, 0, d]])
    assert np.abs(stress - strain @ law).max() < 1e-12 * np.abs(stress).max() and np.abs(stress).max() > 1e5
    for name in ("plane", "box"):
        for point in at:
            for key, wanted in found["grid"][point].items():
                error = np.abs(found[name][point][key] - wanted).max() / np.abs(wanted).max()
                assert error < 1e-9, (name, point, key, error)
    for name in ("grid", "plane"):
        folder.run(0, "contact_dynamics", f"{name}.prm", "--output", "ranks", "--quiet", ranks=3)
        folder.run(0, "contact_dynamics", f"{name}.prm", "--output", "half", "--quiet", "--set", "Time/End time=1e-5")
        folder.run(0, "contact_dynamics", f"{name}.prm", "--output", "half", "--quiet", "--resume")
        for again, rounding in (("ranks", 1e-10), ("half", 0)):
            for key, wanted in found[name]["inside"].items():
                assert np.abs(probe(folder, again, "inside")[key] - wanted).max() <= rounding * np.abs(wanted).max(), (name, again, key)


def check_sentences(folder):
    """What does not fit together is refused, and what the sentences advise works."""
    folder.write("run.prm", scene({**upper(folder, "mesh", [6, 4], [9, 6]), **lower(folder, "mesh", [6, HEIGHT], [9, 4])}, FRICTION[0]))
    refused = lambda words, *settings: refuses(folder, words, *settings)
    works = lambda *settings: folder.run(0, "contact_dynamics", "run.prm", "--validate", *[arg for text in settings for arg in ("--set", text)])
    works()
    lower_grid = ["Counter body/Mesh/File=", "Counter body/Mesh/Scale=1", "Counter body/Size=6e-3, 3e-3", "Counter body/Cells=9, 4"]
    assert refused("Counter body/Size: the body is a plane mesh", *lower_grid)
    assert refused("Counter body/Size has no effect, as the counter body is a mesh", "Counter body/Size=6e-3, 3e-3")
    assert refused("Counter body/Supports/Contact: it is the contact of the counter body", "Counter body/Supports/Contact/Kind=held")
    assert refused("Counter body/Mesh/Contact boundary: 'Right' does not face up", "Counter body/Mesh/Contact boundary=Right")
    assert refused("Counter body/Mesh/Contact boundary: 'Floor' is no physical group", "Counter body/Mesh/Contact boundary=Floor")
    assert refused("Counter body/Supports/Wall: 'Wall' is no physical group", "Counter body/Supports/Wall/Kind=held")
    probed = ("Counter body/Observation/Probes=p", "Counter body/Observation/p/Position=1e-3, {}")
    assert refused("Counter body/Observation/p/Position: (0.001, 0.001) m lies outside the body", probed[0], probed[1].format(1e-3))
    works(probed[0], probed[1].format(-1e-3))
    grids = scene({**upper(folder, "grid", [6, 4], [9, 6]), **lower(folder, "grid", [6, HEIGHT], [9, 4])}, FRICTION[0])
    with open(folder("run.prm"), encoding="ascii") as file:
        meshes = file.read()
    folder.write("run.prm", grids)
    told = works()
    assert "Counter body: Left: a traction of 1e6*y/0.003, 2e6 Pa; a pressure of" in told, told
    folder.write("run.prm", meshes)
    mesh(folder, "lower2.msh", [6, HEIGHT], [8, 4], True)
    works()
    with open(folder("run.prm"), encoding="ascii") as file:
        transient = file.read()
    pair = {**upper(folder, "mesh", [6, 4], [9, 6]), **lower(folder, "mesh", [6, HEIGHT], [8, 4]), "Supports/Top/Kind": "platen", "Flat/Velocity": 2,
            "Counter body/Supports/Bottom/Kind": "held"}
    folder.write("run.prm", "set Analysis = static contact\n" + prm(pair))
    assert "nodes do not match" in works()
    folder.write("run.prm", "set Analysis = complex modes\n" + prm(pair))
    assert "nodes do not match" in works()
    # A platen holds the counter body along its springs only.
    below = {**pair, "Counter body/Supports/Bottom/Kind": "platen", "Supports/Top/Pressure": 5e6}
    for analysis in ("static contact", "modal", "complex modes"):
        folder.write("run.prm", f"set Analysis = {analysis}\n" + prm({key: value for key, value in below.items() if analysis != "modal" or key not in ("Flat/Velocity", "Supports/Top/Pressure")}))
        assert "nothing holds the counter body" in folder.run(2, "contact_dynamics", "run.prm", "--output", f"floats {analysis}")
        folder.run(0, "contact_dynamics", "run.prm", "--output", f"floats {analysis}", "--set", "Counter body/Supports/Bottom/Spring stiffness=0, 1e13")
    folder.write("run.prm", transient)
    box = Box([6, HEIGHT], [9, 4], lambda x: "body")
    box.name_side("Bottom", 1, False).name_side("Contact", 1, True).name_side("Left", 0, False).name_side("Right", 0, True)
    box.points[:, 1] += 0.1 * np.sin(box.points[:, 0]) * (box.points[:, 1] == HEIGHT)
    box.write(folder("lower2.msh"))
    assert refused("Counter body/Mesh/Contact boundary: it is not even, its nodes rise by")
    box = Box([6, HEIGHT], [9, 4], lambda x: "body")
    box.name_side("Contact", 1, True).name_side("Left", 0, False).name_side("Right", 0, True).write(folder("lower2.msh"))
    assert refused("Counter body/Supports/Bottom: 'Bottom' is no physical group")
    folder.write("run.prm", scene({**upper(folder, "grid", [6, 4], [9, 6]), **lower(folder, "mesh", [6, HEIGHT], [9, 4])}, FRICTION[0]))
    assert refused("Counter body/Mesh/File: the body is a plane grid")


def main():
    with tempfile.TemporaryDirectory() as place:
        here = Folder(place)
        for law in FRICTION:
            check_kinds(here, law)
        for law in FRICTION[1:]:
            check_ranks(here, law)
        check_periodic(here, FRICTION[1])
        for columns in (9, 7, 12):
            check_at_rest(here, columns)
        check_exchanged(here)
        check_probes(here, FRICTION[1])
        check_sentences(here)


if __name__ == "__main__":
    main()
