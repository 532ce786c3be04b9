"""./run.sh thickness: the page is what its tables give, its pictures are there, and the programs accept the settings of every run."""

import os
import subprocess
import sys

from scenes import PROGRAMS, TOOLS, TOP, sets

sys.path.insert(0, os.path.join(TOOLS, "studies", "thickness"))

import run  # noqa: E402
import thickness_page  # noqa: E402
from glossary_links import with_links  # noqa: E402
from pages import wrapped  # noqa: E402
from study import Study  # noqa: E402


def main():
    doc = os.path.join(TOP, "doc", "paper")
    with open(os.path.join(doc, "thickness.md"), encoding="utf-8") as file:
        text = with_links(thickness_page.text(os.path.join(doc, "thickness")), "../", width=10**6)  # as pages.write_page
        assert file.read() == wrapped(text), "the page is not that of its tables"
    assert os.path.isfile(os.path.join(doc, "thickness", "thickness.png"))
    study = Study(os.path.join(TOP, "results", "thickness"), PROGRAMS)
    run.add_all(study)
    run.fibres.add_fine_runs(study)
    for case in {(case.prm, *case.settings): case for case in study.cases.values()}.values():
        done = subprocess.run([os.path.join(PROGRAMS, case.program), case.prm, "--print-parameters", *sets(case.settings)],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        assert done.returncode == 0, f"{case.name}: {done.stderr}"
    print("ok")


if __name__ == "__main__":
    main()
