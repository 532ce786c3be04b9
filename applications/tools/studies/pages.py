"""Pages of studies: tables in Markdown and CSV, pictures, and a text for each part, joined into one page."""

import csv
import os
import re
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402
from scipy.spatial import cKDTree  # noqa: E402

from glossary_links import with_links  # noqa: E402

DOC = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "doc")


def number(value, digits=3):
    """A number as a reader wants it; texts stay, None is a dash."""
    return "-" if value is None else f"{value:.{digits}g}" if isinstance(value, float) else str(value)


def table(headings, rows, right=False):
    """Markdown; `right`: all columns but the first are aligned to the right."""
    lines = ["| " + " | ".join(headings) + " |", "|" + " --- |" + (" ---: |" if right else " --- |") * (len(headings) - 1)]
    return "\n".join(lines + ["| " + " | ".join(number(cell).replace("|", "\\|") for cell in row) + " |" for row in rows])


def write_csv(folder, name, headings, rows):
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, name), "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(headings)
        writer.writerows([["" if cell is None else cell for cell in row] for row in rows])


def save_picture(figure, folder, name, colours=None, **options):
    """A PNG; with few `colours` it takes a third of the place."""
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, name)
    figure.savefig(path, **options)
    plt.close(figure)
    if colours:
        with Image.open(path) as image:
            with_palette(image.convert("RGB"), colours).save(path, optimize=True)
    return name


def with_palette(image, number):
    """The image in white, black and other colours, `number` in all. For the choice of these each of its colours counts by the fourth
    root of its pixels, so that those of a colour bar are kept which few cells have, as well as those of large areas."""
    pixels = np.asarray(image).reshape(-1, 3)
    colours, inverse, counts = np.unique(pixels, axis=0, return_inverse=True, return_counts=True)
    weighted = np.repeat(colours, np.ceil(counts ** 0.25).astype(int), axis=0)
    found = Image.fromarray(weighted[:, None].astype(np.uint8)).quantize(number - 2, kmeans=2).getpalette()[:3 * (number - 2)]
    palette = np.array([255] * 3 + [0] * 3 + found).reshape(-1, 3)
    nearest = cKDTree(palette).query(colours)[1]  # Pillow's own search is not exact
    result = Image.fromarray(nearest[inverse.ravel()].reshape(image.height, image.width).astype(np.uint8), mode="P")
    result.putpalette(palette.ravel().tolist())
    return result


def wrapped(text, width=120):
    """Markdown whose paragraphs and items have no longer lines; tables, headings, pictures and code stay."""
    lines, in_code = [], False
    for line in text.split("\n"):
        in_code ^= line.startswith("```")
        if len(line) <= width or in_code or line.lstrip().startswith(("|", "#", "!", "    ")):
            lines.append(line)
        else:
            indent = " " * len(re.match(r" *(\* )?", line)[0])
            kept = re.sub(r" (?=(?:\d+[.)]|[-+]) )", "\0", line)  # at the start of a line these would begin an item
            lines += [part.replace("\0", " ") for part in textwrap.wrap(kept, width, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)]
    return "\n".join(lines)


def write_page(folder, name, text):
    """A page in doc/ or in a folder of it, with links to the glossary."""
    text = wrapped(with_links(text, "" if os.path.realpath(folder) == os.path.realpath(DOC) else "../", width=10**6))
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


class Page:
    """README.md in `folder`, beside pictures and CSV; the texts of the parts are kept in `parts`, so that a run of some parts
    leaves the others as they are."""

    def __init__(self, folder, parts):
        self.folder, self.parts = folder, parts

    def section(self, title):
        """What the page says under "## title" now, with this heading; None where it has none."""
        try:
            with open(os.path.join(self.folder, "README.md"), encoding="utf-8") as file:
                found = [text for text in re.split(r"^(?=## )", file.read(), flags=re.MULTILINE) if text.split("\n")[0] == f"## {title}"]
        except OSError:
            return None
        return found[0].rstrip() + "\n" if found else None

    def text(self, part, content):
        os.makedirs(self.parts, exist_ok=True)
        with open(os.path.join(self.parts, part + ".md"), "w", encoding="utf-8") as file:
            file.write(content.strip() + "\n")

    def write(self, introduction, order, titles=None):
        """Returns the parts that have no text yet. A part with a title in `titles` keeps the text that the page has under it. `introduction` is a text, or
        a function of the texts of the parts."""
        texts, missing = [], []
        for part in order:
            try:
                with open(os.path.join(self.parts, part + ".md"), encoding="utf-8") as file:
                    texts.append(file.read())
            except OSError:
                text = self.section((titles or {}).get(part))
                texts += [text] if text else []
                missing += [] if text else [part]
        first = introduction(texts) if callable(introduction) else introduction
        write_page(self.folder, "README.md", "\n".join([first.strip() + "\n", *texts]))
        return missing
