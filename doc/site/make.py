#!/usr/bin/env python3
"""The documentation as a site with search: doc/site/make.py [folder], by default build/site. The pages are those of the repository, with the
parameter reference as linked pages and, where Doxygen is installed, the pages of the library.

Needs the Debian packages python3-sphinx, python3-myst-parser and furo."""

import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, HERE)

import parameters  # noqa: E402

PROGRAMS = ("rve_homogenization", "contact_dynamics", "stress_localization")
# Heading of the menu: pages, in the order of a first reading.
MENU = {
    "Start": ("doc/gallery", "doc/first_steps", "doc/guide", "doc/guide/tomogram", "doc/guide/squeal", "doc/guide/supports",
              "doc/guide/disc", "doc/glossary"),
    "Use": ("doc/voxels", "doc/meshes", "doc/loads", "doc/composites", "doc/complex_modes/README", "doc/contact_maps", "doc/maps", "doc/chains",
            "doc/python", "doc/platforms"),
    "Reference": ("doc/parameters/README", *(f"doc/parameters/{name}" for name in PROGRAMS), "doc/file_formats", "doc/theory", "doc/limits"),
    "Evidence": ("doc/verification", "doc/performance", "doc/performance/work_precision", "doc/stability/README", "doc/paper/README",
                 "doc/paper/reading", "doc/paper/regimes", "doc/paper/prediction", "doc/paper/thickness", "doc/maps/pin"),
    "Develop": ("CONTRIBUTING", "doc/structure", "doc/extending", "CHANGELOG"),
}
LINK = re.compile(r"(\]\()([^)#\s]+)(#[^)\s]*)?(\))")


def copied(source):
    """Copies all pages and pictures into the folder `source`; links to files that are no pages become plain text."""
    names = subprocess.run(["git", "-C", TOP, "ls-files", "*.md", "doc"], stdout=subprocess.PIPE, check=True, text=True).stdout.split("\n")
    pages = {name for name in names if name.endswith(".md")}
    pictures = {name for name in names if name.endswith((".png", ".svg", ".csv"))}
    reference = {f"doc/parameters/{name}.prm": f"doc/parameters/{name}.md" for name in PROGRAMS}
    for name in pages | pictures:
        target = os.path.join(source, name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        if name in pictures:
            shutil.copyfile(os.path.join(TOP, name), target)
            continue
        with open(os.path.join(TOP, name), encoding="utf-8") as file:
            text = LINK.sub(lambda match, page=name: _link(match, page, pages | pictures, reference), file.read())
        with open(target, "w", encoding="utf-8") as file:
            file.write(text)
    for program in PROGRAMS:
        with open(os.path.join(TOP, f"doc/parameters/{program}.prm"), encoding="utf-8") as file:
            text = parameters.page(program, file.read())
        with open(os.path.join(source, f"doc/parameters/{program}.md"), "w", encoding="utf-8") as file:
            file.write(text)


def _link(match, page, known, reference):
    """The link as the site has it: what leads to a file that is no page is text only."""
    target = match.group(2)
    if re.match(r"[a-z]+:", target):
        return match.group(0)
    path = os.path.normpath(os.path.join(os.path.dirname(page), target))
    if path in reference:
        return match.group(1) + os.path.relpath(reference[path], os.path.dirname(page) or ".") + match.group(4)
    if path in known:
        return match.group(0)
    if os.path.isdir(os.path.join(TOP, path)) and os.path.join(path, "README.md") in known:
        return match.group(1) + os.path.join(target, "README.md") + (match.group(3) or "") + match.group(4)
    return "]"


def write_index(source, with_library):
    """The first page: the README, with the menu of all pages."""
    with open(os.path.join(source, "README.md"), encoding="utf-8") as file:
        text = file.read()
    for heading, pages in MENU.items():
        text += "\n```{toctree}\n:hidden:\n:caption: " + heading + "\n\n" + "\n".join(pages) + "\n```\n"
    if with_library:
        text += '\n<p>For developers: <a href="library/index.html">all classes and functions of the library</a>.</p>\n'
    os.remove(os.path.join(source, "README.md"))
    with open(os.path.join(source, "index.md"), "w", encoding="utf-8") as file:
        file.write(text)


def make(folder, with_library):
    """Writes <folder>/html and returns its name; exit status 1 with the warnings of Sphinx if there are any."""
    source, html = os.path.join(folder, "source"), os.path.join(folder, "html")
    for old in (source, html):
        shutil.rmtree(old, ignore_errors=True)
    os.makedirs(source)
    copied(source)
    write_index(source, with_library)
    done = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-c", HERE, "-b", "html", source, html], check=False)
    if done.returncode:
        sys.exit(f"make.py: Sphinx has warnings, see above; the pages are in {html}")
    return html


def add_library(html):
    """Doxygen's pages as <html>/library."""
    subprocess.run(["doxygen", "doc/Doxyfile"], cwd=TOP, check=True, stdout=subprocess.DEVNULL)
    shutil.copytree(os.path.join(TOP, "build", "doxygen", "html"), os.path.join(html, "library"))


def main():
    if len(sys.argv) > 2 or sys.argv[1:] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    with_library = shutil.which("doxygen") is not None
    html = make(os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else os.path.join(TOP, "build", "site"), with_library)
    if with_library:
        add_library(html)
    else:
        print("There is no doxygen: the pages of the library are left out.")
    print(os.path.join(html, "index.html"))


if __name__ == "__main__":
    main()
