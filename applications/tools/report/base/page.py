"""The page: HTML pieces and numbers with units."""

import base64
import html
import io
import math
import os
import re
import urllib.parse

import matplotlib.pyplot as plt

from report.base.figure_data import csv_of
from report.base.style import STYLE

# Stand for the number of a figure, which is known when all are there: of the next one, and of the same once more.
NEXT, SAME = "\x1a", "\x1b"
PREFIXES = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")]
PREFIXED = {"s", "Hz", "Pa", "m", "J", "W", "W/m", "B", "J/m"}


def number(value, digits=4):
    """A number with some significant digits, 'n/a' for what is none."""
    if value is None or not isinstance(value, (int, float)) or not math.isfinite(value):
        return "n/a"
    if float(value).is_integer() and abs(value) < 1e7:
        return f"{int(value):,}".replace(",", "\u202f").replace("-", "−")
    if value != 0 and not 1e-4 <= abs(value) < 1e7:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        return f"{mantissa}·10<sup>{int(exponent)}</sup>".replace("-", "−")
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(value)))) if value else 0
    return f"{value:.{decimals}f}".replace("-", "−")


def quantity(value, unit="", digits=4):
    """A number with its unit, prefixed where that reads better."""
    if value is None or not isinstance(value, (int, float)) or not math.isfinite(value):
        return "n/a"
    if unit in PREFIXED and value != 0:
        if float(value) != round(value):
            value = float(f"{value:.{digits - 1}e}")  # first, so that 999.999e-6 s is not 1000.0 µs
        for factor, prefix in PREFIXES:
            if abs(value) >= factor * (1 - 1e-9):
                return f"{number(value / factor, digits)} {prefix}{unit}"
        factor, prefix = PREFIXES[-1]
        return f"{number(value / factor, digits)} {prefix}{unit}"
    return f"{number(value, digits)} {unit}".strip()


def quantities(values, unit="", digits=4):
    """Numbers of one row with their unit, prefixed alike: by what suits the largest; "–" where there is none."""
    known = [float(f"{abs(value):.{digits - 1}e}") for value in values if value is not None]
    if unit not in PREFIXED or not any(known):
        return ["–" if value is None else quantity(value, unit, digits) for value in values]
    factor, prefix = next((pair for pair in PREFIXES if max(known) >= pair[0] * (1 - 1e-9)), PREFIXES[-1])
    shown = lambda value: f"{float(f'{value / factor:.{digits - 1}e}'):g}" if unit == "s" else number(value / factor, digits)  # times are round
    return ["–" if value is None else f"{shown(value)} {prefix}{unit}".replace("-", "−") for value in values]


def difference(ours, paper):
    """Relative difference in per cent; positive if ours is larger in the direction of the paper's, also of negative numbers."""
    if ours is None or paper is None or not paper:
        return "n/a"
    percent = round(100 * (ours - paper) / paper, 1) + 0.0
    return f"{percent:+.1f} %".replace("-", "−")


def escape(text):
    return html.escape(str(text))


def table(header, rows, text_columns=(0,)):
    """Rows of ready HTML cells; the columns named are set flush left."""
    kind = lambda i: ' class="text"' if i in text_columns else ""
    head = "".join(f"<th{kind(i)}>{cell}</th>" for i, cell in enumerate(header))
    body = "".join(
        "<tr>" + "".join(f"<td{kind(i)}>{cell}</td>" for i, cell in enumerate(row)) + "</tr>"
        for row in rows)
    return (f'<div class="scroll" tabindex="0"><table><thead><tr>{head}</tr></thead>'
            f"<tbody>{body}</tbody></table></div>")


def plain(text):
    """Words of a piece of HTML."""
    return html.unescape(re.sub("<[^>]*>", "", text))


def first_sentence(caption):
    """Of a caption, which no point in a number or a name ends."""
    return re.split(r"\.(?=\s|$)", plain(caption), maxsplit=1)[0]


def note(text):
    return f'<p class="note">{escape(text)}</p>'


class Page:
    """Sections in order; figures are numbered and embedded as PNG, their data as CSV. Links are relative to `folder`, where it will stand."""

    def __init__(self, title, lead, folder="."):
        self.title, self.lead, self.folder = title, lead, folder
        self.sections = []

    def section(self, title, body, kind="paper"):
        """`kind` "screen" keeps it off the printed page."""
        self.sections.append((title, body, kind))

    def link(self, path, words):
        """A link to a file, if it is there."""
        if not os.path.isfile(path):
            return ""
        place = os.path.relpath(path, self.folder).replace(os.sep, "/")
        return f'<a href="{escape(urllib.parse.quote(place))}">{escape(words)}</a>'

    def figure(self, figure, caption, alt=None):
        """HTML of a matplotlib figure, which is closed."""
        stream = io.BytesIO()
        try:
            figure.set_dpi(170)
            # savefig() would lay it out and draw it twice; compression at level 6, the default, is a seventh of the work, and files are a tenth smaller.
            figure.canvas.print_png(stream, pil_kwargs={"compress_level": 3})
            data = csv_of(figure)
        finally:
            plt.close(figure)
        picture = base64.b64encode(stream.getvalue()).decode("ascii")
        width, height = figure.get_size_inches()
        kinds = " ".join(kind for kind, holds in (("tall", height > 0.95 * width), ("wide", width > 7.0)) if holds)
        kinds = f' class="{kinds}"' if kinds else ""
        below = (f' <a class="data" download="figure-{SAME}.csv" '
                 f'href="data:text/csv;charset=utf-8,{urllib.parse.quote(data, safe=",.:+-()")}">Data (CSV)</a>' if data else "")
        return (f'<figure{kinds}><img alt="{escape(alt or first_sentence(caption))}" style="width:{96 * width:.0f}px" '
                f'src="data:image/png;base64,{picture}">'
                f"<figcaption><b>Figure {NEXT}.</b> {caption}{below}</figcaption></figure>")

    def row(self, pieces):
        """HTML of figures that are compared, which stand side by side."""
        return f'<div class="row">{"".join(pieces)}</div>'

    @staticmethod
    def _numbered(text):
        before, *figures = text.split(NEXT)
        return before + "".join(f"{k}{figure.replace(SAME, str(k))}" for k, figure in enumerate(figures, 1))

    def html(self):
        links = "".join(f'<li><a href="#s{i}">{title}</a></li>'
                        for i, (title, *_) in enumerate(self.sections))
        body = "".join(f'<section class="{kind}"><h2 id="s{i}">{title}</h2>{content}</section>'
                       for i, (title, content, kind) in enumerate(self.sections))
        return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
                '<meta name="viewport" content="width=device-width, initial-scale=1">'
                f"<title>{escape(self.title)}</title><style>{STYLE}</style></head><body>"
                f'<h1>{escape(self.title)}</h1><p class="lead">{self.lead}</p>'
                f"<nav><ol>{links}</ol></nav>{self._numbered(body)}</body></html>\n")
