"""Every result of every program on one rank and on several: the same, or as near as the table says and why.

    ranks.py <folder with the programs> [--only PART] [--folder DIR]
"""

import argparse
import os
import shutil
import tempfile

import h5py
import numpy as np

from comparison import Comparison
from rank_scenes import ENSEMBLE_RANKS, FILES, RUNS
from scenes import PROGRAMS, Folder
from served_study import ServedStudy

# What tells of a process and not of the body; and the state of each rank, which resume.py looks at.
SKIPPED_FILES = r"\.study.*|\.lock|contact_dynamics\.checkpoint"
SKIPPED_VALUES = r"(summary\.json:|rve\.h5:/summary:)(ranks$|seconds(/|$)|peak_memory_bytes$|cell_updates_per_second$)"
SKIPPED_LINES = r"^\w+ [\d.]+, \d+ process(es)?, |^done in |^This analysis runs on one process, all others repeat it"
# What tells of the solver.
SOLVER_FILES = r"|log\.txt|.*\.prm"
SOLVER_VALUES = r"|iterations|residual|digest|friction_change|imbalance"


def comparison(tolerances, other_solver=False):
    return Comparison(SKIPPED_FILES + SOLVER_FILES * other_solver, SKIPPED_VALUES + SOLVER_VALUES * other_solver, SKIPPED_LINES,
                      tolerances)


def run_all(folder, runs):
    """Each run on one rank first: the others may need its results."""
    study = ServedStudy(os.path.join(folder, "runs"), PROGRAMS)
    scene = Folder(folder, {run.name: run.text for run in runs})
    for name, text in FILES.items():
        scene.write(name, text)
    for run in runs:
        settings = {key: value.replace("<files>", folder) if isinstance(value, str) else value
                    for key, value in run.settings.items()}
        for ranks in (1, *run.ranks):
            study.add(f"{run.name}-{ranks}", run.program, scene(run.name + ".prm"), settings, ranks)
    results, failed = study.run(), []
    for run in runs:
        for ranks in (1, *run.ranks):
            result = results.get(f"{run.name}-{ranks}")
            if not result or result.status != 0 or result.summary["ranks"] != ranks:
                failed.append(f"{run.name} on {ranks} ranks: {result.message if result else 'not run'}")
    assert not failed, "\n" + "\n".join(failed)
    return study.path


def compare_all(runs, path):
    problems = []
    for run in runs:
        same, one = comparison(run.tolerances, bool(run.reference)), path(f"{run.reference or run.name}-1")
        for ranks in (1,) * bool(run.reference) + run.ranks:
            problems += [f"{run.name} on {ranks} ranks: {said}" for said in same.differences(one, path(f"{run.name}-{ranks}"))]
        if run.ranks:
            print(f"{run.name}: {same.n_compared} values, lists and lines on {list(run.ranks)} ranks")
        assert same.n_compared >= 50 * len(run.ranks), run.name
    return problems


def check_that_differences_are_seen(folder, one):
    """A number in a dataset, an attribute, a summary, a table; a line; a file less, and one of a new kind."""
    def in_dataset(other):
        with h5py.File(os.path.join(other, "rve.h5"), "r+") as file:
            file["/stiffness/effective"][1, 1] *= 1 + 1e-15

    def in_attribute(other):
        with h5py.File(os.path.join(other, "rve.h5"), "r+") as file:
            file["/grid"].attrs["spacing"] = [1e-4, 1.0000001e-4]

    def in_text(name, old, new):
        def change(other):
            text = Folder(other).read(name).decode()
            assert old in text, (name, old)
            Folder(other).write(name, text.replace(old, new, 1))
        return change

    changes = [in_dataset, in_attribute, lambda other: Folder(other).write("new.bin", "1"), in_text("summary.json", '"members": 4', '"members": 5'),
               in_text("summary.json", '"members"', '"member"'), in_text("ensemble.csv", "KUBC,D11,", "KUBC,D11,1"),
               in_text("log.txt", "effective  ", "effective 1"), in_text("rve.xdmf", "rve.h5", "rve.h6"),
               lambda other: os.remove(os.path.join(other, "stiffness.csv"))]
    for k, change in enumerate(changes):
        other = os.path.join(folder, f"changed-{k}")
        shutil.copytree(one, other)
        change(other)
        assert comparison(()).differences(one, other), f"change {k} was not seen"


def check_effective(path):
    """The stiffness of the composite is the mean over the members of the conditions that it is to stand for."""
    for effective, conditions in (("KUBC", ["KUBC"]), ("SUBC", ["SUBC"]), ("PBC", ["PBC"]), ("mean", ["KUBC", "SUBC"])):
        for ranks in (1, *ENSEMBLE_RANKS[effective]):
            summary = Folder(path(f"ensemble-{effective}-{ranks}")).summary()
            expected = sum(np.array(summary["ensemble"][name]["mean"]) for name in conditions) / len(conditions)
            expected[[0, 1, 2, 2], [2, 2, 0, 1]] = 0.0  # Effective symmetry = orthotropic
            found = np.array(summary["stiffness"]["effective"])
            assert np.allclose(found, expected, rtol=1e-12, atol=0), (effective, ranks, found / expected)


def check_reuse(path):
    """What one rank made is up to date on three, and the other way round."""
    for made_by, ranks in ((1, 3), (3, 1)):
        folder = path(f"ensemble-KUBC-{made_by}")
        before = os.stat(os.path.join(folder, "rve.h5")).st_mtime_ns
        said = Folder(folder).run(0, "rve_homogenization", "parameters.prm", "--output", folder, ranks=ranks)
        assert "rve.h5 is up to date" in said, said
        assert os.stat(os.path.join(folder, "rve.h5")).st_mtime_ns == before, "rve.h5 was written again"


def check_too_many_ranks(path):
    """13 rows of nodes allow 6 ranks: a sentence before anything is touched, the same with --validate."""
    with tempfile.TemporaryDirectory() as folder:
        prm = os.path.join(path("homogeneous-platen-1"), "parameters.prm")
        for options in ([], ["--validate"]):
            status, _, err = Folder(folder).end("contact_dynamics", prm, "--output", "run", *options, ranks=7)
            said = [line for line in err.splitlines() if line.startswith("contact_dynamics: ")]
            assert status == 2 and len(said) == 1, (options, status, err)
            assert "13 rows of nodes" in said[0] and "at most 6" in said[0] and "instead of 7" in said[0], said
            assert os.listdir(folder) == [], os.listdir(folder)
        Folder(folder).run(0, "contact_dynamics", prm, "--output", "run", "--validate", ranks=6)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs")
    parser.add_argument("--only", default="", metavar="PART", help="runs with this in their names, and what they need")
    parser.add_argument("--folder", help="keep the runs there")
    arguments = parser.parse_args()
    needed = {need for run in RUNS if arguments.only in run.name for need in run.needs}
    needed |= {need for run in RUNS if run.name in needed for need in run.needs}
    runs = [run for run in RUNS if arguments.only in run.name or run.name in needed]
    with tempfile.TemporaryDirectory() as temporary:
        folder = os.path.abspath(arguments.folder or temporary)
        os.makedirs(folder, exist_ok=True)
        path = run_all(folder, runs)
        problems = compare_all(runs, path)
        assert not problems, "\n" + "\n".join(problems)
        if not arguments.only:
            check_that_differences_are_seen(temporary, path("ensemble-KUBC-1"))
            check_effective(path)
            check_reuse(path)
            check_too_many_ranks(path)


if __name__ == "__main__":
    main()
