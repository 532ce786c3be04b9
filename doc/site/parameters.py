"""The parameter reference, which `--print-parameters` prints, as pages with a heading for each section and an anchor for each key."""

import re


def anchor(program, section, key):
    """Of a key, as contact-dynamics-complex-modes-sweep."""
    return re.sub(r"[^a-z0-9]+", "-", "-".join([program, *section, key]).lower()).strip("-")


def entries(text):
    """(section, key, value, text) of each `set` of a .prm; `section` are the names of the subsections around it."""
    section, comment = [], []
    for line in text.splitlines()[1:]:  # the first names program and version
        line = line.strip()
        if line.startswith("#"):
            comment.append(line[1:].strip())
            continue
        if line.startswith("subsection "):
            section.append(line[len("subsection "):])
        elif line == "end":
            section.pop()
        elif line.startswith("set "):
            key, value = (part.strip() for part in line[len("set "):].split("=", 1))
            yield tuple(section), key, value, " ".join(comment)
        comment = []


def page(program, text):
    """The page of a program, in MyST's Markdown: keys by section, each with its default and its text."""
    lines, before = [f"# Parameters of {program}", "",
                     "Every key with its default, meaning, unit and allowed values. A key is given as `set Key = value` in its",
                     f"subsection of a `.prm` file. `{program} --print-parameters` prints the same.", ""], None
    for section, key, value, comment in entries(text):
        if section != before:
            lines += [f"## {' / '.join(section) or 'At the top of the file'}", ""]
            before = section
        lines += [f"({anchor(program, section, key)})=", f"**{key}** = `{value}`" if value else f"**{key}** =", "", escaped(comment), ""]
    return "\n".join(lines)


def escaped(text):
    """Plain text as Markdown."""
    return re.sub(r"([\\`*_<>\[\]{}|$#~])", r"\\\1", text)
