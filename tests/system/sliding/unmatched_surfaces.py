"""Counter bodies whose nodes are not where those of the body are, and which slide on below it. A plane grid, a mesh of its quadrilaterals and a box one cell deep move
alike, as do boxes and meshes of their bricks; runs are the same on 1, 2 and 3 ranks, close their energy and are continued bit for bit. What is uniform stays so
through the contact, wherever the surfaces are, and an endless counter body is one of many periods."""

import tempfile

import numpy as np

from counter_bodies import FRICTION, HEIGHT, RUN, check_kinds, check_periodic, check_ranks, lower, run, upper
from four_bodies import refuses
from scenes import Folder, prm

SLIDING = {"Counter body/Sliding": "finite", "Flat/Velocity": 45}  # over 0.9 mm
BAR, BAR_3D = "40e9, 0, 40e9, 13e9", "40e9, 0, 0, 40e9, 0, 40e9, 13e9, 13e9, 13e9"


def check_uniform(folder):
    """Bars without contraction that meet: in each row all nodes move alike, as between nodes that match, while surfaces are at rest and while they slide."""
    keys = {"Body/Density": 1600, "Counter body/Density": 4000, "Friction/Coefficient": 0, "Time/End time": 6e-6, "Time/Time step": 2e-8, "Supports/Top/Kind": "pressure",
            "Supports/Top/Pressure": 0, "Snapshots/Interval": 1e-6, "Counter body/Supports/Bottom/Kind": "free"}
    at_rest, sliding = {}, {"Counter body/Sliding": "finite", "Flat/Velocity": 200, "Counter body/Periodic": "true"}
    for dim, stiffness, above, below in ((2, BAR, ([6, 4], [9, 20]), ([6, 3], [13, 11])), (3, BAR_3D, ([3, 2, 4], [4, 3, 20]), ([3, 2, 3], [5, 7, 11]))):
        speed = ", ".join(["0"] * (dim - 1))
        bodies = lambda cells: {**upper(folder, "grid", *above), **lower(folder, "grid", below[0], cells), "Body/Stiffness": stiffness,
                                "Counter body/Stiffness": stiffness.replace("40e9", "90e9"), "Body/Initial velocity": speed + ", -1",
                                "Counter body/Initial velocity": speed + ", 0"}
        text = lambda cells, more: ("set Dimension = 3\n" if dim == 3 else "") + prm({**keys, **bodies(cells), **more})
        wanted = run(folder, "matched", text([*above[1][:-1], below[1][-1]], at_rest))
        for more in (at_rest, sliding):
            found = run(folder, "other", text(below[1], more))
            for (x, u), (y, v) in zip(found, wanted):
                size = np.abs(v[..., -1]).max()
                assert np.abs(u[..., :-1]).max() < 1e-12 * size
                for level in np.unique(np.round(x[:, -1], 9)):
                    here, there = np.abs(x[:, -1] - level) < 1e-9, np.abs(y[:, -1] - level) < 1e-9
                    off = np.abs(u[:, here, -1] - v[:, there, -1].mean(axis=1)[:, None]).max()
                    assert off < 1e-12 * size, (dim, more, level, off / size)


def check_endless(folder):
    """A pin that is not periodic on a disc that is: a grid, a mesh with periodic sides, and three periods of it."""
    keys = {**{key: value for key, value in RUN.items() if "Left" not in key}, **SLIDING, "Friction/Law": "constant time", "Friction/Regularization time": 1e-6,
            "Counter body/Supports/Bottom/Kind": "held", **upper(folder, "grid", [6, 4], [9, 6])}
    text = lambda more: prm({**keys, **more})
    one = run(folder, "one", text({**lower(folder, "grid", [7, HEIGHT], [12, 4]), "Counter body/Periodic": "true"}))
    shifted = run(folder, "shifted", text({**lower(folder, "grid", [7, HEIGHT], [12, 4], position=(-63,)), "Counter body/Periodic": "true"}))
    assert np.abs(shifted[0][1] - one[0][1]).max() < 1e-9 * np.abs(one[0][1]).max()
    solid = {**upper(folder, "grid", [6, 0.5, 4], [9, 1, 6]), **lower(folder, "grid", [7, 0.5, HEIGHT], [12, 1, 4]), "Counter body/Periodic": "true"}
    vectors = ("Body/Initial velocity", "Body/Acceleration", "Counter body/Initial velocity")
    solid |= {key: keys[key].replace(",", ", 0,") for key in vectors} | {f"{body}Supports/{side}/Held": "u_y" for body in ("", "Counter body/") for side in ("Front", "Back")}
    box = run(folder, "box", "set Dimension = 3\n" + text(solid))
    for (x, u), (y, v) in zip(box, one):
        front = x[:, 1] == x[:, 1].min()
        assert np.abs(u[:, front][..., [0, 2]] - v).max() < 1e-10 * np.abs(v).max()
    assert folder.summary("one")["energy_balance_residual"] < 1e-12


def check_sentences(folder):
    free = {key: value for key, value in RUN.items() if "Left" not in key}
    folder.write("run.prm", prm({**free, **upper(folder, "grid", [6, 4], [9, 6]), **lower(folder, "grid", [6, HEIGHT], [7, 4])}))
    refused = lambda words, *settings: refuses(folder, words, *settings)
    works = lambda *settings: folder.run(0, "contact_dynamics", "run.prm", "--validate", *[arg for text in settings for arg in ("--set", text)])
    assert "nodes do not match" in works()
    finite = ["Counter body/Sliding=finite", "Flat/Velocity=45"]
    assert refused("goes from 0 to 0.006 m along x, but the body comes above -0.0009 to 0.006 m of it on its way; make it longer, or periodic, or reduce", *finite)
    assert "slides on" in works(*finite, "Counter body/Size=7e-3, 3e-3", "Counter body/Position=-1e-3")
    works(*finite, "Counter body/Periodic=true")
    works(*finite, "Time/End time=1e-5", "Counter body/Size=7e-3, 3e-3", "Counter body/Position=-5e-4")
    assert refused("goes from 0.001 to 0.007 m", "Counter body/Position=1e-3")
    assert refused("it repeats itself after 0.007 m along x, the body after 0.006 m", "Sides/Periodic=true", "Counter body/Size=7e-3, 3e-3")
    assert refused("Counter body/Periodic in y", "Counter body/Periodic in y=true")
    bodies = {**upper(folder, "grid", [6, 4], [9, 6]), **lower(folder, "grid", [6, HEIGHT], [9, 4])}
    folder.write("run.prm", "set Analysis = static contact\n" + prm({**bodies, "Supports/Top/Kind": "platen", "Supports/Top/Pressure": 5e6}))
    works()
    assert refused("Counter body/Sliding: a counter body that moves on is known in transient runs", finite[0])


def main():
    with tempfile.TemporaryDirectory() as place:
        here = Folder(place)
        check_sentences(here)
        check_uniform(here)
        check_endless(here)
        for law in FRICTION:
            check_kinds(here, law, ([6, HEIGHT], [7, 4]), ([3, 2, HEIGHT], [4, 3, 4]))
            check_kinds(here, {**law, **SLIDING}, ([7, HEIGHT], [11, 4]), ([4, 2, HEIGHT], [5, 3, 4]), (-1,))
        short = {"Time/End time": 1.2e-5}  # ranks tell each other the contact a dozen times a step
        check_ranks(here, {**FRICTION[1], **short}, ((4, 5), (7,), (6, 4)))
        check_ranks(here, {**FRICTION[2], **SLIDING, **short}, ((7, 5), (11,), (6, 4)), 1.0)
        check_periodic(here, FRICTION[1], (7, 4, 5))
        check_periodic(here, {**FRICTION[1], **SLIDING}, (7, 4, 5))


if __name__ == "__main__":
    main()
