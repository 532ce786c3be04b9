"""The gallery has every file of prm/examples, and every one of them is valid as it stands; chains are checked as a whole."""

import os
import sys
import tempfile

from scenes import TOOLS, TOP, Folder, run_chain

sys.path[:0] = [os.path.join(TOOLS, "studies", "gallery"), TOOLS]

from examples import EXAMPLES  # noqa: E402

FOLDER = os.path.join("prm", "examples")


def files_of_examples():
    """Paths below prm/examples of all .prm files."""
    return sorted(os.path.relpath(os.path.join(folder, name), os.path.join(TOP, FOLDER))
                  for folder, _, names in os.walk(os.path.join(TOP, FOLDER)) for name in names if name.endswith(".prm"))


def main():
    page = Folder(TOP).read("doc", "gallery.md").decode()
    shown = {target for example in EXAMPLES for target in example.targets}
    for name in files_of_examples():
        assert name in shown or os.path.dirname(name) in shown, f"{name} is not in the gallery"
    with tempfile.TemporaryDirectory() as results:
        for example in EXAMPLES:
            for target in example.targets:
                assert f"{FOLDER}/{target}\n" in page, f"./run.sh gallery writes doc/gallery.md, which lacks {target}"
                path = os.path.join(FOLDER, target)
                if example.program:
                    Folder(TOP).run(0, example.program, path, "--validate")
                else:
                    run_chain("--validate", "--output", os.path.join(results, os.path.basename(target)), os.path.join(TOP, path))
    print(f"{len(shown)} examples, all valid")


if __name__ == "__main__":
    main()
