"""The explicit step on boxes of voxels: cells a second by size and material, against a mesh of shifted hexahedra and the product with a
Trilinos matrix, in turns, on one and two ranks."""

from plots import curve, legend, logarithmic, panels

KINDS = {"homogeneous": (32, 64, 128, 256), "two": (32, 64, 128, 256), "anisotropic": (64, 128)}
LARGEST_ON_RANKS = 128


def run(bench):
    rows = []
    for kind, edges in KINDS.items():
        for edge in [n for n in edges if n <= (64 if bench.quick else 256)]:
            rows += bench.tool("brick_benchmark", f"{kind}:{edge}", ranks=1 if edge > LARGEST_ON_RANKS else 2)
    for row in rows:
        row["times_mesh"] = row["box"] / row["mesh"]
        row["times_matrix"] = row["box"] / row["matrix"]
        if row["ranks"] == 1:
            row.update(dict.fromkeys(("all_ranks", "all_ranks_low", "all_ranks_high"), float("nan")))
        row["two_ranks_times_one"] = row["all_ranks"] / row["box"]
        row["bound_of_two_ranks"] = 2 * row["side_by_side"] / row["box"] if row["ranks"] > 1 else float("nan")
    bench.write("brick-step", rows, "a contact step of a box of cubes on the flat, without observers: million cells a second, medians of turns; mesh and "
                "matrix: shifted hexahedra, at most 48 along an edge; side by side: a box of its own on each rank at once", ranks="1 and 2",
                repetitions=9)
    draw(bench, rows)


def draw(bench, rows):
    figure, axes = panels(1, width=6.5)
    logarithmic(axes[0], "cells", "million cells per second", "one rank", percent=False)
    for k, kind in enumerate(KINDS):
        own = [row for row in rows if row["kind"] == kind]
        name = {"two": "two phases"}.get(kind, kind)
        curve(axes[0], k, [row["edge"] ** 3 for row in own], [row["box"] for row in own], name)
    of_two = [row for row in rows if row["kind"] == "two" and row["edge"] <= 64]  # larger meshes are the same one
    for k, (what, name) in enumerate((("mesh", "mesh of hexahedra"), ("matrix", "CSR matrix")), len(KINDS)):
        curve(axes[0], k, [min(row["edge"], 48) ** 3 for row in of_two], [row[what] for row in of_two], name, ls=":", mfc="none")
    legend(axes[0])
    bench.draw("brick-step", figure)
