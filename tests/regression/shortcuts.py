"""Shortcuts change no answer: each with and without, on small grids.

    shortcuts.py <folder with the programs>
"""

import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(HERE, "..", "benchmarks"))

import shortcuts as benchmark  # noqa: E402
from common import Study  # noqa: E402


def check_reused(results, study):
    """A second run finds rve.h5 up to date and says the same."""
    path = os.path.join(study.folder, "rve", "rve.h5")
    before, written = results["rve"].summary, os.stat(path).st_mtime_ns
    os.remove(os.path.join(study.folder, "rve", ".study.json"))
    again = study.run()["rve"].summary
    assert os.stat(path).st_mtime_ns == written, "rve.h5 was made again"
    assert again["stiffness"] == before["stiffness"], "the reused stiffness differs"


def main():
    with tempfile.TemporaryDirectory() as folder:
        study = Study(folder, sys.argv[1])
        benchmark.add_needs(study, small=True)
        cases = [s for s in benchmark.shortcuts() if s.tested]
        for k, shortcut in enumerate(cases):
            for which in ("short", "full"):
                benchmark.add(study, shortcut, which, f"{which}-{k}", small=True)
        results = study.run()
        failed = [f"{name}: {result.message}" for name, result in results.items() if result.status != 0]
        assert not failed, "\n".join(failed)
        wrong = []
        for k, shortcut in enumerate(cases):
            found = benchmark.difference(shortcut, results[f"short-{k}"].summary, results[f"full-{k}"].summary)
            print(f"{shortcut.name}: {found:.1e}")
            if not found <= shortcut.tolerance:
                wrong.append(f"{shortcut.name}: {found:.2e} instead of at most {shortcut.tolerance:.0e}")
        assert not wrong, "\n".join(wrong)
        check_reused(results, study)


if __name__ == "__main__":
    main()
