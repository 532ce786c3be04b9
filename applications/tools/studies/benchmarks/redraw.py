"""All diagrams once more, from the tables beside them: nothing is measured."""

import os

import brick_step
import fitted
import localization
import mesh_statics
import mesh_step
import model_problem
import pin
import pin_diagrams
import slab
import static_scaling
import statics
import step_scaling
import stiffness
import voxel_cost
import voxel_ranks
import voxel_stiffness
from common import read_csv


def pictures(bench):
    def rows(name):
        return read_csv(os.path.join(bench.pictures, name + ".csv"))[0]

    for name in model_problem.SHOWN:
        model_problem.draw(bench, name, rows(name))
    stiffness.draw(bench, rows("stiffness"), rows("stiffness-tolerance"))
    kinds = rows("localization")
    localization.draw(bench, kinds, list(dict.fromkeys(row["kind"] for row in kinds)))
    step_scaling.draw(bench, *(rows(name) for name in ("step-scaling", "stream", "messages", "halos")))
    for module, name in ((brick_step, "brick-step"), (fitted, "fitted"), (mesh_statics, "mesh-statics"), (mesh_step, "mesh-step"),
                         (static_scaling, "static-scaling"), (statics, "statics"), (voxel_stiffness, "voxel-stiffness")):
        module.draw(bench, rows(name))
    limit, = rows("slab-limit")
    slab.draw(bench, rows("slab"), 100 * limit["standard_error"] / limit["value"])
    voxel_cost.draw(bench, rows("voxel-step-cost"), rows("voxel-static-cost"))
    voxel_ranks.draw(bench, *(rows(f"voxel-{name}") for name in ("step-ranks", "static-ranks", "step-1000-ranks", "static-1000-ranks")))
    pin_diagrams.errors(bench, rows("pin"))
    pin_diagrams.homogenization(bench, rows("pin"))
    if os.path.exists(os.path.join(bench.pictures, pin.HISTORY + ".csv")):
        pin_diagrams.history(bench, pin.kept_history(rows(pin.HISTORY)))
