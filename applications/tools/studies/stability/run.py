"""Stability under stress: time steps around the limit, settings far beyond the paper's, a million steps, refinement with
and without regularization, sensitivity. Leaves tables and pictures in doc/stability. The part `pictures` only redraws the
pictures from the tables that are there."""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.normpath(os.path.join(HERE, *4 * [".."]))
sys.path[:0] = [HERE, os.path.join(TOP, "tests", "scenes"), os.path.dirname(HERE)]

import redraw  # noqa: E402
import sections  # noqa: E402
from pages import Page  # noqa: E402
from study import Study, parse_arguments  # noqa: E402

PARTS = {"limit": sections.limit_part, "stress": sections.stress_part, "long": sections.long_part,
         "refinement": sections.refinement_part, "sensitivity": sections.sensitivity_part}


def main():
    arguments = parse_arguments(__doc__, "stability", list(PARTS), on_request=("pictures",))
    doc = os.path.join(TOP, "doc", "stability")
    if arguments.parts == ["pictures"]:
        redraw.pictures(doc)
        return 0
    study = Study(arguments.output, arguments.programs, arguments.jobs, arguments.keep)
    page = Page(doc, os.path.join(arguments.output, "page"))
    wrong = []
    for part in arguments.parts:
        verdicts, findings = PARTS[part](study, page)
        wrong += findings + [verdict.outcome for verdict in verdicts if not verdict.good]
    page.write(sections.summary(doc), PARTS)
    for sentence in wrong:
        print("stability: " + sentence, file=sys.stderr)
    print(f"doc/stability/README.md: {'all as it should be' if not wrong else f'{len(wrong)} runs are not as they should be'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
