"""doc/verification.md names tests that exist, and it names all that ./run.sh verification would put there.

    verification_page.py <folder with the programs>
"""

import os
import sys

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
VERIFICATION = os.path.join(TOP, "tests", "verification")
sys.path.insert(0, VERIFICATION)

import problems  # noqa: E402
import run  # noqa: E402


def main():
    build = os.path.dirname(os.path.abspath(sys.argv[1]))
    run.check_names(os.path.join(build, "tests"))
    with open(os.path.join(TOP, "doc", "verification.md"), encoding="utf-8") as file:
        page = file.read()
    for problem, claim, tests in problems.PROBLEMS:
        for text in (problem, claim, *tests):
            assert text in page, f"doc/verification.md lacks '{text}'; ./run.sh verification writes it"
    for names in problems.ORDERS.values():
        for series in names:
            assert f"| {series} |" in page, f"doc/verification.md lacks the series '{series}'"


if __name__ == "__main__":
    main()
