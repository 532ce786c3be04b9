"""The page of the study: tables as CSV and markdown, one text a part, joined into README.md."""

import csv
import os

from PIL import Image


def number(value, digits=3):
    """A number as a reader wants it; texts stay, None is a dash."""
    if value is None:
        return "-"
    return f"{value:.{digits}g}" if isinstance(value, float) else str(value)


def table(headings, rows):
    lines = ["| " + " | ".join(headings) + " |", "|" + " --- |" * len(headings)]
    lines += ["| " + " | ".join(number(cell).replace("|", "\\|") for cell in row) + " |" for row in rows]
    return "\n".join(lines)


class Page:
    """Writes into `folder` (pictures, CSV, README.md); the texts of the parts are kept in `parts`, so that a run of
    some parts leaves the others as they are."""

    def __init__(self, folder, parts):
        self.folder, self.parts = folder, parts
        os.makedirs(folder, exist_ok=True)
        os.makedirs(parts, exist_ok=True)

    def csv(self, name, headings, rows):
        with open(os.path.join(self.folder, name), "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(headings)
            writer.writerows([["" if cell is None else cell for cell in row] for row in rows])

    def picture(self, name, figure):
        path = os.path.join(self.folder, name)
        figure.savefig(path, dpi=90, bbox_inches="tight")
        with Image.open(path) as image:  # few colours: a third of the size
            image.convert("RGB").quantize(48).save(path, optimize=True)

    def text(self, part, content):
        with open(os.path.join(self.parts, part + ".md"), "w", encoding="utf-8") as file:
            file.write(content.strip() + "\n")

    def write(self, introduction, order):
        texts = [introduction.strip() + "\n"]
        for part in order:
            path = os.path.join(self.parts, part + ".md")
            if os.path.exists(path):
                with open(path, encoding="utf-8") as file:
                    texts.append(file.read())
        with open(os.path.join(self.folder, "README.md"), "w", encoding="utf-8") as file:
            file.write("\n".join(texts))
