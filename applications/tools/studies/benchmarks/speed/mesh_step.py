"""The explicit step on meshes: cells a second by kind of cell and size, against the product with a Trilinos matrix, on one and two
ranks; and a model of it, with constants measured apart from what it predicts, carried to 1000 ranks."""

import numpy as np

from plots import curve, legend, logarithmic, panels
from step_scaling import CLUSTER

# Cells along an edge: of some 4000, 1e5 and 3e5 to 5e5 cells. Squares are cut into 8 triangles, cubes into 24 tetrahedra.
EDGES = {"quadrilaterals": (64, 300, 700), "congruent-quadrilaterals": (64, 300, 700), "triangles": (24, 112, 250),
         "congruent-triangles": (24, 112, 250), "hexahedra": (16, 40, 64), "congruent-hexahedra": (16, 40, 64),
         "tetrahedra": (6, 16, 28), "congruent-tetrahedra": (6, 16, 28)}
FLAT = {2: 24, 3: 6}  # the smallest meshes, where start and contact count
MESSAGES = [64, 1024, 16384, 262144, 1048576]
CELLS_A_RANK = 1000000
REPETITIONS = 15


def run(bench):
    edges = {kind: all_edges[:2] if bench.quick else all_edges for kind, all_edges in EDGES.items()}
    cases = [f"{kind}:{n}" for kind, all_edges in edges.items() for n in all_edges]
    rows = [row for case in cases for row in bench.tool("mesh_benchmark", case, ranks=2)]
    small = [row for kind in ("quadrilaterals", "hexahedra") for n in {FLAT[2 if kind == "quadrilaterals" else 3], *edges[kind][:2]}
             for row in bench.tool("mesh_benchmark", f"{kind}:{n}", ranks=2)]
    messages = bench.tool("scaling_benchmark", "message", *MESSAGES, ranks=2)
    models = {dim: Model([row for row in small if row["dim"] == dim], messages) for dim in (2, 3)}
    for row in rows:
        row["million_cells_per_s"] = 1e-6 * row["cells"] / row["one_rank_s"]
        row["times_matrix"] = row["matrix_s"] / row["one_rank_s"]
        row["two_ranks_times_one"] = row["one_rank_s"] / row["all_ranks_s"]
        row["bound_of_two_ranks"] = 2 * row["one_rank_s"] / row["side_by_side_s"]
        predicted = models[row["dim"]].on_two_ranks(row) if "congruent" not in row["kind"] and row["kind"][0] in "qh" else float("nan")
        row["two_ranks_over_predicted"] = row["all_ranks_s_low"] / predicted
    bench.write("mesh-step", rows, "a contact step of a block on the flat, without observers: wall-clock seconds, medians of turns; matrix: product with "
                "a Trilinos CSR matrix and update of the nodes on one rank; side by side: two bodies of their own at once, the bound of two ranks",
                ranks="1 and 2", repetitions=REPETITIONS)
    bench.write("mesh-step-constants", [{"dim": dim, **model.constants()} for dim, model in models.items()],
                "constants of the model, from quadrilaterals and hexahedra, shifted at random, on one rank", repetitions=REPETITIONS)
    bench.write("mesh-step-1000-ranks", [row for model in models.values() for row in model.cluster()],
                f"predicted, {CELLS_A_RANK:g} cells a rank; assumed: {CLUSTER['ranks']} ranks a node, network {CLUSTER['network'] / 1e9:g} GB/s "
                f"a node, latency {1e6 * CLUSTER['latency']:g} us", ranks="1 to 1000")
    draw(bench, rows)


class Model:
    """Seconds a step: work a cell, of the nodes of the contact that the rank has, and a start; an exchange of the points between
    the ranks, which cells in the inside hide as far as they last, and one of the sum of the forces on the platen."""

    def __init__(self, rows, messages):
        self.dim = rows[0]["dim"]
        terms = np.array([[row["cells"], row["contact_nodes"], 1.0] for row in rows])
        times = np.array([row["one_rank_s_low"] for row in rows])
        best = np.linalg.lstsq(terms / times[:, None], np.ones(len(times)), rcond=None)[0]  # relative errors weigh
        self.cell, self.contact, self.start = np.maximum(best, 0.0)
        self.messages = sorted((row["bytes"], row["seconds_low"]) for row in messages)
        largest = max(rows, key=lambda row: row["cells"])
        self.sent = largest["points_sent"] / largest["cells"] ** (1 - 1 / self.dim)  # of the points of a cut through a block

    def on_two_ranks(self, row):
        points, platen = (float(np.interp(8 * self.dim * n, *zip(*self.messages))) for n in (row["points_sent"], 1))
        work = self.cell * row["cells"] / 2
        return max(work, points) + self.contact * row["contact_nodes_a_rank"] + self.start + platen

    def constants(self):
        return {"work_s_per_cell": self.cell, "work_s_per_contact_node": self.contact, "work_s_per_step": self.start,
                "points_of_a_cut": self.sent, **{f"message_{size}_bytes_s": seconds for size, seconds in self.messages}}

    def cluster(self):
        """Blocks of the same size, each with as many neighbours as a cube has faces; the lowest and the highest have one of theirs
        at the contact or at the platen."""
        rows, share = [], CELLS_A_RANK
        for ranks in (1, 10, 100, 1000):
            contact, at_platen = share ** (1 - 1 / self.dim), ranks ** (1 - 1 / self.dim)
            sides = 0 if ranks == 1 else 2 * self.dim
            sent = 8 * self.dim * sides * self.sent * share ** (1 - 1 / self.dim)
            rate = CLUSTER["network"] / min(ranks, CLUSTER["ranks"])
            points = sides * CLUSTER["latency"] + sent / rate
            platen = CLUSTER["latency"] * np.log2(at_platen) + 8 * self.dim * at_platen / rate if ranks > 1 else 0
            work = self.cell * share
            total = max(work, points) + self.contact * contact + self.start + platen
            rows.append({"dim": self.dim, "ranks": ranks, "cells": share * ranks, "work_s": work, "points_s": points,
                         "contact_s": self.contact * contact, "sum_of_platen_s": platen, "step_s": total, "efficiency": work / total})
        return rows


def draw(bench, rows):
    figure, axes = panels(2)
    for panel, prefix in zip(axes, ("", "congruent-")):
        logarithmic(panel, "cells", "million cells a second", f"one rank, {'congruent' if prefix else 'shifted'} cells", percent=False)
        for k, kind in enumerate(("quadrilaterals", "triangles", "hexahedra", "tetrahedra")):
            own = [row for row in rows if row["kind"] == prefix + kind]
            cells = [row["cells"] for row in own]
            curve(panel, k, cells, [row["million_cells_per_s"] for row in own], kind)
            curve(panel, k, cells, [1e-6 * row["cells"] / row["matrix_s"] for row in own], f"{kind}, CSR matrix", ls=":", mfc="none")
        legend(panel)
    bench.draw("mesh-step", figure)
