#!/usr/bin/env python3
"""The gallery of examples: runs every file and chain of prm/examples as it stands, and writes doc/gallery.md with a picture of each."""

import itertools
import os
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.normpath(os.path.join(HERE, "..", "..", "..", ".."))
sys.path[:0] = [HERE, os.path.join(HERE, ".."), os.path.join(HERE, "..", "..")]

from examples import EXAMPLES  # noqa: E402
from pages import write_page  # noqa: E402
from report_pictures import report_figures, save  # noqa: E402
from study import parse_arguments  # noqa: E402

PAGE = """# Gallery of examples

This page shows every `.prm` file of [prm/examples](../prm/examples). The time in brackets is for one core. Run the
commands in the top folder. `./run.sh` with a folder or a `.prm` file also writes a report.

`./run.sh gallery` runs all examples and writes this page.

{examples}
"""


def run(programs, folder, example):
    """Seconds by the clock of the runs of an example, whose results are then in `folder`; SystemExit when one fails."""
    begin = time.monotonic()
    for target, (changed, keys) in itertools.product(example.targets, example.changes or (("", {}),)):
        name, path = os.path.splitext(os.path.basename(target))[0], os.path.join(TOP, "prm", "examples", target)
        output = folder if os.path.isdir(path) else os.path.join(folder, changed or name)
        command = [sys.executable, os.path.join(TOP, "applications", "tools", "run_chain.py"), "--programs", programs, "--jobs", "1", "--no-report",
                   path, "--output", output] if os.path.isdir(path) else [os.path.join(programs, example.program), path, "--output", output, "--quiet"]
        command += [f"--set={key}={value}" for key, value in keys.items()]
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        done = subprocess.run(command, cwd=TOP, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False, text=True)
        if done.returncode:
            raise SystemExit(f"gallery: {target} ends with exit status {done.returncode}: {done.stderr.strip()}")
    return time.monotonic() - begin


def commands(example):
    return [f"./run.sh prm/examples/{target}" if not example.program else f"build/applications/{example.program} prm/examples/{target}"
            for target in example.targets]


def drawn(example, folder):
    """The picture of an example that draws its own, as report_figures() has those of a report."""
    path = os.path.join(folder, "picture.png")
    example.draw(folder, path)
    with open(path, "rb") as file:
        return [("", file.read())]


def entry(arguments, example):
    """The text of an example; its picture goes to doc/gallery."""
    name = os.path.splitext(os.path.basename(example.targets[0]))[0]
    folder = os.path.join(arguments.output, name)
    seconds = run(arguments.programs, folder, example)
    pictured = os.path.join(folder, example.pictured) if example.pictured else folder
    if example.program and not example.pictured:
        pictured = os.path.join(folder, name)
    figures = drawn(example, folder) if example.draw else report_figures(pictured)
    save(figures, example.figure, os.path.join(TOP, "doc", "gallery", name + ".png"))
    print(f"{name}: {seconds:.1f} s", file=sys.stderr, flush=True)
    return "\n".join([f"## {example.title}", "", f"{example.text} ({'' if seconds >= 1 else '< '}{max(1, round(seconds))} s)", "",
                      *("    " + command for command in commands(example)), "", f"![picture](gallery/{name}.png)", ""])


def main():
    arguments = parse_arguments(__doc__, "gallery", ("page",))
    os.makedirs(os.path.join(TOP, "doc", "gallery"), exist_ok=True)
    texts = [entry(arguments, example) for example in EXAMPLES]
    write_page(os.path.join(TOP, "doc"), "gallery.md", PAGE.format(examples="\n".join(texts).rstrip()))
    print(os.path.join(TOP, "doc", "gallery.md"))


if __name__ == "__main__":
    main()
