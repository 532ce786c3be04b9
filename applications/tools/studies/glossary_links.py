#!/usr/bin/env python3
"""Links to doc/glossary.md where a page uses a term first: in the prose, not in headings, tables, code or other links.

    glossary_links.py page.md...    adds those that are missing to pages written by hand
"""

import os
import re
import sys

DOC = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "doc")
# Words as pages write them: anchor in the glossary.
TERMS = {
    r"KUBC": "kubc", r"SUBC": "subc", r"PBC": "pbc", r"MUBC": "mubc", r"T_G": "t_g", r"[Pp]laten": "platen", r"[Ll]imit cycles?": "limit-cycle",
    r"[Rr]egimes?(?: 1| 2)?": "regime", r"[Nn]ode M": "reference-node", r"SCA": "sca", r"SPR": "spr", r"mu_inter|μ_inter": "mu_inter",
    r"mu_app": "mu_app", r"mu_homo": "mu_homo", r"delta|δ": "delta", r"beta2|β₂": "beta2", r"beta|β": "beta", r"Voigt": "voigt-notation",
    r"[Mm]orpholog(?:y|ies)": "morphology", r"[Cc]oncentration tensors?": "concentration-tensors", r"Hill-Mandel": "hill-mandel-condition",
    r"[Cc]omplex modes": "complex-modes", r"[Gg]rowth rates?": "growth-rate", r"[Cc]ritical time step": "critical-time-step",
    r"[Ee]ffective stiffness": "effective-stiffness", r"[Cc]ontact map": "contact-map"}
# Not to be changed: code, also over a line's end, links, pictures, and lines that are no prose.
APART = re.compile(r"(?ms)^```.*?^```|^(?:#|\||    |<)[^\n]*|`[^`]*`|!?\[[^\]]*\]\([^)]*\)|<[^>\n]*>")
BEFORE, AFTER = r"(?<![\w*/(_^-])(?<!omega )", r"(?![\w*/_^*-]|\s*[=(<>]|\)| omega)"  # of a word, not part of a formula


def with_links(text, folder_up, width=120):
    """The text with links; `folder_up` leads from the page to doc/ ("" or "../"). A line that becomes too long is broken."""
    linked = set(re.findall(r"glossary\.md#([\w-]+)", text))
    for term, anchor in TERMS.items():
        if anchor in linked:
            continue
        taken = [match.span() for match in APART.finditer(text)]
        for match in re.finditer(f"{BEFORE}(?:{term}){AFTER}", text):
            if not any(begin < match.end() and match.start() < end for begin, end in taken):
                text = f"{text[:match.start()]}[{match[0]}]({folder_up}glossary.md#{anchor}){text[match.end():]}"
                text = broken(text, match.start(), width)
                break
    return text


def broken(text, place, width):
    """The line at a place is broken once if it is too long; the others stay as they are."""
    begin, end = text.rfind("\n", 0, place) + 1, text.find("\n", place)
    line = text[begin:end]
    if len(line) <= width:
        return text
    indent = " " * len(re.match(r" *(?:\* |\d+\. )?", line)[0])
    at = line.rfind(" ", len(indent) + 1, width + 1)
    return text if at < 0 else text[:begin] + line[:at] + "\n" + indent + line[at + 1:] + text[end:]


def to_glossary(page):
    """The path from the folder of a page to doc/, as links begin with it."""
    path = os.path.relpath(DOC, os.path.dirname(os.path.abspath(page)))
    return "" if path == "." else path + "/"


def main():
    for page in sys.argv[1:]:
        with open(page, encoding="utf-8") as file:
            text = file.read()
        with open(page, "w", encoding="utf-8") as file:
            file.write(with_links(text, to_glossary(page)))


if __name__ == "__main__":
    main()
