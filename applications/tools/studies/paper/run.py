#!/usr/bin/env python3
"""The paper's tables and figures beside ours: runs prm/paper in many settings, side by side and resumable, and
writes doc/paper/README.md with its pictures. With parts named only these are run and renewed."""

import dataclasses
import os
import sys
from functools import partial
from typing import Callable

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.dirname(HERE), os.path.join(HERE, "..", "..")]

import contact_stress  # noqa: E402
import friction_law  # noqa: E402
import histories  # noqa: E402
import homogenization  # noqa: E402
import localization  # noqa: E402
import motion  # noqa: E402
import readings  # noqa: E402
import static_contact  # noqa: E402
import tables  # noqa: E402
from cases import TOP, Cases  # noqa: E402
from measures import Runs  # noqa: E402
from page import Fragment, introduction  # noqa: E402
from pages import Page  # noqa: E402
from report.base.data import Missing  # noqa: E402
from report.runs import paper_values  # noqa: E402
from study import Study, parse_arguments  # noqa: E402


@dataclasses.dataclass
class Part:
    title: str
    runs: Callable  # adds the runs to Cases and returns their names
    write: Callable  # writes them into a Fragment


# In the order of the paper.
PARTS = {
    "readings": Part("How the loading was read: both regimes", readings.regime_runs, readings.regimes),
    "figure-2": Part("Figure 2: the friction law", friction_law.step_runs, friction_law.step),
    "figure-4": Part("Figure 4: trajectory of a contact node", motion.trajectory_runs, motion.trajectory),
    "figure-5": Part("Figure 5: convergence", motion.convergence_runs, motion.convergence),
    "figure-6": Part("Figure 6: apparent friction", histories.regime_runs, histories.regimes),
    "figure-7": Part("Figure 7: dissipated energy", histories.regime_runs, histories.energy),
    "equation-10": Part("Equation (10): homogenized stiffness", homogenization.stiffness_runs, homogenization.stiffness),
    "figure-8": Part("Figure 8: modes of vibration", homogenization.modes_runs, homogenization.modes),
    "table-2": Part("Table 2: mu_inter at 0.5 MPa", tables.table_2_runs, tables.table_2),
    "figure-9": Part("Figure 9: normal stress at node M", contact_stress.normal_runs, contact_stress.normal),
    "figure-11": Part("Figure 11: friction against regularization time", contact_stress.sweep_runs, contact_stress.sweep),
    "table-3": Part("Table 3: mu_inter at 0.4 MPa", tables.table_3_runs, tables.table_3),
    "table-4": Part("Table 4: static contact", static_contact.runs, static_contact.table),
    "table-5": Part("Table 5: friction by phase, mu_homo = 0.2", partial(tables.by_phase_runs, paper_values.TABLE_5), partial(tables.by_phase, 5)),
    "figure-12": Part("Figure 12: apparent friction, mu_homo = 0.2", partial(histories.by_phase_runs, 0.2, (1500, 2500)), histories.by_phase),
    "table-6": Part("Table 6: friction by phase, mu_homo = 0.23", partial(tables.by_phase_runs, paper_values.TABLE_6), partial(tables.by_phase, 6)),
    "figure-13": Part("Figure 13: apparent friction, mu_homo = 0.23", partial(histories.by_phase_runs, 0.23, (1500, 4000)), histories.by_phase),
    "figure-14": Part("Figure 14: stress in element A", localization.runs, localization.element_a),
    "figure-15": Part("Figure 15: stress in element B", localization.runs, localization.element_b),
    "figure-16": Part("Figure 16: mean von Mises stress", localization.field_runs, localization.mean_von_mises),
}


def make(study, keys, doc, extra=None):
    """Runs and writes the parts named; returns the sentences on what could not be made."""
    cases = Cases(study, extra)
    names = {key: PARTS[key].runs(cases) for key in keys}
    runs, missing, page = Runs(study.run()), [], Page(doc, os.path.join(study.folder, "fragments"))
    for key in keys:
        fragment = Fragment(key, PARTS[key].title, page)
        try:
            PARTS[key].write(fragment, runs, names[key])
        except Missing as reason:
            missing.append(f"{key}: {reason}")
            continue
        fragment.save()
    missing += [f"{key}: not run yet" for key in page.write(introduction, PARTS, {key: part.title for key, part in PARTS.items()}) if key not in keys]
    return missing


def main():
    arguments = parse_arguments(__doc__, "paper", list(PARTS))
    study = Study(arguments.output, arguments.programs, arguments.jobs, arguments.keep)
    missing = make(study, arguments.parts, os.path.join(TOP, "doc", "paper"))
    for sentence in missing:
        print(f"run.sh paper: {sentence}", file=sys.stderr)
    print("doc/paper/README.md")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
