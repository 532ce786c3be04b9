"""The page doc/paper/README.md: a fragment a part, with its pictures, put together from what there is."""

import re

import pages

INTRODUCTION = """# The paper's tables and figures

Peillex, Baillet, Berthier, *Homogenization in non linear dynamics due to frictional contact*, Int. J. Solids Structures (2008): every table
and figure with a number or a curve, beside what mesoslip computes. `./run.sh paper` makes this page; the runs are the files of
[prm/paper](../../prm/paper) with the changes named. Only the paper's numbers are typed in
(`applications/tools/report/paper_values.py`); nothing is read off its figures. "Difference" is ours against the paper's.

How the paper was read, and why, has [a page of its own](reading.md).
"""


def relative(ours, paper):
    """Relative difference in per cent, signed."""
    return "-" if ours is None or not paper else f"{100 * (ours - paper) / abs(paper):+.1f} %".replace("-", "−")


def fixed(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}".replace("-", "−")


class Fragment:
    """What one part says, and its pictures in the folder of the page."""

    def __init__(self, key, title, page):
        self.key, self.page, self.lines = key, page, [f"## {title}", ""]

    def text(self, text):
        self.lines += [text, ""]

    def reading(self, text):
        self.text("*Reading.* " + text)

    def table(self, header, rows):
        self.text(pages.table(header, rows, right=True))

    def compare(self, rows, digits=3):
        """Rows (quantity, paper, ours) of numbers; ours may be None."""
        self.table(["", "paper", "ours", "difference"],
                   [(what, fixed(paper, digits), fixed(ours, digits), relative(ours, paper))
                    for what, paper, ours in rows])

    def figure(self, figure, caption, suffix="", dpi=110):
        name = pages.save_picture(figure, self.page.folder, self.key + suffix + ".png", dpi=dpi, pil_kwargs={"optimize": True})
        self.text(f"![{re.split(r'[.:;] (?=[A-Z])', caption)[0].rstrip('.')}]({name})\n\n*{caption}*")

    def save(self):
        self.page.text(self.key, "\n".join(self.lines))
