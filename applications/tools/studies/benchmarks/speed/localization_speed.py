"""Localization against the memory: averaging beside copying in the same run, reading, peak memory against snapshots."""

from common import add_repeated, prm, require_ended
from fits import spread

PIN = (560, 160)
COPY = [2 ** 20, 2 ** 23, 2 ** 28]  # bytes of each of the two arrays
# What passes through the memory for each cell and snapshot if no cache helps: sums of three stresses, their squares and the von Mises
# stress, read and written, and a displacement, read.
TRAFFIC = {ratio: 2 * 7 * 8 + 2 * 8 / ratio ** 2 for ratio in (1, 2)}  # bytes
INTERVAL, FIRST = 2.5e-6, 0.0  # s, of the snapshots
REPETITIONS = 7


def run(bench):
    study = bench.study("localization_speed")
    study.jobs = 1  # times count
    study.add("rve", "rve_homogenization", prm("pin/10-rve_homogenization.prm"))
    counts = [20] if bench.quick else [20, 100]
    cases = [(ratio, count) for ratio in (1, 2) for count in counts]
    for ratio in (1, 2):
        study.add(f"run-{ratio}", "contact_dynamics", prm("pin/20-contact_dynamics-homogeneous.prm"), {
            "Body/RVE file": "{rve}/rve.h5", "Body/Cells": [n // ratio for n in PIN], "Time/End time": INTERVAL * (counts[-1] + 1),
            "Observation/Steady from": "auto", "Snapshots/From": FIRST, "Snapshots/To": "auto", "Snapshots/Interval": INTERVAL})
    for ratio, count in cases:
        for fields, settings in (("all fields", {}), ("probes only", {"Localization/Fields": ""})):
            add_repeated(study, name_of(ratio, count, fields), REPETITIONS, "stress_localization", prm("pin/40-stress_localization.prm"), {
                "Input/RVE file": "{rve}/rve.h5", "Input/Homogeneous run": "{run-%d}/dynamics.h5" % ratio, "Input/Direct run": "",
                "Window/From": FIRST, "Window/To": INTERVAL * (count - 0.5), **settings})
    results = study.run()
    require_ended(results)
    copies = bench.tool("scaling_benchmark", "copy", *COPY)
    rows = [row_of(results, ratio, count, fields, copies[-1]) for ratio, count in cases for fields in ("all fields", "probes only")]
    bench.write("localization-speed", rows, f"{PIN[0]} x {PIN[1]} cells; macroscopic grid coarser by ratio; averaging_GB_per_s: bytes a "
                f"cell and snapshot ({TRAFFIC[1]:g}, with ratio 2 {TRAFFIC[2]:g}) over the time to average; part_of_copy: of copying 256 MB, both "
                "ways counted",
                repetitions=REPETITIONS)
    for row in copies:
        row["GB_per_s"] = 2e-9 * row["bytes"] / row["seconds"]
    bench.write("copy", copies, "memcpy from one array of that size to another, seconds; GB_per_s: read and written", repetitions=41)


def name_of(ratio, count, fields):
    return f"{fields.split()[0]}-{ratio}-{count}"


def row_of(results, ratio, count, fields, copy):
    runs = [results[f"{name_of(ratio, count, fields)}.{k + 1}"] for k in range(REPETITIONS)]
    row = {"ratio": ratio, "fields": fields, "snapshots": count}
    for column, values in (("program_s", [run.summary["seconds"]["total"] for run in runs]),
                           ("cpu_s", [run.cpu_seconds for run in runs]),
                           ("waiting_s", [part(run, "Waiting for snapshots") for run in runs]),
                           ("averaging_s", [part(run, "Averaging") for run in runs])):
        row.update(spread(column, values))
    averaged = fields == "all fields"
    rate = TRAFFIC[ratio] * PIN[0] * PIN[1] * count / row["averaging_s"] if averaged else 0.0
    row["ms_a_snapshot"] = 1e3 * row["averaging_s"] / count
    row["averaging_GB_per_s"] = 1e-9 * rate
    row["part_of_copy"] = rate / (2 * copy["bytes"] / copy["seconds"])
    row["peak_memory_MB"] = 1e-6 * runs[0].summary["peak_memory_bytes"]
    return row


def part(run, name):
    return run.summary["seconds"].get("Localization/" + name, 0.0)
