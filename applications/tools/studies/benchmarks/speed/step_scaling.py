"""The explicit step against cells and ranks: measured, and predicted by a model whose constants are measured apart from it
(work a cell, a row, a step; bandwidth by working set; exchange of rows between ranks), carried to 1000 ranks and 1e9 cells."""

import numpy as np

from plots import curve, legend, logarithmic, panels

BYTES_A_NODE = 32  # u and w, two components each
TRAFFIC = 64  # bytes a cell and sweep: all of them read and written
ROWS_AT_ONCE = 3  # of the kernel; a step in flight lags one row behind the one before it
# Grids that fit the second-level cache: they give work a cell, a row and a step.
SMALL = [(32, 32), (200, 20), (64, 128), (100, 100), (250, 40)]
LARGE = [(316, 316), (560, 160), (1120, 320), (1000, 1000), (2240, 640), (3162, 3162)]
STREAM = [2 ** k for k in (12, 14, 16, 18, 20, 22, 23, 24, 25, 26, 27, 28)]
MESSAGES = [8, 1024, 4096, 16384, 32768, 65536, 262144]
HALOS = [(32, 1), (100, 1), (317, 1), (1001, 1), (3163, 1), (1001, 8), (3163, 4), (3163, 8), (3163, 16)]  # columns and rows of nodes
# Assumed of a cluster, for the prediction: ranks a node, its memory bandwidth (B/s), network of a node (B/s), latency (s).
CLUSTER = {"ranks": 48, "memory": 200e9, "network": 12.5e9, "latency": 2e-6}
REPETITIONS = 41


def run(bench):
    large = LARGE[:3] if bench.quick else LARGE
    sizes = STREAM[:-3] if bench.quick else STREAM
    stream = [{"ranks": ranks, **row} for ranks in (1, 2)
              for row in bench.tool("scaling_benchmark", "stream", *sizes, ranks=ranks)]
    messages = bench.tool("scaling_benchmark", "message", *MESSAGES, ranks=2)
    small = [row for nx, ny in SMALL for row in steps(bench, nx, ny, 1)]
    halos = bench.tool("scaling_benchmark", "halo", *(f"{columns}:{rows}" for columns, rows in HALOS), ranks=2)
    model = Model(small, stream, halos)
    rows = small + [row for nx, ny in large for depth in (1, 0) for row in steps(bench, nx, ny, depth)]
    rows += [row for nx, ny in SMALL[3:] + large for depth in (1, 0) for row in steps(bench, nx, ny, depth, ranks=2)
             if depth == 1 or row["in_flight"] > 1]
    for row in rows:
        row["predicted"] = model.step(row["nx"], row["ny"], row["in_flight"], row["ranks"])
        row["measured_over_predicted"] = row["seconds_low"] / row["predicted"]
    bench.write("step-scaling", rows, "seconds a step of a body on the flat, without observers; bytes: memory of the grid; the "
                "prediction is compared with the fastest repetition", ranks="1 and 2", repetitions=REPETITIONS)
    bench.write("step-scaling-machine", [{"constant": k, "value": v} for k, v in model.constants().items()],
                "constants of the model, from grids within the second-level cache and from two ranks", repetitions=REPETITIONS)
    bench.write("stream", stream, "numbers read and written in place by every rank at once, seconds a sweep; bytes: of one rank",
                ranks="1 and 2", repetitions=REPETITIONS)
    bench.write("messages", messages, "seconds of half a round trip", ranks=2, repetitions=REPETITIONS)
    bench.write("halos", halos, "seconds in which two ranks of one machine exchange rows; bytes: of one direction", ranks=2,
                repetitions=REPETITIONS)
    bench.write("step-scaling-1000-ranks", model.cluster(), "predicted: 1e9 cells on 1000 ranks; assumed: "
                f"{CLUSTER['ranks']} ranks a node with {CLUSTER['memory'] / 1e9:g} GB/s of memory, network "
                f"{CLUSTER['network'] / 1e9:g} GB/s a node, latency {1e6 * CLUSTER['latency']:g} us", ranks=1000)
    draw(bench, rows, stream, messages, halos)


def steps(bench, nx, ny, depth, ranks=1):
    """One process for each grid, so that memory is its own."""
    return bench.tool("scaling_benchmark", "step", f"{nx}:{ny}:{depth}", ranks=ranks)


class Model:
    """Seconds a step: the slowest of work, memory and cache, and an exchange of rows that nothing hides."""

    def __init__(self, small, stream, halos):
        terms = np.array([[row["nx"] * row["ny"], row["ny"], 1.0] for row in small])
        times = np.array([row["seconds_low"] for row in small])
        best = np.linalg.lstsq(terms / times[:, None], np.ones(len(times)), rcond=None)[0]  # relative errors weigh
        self.cell, self.row, self.start = np.maximum(best, 0.0)
        self.sizes = sorted({row["bytes"] for row in stream})
        self.bandwidths = {ranks: [2 * row["bytes"] / row["seconds_low"] for row in stream if row["ranks"] == ranks]
                           for ranks in (1, 2)}
        self.halos = sorted((row["bytes"], row["seconds_low"]) for row in halos)

    def bandwidth(self, working_set, ranks):
        """B/s of one rank, when as many as `ranks` want it."""
        return float(np.interp(np.log(working_set), np.log(self.sizes), self.bandwidths[ranks]))

    def halo(self, size):
        return float(np.interp(size, *zip(*self.halos)))

    def work(self, nx, ny):
        return nx * ny * self.cell + ny * self.row + self.start

    def step(self, nx, ny, in_flight=1, ranks=1):
        """The grid passes once in the n steps in flight, the rows between the first and the last of these in each step. n rows are
        exchanged once in n steps, and a slab advances (n - 1) / 2 of its ghost rows a step where its neighbour is (two ranks)."""
        row, own = BYTES_A_NODE * nx, ny / ranks
        swept = own + (in_flight - 1) / 2 if ranks > 1 else own
        traffic = TRAFFIC * nx * own
        memory = traffic / in_flight / self.bandwidth(row * own, ranks)
        cache = traffic / self.bandwidth(row * (in_flight + ROWS_AT_ONCE), ranks)
        halo = self.halo(row * in_flight) / in_flight if ranks > 1 else 0.0
        return max(self.work(nx, swept), memory, cache) + halo

    def constants(self):
        return {"work_s_per_cell": self.cell, "work_s_per_row": self.row, "work_s_per_step": self.start,
                "bytes_per_node": BYTES_A_NODE, "traffic_bytes_per_cell": TRAFFIC, "halo_1kB_s": self.halo(1024),
                "halo_64kB_s": self.halo(65536)}

    def cluster(self, cells=1e9, ranks=1000, aspect=3.5):
        """Slabs of rows as they are, with one step in flight or several, and blocks as they might be."""
        found, share = [], cells / ranks
        nodes = ranks / CLUSTER["ranks"]
        memory_rate = CLUSTER["memory"] / CLUSTER["ranks"]
        width = (cells * aspect) ** 0.5
        for name, nx, sides, depth in (("slabs of rows, plain sweep", width, 1, 1), ("slabs of rows, 8 steps in flight", width, 1, 8),
                                       ("blocks, plain sweep", share ** 0.5, 2, 1),
                                       ("blocks, 8 steps in flight", share ** 0.5, 2, 8)):
            ny = share / nx
            halo_bytes = BYTES_A_NODE * (nx if sides == 1 else 2 * (nx + ny))  # sent a step
            # Only what leaves a node crosses the network: one of a node's slabs, the rim of its blocks.
            crossing = halo_bytes if sides == 1 else halo_bytes * CLUSTER["ranks"] ** 0.5
            ghosts = depth - 1  # rows and columns that are advanced twice
            swept = (nx + (ghosts if sides == 2 else 0), ny + ghosts)
            parts = {"work_s": self.work(*swept), "memory_s": TRAFFIC * share / depth / memory_rate,
                     "halo_s": CLUSTER["latency"] * 2 * sides / depth + crossing / CLUSTER["network"],
                     "halo_bytes_per_rank": halo_bytes}
            total = max(parts["work_s"], parts["memory_s"]) + parts["halo_s"]
            found.append({"layout": name, "cells_per_rank": share, "nodes": nodes, **parts, "step_s": total,
                          "million_cells_per_s": 1e-6 * cells / total,
                          "efficiency": self.cell * share / total, "memory_GB_per_rank": BYTES_A_NODE * share / 1e9})
        return found


def draw(bench, rows, stream, messages, halos):
    figure, (cells, two, machine) = panels(3, width=12.6)
    logarithmic(cells, "cells", "time per cell and step, fastest repetition (ns)", "one rank", percent=False)
    draw_sweeps(cells, [r for r in rows if r["ranks"] == 1])
    logarithmic(two, "cells", "time per cell and step, fastest repetition (ns)", "two ranks", percent=False)
    draw_sweeps(two, [r for r in rows if r["ranks"] == 2])
    logarithmic(machine, "size (bytes)", "rate (GB/s)", "measured of the machine", percent=False)
    for ranks in (1, 2):
        own = [r for r in stream if r["ranks"] == ranks]
        curve(machine, ranks - 1, [r["bytes"] for r in own], [2e-9 * r["bytes"] / r["seconds_low"] for r in own],
              f"update in place, each of {ranks} rank{'s' if ranks > 1 else ''}, by working set")
    curve(machine, 2, [r["bytes"] for r in messages], [1e-9 * r["bytes"] / r["seconds_low"] for r in messages],
          "message between two ranks")
    curve(machine, 3, [r["bytes"] for r in halos], [1e-9 * r["bytes"] / r["seconds_low"] for r in halos],
          "rows exchanged by two ranks, one direction")
    for axes in (cells, two, machine):
        legend(axes, 1)
    bench.draw("step-scaling", figure)


def draw_sweeps(axes, rows):
    for k, (label, chosen) in enumerate((("plain sweep", lambda r: r["in_flight"] == 1),
                                         ("several steps in flight", lambda r: r["in_flight"] > 1))):
        draw_measured(axes, k, sorted(filter(chosen, rows), key=lambda r: r["nx"] * r["ny"]), label)


def draw_measured(axes, index, rows, label):
    count = [r["nx"] * r["ny"] for r in rows]
    curve(axes, index, count, [1e9 * r["seconds_low"] / n for r, n in zip(rows, count)], f"{label}, measured", ls="")
    curve(axes, index, count, [1e9 * r["predicted"] / n for r, n in zip(rows, count)], f"{label}, predicted", marker="")
