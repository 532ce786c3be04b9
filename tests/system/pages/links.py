#!/usr/bin/env python3
"""Every relative link of a tracked .md file leads to a tracked file or folder, and every anchor to a heading. Pages written by hand link
terms to the glossary at first use, and their lines have at most 120 characters."""

import os
import re
import subprocess
import sys
import urllib.parse

from scenes import TOP, Folder

sys.path.insert(0, os.path.join(TOP, "applications", "tools", "studies"))
from glossary_links import to_glossary, with_links  # noqa: E402

LINK = re.compile(r"!?\[[^\]]*\]\(\s*<?([^)>\s]+)>?(?:\s+\"[^\"]*\")?\s*\)|^\[[^\]]+\]:\s*(\S+)", re.MULTILINE)
HTML_LINK = re.compile(r"<(?:a|img)\b[^>]*?\b(?:href|src)=\"([^\"]+)\"")
MADE = ("doc/paper/", "doc/performance/", "doc/stability/", "doc/complex_modes/")  # by programs
REFERENCE = ("doc/glossary.md", "doc/file_formats.md", "doc/extending.md", "doc/parameters/README.md")
CODE = re.compile(r"^(```|~~~).*?^\1|^(?: {4}|\t).*?$|`[^`\n]+`", re.MULTILINE | re.DOTALL)


def tracked():
    """Names of the files under version control; all files where there is no git repository."""
    done = subprocess.run(["git", "-C", TOP, "ls-files", "-z"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                          check=False)
    if done.returncode == 0:
        return [name for name in done.stdout.split("\0") if name]
    return [os.path.relpath(os.path.join(folder, name), TOP) for folder, _, names in os.walk(TOP) for name in names]


def slug(heading):
    """The anchor that code forges give a heading: lower case, without punctuation, hyphens for blanks."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def anchors(text):
    found, count = set(re.findall(r"<a\s+(?:id|name)=\"([^\"]+)\"", text)), {}
    for heading in re.findall(r"^#{1,6}\s+(.*?)\s*#*$", text, re.MULTILINE):
        name = slug(heading)
        found.add(f"{name}-{count[name]}" if name in count else name)
        count[name] = count.get(name, 0) + 1
    return found


def links(text):
    plain = CODE.sub("", text)
    return [a or b for a, b in LINK.findall(plain)] + HTML_LINK.findall(plain)


def problems(files, texts):
    """`files`: all tracked names; `texts`: {name of an .md file: its text}."""
    there = set(files) | {os.path.dirname(f) for f in files}
    there |= {folder for f in list(there) for folder in parents(f)}
    for name, text in sorted(texts.items()):
        for link in links(text):
            if re.match(r"[a-z][a-z0-9+.-]*:", link):
                continue
            path, _, anchor = urllib.parse.unquote(link).partition("#")
            target = os.path.normpath(os.path.join(os.path.dirname(name), path)) if path else name
            if target not in there and target != ".":
                yield f"{name}: the link {link} leads to {target}, which is not in the repository"
            elif anchor and target in texts and anchor not in anchors(texts[target]):
                yield f"{name}: the link {link} names a heading that {target} does not have"


def parents(path):
    while path:
        path = os.path.dirname(path)
        yield path


def long_lines(name, text):
    """Lines of prose beyond 120 characters, targets of links not counted."""
    plain = re.sub(r"^```.*?^```", lambda code: "\n" * code[0].count("\n"), text, flags=re.MULTILINE | re.DOTALL)
    for number, line in enumerate(plain.split("\n"), 1):
        if len(re.sub(r"\]\([^)]*\)", "]", line)) > 120 and not re.match(r"\||    |!\[|<|#", line):
            yield f"{name}:{number}: the line has more than 120 characters"


def missing_terms(name, text):
    """Terms of the glossary that a page uses without a link."""
    linked = with_links(text, to_glossary(os.path.join(TOP, name)))
    if linked != text:
        known = set(re.findall(r"glossary\.md#([\w-]+)", text))
        new = [anchor for anchor in re.findall(r"glossary\.md#([\w-]+)", linked) if anchor not in known]
        yield f"{name}: no link to the glossary at the first use of {', '.join(new)}; applications/tools/studies/glossary_links.py adds it"


def check_itself():
    """The check finds what it is made for."""
    texts = {"doc/a.md": "# Two words: one\n[x](b.md#here) [y](#two-words-one) ![z](gone.png) `[n](no.md)` [o](https://x.y)\n[f](..)\n",
             "doc/b.md": "# There\n    [code](none.md)\n[up](../README.md)"}
    found = list(problems(["doc/a.md", "doc/b.md", "README.md"], texts))
    assert len(found) == 2 and "#here" in found[0] and "gone.png" in found[1], found


def main():
    check_itself()
    files = tracked()
    texts = {name: Folder(TOP).read(name).decode() for name in files if name.endswith(".md") and os.path.exists(os.path.join(TOP, name))}
    found = list(problems(files, texts))
    for name, text in texts.items():
        if not name.startswith(MADE):
            found += long_lines(name, text)
        if name.startswith(("README", "doc/")) and name not in REFERENCE and not name.startswith(MADE):
            found += missing_terms(name, text)
    print("\n".join(found) or f"{len(texts)} files: {sum(len(links(t)) for t in texts.values())} links, all valid")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
