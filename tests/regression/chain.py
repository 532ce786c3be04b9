"""The whole chain at a small size: against reference numbers, a second time, and on two ranks.

    chain.py <folder with the programs> [--update]
"""

import json
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
REFERENCE = os.path.join(HERE, "chain", "reference.json")
RUNNER = os.path.join(HERE, "..", "..", "applications", "tools", "run_chain.py")

# Numbers of summary.json that are compared; regression values, not truths.
KEYS = {
    "10-rve_homogenization": ["phases", "stiffness", "bounds", "engineering_constants"],
    "20-contact_dynamics-homogeneous": ["steps", "critical_time_step", "friction_energy", "slip_fraction",
                                        "stick_fraction", "separation_fraction", "reference_node"],
    "30-contact_dynamics-heterogeneous": ["steps", "critical_time_step", "friction_energy", "slip_fraction",
                                          "stick_fraction", "separation_fraction", "reference_node"],
    "40-stress_localization": ["probes", "field_errors"],
}


# Of no dimension and zero but for rounding: another compiler rounds otherwise.
ZERO = {"non_orthotropy": 1e-12}


def run_chain(programs, output, ranks=1):
    command = [sys.executable, "-B", RUNNER, os.path.join(HERE, "chain"), "--programs", programs, "--output", output,
               "--ranks", str(ranks), "--jobs", "1" if ranks > 1 else "2"]
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    return done.stdout


def summaries(folder):
    found = {}
    for name, keys in KEYS.items():
        with open(os.path.join(folder, name, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
        found[name] = {key: summary[key] for key in keys}
    return found


def differences(a, b, tolerance, path=""):
    """Paths at which two JSON values differ by more than the relative tolerance."""
    if isinstance(a, dict):
        if not isinstance(b, dict) or a.keys() != b.keys():
            return [f"{path}: other keys"]
        return [d for key in a for d in differences(a[key], b[key], tolerance, f"{path}/{key}")]
    if isinstance(a, list):
        if not isinstance(b, list) or len(a) != len(b):
            return [f"{path}: other length"]
        scale = max([abs(x) for x in a if isinstance(x, float)] + [0.0])
        return [d for k, (x, y) in enumerate(zip(a, b))
                for d in ([] if isinstance(x, float) and isinstance(y, float) and abs(x - y) <= 1e-9 * scale
                          else differences(x, y, tolerance, f"{path}/{k}"))]
    if isinstance(a, float) and isinstance(b, (float, int)):
        rounding = ZERO.get(path.rsplit("/", 1)[-1], 0.0)
        return [] if abs(a - b) <= max(tolerance * max(abs(a), abs(b)), rounding) else [f"{path}: {a} and {b}"]
    return [] if a == b else [f"{path}: {a} and {b}"]


def compare_files(one, two, tolerance):
    """Largest difference between the datasets of two HDF5 files, relative to each one's largest value."""
    worst = []
    with h5py.File(one) as a, h5py.File(two) as b:
        def visit(name, dataset):
            if not isinstance(dataset, h5py.Dataset) or dataset.dtype.kind not in "fiu":
                return
            x, y = dataset[...].astype(float), b[name][...].astype(float)
            assert x.shape == y.shape, f"{name}: {x.shape} and {y.shape}"
            scale = np.abs(x).max() if x.size else 0.0
            if scale > 0 and not np.abs(x - y).max() <= tolerance * scale:
                worst.append(f"{os.path.basename(one)} {name}: {np.abs(x - y).max() / scale:.2e}")
        a.visititems(visit)
    return worst


def main():
    programs = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        serial, parallel = os.path.join(folder, "one"), os.path.join(folder, "two")
        run_chain(programs, serial)
        found = summaries(serial)
        if "--update" in sys.argv:
            with open(REFERENCE, "w", encoding="utf-8") as file:
                json.dump(found, file, indent=1, sort_keys=True)
                file.write("\n")
            return
        assert os.path.getsize(os.path.join(serial, "report.html")) > 100000, "the report is empty"
        with open(REFERENCE, encoding="utf-8") as file:
            wrong = differences(json.load(file), found, 1e-6)
        assert not wrong, "\n".join(["differs from reference.json (chain.py --update renews it):"] + wrong)

        again = run_chain(programs, serial)
        assert again.count("up to date") == len(KEYS), again

        # A result that was changed, or of which one bit has flipped, is made again.
        path = os.path.join(serial, "10-rve_homogenization", "rve.h5")
        with open(path, "rb") as file:
            before = file.read()
        with h5py.File(path, "r+") as file:
            file["stiffness/effective"][0, 0] *= 2
        again = run_chain(programs, serial)
        assert again.count("up to date") == len(KEYS) - 1 and "10-rve_homogenization: done" in again, again
        with open(path, "rb") as file:
            assert file.read() == before, "rve.h5 was not made again"

        # What determines nothing is no reason to compute again, what does is one.
        run_chain(programs, parallel, ranks=2)
        wrong = differences(found, summaries(parallel), 1e-8)
        wrong += compare_files(os.path.join(serial, "10-rve_homogenization", "rve.h5"),
                               os.path.join(parallel, "10-rve_homogenization", "rve.h5"), 1e-8)
        for name in list(KEYS)[1:3]:
            wrong += compare_files(os.path.join(serial, name, "dynamics.h5"),
                                   os.path.join(parallel, name, "dynamics.h5"), 1e-8)
        assert not wrong, "\n".join(["one and two ranks differ:"] + wrong)


if __name__ == "__main__":
    main()
