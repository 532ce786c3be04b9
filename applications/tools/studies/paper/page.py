"""The page doc/paper/README.md: a fragment a part, with its pictures, put together from what there is."""

import os
import re
import sys

sys.path.append(os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "report")))

import matplotlib.pyplot as plt  # noqa: E402

INTRODUCTION = """# The paper's tables and figures

Peillex, Baillet, Berthier, *Homogenization in non linear dynamics due to frictional contact*, Int. J. Solids Structures (2008): every table
and figure with a number or a curve, beside what mesoslip computes. `./run.sh paper` makes this page; the runs are the files of
[prm/paper](../../prm/paper) with the changes named. Only the paper's numbers are typed in
(`applications/tools/studies/paper/paper_values.py`); nothing is read off its figures. "Difference" is ours against the paper's.

How the paper was read, and why, is in [limits](../limits.md).
"""


def relative(ours, paper):
    """Relative difference in per cent, signed."""
    return "-" if ours is None or not paper else f"{100 * (ours - paper) / abs(paper):+.1f} %".replace("-", "−")


def fixed(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}".replace("-", "−")


class Fragment:
    """What one part says: Markdown in `folder`/fragments, pictures in the page's folder."""

    def __init__(self, key, title, doc, folder):
        self.key, self.doc, self.folder = key, doc, os.path.join(folder, "fragments")
        self.lines = [f"## {title}", ""]

    def text(self, text):
        self.lines += [text, ""]

    def reading(self, text):
        self.text("*Reading.* " + text)

    def table(self, header, rows):
        self.lines += ["| " + " | ".join(header) + " |", "| --- |" + " ---: |" * (len(header) - 1)]
        self.lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows] + [""]

    def compare(self, rows, digits=3):
        """Rows (quantity, paper, ours) of numbers; ours may be None."""
        self.table(["", "paper", "ours", "difference"],
                   [(what, fixed(paper, digits), fixed(ours, digits), relative(ours, paper))
                    for what, paper, ours in rows])

    def figure(self, figure, caption, suffix="", dpi=110):
        name = self.key + suffix + ".png"
        os.makedirs(self.doc, exist_ok=True)
        figure.savefig(os.path.join(self.doc, name), dpi=dpi, pil_kwargs={"optimize": True})
        plt.close(figure)
        self.lines += [f"![{re.split(r'[.:;] (?=[A-Z])', caption)[0].rstrip('.')}]({name})", "", f"*{caption}*", ""]

    def save(self):
        os.makedirs(self.folder, exist_ok=True)
        with open(os.path.join(self.folder, self.key + ".md"), "w", encoding="utf-8") as file:
            file.write("\n".join(self.lines).rstrip() + "\n")


def assemble(parts, doc, folder):
    """The page of all fragments there are, in the order of parts {key: title}; returns the keys without one."""
    text, missing = [INTRODUCTION], []
    for key in parts:
        try:
            with open(os.path.join(folder, "fragments", key + ".md"), encoding="utf-8") as file:
                text.append(file.read())
        except OSError:
            missing.append(key)
    with open(os.path.join(doc, "README.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(text))
    return missing
