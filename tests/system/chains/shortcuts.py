"""Shortcuts change no answer: each with and without, on small grids."""

import os
import sys
import tempfile

import h5py
import numpy as np

from scenes import TOP

sys.path[:0] = [os.path.join(TOP, "applications", "tools", "studies", "benchmarks", *folder) for folder in ((), ("speed",))]

import shortcuts as benchmark  # noqa: E402
from common import Study  # noqa: E402


LENGTH = 0.056  # m; of the contact


def check_reused(results, study):
    """A second run finds rve.h5 up to date and says the same."""
    path = os.path.join(study.folder, "rve", "rve.h5")
    before, written = results["rve"].summary, os.stat(path).st_mtime_ns
    os.remove(os.path.join(study.folder, "rve", ".study.json"))
    again = study.run()["rve"].summary
    assert os.stat(path).st_mtime_ns == written, "rve.h5 was made again"
    assert again["stiffness"] == before["stiffness"], "the reused stiffness differs"


def check_cycle(stopped, on):
    """Up to its end the run that stops has the histories of the one that goes on, and its mu_inter is theirs, eq. (9)."""
    histories = []
    for result in (stopped, on):
        with h5py.File(os.path.join(result.folder, "dynamics.h5")) as file:
            histories.append({name: values[:] for name, values in file["history"].items()})
    short, full = histories
    n, facts = len(short["time"]), stopped.summary
    assert 100 < n < len(full["time"]) and facts["limit_cycle_reached"], "the run did not stop at a limit cycle"
    for name, values in short.items():
        assert np.array_equal(values, full[name][:n]), f"{name} is another one in the run that stops"
    time = full["time"][:n]
    chosen = (time >= facts["window_begin"]) & (time <= facts["window_end"])
    power = np.polyfit(time[chosen], full["friction_energy"][:n][chosen], 1)[0]
    found = power / (facts["pressure"] * LENGTH * facts["flat_velocity"])
    expected = facts["global_interface_friction_coefficient"]
    # The program's own samples are denser than those of the histories: ends of the window differ by less than an interval.
    assert abs(found / expected - 1) < 1e-5, f"mu_inter of the window is {found}, of the run that stops {expected}"


def main():
    with tempfile.TemporaryDirectory() as folder:
        study = Study(folder, sys.argv[1])
        benchmark.add_needs(study, small=True)
        cases = benchmark.shortcuts()
        for k, shortcut in enumerate(cases):
            for which in ("short", "full"):
                benchmark.add(study, shortcut, which, f"{which}-{k}", small=True)
        results = study.run()
        failed = [f"{name}: {result.message}" for name, result in results.items() if result.status != 0]
        assert not failed, "\n".join(failed)
        wrong = []
        for k, shortcut in enumerate(cases):
            pair = [results[f"{which}-{k}"] for which in ("short", "full")]
            answers = [result.summary for result in pair]
            found, most = benchmark.difference(shortcut, *answers), benchmark.promise(shortcut, *answers)
            print(f"{shortcut.name}: {found:.1e}, at most {most:.1e}")
            if not found <= most:
                wrong.append(f"{shortcut.name}: {found:.2e} instead of at most {most:.2e}")
            if shortcut.name == benchmark.STOP:
                check_cycle(*pair)
        assert not wrong, "\n".join(wrong)
        check_reused(results, study)


if __name__ == "__main__":
    main()
