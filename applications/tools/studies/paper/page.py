"""The page doc/paper/README.md: a fragment a part, with its pictures, put together from what there is."""

import re

import pages

INTRODUCTION = """# The paper's tables and figures

This page compares mesoslip with the tables and figures of the [paper](../theory.md).

* Effective stiffness, modes, static contact and friction by phase agree with the paper.
* Both regimes of the sliding pin appear at the printed pressures if the pin starts with a velocity along x, a push; the paper mentions no push.
* Table 3: two of four models are in regime 2 where the paper has regime 1.
* Figure 4: in regime 1 node M leaves the flat by about half the paper's distance.
* Figures 14 and 15: localized stresses miss the paper's bounds at the contact and nearly keep them in the middle of the pin.

{differences}

`./run.sh paper` makes this page from the files of [prm/paper](../../prm/paper). The paper's numbers are in \
`applications/tools/report/runs/paper_values.py`; none is read off a figure. [How the paper was read](reading.md) gives reasons for the settings.
"""


def introduction(texts):
    """What stands above the parts, with the largest difference of each."""
    rows = [row for row in map(_largest, texts) if row]
    return INTRODUCTION.format(differences=pages.table(["part", "largest difference [%]", "of"], rows)) if rows else INTRODUCTION.replace("{differences}\n\n", "")


def _largest(text):
    """Link, value and row of the largest entry below "difference [%]" in the tables of a part; None where it has no such column."""
    title, found = text.split("\n")[0].removeprefix("## "), []
    for lines in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE):
        head, _, *rows = ([cell.strip() for cell in line.strip("|").split(" | ")] for line in lines.strip().split("\n"))
        found += [(cell, row[0]) for row in rows for name, cell in zip(head, row) if name == "difference [%]" and cell != "-"]
    if not found:
        return None
    value, row = max(found, key=lambda entry: abs(float(entry[0].replace("−", "-"))))
    anchor = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
    return [f"[{title.split(':')[0]}](#{anchor})", value, row]


def relative(ours, paper):
    """Relative difference in per cent, signed."""
    return "-" if ours is None or not paper else f"{100 * (ours - paper) / abs(paper):+.1f}".replace("-", "−")


def fixed(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}".replace("-", "−")


class Fragment:
    """What one part says, and its pictures in the folder of the page."""

    def __init__(self, key, title, page):
        self.key, self.page, self.lines = key, page, [f"## {title}", ""]

    def text(self, text):
        self.lines += [text, ""]

    def table(self, header, rows):
        self.text(pages.table(header, rows, right=True))

    def compare(self, rows, digits=3):
        """Rows (quantity, paper, ours) of numbers; ours may be None."""
        self.table(["", "paper", "ours", "difference [%]"],
                   [(what, fixed(paper, digits), fixed(ours, digits), relative(ours, paper))
                    for what, paper, ours in rows])

    def csv(self, headings, rows):
        """Keeps a table beside the page; returns a link to it."""
        pages.write_csv(self.page.folder, self.key + ".csv", headings, rows)
        return f"[{self.key}.csv]({self.key}.csv)"

    def figure(self, figure, title, caption="", suffix="", dpi=110):
        """`title` stands for the picture, `caption` below it."""
        name = pages.save_picture(figure, self.page.folder, self.key + suffix + ".png", dpi=dpi, pil_kwargs={"optimize": True})
        self.text(f"![{title}]({name})" + (f"\n\n*{caption}*" if caption else ""))

    def save(self):
        self.page.text(self.key, "\n".join(self.lines))
