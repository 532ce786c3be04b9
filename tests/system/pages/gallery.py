"""The gallery has every file of prm/examples, and every one of them is valid as it stands; chains are checked as a whole."""

import os
import sys
import tempfile
import types
from unittest import mock

from scenes import PROGRAMS, TOOLS, TOP, Folder, served

sys.path[:0] = [os.path.join(TOOLS, "studies", "gallery"), TOOLS]

from chain.inputs import list_inputs  # noqa: E402
from chain.plan import Plan  # noqa: E402
from examples import EXAMPLES  # noqa: E402

FOLDER = os.path.join("prm", "examples")


def files_of_examples():
    """Paths below prm/examples of all .prm files."""
    return sorted(os.path.relpath(os.path.join(folder, name), os.path.join(TOP, FOLDER))
                  for folder, _, names in os.walk(os.path.join(TOP, FOLDER)) for name in names if name.endswith(".prm"))


def check_chain(source):
    """Each step is valid; where stresses are localized, memory and disk of that are known before anything has run. How long the steps
    take, which run_chain.py --validate tries out as well, is not asked for."""
    with tempfile.TemporaryDirectory() as path:
        plan = Plan(source, os.path.join(path, "none"), *list_inputs(source), PROGRAMS, tempfile.mkdtemp(dir=path))
        checked = {step.name: plan.check(step) for step in plan.to_run}
    assert len(checked) == len(plan.steps) > 1, checked
    localized = [found for name, found in checked.items() if name.endswith("stress_localization")]
    for estimate, lines in localized:
        print(f"{os.path.basename(source)}: {estimate.text()}")
        assert estimate.memory > 1e8 and estimate.disk > 1e5, estimate.text()
        assert any("drafts stand for the results" in line for line in lines), lines
    return len(localized)


def main():
    localizations = 0
    page = Folder(TOP).read("doc", "gallery.md").decode()
    shown = {target for example in EXAMPLES for target in example.targets}
    for name in files_of_examples():
        assert name in shown or os.path.dirname(name) in shown, f"{name} is not in the gallery"
    with mock.patch("chain.plan.subprocess", types.SimpleNamespace(run=served)):
        for example in EXAMPLES:
            for target in example.targets:
                assert f"{FOLDER}/{target}\n" in page, f"./run.sh gallery writes doc/gallery.md, which lacks {target}"
                path = os.path.join(FOLDER, target)
                if example.program:
                    Folder(TOP).run(0, example.program, path, "--validate")
                else:
                    localizations += check_chain(os.path.join(TOP, path))
    assert localizations == 8, localizations
    print(f"{len(shown)} examples, all valid")


if __name__ == "__main__":
    main()
