"""The whole chain at a small size: against reference numbers, a second time, and after a result was changed.

    chain.py <folder with the programs> [--update]
"""

import os
import tempfile

import h5py

from scenes import TOP, Folder, run_chain
from stored import check_stored

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


def summaries(folder):
    whole = {name: Folder(folder).summary(name) for name in KEYS}
    return {name: {key: whole[name][key] for key in keys} for name, keys in KEYS.items()}


def main():
    with tempfile.TemporaryDirectory() as folder:
        run_chain(CHAIN, "--output", folder, "--jobs", "2")
        assert os.path.getsize(os.path.join(folder, "report.html")) > 100000, "the report is empty"
        check_stored(REFERENCE, summaries(folder), 1e-6)

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
