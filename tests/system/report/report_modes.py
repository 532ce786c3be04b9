"""What the report draws of modes: surface and outline of boxes and of a plane mesh, counted; a page on a box that is run.

    report_modes.py <folder with the programs>
"""

import os
import sys
import tempfile

import h5py
import numpy as np

from scenes import TOOLS, Folder, prm

sys.path.insert(0, TOOLS)

from report.base.data import Run  # noqa: E402
from report.bodies import mode_shapes  # noqa: E402

from whole_page import report  # noqa: E402

CELLS = (2, 3, 4)


def run_of(folder, groups, attributes=None):
    os.makedirs(folder)
    with h5py.File(os.path.join(folder, "modal.h5"), "w") as file:
        for path, data in groups.items():
            file[path] = data
        if attributes:
            file.create_group("grid").attrs.update(attributes)
    return Run(folder, {"program": "contact_dynamics", "analysis": "modal"})


def nodes_of(cells):
    axes = [np.arange(n + 1.0) for n in cells]
    return np.stack([axis.ravel() for axis in np.meshgrid(*axes[::-1], indexing="ij")[::-1]], axis=1)


def hexahedra(cells):
    """/mesh/topology of the cells of a box."""
    number = np.arange(np.prod(np.add(cells, 1))).reshape([n + 1 for n in cells[::-1]])
    corners = [number[z:z + cells[2], y:y + cells[1], x:x + cells[0]].ravel()
               for z, y, x in ((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0), (1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0))]
    return np.column_stack([np.full(len(corners[0]), 9), *corners]).ravel()


def check_box(skin, what):
    nx, ny, nz = CELLS
    inside = (nx - 1) * (ny - 1) * (nz - 1)
    assert len(skin.points) == (nx + 1) * (ny + 1) * (nz + 1) - inside, f"{what}: {len(skin.points)} points"
    assert len(skin.triangles) == 4 * (nx * ny + ny * nz + nx * nz), f"{what}: {len(skin.triangles)} triangles"
    lengths = np.linalg.norm(np.diff(skin.points[skin.outline], axis=1), axis=2)
    assert abs(lengths.sum() - 4e3 * (nx + ny + nz)) < 1e-6, f"{what}: twelve edges of {lengths.sum()} mm"
    assert np.array_equal(skin.points, 1e3 * nodes_of(CELLS)[skin.nodes]), f"{what}: nodes and points differ"


def check_skins(root):
    check_box(mode_shapes.skin(run_of(os.path.join(root, "grid"), {}, {"cells": CELLS, "spacing": [1.0] * 3, "origin": [0.0] * 3})), "box of voxels")
    check_box(mode_shapes.skin(run_of(os.path.join(root, "mesh"), {"mesh/points": nodes_of(CELLS), "mesh/topology": hexahedra(CELLS)})), "mesh of hexahedra")
    # A square beside a triangle: three triangles to draw, and an outline without their common edge.
    points = [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0]]
    plane = mode_shapes.skin(run_of(os.path.join(root, "plane"), {"mesh/points": np.array(points, float), "mesh/topology": [5, 0, 1, 2, 3, 4, 1, 4, 2]}))
    assert len(plane.triangles) == 3
    assert {tuple(sorted(edge)) for edge in plane.nodes[plane.outline]} == {(0, 1), (2, 3), (0, 3), (1, 4), (2, 4)}
    fine = mode_shapes.skin(run_of(os.path.join(root, "fine"), {}, {"cells": [600, 10], "spacing": [1e-3, 1e-3], "origin": [0.0, 0.0]}))
    assert len(fine.points) == 61 * 11 and fine.points.max() == 600, "lines of a fine grid"


def check_page(folder, root):
    """Modes of a box and the sentence on it."""
    folder.write("box.prm", prm({"Dimension": 3, "Analysis": "modal", "Body/Material": "homogeneous", "Body/Size": "0.02, 0.01, 0.008",
                                 "Body/Cells": "10, 5, 4", "Body/Stiffness": "36e9, 9e9, 9e9, 36e9, 9e9, 36e9, 13.5e9, 13.5e9, 13.5e9",
                                 "Body/Density": 1770, "Supports/Top/Kind": "platen", "Modal/Number of modes": 3}))
    folder.run(0, "contact_dynamics", "box.prm", "--output", "box")
    page = report(root, folder("box"))
    assert "Left out" not in page and page.count("<img") == 1
    assert "seen from an angle" in page and "bottom held in z" in page


def main():
    place = np.array([[1.0, 0, 0], [0, 0, 1]])
    seen, near = mode_shapes.projected(place)
    expected = [[np.sqrt(3) / 2, 0.5 * np.sin(np.radians(25))], [0, np.cos(np.radians(25))]]
    assert np.allclose(seen, expected, atol=1e-15) and near[1] > near[0]
    with tempfile.TemporaryDirectory() as root:
        check_skins(root)
        check_page(Folder(root), root)
    print("report_modes: surfaces, outlines and the page are right")


if __name__ == "__main__":
    main()
