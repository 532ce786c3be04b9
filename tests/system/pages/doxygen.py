#!/usr/bin/env python3
"""doxygen reads the public headers without a warning: every member has a comment."""

import os
import subprocess
import sys
import tempfile

from scenes import TOP, Folder


def warnings(folder, more=""):
    """What doxygen has to say with the project's settings and some more; pages go to @p folder."""
    settings = f"@INCLUDE = doc/Doxyfile\nOUTPUT_DIRECTORY = {folder}\nGENERATE_HTML = NO\nGENERATE_XML = YES\n" + more
    done = subprocess.run(["doxygen", "-"], input=settings, cwd=TOP, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    text = done.stdout.replace(TOP + os.sep, "").strip()
    assert bool(text) == (done.returncode != 0), (done.returncode, text)
    return text


def main():
    with tempfile.TemporaryDirectory() as folder:
        # The check finds what it is for.
        Folder(folder).write("bare.h", "/** Documented. */\nstruct Bare\n{\n  int member;\n};\n")
        assert "Member member" in warnings(folder, f"INPUT = {folder}/bare.h\n"), "an undocumented member passes"

        found = warnings(folder)
    print(found or "no warnings")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
