"""The paper's pin, whole program with all its observers but snapshots: on one rank, on two, and twice on one rank side by side,
which is the bound as it shares caches and memory without having to talk."""

from common import prm, require_ended
from fits import spread

PIN = (560, 160)
MATERIALS = {"homogeneous": "pin/20-contact_dynamics-homogeneous.prm", "every fibre": "pin/30-contact_dynamics-heterogeneous.prm"}
LAYOUTS = {"one rank": (1, 1), "two ranks": (2, 1), "side by side": (1, 2)}  # ranks of a program, programs at once
END_TIME = 1e-4  # s
REPETITIONS = 5


def run(bench):
    study = bench.study("two_ranks")
    study.add("rve", "rve_homogenization", prm("pin/10-rve_homogenization.prm"))
    require_ended(study.run())
    end_time = END_TIME / 10 if bench.quick else END_TIME
    turns = range(2 if bench.quick else REPETITIONS)
    rates = {(material, layout): [] for material in MATERIALS for layout in LAYOUTS}
    for turn in turns:
        for material, layout in rates:
            rates[material, layout].append(rate(study, material, layout, turn, end_time))
    rows = [row_of(material, layout, rates) for material, layout in rates]
    bench.write("two-ranks", rows, f"the pin on {PIN[0]} x {PIN[1]} cells with contact, platen, energies, histories and probes, no snapshots, "
                f"first {end_time:g} s: million cell updates a second, of both programs together when side by side; ratio: to one rank in "
                "the same turn", ranks="1 and 2", repetitions=len(turns))


def rate(study, material, layout, turn, end_time):
    """Million cell updates a second of the time loop; the programs of a layout run at once, nothing beside them."""
    ranks, study.jobs = LAYOUTS[layout]
    names = [f"{material}-{layout}-{turn + 1}.{k + 1}".replace(" ", "_") for k in range(study.jobs)]
    for name in names:
        study.add(name, "contact_dynamics", prm(MATERIALS[material]), {
            "Body/RVE file": "{rve}/rve.h5", "Body/Cells": PIN, "Time/End time": end_time, "Observation/Steady from": "auto",
            "Observation/Stop at limit cycle": False, "Snapshots/From": 0.0, "Snapshots/To": "auto", "Snapshots/Interval": 0}, ranks=ranks)
    results = study.run()
    require_ended(results)
    return sum(1e-6 * results[name].summary["cell_updates_per_second"] for name in names)


def row_of(material, layout, rates):
    ratios = [found / one for found, one in zip(rates[material, layout], rates[material, "one rank"])]
    return {"material": material, "layout": layout, **spread("million_cells_per_s", rates[material, layout]), **spread("ratio", ratios)}
