"""Run time against error, and scaling: runs the studies and redraws the diagrams of doc/performance/.

    ./run.sh benchmarks [part...] [--quick]

Every diagram has a CSV beside it, which names machine, compiler, instruction set, ranks and repetitions. Costs are
CPU seconds (user and system) of whole programs or of the time loop, as the headings say. The part `pictures` only redraws
the diagrams from the CSV.
"""

import importlib
import os
import sys

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
TESTS = os.path.join(HERE, "..", "..", "..", "..", "tests")
sys.path[:0] = [HERE, *(os.path.join(HERE, folder) for folder in ("accuracy", "speed")), os.path.join(TESTS, "scenes"), os.path.join(TESTS, "verification")]

from common import TOP, Bench  # noqa: E402
from study import parse_arguments  # noqa: E402

# Part: its module, in which it is a function of that name or `run`.
PARTS = {**dict.fromkeys(("modes", "bar", "sliding_growth", "oblique_growth"), "model_problem"), **{name: name for name in (
    "stiffness", "localization", "pin", "step_scaling", "static_scaling", "statics", "mesh_statics", "mesh_memory", "mesh_step", "brick_step", "fitted", "localization_speed", "skips", "two_ranks", "busy_cores",
    "voxel_stiffness", "slab", "voxel_cost", "voxel_ranks", "precision", "many_pins", "earlier")}}
ON_REQUEST = {"pictures": "redraw", "fans": "fans"}


def main():
    def options(parser):
        parser.add_argument("--quick", action="store_true",
                            help="small cases only; the diagrams go beside the runs instead of to doc/performance")
        parser.add_argument("--earlier", metavar="DIR", help="part earlier: the build folder of an earlier commit")
        parser.add_argument("--fans", metavar="FILE", default="", help="part fans: the program FANS, which is built apart")

    arguments = parse_arguments(__doc__, "benchmarks", list(PARTS), options, tuple(ON_REQUEST))
    runs = os.path.join(arguments.output, "quick") if arguments.quick else arguments.output
    pictures = os.path.join(runs, "diagrams") if arguments.quick else os.path.join(TOP, "doc", "performance")
    bench = Bench(runs, arguments.programs, pictures, arguments.jobs, arguments.keep, arguments.quick, arguments.earlier, arguments.fans)
    for part in arguments.parts:
        print(f"{part}", file=sys.stderr, flush=True)
        module = importlib.import_module({**PARTS, **ON_REQUEST}[part])
        getattr(module, part, getattr(module, "run", None))(bench)
    print(f"diagrams in {os.path.relpath(pictures)}")


if __name__ == "__main__":
    main()
