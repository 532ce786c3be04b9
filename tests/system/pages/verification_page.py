"""doc/verification.md names tests that exist, and it names all that ./run.sh verification would put there."""

import os
import sys

from scenes import PROGRAMS, TOP, Folder

sys.path.insert(0, os.path.join(TOP, "tests", "verification"))

import problems  # noqa: E402
import run  # noqa: E402


def main():
    run.check_names(os.path.join(PROGRAMS, "..", "tests"))
    page = Folder(TOP).read("doc", "verification.md").decode()
    for problem, claim, tests in problems.PROBLEMS:
        for text in (problem, claim, *(test.split(": ")[1] for test in tests)):
            assert text in page, f"doc/verification.md lacks '{text}'; ./run.sh verification writes it"
    for names in problems.ORDERS.values():
        for series in names:
            assert f"| {series} |" in page, f"doc/verification.md lacks the series '{series}'"


if __name__ == "__main__":
    main()
