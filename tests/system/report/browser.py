"""report.html in a headless browser, as wide as a desk and as a phone, and printed.

    browser.py <folder with the programs, not used> [folder for the screenshots]

The page has to render with all its figures, ask nobody for anything, log no error and fit the width of a phone. Without
chromium the test is skipped (exit status 77).
"""

import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

import matplotlib.image
import numpy as np

from synthetic_chain import write_chain
from whole_page import report

SKIPPED = 77
VIEWS = {"desk": (1400, 900), "phone": (390, 844)}
# Ahead of the page: nothing but the page itself may be loaded, and what is complained about is kept.
GUARD = """<meta http-equiv="Content-Security-Policy" content="default-src 'unsafe-inline' data:"><script>
const said = [], error = console.error
console.error = (...words) => said.push('console ' + words.join(' '))
addEventListener('error', e => said.push('error ' + (e.message || e.target.src)), true)
addEventListener('securitypolicyviolation', e => said.push('asks for ' + e.blockedURI))
</script>"""
# What the page looks like, for the page that it is embedded in; tables scroll up to their last column.
MEASURE = """<script>
addEventListener('load', () => {
  const right = e => e.getBoundingClientRect().right, width = document.documentElement.clientWidth, images = [...document.images]
  const tables = [...document.querySelectorAll('table')].map(t => {
    const box = t.closest('.scroll'), cell = t.rows[0].cells[t.rows[0].cells.length - 1]
    if (!box) return {words: t.textContent.slice(0, 40), box: 1e9, last: 0, wide: false}
    box.scrollLeft = 1e6
    const found = {words: t.textContent.slice(0, 40), box: right(box), last: right(cell), wide: box.scrollWidth > box.clientWidth + 1}
    box.scrollLeft = 0
    return found
  })
  parent.postMessage(JSON.stringify({said, tables, width: document.documentElement.scrollWidth, images: images.length,
    broken: images.filter(i => !i.naturalWidth).length, text: document.body.innerText.length,
    letter: parseFloat(getComputedStyle(document.body).fontSize),
    wide: [...document.querySelectorAll('body *')].filter(e => !e.closest('.scroll') && right(e) > width + 1).map(e => e.tagName)}), '*')
})
</script>"""
FRAME = """<body style="margin:0"><pre id="seen"></pre><iframe src="%s" width="%d" height="%d" style="border:0"></iframe>
<script>addEventListener('message', e => document.getElementById('seen').textContent = e.data)</script>"""


class Browser:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def call(self, url, *options):
        done = subprocess.run([self.program, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
                               "--virtual-time-budget=20000", "--user-data-dir=" + os.path.join(self.folder, "profile"), *options, url],
                              cwd=self.folder, capture_output=True, text=True, timeout=120)
        return done.stdout

    def measure(self, page, name):
        """What the page says of itself in a frame as wide as the view."""
        guarded, frame = (os.path.join(self.folder, word + ".html") for word in ("guarded", "frame"))
        with open(guarded, "w", encoding="utf-8") as file:
            file.write(page.replace("<head>", "<head>" + GUARD, 1).replace("</body>", MEASURE + "</body>", 1))
        with open(frame, "w", encoding="utf-8") as file:
            file.write(FRAME % ("guarded.html", *VIEWS[name]))
        seen = re.search(r'<pre id="seen">(.+?)</pre>', self.call("file://" + frame, "--dump-dom"), re.DOTALL)
        assert seen, f"{name}: the page says nothing of itself"
        return json.loads(html.unescape(seen[1]))


def problems_of(page, name):
    width = VIEWS[name][0]
    problems = list(page["said"])
    if page["width"] > width:
        problems.append(f"{page['width']} pixels wide on a screen of {width}: {page['wide'][:5]}")
    if page["images"] < 10 or page["broken"] or page["text"] < 2000 or page["letter"] < 14:
        problems.append(f"not all there: {page['images']} images, {page['broken']} broken, {page['text']} letters of {page['letter']} pixels")
    problems += [f"table ends at pixel {t['box']:.0f}, its last column at {t['last']:.0f} of {width}: {t['words']}"
                 for t in page["tables"] if t["box"] > width or t["last"] > t["box"] + 1]
    if name == "phone" and not any(t["wide"] for t in page["tables"]):
        problems.append(f"no table of {len(page['tables'])} is wider than the screen, so scrolling was not tested")
    return [f"{name}: {problem}" for problem in problems]


def looks(browser, url, shots):
    """A screenshot with colours and without a blank screen, and a PDF of some pages."""
    width, height = VIEWS["desk"]
    picture, pdf = (os.path.join(shots, name) for name in ("desk.png", "printed.pdf"))
    browser.call(url, f"--window-size={width},{6 * height}", "--screenshot=" + picture)
    pixels = matplotlib.image.imread(picture)[..., :3]
    blank = [k for k in range(0, pixels.shape[0] - height + 1, height) if pixels[k:k + height].std() < 0.02]
    if blank or np.ptp(pixels, axis=2).max() < 0.2:
        yield f"blank at pixels {blank} of {pixels.shape[0]}"
    browser.call(url, "--print-to-pdf=" + pdf)
    with open(pdf, "rb") as file:
        pages = len(re.findall(rb"/Type /Page\b", file.read()))
    if not 3 <= pages <= 40:
        yield f"printed: {pages} pages"


def main():
    program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if program is None:
        print("skipped: the report is looked at with chromium, which is not installed")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="mesoslip-browser-") as root:
        shots = os.path.abspath(sys.argv[2]) if len(sys.argv) > 2 else root
        os.makedirs(shots, exist_ok=True)
        write_chain(os.path.join(root, "chain"))
        page, browser = report(root, os.path.join(root, "chain")), Browser(program, root)
        problems = [p for name in VIEWS for p in problems_of(browser.measure(page, name), name)]
        problems += looks(browser, "file://" + os.path.join(root, "report.html"), shots)
        # The checks see what they look for.
        bad = page.replace("<body>", "<body><p style='width:500px'>x</p><script>console.error(1)</script><img src='http://localhost:9/x.png'>", 1)
        seen = " ".join(problems_of(browser.measure(bad, "phone"), "phone"))
        problems += [f"not seen: {word}" for word in ("asks for http", "console", "pixels wide") if word not in seen]
    assert not problems, "\n".join(problems)


if __name__ == "__main__":
    main()
