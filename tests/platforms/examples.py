"""Ten examples with the programs of one platform, dataset by dataset against the results of another one:

    examples.py PROGRAMS OUTPUT [--against OTHER]

Runs whose inputs are results of earlier ones read those of the other platform, so that its files are read here and differences do not add up.
Exit status 1 unless steps are the same bit by bit and all else within a ten-millionth of the largest number of its dataset."""

import argparse
import os
import subprocess
import sys

import numpy as np

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
EXAMPLES = os.path.join(TOP, "prm", "examples")
sys.path.append(os.path.join(TOP, "tests", "scenes"))

from comparison import content_of_h5  # noqa: E402

SOLVED = 1e-7  # what solvers and eigenvalues may differ by, over the largest number of a dataset
RVE, CONTACT, STRESS = "rve_homogenization", "contact_dynamics", "stress_localization"
BODY = {"Body/RVE file": "{inputs}/image/rve.h5"}
# Name: program, .prm, what is set, whether only time steps decide the results. Folders of results have these names.
RUNS = {
    "image": (RVE, "image/10-rve_homogenization.prm", {}, False),
    "loads": (RVE, "loads.prm", {}, False),
    "fibre_cell": (RVE, "mesh/fibre_cell.prm", {}, False),
    "two_fibres": (RVE, "voxels/two_fibres.prm", {}, False),
    "pad": (RVE, "voxels/pad/10-rve_homogenization.prm", {}, False),
    "modal": (CONTACT, "modal.prm", {}, False),
    "cylinder_static": (CONTACT, "mesh/cylinder_static.prm", {}, False),
    "homogeneous": (CONTACT, "image/20-contact_dynamics-homogeneous.prm", BODY, True),
    "heterogeneous": (CONTACT, "image/30-contact_dynamics-heterogeneous.prm", BODY, True),
    "onset": (CONTACT, "contact_map_onset.prm", {"Time/End time": 1e-4}, True),
    "chamfered_pin": (CONTACT, "mesh/chamfered_pin.prm", {}, True),
    "pad_slides": (CONTACT, "voxels/pad/20-contact_dynamics-homogeneous.prm",
                   {"Body/RVE file": "{inputs}/pad/rve.h5", "Time/End time": 5e-6, "Snapshots/From": 0, "Snapshots/Interval": 1e-6}, True),
    "stresses": (STRESS, "image/40-stress_localization.prm",
                 {"Input/RVE file": "{inputs}/image/rve.h5", "Input/Homogeneous run": "{inputs}/homogeneous/dynamics.h5",
                  "Input/Direct run": "{inputs}/heterogeneous/dynamics.h5"}, False),
}


def run(programs, output, inputs):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    for name, (program, prm, settings, _) in RUNS.items():
        words = [f"--set={key}={str(value).format(inputs=inputs)}" for key, value in settings.items()]
        subprocess.run([os.path.join(programs, program), os.path.join(EXAMPLES, prm), "--quiet", "--output", os.path.join(output, name), *words],
                       env=environment, check=True)


def difference(here, there):
    """Largest difference over the largest number; shapes of modes may point the other way."""
    if here.shape != there.shape:
        return np.inf
    if not np.issubdtype(here.dtype, np.number):
        return 0.0 if np.array_equal(here, there) else np.inf
    if here.size == 0 or np.array_equal(here, there, equal_nan=here.dtype.kind in "fc"):
        return 0.0
    turned = [here - there, here + there] if here.ndim > 2 else [here - there]
    return min(float(np.max(np.abs(d))) for d in turned) / max(float(np.max(np.abs(there))), 1e-300)


def compare(output, other):
    """A line for each example; whether all agree."""
    agree = True
    for name, (*_, explicit) in RUNS.items():
        worst, where, n = 0.0, "", 0
        for file in sorted(f for f in os.listdir(os.path.join(other, name)) if f.endswith(".h5")):
            here, there = (content_of_h5(os.path.join(folder, name, file)) for folder in (output, other))
            # The summary has times.
            for key in sorted(key for key in {*here, *there} if "@" not in key and key != "/summary"):
                found = difference(here[key], there[key]) if key in here and key in there else np.inf
                n += 1
                if not found <= worst:
                    worst, where = found, f"{file}{key}"
        good = worst == 0 if explicit else worst <= SOLVED
        agree = agree and good and n > 0
        print(f"{name}: {n} datasets, {'bit by bit' if worst == 0 else f'within {worst:.1g} ({where})'}{'' if good else ': DIFFERENT'}", flush=True)
    return agree


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs")
    parser.add_argument("output")
    parser.add_argument("--against", metavar="OTHER", help="results of another platform")
    arguments = parser.parse_args()
    run(arguments.programs, arguments.output, os.path.abspath(arguments.against or arguments.output))
    if arguments.against and not compare(arguments.output, arguments.against):
        raise SystemExit(1)


if __name__ == "__main__":
    main()
