"""The whole chain at a small size: against reference numbers, a second time, and after a result was changed.

    chain.py <folder with the programs> [--update]
"""

import json
import os
import sys
import tempfile

import h5py

from scenes import TOP, Folder, run_chain

CHAIN = os.path.join(TOP, "tests", "system", "chains", "reference")
REFERENCE = os.path.join(CHAIN, "reference.json")

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


def summaries(folder):
    whole = {name: Folder(folder).summary(name) for name in KEYS}
    return {name: {key: whole[name][key] for key in keys} for name, keys in KEYS.items()}


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


def one_line_a_key(found):
    """JSON with a line for each key of each summary."""
    return "{\n" + ",\n".join(f' "{name}": {{\n' + ",\n".join(f'  "{key}": {json.dumps(value, sort_keys=True)}' for key, value in values.items())
                              + "}" for name, values in found.items()) + "\n}\n"


def main():
    with tempfile.TemporaryDirectory() as folder:
        run_chain(CHAIN, "--output", folder, "--jobs", "2")
        found = summaries(folder)
        if "--update" in sys.argv:
            with open(REFERENCE, "w", encoding="utf-8") as file:
                file.write(one_line_a_key(found))
            return
        assert os.path.getsize(os.path.join(folder, "report.html")) > 100000, "the report is empty"
        with open(REFERENCE, encoding="utf-8") as file:
            wrong = differences(json.load(file), found, 1e-6)
        assert not wrong, "\n".join(["differs from reference.json (chain.py --update renews it):"] + wrong)

        again = run_chain(CHAIN, "--output", folder, "--jobs", "2", "--no-report")
        assert again.count("up to date") == len(KEYS), again

        # A result that was changed, or of which one bit has flipped, is made again.
        path = os.path.join(folder, "10-rve_homogenization", "rve.h5")
        before = Folder(folder).read(path)
        with h5py.File(path, "r+") as file:
            file["stiffness/effective"][0, 0] *= 2
        again = run_chain(CHAIN, "--output", folder, "--jobs", "2", "--no-report")
        assert again.count("up to date") == len(KEYS) - 1 and "10-rve_homogenization: done" in again, again
        assert Folder(folder).read(path) == before, "rve.h5 was not made again"


if __name__ == "__main__":
    main()
