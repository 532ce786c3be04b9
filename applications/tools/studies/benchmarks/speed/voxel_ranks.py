"""Boxes of voxels on many ranks: the explicit step and the statics by models whose constants are measured apart from what they predict, on
one and two ranks, carried to 1e9 voxels on 1000 ranks; and what bounds the step on one rank."""

import os

import numpy as np

from plots import curve, legend, logarithmic, panels
from step_scaling import CLUSTER
from vector_loop import vector_loop

# Boxes (x, y, z) of at most 3 MB: they give work a vector of cells, a row and a node of the contact.
SMALL = [(64, 12, 12), (128, 12, 12), (24, 20, 20), (16, 16, 32), (40, 15, 15), (191, 12, 12), (32, 32, 32), (95, 16, 16), (127, 16, 16)]
STEPS = {1: (64, 100, 128, 160, 256), 2: (64, 100, 128, 160)}
STATICS = {1: (32, 64, 128), 2: (64, 128)}
STREAM = [2 ** k for k in (12, 14, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28)]
MESSAGES = [8, 1024, 16384, 131072, 524288, 2097152]
LANES = 8  # cells of a vector
STEP_BYTES = 104  # a cell and step: u and w read and written, a phase, masses of a row
STATE_BYTES = 96  # of them resident: u and w, points
PLANE_BYTES = 24  # of a node that is sent: u + beta w
# Statics, counted: bytes of memory a voxel in an iteration (products, vectors of conjugate gradients, coarse grids), and a node that is sent.
STATIC_BYTES, STATIC_PLANE_BYTES, STATIC_MEMORY, COARSE_MEMORY = 600, 12, 210, 60
DEGREES = (2, 4, 8, 8, 8, 8, 8, 8, 8, 8)  # of the smoother, from grid to grid, up to contrast 140
ITERATIONS, REDUCTIONS = 10, 3
FEWEST_PLANES = 4  # a rank: a grid with fewer is solved by every rank alone


def run(bench):
    small = [box(bench, *n) for n in (SMALL[:5] if bench.quick else SMALL)]
    stream = [{"ranks": ranks, **row} for ranks in (1, 2) for row in bench.tool("scaling_benchmark", "stream", *STREAM, ranks=ranks)]
    messages = bench.tool("scaling_benchmark", "message", *MESSAGES, ranks=2)
    machine = Machine(stream, messages)
    steps = StepModel(small, machine)
    largest = 64 if bench.quick else 256
    step_rows = [steps.compared(box(bench, n, n, n, ranks)) for ranks, edges in STEPS.items() for n in edges if n <= largest]
    solved = {(ranks, n): bench.tool("voxel_benchmark", n, 8, "PBC", 6, ranks=ranks)[0] for ranks, edges in STATICS.items() for n in edges if n <= largest}
    statics = StaticModel(solved[1, 64], machine)
    static_rows = [statics.compared(row) for row in solved.values()]
    write_all(bench, steps, statics, small, step_rows, static_rows)
    bench.write("voxel-stream", stream, "numbers read and written in place by every rank at once, seconds a sweep; bytes: of one rank", ranks="1 and 2",
                repetitions=41)
    bench.write("voxel-step-bounds", bounds(bench, steps, machine, [row for row in step_rows if row["ranks"] == 1]), "what bounds a step of a box of cubes on "
                "one rank, in million cells a second; instructions are counted in the compiled loop")
    draw(bench, step_rows, static_rows, steps.cluster(), statics.cluster())


def box(bench, nx, ny, nz, ranks=1):
    return bench.tool("scaling_benchmark", "box", f"{nx}:{ny}:{nz}:1", ranks=ranks)[0]


def write_all(bench, steps, statics, small, step_rows, static_rows):
    assumed = (f"assumed: {CLUSTER['ranks']} ranks a node with {CLUSTER['memory'] / 1e9:g} GB/s of memory, network {CLUSTER['network'] / 1e9:g} GB/s a node, "
               f"latency {1e6 * CLUSTER['latency']:g} us")
    bench.write("voxel-step-ranks", step_rows, "seconds a step of a box of cubes, homogeneous, without observers; one rank: of the processor, two: of the "
                "clock, each the fastest of the repetitions, and predicted", ranks="1 and 2", repetitions=41)
    bench.write("voxel-static-ranks", static_rows, "six load cases of PBC to 1e-8, contrast 8; one rank: seconds of the processor, two: of the clock",
                ranks="1 and 2")
    bench.write("voxel-ranks-constants", [{"constant": k, "value": v} for k, v in {**steps.constants(), **statics.constants()}.items()],
                "constants of the models, from boxes of at most 33,000 cells and from 64^3 voxels on one rank")
    bench.write("voxel-step-1000-ranks", steps.cluster(), f"predicted; {assumed}", ranks="10 to 1000")
    bench.write("voxel-static-1000-ranks", statics.cluster(), f"predicted, six load cases of PBC to 1e-8 in {ITERATIONS} iterations each; {assumed}",
                ranks="10 to 1000")


class Machine:
    """Bandwidth of one rank by its working set, and messages between two, as measured."""

    def __init__(self, stream, messages):
        self.sizes = sorted({row["bytes"] for row in stream})
        self.bandwidths = {ranks: [2 * row["bytes"] / row["seconds_low"] for row in stream if row["ranks"] == ranks] for ranks in (1, 2)}
        self.messages = sorted((row["bytes"], row["seconds_low"]) for row in messages)

    def bandwidth(self, working_set, ranks=1):
        return float(np.interp(np.log(working_set), np.log(self.sizes), self.bandwidths[ranks]))

    def message(self, size):
        last, seconds = self.messages[-1]
        return float(np.interp(size, *zip(*self.messages))) if size <= last else seconds * size / last


def vectors(nx):
    """Vectors of a row of cells, with the one that the last node takes."""
    return -(-(nx + 1) // LANES)


class StepModel:
    """Seconds a step: the larger of work and memory, or their sum where nothing overlaps, and an exchange of planes that nothing hides. Ranks have layers across y; each also computes
    the forces of the layers of its neighbours on its own planes."""

    def __init__(self, rows, machine):
        self.machine = machine
        terms = np.array([self.terms(row["nx"], row["ny"], row["nz"], 0) for row in rows])
        times = np.array([row["cpu_s"] for row in rows])
        best = np.linalg.lstsq(terms / times[:, None], np.ones(len(times)), rcond=None)[0]  # relative errors weigh
        self.best = np.maximum(best, 0.0)
        self.fit = float(np.abs(terms @ self.best / times - 1).max())

    @staticmethod
    def terms(nx, ny, nz, neighbours):
        rows = (ny + neighbours) * nz
        return rows * vectors(nx), rows, 2 * (nx + 1) * (ny + 1)

    def work(self, nx, ny, nz, neighbours):
        return float(np.dot(self.best, self.terms(nx, ny, nz, neighbours)))

    def step(self, nx, ny, nz, ranks):
        neighbours, cells = int(ranks > 1), nx * ny / ranks * nz
        work = self.work(nx, ny / ranks, nz, neighbours)
        memory = STEP_BYTES * cells / self.machine.bandwidth(STATE_BYTES * cells, ranks)
        exchange = 2 * self.machine.message(PLANE_BYTES * (nx + 1) * (nz + 1)) + self.machine.message(8) if ranks > 1 else 0.0
        return {"work_s": work, "memory_s": memory, "exchange_s": exchange, "predicted_s": max(work, memory) + exchange, "sum_s": work + memory + exchange}

    def compared(self, row):
        nx, ny, nz, ranks = (int(row[key]) for key in ("nx", "ny", "nz", "ranks"))
        seconds = row["cpu_s"] if ranks == 1 else row["seconds_low"]
        predicted = self.step(nx, ny, nz, ranks)
        return {"edge": nx, "cells": nx * ny * nz, "ranks": ranks, "seconds": seconds, "million_cells_per_s": 1e-6 * nx * ny * nz / seconds, **predicted,
                "measured_over_predicted": seconds / predicted["predicted_s"], "measured_over_sum": seconds / predicted["sum_s"]}

    def constants(self):
        return {"step_s_per_vector_of_8": self.best[0], "step_s_per_row": self.best[1], "step_s_per_contact_node": self.best[2],
                "step_largest_error_of_fit": self.fit, "step_bytes_per_cell": STEP_BYTES}

    def cluster(self):
        """As it is, layers across y, of a cube and of a body that is long in y; and blocks as they might be."""
        found = []
        for name, n, ranks in (("layers, cube", (1000, 1000, 1000), 10), ("layers, cube", (1000, 1000, 1000), 100), ("layers, cube", (1000, 1000, 1000), 1000),
                               ("layers, long in y", (500, 8000, 250), 1000), ("blocks, cube", (1000, 1000, 1000), 1000)):
            found.append({"layout": name, "ranks": ranks, "cells": np.prod(n), **self.on_cluster(name, n, ranks)})
        return found

    def on_cluster(self, name, n, ranks):
        share, memory_rate = np.prod(n) / ranks, CLUSTER["memory"] / CLUSTER["ranks"]
        if name.startswith("blocks"):
            edge = share ** (1 / 3)
            work = self.work(edge + 2, edge + 2, edge + 2, 0)
            nodes, sides = edge ** 2, 6
            crossing = sides / 2 * CLUSTER["ranks"] ** (2 / 3) * nodes  # the surface of a node's block of blocks, on average half its own faces
        else:
            work = self.work(n[0], n[1] / ranks, n[2], 2)
            nodes, sides = (n[0] + 1) * (n[2] + 1), 2
            crossing = sides / 2 * nodes
        # u and w are read, a plane written, sent and received by way of memory.
        copies = sides * nodes * (STATE_BYTES / 2 + 4 * PLANE_BYTES) / memory_rate
        planes = sides * CLUSTER["latency"] + copies + PLANE_BYTES * crossing / CLUSTER["network"]
        memory = STEP_BYTES * share / memory_rate
        platen = CLUSTER["latency"] * np.log2(ranks)
        total = max(work, memory) + planes + platen
        alone = self.best[0] * share / LANES
        return {"work_s": work, "memory_s": memory, "planes_s": planes, "platen_s": platen, "step_s": total, "step_s_without_overlap": work + memory + planes + platen, "million_cells_per_s": 1e-6 * share * ranks / total,
                "efficiency": alone / total, "of_memory_bound": max(alone, memory) / total, "planes_MB_per_rank": sides * nodes * PLANE_BYTES / 1e6}


class StaticModel:
    """Seconds of six load cases: products with every grid, by voxels, from the set-up and the solution of a volume on one rank; planes that each
    product tells the neighbours; sums. Grids with fewer than FEWEST_PLANES planes a rank are gathered and solved by every rank."""

    def __init__(self, row, machine):
        self.machine = machine
        voxels, iterations = row["n"] ** 3, sum(map(int, row["iterations"].split()))
        self.set_up = row["set_up_s"] / voxels * row["cpu_s"] / row["seconds"]
        self.product = (row["cpu_s"] - self.set_up * voxels) / iterations / voxels / self.products_in_all()

    @staticmethod
    def products(level):
        """Before and after the coarser grid, and the residual; on the finest that of conjugate gradients."""
        return 2 * DEGREES[min(level, len(DEGREES) - 1)] + (level == 0)

    def products_in_all(self):
        return sum(self.products(level) / 8 ** level for level in range(8))

    def compared(self, row):
        n, ranks = int(row["n"]), int(row["ranks"])
        iterations = sum(map(int, row["iterations"].split()))
        seconds = row["cpu_s"] if ranks == 1 else row["seconds"]
        work = message = 0.0
        for level in range(12):
            edge = n / 2 ** level
            if edge < 4:
                break
            divided = ranks > 1 and edge / ranks >= FEWEST_PLANES
            planes = edge / ranks if divided else edge
            work += self.products(level) * self.product * edge * edge * (planes + divided)
            if divided:
                message += self.products(level) * 2 * self.machine.message(STATIC_PLANE_BYTES * edge ** 2)
        predicted = iterations * (work + message) + self.set_up * n ** 3 / ranks
        return {"edge": n, "voxels": n ** 3, "ranks": ranks, "iterations": row["iterations"], "seconds": seconds, "work_s": iterations * work,
                "messages_s": iterations * message, "predicted_s": predicted, "measured_over_predicted": seconds / predicted, "memory_MB": row["memory_MB"]}

    def constants(self):
        return {"static_s_per_voxel_and_product": self.product, "static_s_set_up_per_voxel": self.set_up, "static_products_of_an_iteration": self.products_in_all(),
                "static_bytes_per_voxel_and_iteration": STATIC_BYTES}

    def cluster(self):
        cube, tower = (1000, 1000, 1000), (500, 500, 4000)
        return [{"layout": name, "ranks": ranks, "voxels": np.prod(n), **self.on_cluster(name, n, ranks)} for name, n, ranks in
                (("planes, cube", cube, 10), ("planes, cube", cube, 48), ("planes, cube", cube, 125), ("planes, cube", cube, 500),
                 ("planes, long in z", tower, 1000), ("blocks, cube", cube, 1000))]

    def on_cluster(self, name, n, ranks):
        blocks, memory_rate = name.startswith("blocks"), CLUSTER["memory"] / CLUSTER["ranks"]
        parts = dict.fromkeys(("work_s", "memory_s", "planes_s", "whole_grids_s"), 0.0)
        voxels, resident = np.prod(n), 0.0
        memory_of_product = STATIC_BYTES / self.products_in_all() / memory_rate
        gathered = False
        for level in range(12):
            size, count = voxels / 8 ** level, self.products(level)
            if min(n) / 2 ** level < 4:
                break
            planes = n[2] / 2 ** level / ranks
            if not blocks and planes < FEWEST_PLANES and level > 0:
                # Every rank of a node gets all of it, twice an iteration from all others.
                parts["whole_grids_s"] += count * size * max(self.product, memory_of_product)
                if not gathered:
                    parts["whole_grids_s"] += STATIC_PLANE_BYTES * size * CLUSTER["ranks"] / CLUSTER["network"]
                resident += COARSE_MEMORY * size
                gathered = True
                continue
            share = max(size / ranks, 64.0)
            resident += (STATIC_MEMORY if level == 0 else 0) * share
            nodes = share ** (2 / 3) if blocks else n[0] * n[1] / 4 ** level
            sides, crossing = (6, 3 * CLUSTER["ranks"] ** (2 / 3)) if blocks else (2, 1)
            layers = 1 + (3 / share ** (1 / 3) if blocks else 1 / planes)  # of cells that two ranks have
            parts["work_s"] += count * share * layers * self.product
            parts["memory_s"] += count * share * memory_of_product
            parts["planes_s"] += count * (sides * CLUSTER["latency"] + STATIC_PLANE_BYTES * nodes * (crossing / CLUSTER["network"] + sides * 4 / memory_rate))
        reductions = REDUCTIONS * 2 * CLUSTER["latency"] * np.log2(ranks)
        iteration = max(parts["work_s"], parts["memory_s"]) + parts["planes_s"] + parts["whole_grids_s"] + reductions
        alone, memory = (voxels / ranks * self.products_in_all() * of_product for of_product in (self.product, memory_of_product))
        times = 6 * ITERATIONS
        return {**{key: times * value for key, value in parts.items()}, "sums_s": times * reductions, "set_up_s": self.set_up * voxels / ranks,
                "seconds": times * iteration + self.set_up * voxels / ranks, "efficiency": alone / iteration, "of_memory_bound": max(alone, memory) / iteration, "memory_GB_per_rank": resident / 1e9}


def bounds(bench, steps, machine, rows):
    """Each as if there were nothing else. A 512-bit operation is one of two halves on some processors, so the rates of single kinds are measured."""
    rates = {row["kind"]: row["per_ns"] for row in bench.tool("scaling_benchmark", "units", "fma", "add", "mixed", "load", "store", "cycle")}
    loop = vector_loop(os.path.join(bench.programs, "..", "tests", "scaling_benchmark"), r"x86_64_v4.*advance<4u>")
    arithmetic = max(loop["additions"] / rates["add"], loop["multiplications"] / rates["fma"],
                     (loop["additions"] + loop["multiplications"]) / rates["mixed"])
    moves = max(loop["loads"] / rates["load"], loop["stores"] / rates["store"])
    found = []
    for row in rows:
        n = row["edge"]
        per_cell = steps.work(n, n, n, 0) / n ** 3
        cached = 1e-6 / (steps.best[0] / LANES)
        found.append({"edge": n, "measured": row["million_cells_per_s"], "arithmetic": 1e3 * LANES / arithmetic, "loads_and_stores": 1e3 * LANES / moves,
                      "vectors_alone": cached, "with_rows_and_contact": 1e-6 / per_cell,
                      "memory": 1e-6 * machine.bandwidth(STATE_BYTES * n ** 3) / STEP_BYTES, **{f"{key}_of_8_cells": value for key, value in loop.items()},
                      **{f"{kind}_per_ns": rate for kind, rate in rates.items()}})
    return found


def draw(bench, step_rows, static_rows, step_cluster, static_cluster):
    figure, (step, static, many) = panels(3, width=15.5)
    for axes, rows, text, per in ((step, step_rows, "time per cell and step (ns)", "cells"), (static, static_rows, "time per voxel, six load cases (µs)", "voxels")):
        logarithmic(axes, per, text, "explicit step" if per == "cells" else "statics, PBC to 1e-8", percent=False)
        scale = 1e9 if per == "cells" else 1e6
        for ranks in (1, 2):
            own = [row for row in rows if row["ranks"] == ranks]
            name = f"{ranks} rank{'s' if ranks > 1 else ''}"
            curve(axes, ranks - 1, [r[per] for r in own], [scale * r["seconds"] / r[per] for r in own], f"{name}, measured", ls="")
            curve(axes, ranks - 1, [r[per] for r in own], [scale * r["predicted_s"] / r[per] for r in own], f"{name}, predicted", marker="")
        values = [scale * r[key] / r[per] for r in rows for key in ("seconds", "predicted_s")]
        axes.set_ylim(0.6 * min(values), 1.7 * max(values))
    logarithmic(many, "ranks", "efficiency", "1e9 voxels, predicted", percent=False)
    for k, (name, rows) in enumerate((("step", step_cluster), ("statics", static_cluster))):
        for m, layout in enumerate(dict.fromkeys(row["layout"] for row in rows)):
            own = [row for row in rows if row["layout"] == layout]
            curve(many, 3 * k + m, [row["ranks"] for row in own], [row["efficiency"] for row in own], f"{name}: {layout}")
    for axes in (step, static, many):
        legend(axes, 2)
    bench.draw("voxel-ranks", figure)
