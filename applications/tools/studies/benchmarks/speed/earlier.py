"""Whether the present programs are slower in 2D than those of an earlier commit: both in turns, ratios of processor time.

    ./run.sh benchmarks earlier --earlier DIR

DIR is the build folder of that commit with contact_dynamics and step_benchmark, made with the same options.
"""

import os
import subprocess
import sys

from common import prm
from fits import median

PAIRS = 10
# The runs of the default job, shortened, without a limit cycle that could end one of them earlier.
RUNS = {"homogeneous": ("pin/20-contact_dynamics-homogeneous.prm", {"Time/End time": 4e-4, "Snapshots/From": 3e-4, "Snapshots/To": 4e-4,
                                                                   "Observation/Blocks": 200, "Observation/Stop at limit cycle": "false"}),
        "heterogeneous": ("pin/30-contact_dynamics-heterogeneous.prm", {"Time/End time": 1e-4, "Snapshots/From": 7.5e-5, "Observation/Blocks": 50,
                                                                       "Observation/Steady from": 7.5e-5})}
STEPS = {"560 x 160, all kernels": ("1", "coarse"), "4480 x 1280, widest vectors": ("3", "fine")}


def run(bench):
    if not bench.earlier:
        print("earlier: left out, as --earlier names no build folder", file=sys.stderr)
        return
    study = bench.study("earlier")
    study.add("rve", "rve_homogenization", prm("pin/10-rve_homogenization.prm"))
    study.run()
    folders = (os.path.join(bench.earlier, "applications"), bench.programs)
    cases = {f"default job, {name}, shortened": [program(study, folder, which, name) for which, folder in enumerate(folders)] for name in RUNS}
    cases |= {f"step_benchmark, {name}": [[os.path.join(folder, "..", "tests", "step_benchmark"), *arguments] for folder in folders]
              for name, arguments in STEPS.items()}
    pairs = 2 if bench.quick else PAIRS
    rows = [compare(what, commands, pairs) for what, commands in cases.items()]
    bench.write("earlier", rows, "seconds of the processor of whole programs, of an earlier commit and the present one in turns; ratios present to earlier",
                repetitions=pairs)


def program(study, folder, which, name):
    path, settings = RUNS[name]
    settings = {**settings, "Body/RVE file": study.path("rve/rve.h5")}
    return [os.path.join(folder, "contact_dynamics"), prm(path), "--quiet", "--output", study.path(f"{name}-{('earlier', 'now')[which]}"),
            *(part for key, value in settings.items() for part in ("--set", f"{key}={value}"))]


def seconds_of(command):
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise RuntimeError(f"{command[0]} ended with status {child.returncode}")
    return usage.ru_utime + usage.ru_stime


def compare(what, commands, pairs):
    earlier, now = [], []
    for k in range(pairs):
        for which in ((0, 1), (1, 0))[k % 2]:
            (earlier, now)[which].append(seconds_of(commands[which]))
    ratios = sorted(b / a for a, b in zip(earlier, now))
    quarter = pairs // 4
    return {"what": what, "earlier_s": median(earlier), "now_s": median(now), "earlier_s_least": min(earlier), "now_s_least": min(now),
            "ratio": median(ratios), "ratio_lower_quartile": ratios[quarter], "ratio_upper_quartile": ratios[-1 - quarter], "ratio_low": ratios[0],
            "ratio_high": ratios[-1], "ratio_of_least": min(now) / min(earlier)}
