"""The site of the documentation: it is made without a warning, has all pages and all keys of the parameter reference, and can be searched.
Without Sphinx, MyST or Furo the test is skipped (exit status 77)."""

import importlib.util
import os
import re
import sys
import tempfile

from scenes import TOP

SITE = os.path.join(TOP, "doc", "site")
sys.path.insert(0, SITE)

import make  # noqa: E402
import parameters  # noqa: E402


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def main():
    if not all(importlib.util.find_spec(module) for module in ("sphinx", "myst_parser", "furo")):
        print("skipped: the packages python3-sphinx, python3-myst-parser and furo are not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        html = make.make(folder, False)
        for page in ("index", *(page for pages in make.MENU.values() for page in pages)):
            assert os.path.exists(os.path.join(html, page + ".html")), page
        assert "guide" in read(html, "searchindex.js")
        n = 0
        for program in make.PROGRAMS:
            reference, page = read(TOP, "doc", "parameters", program + ".prm"), read(html, "doc", "parameters", program + ".html")
            for section, key, _, text in parameters.entries(reference):
                n += 1
                assert f'id="{parameters.anchor(program, section, key)}"' in page, (section, key)
                assert text, (section, key)
            assert len(re.findall(r"^ *set ", reference, re.MULTILINE)) == len(list(parameters.entries(reference))), program
        links = [link for link in re.findall(r'href="([^"#?]+)', read(html, "index.html")) if ":" not in link]
        for link in links:
            assert os.path.exists(os.path.join(html, link)), link
        print(f"{n} keys, {len(links)} links of the first page")
    assert make._link(re.match(make.LINK, "](../prm/pin)"), "doc/guide.md", set(), {}) == "]"  # pylint: disable=protected-access


if __name__ == "__main__":
    main()
