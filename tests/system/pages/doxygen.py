#!/usr/bin/env python3
"""doxygen reads the public headers without a warning: every member has a comment, and none opens with a word that says nothing."""

import os
import re
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


# A comment begins with what is documented, not with what it is of.
EMPTY_OPENING = re.compile(r"(?:/\*\*<?|///<?)[\s*]*((?:of|what|those|that|others?|with (?:these|those|it))\b[^\n]*)", re.IGNORECASE)


def empty_openings(path):
    with open(path, encoding="utf-8") as file:
        return [f"{os.path.relpath(path, TOP)}: '{found}' opens with a word that says nothing" for found in EMPTY_OPENING.findall(file.read())]


def main():
    with tempfile.TemporaryDirectory() as folder:
        # The check finds what it is for.
        Folder(folder).write("bare.h", "/** Documented. */\nstruct Bare\n{\n  int member;\n};\n")
        assert "Member member" in warnings(folder, f"INPUT = {folder}/bare.h\n"), "an undocumented member passes"

        Folder(folder).write("empty.h", "/** What it is. */\nint a; ///< of a node\n/** Offset. */\nint b; ///< offset\n")
        assert len(empty_openings(os.path.join(folder, "empty.h"))) == 2, "an opening that says nothing passes"

        found = warnings(folder)
    headers = [os.path.join(place, name) for place, _, names in os.walk(os.path.join(TOP, "lib")) for name in names if name.endswith(".h")]
    found = "\n".join([found] * bool(found) + [line for path in sorted(headers) for line in empty_openings(path)])
    print(found or "no warnings")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
