"""Maps of the report for bodies of many shapes: nothing leaves the picture, no panel is too small, no labels touch.

    report_layout.py <folder with the programs, not used>
"""

import sys
import tempfile

import numpy as np

from scenes import TOOLS, Folder, prm

sys.path.insert(0, TOOLS)

from report.base.data import without_folders  # noqa: E402
from report.base.figures import plt  # noqa: E402
from report.bodies.loads import without_round_off  # noqa: E402
from report.bodies import points, projections  # noqa: E402
from report.bodies.maps import TALL, views, whole_view  # noqa: E402
from report.bodies.phase_colours import colours_of, words_on_colours  # noqa: E402
from report.bodies.projections import Group, View, draw  # noqa: E402
from report.bodies.stress_maps import compared, phase_figure, stress_group  # noqa: E402
from report.runs.energies import friction_energy  # noqa: E402
from report.runs.key_numbers import frictional_power  # noqa: E402

LONG = "reinforcement-of-carbon-fibre-lot-7"
SHAPES = [(240, 20), (120, 20), (90, 60), (60, 60), (60, 90), (20, 120), (16, 192), (560, 160)]  # cells of 0.1 mm
SLACK = 0.03  # in


class Body:
    """A run on a plane grid, as far as maps ask."""
    name, folder, summary = "body", "no folder", {"phases": [{"name": LONG[:-1] + "6"}, {"name": LONG}]}

    def __init__(self, nx, ny, side=None):
        self.cells, self.side = np.array([nx, ny]), side

    def grid(self):
        return [self.cells.astype(float), np.array([1e-4, 1e-4]), np.zeros(2)]

    def extent(self):
        return [0, 0.1 * self.cells[0], 0, 0.1 * self.cells[1]]

    def get(self, dataset, rows=...):
        return None

    def attribute(self, place, name):
        return self.side if (place, name) == ("/run", "contact_side") else None


def overlaps(axes, renderer):
    """Whether labels of neighbouring ticks touch."""
    for line, side in ((axes.xaxis, 0), (axes.yaxis, 1)):
        boxes = [label.get_window_extent(renderer) for label in line.get_ticklabels() if label.get_visible() and label.get_text()]
        ends = sorted((box.intervalx if side == 0 else box.intervaly).tolist() for box in boxes)
        if any(first[1] > second[0] + 1 for first, second in zip(ends, ends[1:])):
            yield f"labels along {'xy'[side]} touch"


def problems_of(figure):
    """What a reader would object to."""
    figure.draw_without_rendering()
    renderer = figure.canvas.get_renderer()
    width, height = figure.get_size_inches()
    box = figure.get_tightbbox(renderer)
    if box.x0 < -SLACK or box.y0 < -SLACK or box.x1 > width + SLACK or box.y1 > height + SLACK:
        yield f"what is drawn reaches from {box.p0} to {box.p1} in a picture of {width:.1f} x {height:.1f} in"
    if width > 10 or height > 13:
        yield f"{width:.1f} x {height:.1f} in"
    for axes in figure.axes:
        yield from overlaps(axes, renderer)
        place = axes.get_position()
        if place.width * width < 0.1 or place.height * height < 0.1:
            yield f"a panel of {place.width * width:.2f} x {place.height * height:.2f} in"
    plt.close(figure)


def pictures(body):
    values = np.random.default_rng(1).random(body.cells.prod()) * 3e6
    ids = (values > 2e6).astype(int)
    one = [whole_view(body)]
    yield "phases", phase_figure(views(body), body, ids, [" (90.0 %)", " (10.0 %)"])
    yield "stress", draw(views(body), [stress_group(values)])
    yield "motion", draw(views(body), [stress_group(values)], title="the run", flat=np.array([-1.0, 0.0]))
    yield "comparison", compared(one, values, 1.1 * values, "mean von Mises stress")[0]
    signed = 1e-5 * (values / 3e6 - 0.5)
    yield "four fields", draw(one, [Group(signed, "PuOr_r", (-5e-6, 5e-6), "", f"$\\sigma_{{{name}}}$ (GPa)") for name in ("xx", "yy", "xy", "zz")])


def solid_pictures(size):
    """Sections of a box."""
    bounds, seen = np.array([np.zeros(3), size]), []
    for axis in range(3):
        others = [d for d in range(3) if d != axis]
        corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * bounds[1][others]
        seen.append(View(bounds, axis, [corners], np.array([0])))
    values = np.array([-0.0123])
    yield "sections", draw(seen, [Group(values, "viridis", (-0.0125, 0.0125), "", "stress (MPa)")])


def check_colours():
    """Phases of a picture are as light as their values in it are high, also in the run that read its rve.h5; others have a fixed order."""
    with tempfile.TemporaryDirectory() as root:
        folder, body = Folder(root), Body(6, 4)

        def lightness(settings, n, name):
            folder.write(f"{name}/parameters.prm", prm(settings))
            body.folder = folder(name)
            return [sum(colours_of(body, n)(phase)[:3]) for phase in range(n)]
        made = {"Microstructure/Type": "image", "Microstructure/File": "a/grey.png"}
        for values in ("0, 255", "255, 0", "90, 200, 10", "1, 7, 6, 5, 4, 3, 2"):
            numbers = [int(value) for value in values.split(",")]
            light = lightness({**made, "Microstructure/Image values": values}, len(numbers), "rve")
            assert np.array_equal(np.argsort(light), np.argsort(numbers)), (values, light)
        assert "in grey.png, the lighter" in words_on_colours(body, 7), words_on_colours(body, 7)
        light = lightness(made, 2, "rve")  # ascending
        assert light[0] < light[1], light
        for path in (folder("rve/rve.h5"), "rve/rve.h5", "/of/another/machine/rve/rve.h5"):
            light = lightness({"Body/RVE file": path}, 2, "sliding")
            assert light[0] < light[1], (path, light)
        light = lightness({"Microstructure/Type": "random fibres"}, 2, "rve")
        assert light[0] > light[1] and not words_on_colours(body, 2), light


class Sliding:
    """A run of some length (s) that dissipates 3 W/m, as far as energies ask."""
    label = "run"

    def __init__(self, end):
        self.time = np.linspace(0, end, 201)

    def get(self, dataset, rows=...):
        return {"/history/time": self.time, "/history/friction_energy": 3 * self.time}[dataset]

    def number(self, *path):
        return 3 * self.time[-1] if path == ("friction_energy",) else None

    def steady_from(self):
        return 0.5 * self.time[-1]

    def per_thickness(self):
        return "/m"


class Strained:
    """A direct run of two phases on a grid or the same cells as a mesh of quadrilaterals, with a uniform strain in all snapshots."""
    STRAIN = np.array([1e-3, -2e-3, 5e-4])

    def __init__(self, as_mesh):
        n = np.array([6, 4])
        x, y = np.meshgrid(np.arange(7) * 1e-3, np.arange(5) * 1e-3)
        xx, yy, xy = self.STRAIN
        field = np.stack([xx * x + xy * y, yy * y], axis=-1)
        first = (np.arange(4)[:, None] * 7 + np.arange(6)).ravel()
        phase = lambda e: e / 0.72 * np.array([[0.8, 0.2, 0], [0.2, 0.8, 0], [0, 0, 0.3]])
        self.cells = None if as_mesh else [n.astype(float), np.array([1e-3, 1e-3]), np.zeros(2)]
        self.data = {"/material/phase_id": np.arange(24) % 2, "/material/stiffness": np.stack([phase(30e9), phase(60e9)]),
                     "/snapshots/time": np.array([1.0, 2.0, 3.0]), "/snapshots/displacement": np.stack([9 * field, field, field])}
        if as_mesh:
            self.data["/mesh/points"] = np.stack([x.ravel(), y.ravel()], axis=1)
            self.data["/mesh/topology"] = np.column_stack([np.full(24, 5), first, first + 1, first + 8, first + 7]).ravel()

    def grid(self):
        return self.cells

    def members(self, group):
        return [name for name in self.data if name.startswith(group + "/")]

    def get(self, dataset, rows=...):
        return self.data[dataset][rows] if dataset in self.data else None

    def need(self, *datasets):
        found = [self.data[dataset] for dataset in datasets]
        return found if len(found) > 1 else found[0]


def check_points():
    """Means of a direct run over a box and a window, of cells on a grid and of a mesh; of a box that the body fills by half."""
    for run in (Strained(False), Strained(True)):
        stress = 0.5 * (run.data["/material/stiffness"][0] + run.data["/material/stiffness"][1]) @ Strained.STRAIN
        mises, normal, filled = points.mean_in_box(run, np.array([2.0, 1]), np.array([4.0, 3]), (1.5, 3))
        assert abs(normal / stress[1] - 1) < 1e-12 and abs(filled - 1) < 1e-12, (normal, stress, filled)
        zz = 0.2 * (stress[0] + stress[1])
        expected = np.sqrt(0.5 * ((stress[0] - stress[1]) ** 2 + (stress[1] - zz) ** 2 + (zz - stress[0]) ** 2) + 3 * stress[2] ** 2)
        assert abs(mises / expected - 1) < 1e-12, (mises, expected)
        assert abs(points.mean_in_box(run, np.array([4.0, 1]), np.array([8.0, 3]), (0, 3))[2] - 0.5) < 1e-12
        assert points.mean_in_box(run, np.array([40.0, 1]), np.array([48.0, 3]), (0, 3)) == (None, None, 0.0)
        assert points.mean_in_box(run, np.array([2.0, 1]), np.array([4.0, 3]), (4, 5))[0] is None, "no snapshot in the window"


def check_lengths():
    """Frictional energies of runs of different length are shown over the time of the shortest, and per second."""
    for ends, shown in (((1e-3, 1e-3), None), ((2e-3, 1e-3), 1e-3)):
        runs = [Sliding(end) for end in ends]
        figure, end = friction_energy(runs)
        assert end == shown and abs(figure.axes[0].get_xlim()[1] - 1.0) < 1e-9, (end, figure.axes[0].get_xlim())
        rows = frictional_power(runs)
        assert [row[1:] for row in rows] == ([["3 W/m", "3 W/m"]] if shown else []), rows
        plt.close(figure)


def main():
    check_colours()
    check_lengths()
    check_points()
    found = []
    for shape in SHAPES:
        body = Body(*shape)
        seen, below = views(body), views(Body(*shape, "upper"))
        assert (len(seen) == 2) == (shape[0] > 50 or shape[1] > TALL * shape[0]), shape
        if len(seen) == 2:  # what is enlarged is at the contact
            (bottom, top), ends = seen[0].bounds[:, 1], [body_views[1].bounds[:, 1] for body_views in (seen, below)]
            assert ends[0][0] == bottom and ends[1][1] == top and abs(np.ptp(ends[0]) - np.ptp(ends[1])) < 1e-12, ends
        found += [f"{shape}, {name}: {problem}" for name, figure in pictures(body) for problem in problems_of(figure)]
    for size in ([6.0, 2, 3], [12, 1, 1], [1, 1, 12], [1, 12, 1], [4, 4, 4]):
        found += [f"{size}, {name}: {problem}" for name, figure in solid_pictures(size) for problem in problems_of(figure)]
    assert not found, "\n".join(found)

    figure, axes = plt.subplots(figsize=(2, 1.5), layout="none")  # the checks see what they look for
    axes.set_xticks([0.1, 0.12, 0.14], ["0.1000", "0.1200", "0.1400"])
    figure.text(0.9, 0.5, LONG)
    seen = " ".join(problems_of(figure))
    assert "touch" in seen and "reaches" in seen, seen

    assert projections.without_round_off(-5.89e-5, 6.0) == 0 and projections.without_round_off(-5.89e-3, 6.0) == -5.89e-3
    assert without_round_off({"xx": 2e9, "yy": -3e-4, "xy": 5.0}) == {"xx": 2e9, "yy": 0.0, "xy": 5.0}
    paths = {"a": ["the phases of /tmp/x/square/10-rve/rve.h5, 1/s and J/m; /etc is kept"]}
    assert without_folders(paths) == {"a": ["the phases of 10-rve/rve.h5, 1/s and J/m; /etc is kept"]}, without_folders(paths)
    print("report_layout: bodies from 12:1 to 1:12 fit")


if __name__ == "__main__":
    main()
