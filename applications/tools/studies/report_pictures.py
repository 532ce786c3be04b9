"""Figures of a report, taken out of its HTML."""

import base64
import html
import io
import os
import re
import subprocess
import sys

from PIL import Image

from pages import with_palette

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
WIDTH = 900  # pixels


def report_figures(folder):
    """[(alternative text, PNG)] of the report on the run or runs in `folder`, in their order."""
    page = os.path.join(folder, "report.html")
    subprocess.run([sys.executable, os.path.join(TOP, "applications", "tools", "report", "make_report.py"), folder, "--output", page],
                   check=True, stdout=subprocess.DEVNULL)
    with open(page, encoding="utf-8") as file:
        found = re.findall(r'<img\b[^>]*?\balt="([^"]*)"[^>]*?\bsrc="data:image/png;base64,([^"]*)"', file.read())
    return [(html.unescape(text), base64.b64decode(data)) for text, data in found]


def save(figures, beginning, path):
    """Writes the first figure whose text begins so, WIDTH pixels wide at most and with 256 colours."""
    data = next((data for text, data in figures if text.startswith(beginning)), None)
    assert data is not None, f"no figure begins with {beginning!r}: {[text[:60] for text, _ in figures]}"
    image = Image.open(io.BytesIO(data)).convert("RGB")
    image.thumbnail((WIDTH, 4 * WIDTH), Image.LANCZOS)
    with_palette(image, 256).save(path, optimize=True)
