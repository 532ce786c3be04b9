"""What each shortcut saves: CPU seconds of one scene with and without it, in turns, and how far the answers are apart."""

import os
import subprocess
import sys

import shortcuts
from common import TOP, cpu_seconds, prm, require_ended
from fits import median

REPETITIONS = 3


def run(bench):
    study = bench.study("skips")
    study.jobs = 1  # times count
    shortcuts.add_needs(study, small=bench.quick)
    cases = shortcuts.shortcuts()
    for turn in range(REPETITIONS):
        for k, shortcut in enumerate(cases):
            for which in ("short", "full"):
                shortcuts.add(study, shortcut, which, f"{which}-{k}.{turn + 1}", bench.quick)
    results = study.run()
    require_ended(results)
    rows = [row_of(shortcut, k, results) for k, shortcut in enumerate(cases)] + reuse(bench)
    bench.write("skips", rows, "CPU seconds of whole programs with a shortcut and without; saved: share of the time without; difference: "
                "relative, of the answers; differs_at_most: what is promised", repetitions=REPETITIONS)


def row_of(shortcut, k, results):
    runs = {which: [results[f"{which}-{k}.{turn + 1}"] for turn in range(REPETITIONS)] for which in ("short", "full")}
    answers = [runs[which][0].summary for which in ("short", "full")]
    return timed(shortcut.name, shortcut.scene, *([run.cpu_seconds for run in runs[which]] for which in ("short", "full")),
                 shortcuts.difference(shortcut, *answers), shortcuts.promise(shortcut, *answers))


def timed(name, scene, short, full, found, tolerance):
    row = {"shortcut": name, "scene": scene}
    for which, seconds in (("short", short), ("full", full)):
        row.update({which + "_s": median(seconds), which + "_low": min(seconds), which + "_high": max(seconds)})
    row["ratio"] = row["full_s"] / row["short_s"]
    row["saved"] = 1 - row["short_s"] / row["full_s"]
    row["difference"], row["differs_at_most"] = found, tolerance
    return row


def reuse(bench):
    """rve.h5 and the steps of a chain, made and found up to date."""
    rve = [os.path.join(bench.programs, "rve_homogenization"), prm(shortcuts.RVE), "--quiet", "--output", os.path.join(bench.runs, "reused")]
    chain = [sys.executable, os.path.join(TOP, "applications", "tools", "run_chain.py"), prm("examples/image"), "--programs", bench.programs,
             "--no-report", "--output", os.path.join(bench.runs, "chain")]
    rows = []
    for name, scene, command, again in (("rve.h5 reused", "the pin's, KUBC and SUBC", rve, ["--set", "Homogenization/Reuse=false"]),
                                        ("steps up to date", "./run.sh prm/examples/image, no report", chain, None)):
        made, found = [], []
        for _ in range(REPETITIONS):
            if again is None:
                subprocess.run(["rm", "-rf", chain[-1]], check=True)
            made.append(cpu_seconds(command + (again or [])))
            if again is not None:
                cpu_seconds(command)
            found.append(cpu_seconds(command))
        rows.append(timed(name, scene, found, made, 0.0, 0.0))
    return rows
