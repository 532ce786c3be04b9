"""The page: HTML pieces, numbers with units, and the style sheet (phone, desk, print)."""

import base64
import html
import io
import math

import matplotlib.pyplot as plt

STYLE = """
:root{--ink:#1d2733;--soft:#5b6773;--line:#d5dbe1;--wash:#f4f6f8;--accent:#0072b2}
*{box-sizing:border-box}
body{margin:0 auto;max-width:54rem;padding:1rem 1rem 4rem;color:var(--ink);background:#fff;
 font:1rem/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
h1{font-size:1.7rem;line-height:1.2;margin:.6rem 0 .2rem}
h2{font-size:1.25rem;margin:2.4rem 0 .6rem;padding-bottom:.25rem;border-bottom:2px solid var(--accent)}
h3{font-size:1.02rem;margin:1.4rem 0 .4rem}
.lead,.note,figcaption{color:var(--soft)}
nav ol{columns:2;padding-left:2rem;margin:.4rem 0}
nav a{color:var(--accent);text-decoration:none}
.scroll{overflow-x:auto;-webkit-overflow-scrolling:touch}
table{border-collapse:collapse;width:100%;font-size:.9rem;font-variant-numeric:tabular-nums}
th,td{padding:.35rem .6rem;text-align:right;border-bottom:1px solid var(--line);vertical-align:top}
td:not(.text){white-space:nowrap}
td.text{min-width:6.5rem}
.words{white-space:normal}
th:first-child,td:first-child,td.text,th.text{text-align:left}
thead th{background:var(--wash);border-bottom:2px solid var(--line);font-weight:600}
figure{margin:1rem 0 1.6rem}
figure img{width:100%;height:auto;display:block}
figcaption{font-size:.88rem;margin-top:.4rem}
.note{background:var(--wash);border-left:4px solid var(--line);padding:.5rem .8rem;font-size:.9rem;
 overflow-wrap:anywhere}
details{margin:.5rem 0}pre{background:var(--wash);padding:.7rem;font-size:.75rem;white-space:pre-wrap;
 overflow-wrap:anywhere}
@media (max-width:34rem){nav ol{columns:1}body{padding:.6rem .7rem 3rem}th,td{padding:.3rem .4rem}
 table{font-size:.8rem}figure{margin:1rem -.5rem 1.4rem}figcaption{padding:0 .5rem}}
@media print{@page{margin:16mm}body{max-width:none;padding:0;font-size:10pt}nav,details{display:none}
 figure,table,.note{break-inside:avoid}.screen{display:none}h2,h3{break-after:avoid}.scroll{overflow:visible}
 figure img{max-height:112mm;object-fit:contain;object-position:left}
 figure.tall img{max-height:185mm}}
"""

PREFIXES = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")]
PREFIXED = {"s", "Hz", "Pa", "m", "J", "W", "B", "J/m"}


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


def difference(ours, paper):
    """Relative difference in per cent, signed."""
    if ours is None or paper is None or not paper:
        return "n/a"
    percent = round(100 * (ours - paper) / abs(paper), 1) + 0.0
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
    return (f'<div class="scroll"><table><thead><tr>{head}</tr></thead>'
            f"<tbody>{body}</tbody></table></div>")


def note(text):
    return f'<p class="note">{escape(text)}</p>'


class Page:
    """Sections in order; figures are numbered and embedded as PNG."""

    def __init__(self, title, lead):
        self.title, self.lead = title, lead
        self.sections, self.figures = [], 0

    def section(self, title, body, kind="paper"):
        """`kind` "screen" keeps it off the printed page."""
        self.sections.append((title, body, kind))

    def figure(self, figure, caption, alt=None):
        """HTML of a matplotlib figure, which is closed."""
        self.figures += 1
        stream = io.BytesIO()
        try:
            figure.savefig(stream, format="png", dpi=170)
        finally:
            plt.close(figure)
        data = base64.b64encode(stream.getvalue()).decode("ascii")
        tall = ' class="tall"' if figure.get_figheight() > 0.95 * figure.get_figwidth() else ""
        plain = escape(alt or caption.split(".")[0])
        return (f'<figure{tall}><img alt="{plain}" src="data:image/png;base64,{data}">'
                f"<figcaption><b>Figure {self.figures}.</b> {caption}</figcaption></figure>")

    def html(self):
        links = "".join(f'<li><a href="#s{i}">{title}</a></li>'
                        for i, (title, *_) in enumerate(self.sections))
        body = "".join(f'<section class="{kind}"><h2 id="s{i}">{title}</h2>{content}</section>'
                       for i, (title, content, kind) in enumerate(self.sections))
        return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
                '<meta name="viewport" content="width=device-width, initial-scale=1">'
                f"<title>{escape(self.title)}</title><style>{STYLE}</style></head><body>"
                f'<h1>{escape(self.title)}</h1><p class="lead">{self.lead}</p>'
                f"<nav><ol>{links}</ol></nav>{body}</body></html>\n")
