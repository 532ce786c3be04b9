"""report.html in a headless browser, as wide as a desk and as a phone, and printed.

    browser.py <folder with the programs, not used> [folder for the screenshots]

The page has to render with all its figures, ask nobody for anything, log no error and fit the width of a phone. Without
chromium the test is skipped (exit status 77).
"""

import base64
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile

import matplotlib.image
import numpy as np

import report

SKIPPED = 77
VIEWS = {"desk": (1280, 900, False), "phone": (390, 844, True)}


class Browser:
    """Chromium, spoken to in its DevTools protocol: JSON ending in a zero, over two pipes."""

    def __init__(self, program, profile):
        down, self.write_end = os.pipe()
        self.read_end, up = os.pipe()

        def connect():
            # The protocol's fixed descriptors; copies first, as the pipes may hold these numbers.
            source, sink = os.dup(down), os.dup(up)
            os.dup2(source, 3)
            os.dup2(sink, 4)

        self.process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--remote-debugging-pipe",
             "--hide-scrollbars", "--user-data-dir=" + profile, "about:blank"],
            preexec_fn=connect, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(down)
        os.close(up)
        self.rest, self.last, self.events, self.session = b"", 0, [], None

    def message(self):
        while b"\0" not in self.rest:
            chunk = os.read(self.read_end, 1 << 16)
            if not chunk:
                raise RuntimeError("chromium has ended")
            self.rest += chunk
        text, _, self.rest = self.rest.partition(b"\0")
        return json.loads(text)

    def call(self, method, **parameters):
        self.last += 1
        request = {"id": self.last, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        data = json.dumps(request).encode() + b"\0"
        while data:
            data = data[os.write(self.write_end, data):]
        while True:
            answer = self.message()
            if answer.get("id") == self.last:
                assert "error" not in answer, answer
                return answer["result"]
            self.events.append(answer)

    def wait_for(self, event):
        while not any(e.get("method") == event for e in self.events):
            self.events.append(self.message())

    def evaluate(self, expression):
        return self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)["result"]["value"]

    def open(self, url, width, height, mobile):
        if self.session is None:
            target = self.call("Target.createTarget", url="about:blank")["targetId"]
            self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
            for domain in ("Page", "Network", "Runtime", "Log"):
                self.call(domain + ".enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=mobile)
        self.events = []
        self.call("Page.navigate", url=url)
        self.wait_for("Page.loadEventFired")
        self.evaluate("Promise.all([...document.images].map(i => i.decode())).then(() => true)")

    def close(self):
        self.session = None
        self.call("Browser.close")
        self.process.wait(timeout=30)


def complaints(events, url):
    """Errors on the console, exceptions, and requests for anything but the page itself."""
    found = []
    for event in events:
        what, details = event.get("method"), event.get("params", {})
        if what == "Network.requestWillBeSent" and not details["request"]["url"].startswith(("data:", url)):
            found.append("asks for " + details["request"]["url"])
        if what == "Runtime.exceptionThrown" or (what == "Log.entryAdded" and details["entry"]["level"] == "error") or (
                what == "Runtime.consoleAPICalled" and details["type"] in ("error", "assert")):
            found.append(json.dumps(details)[:300])
    return found


def check_tables(browser, name):
    """Wide tables scroll in boxes of their own, up to their last column, and the page stays where it is."""
    width, _, mobile = VIEWS[name]
    tables = browser.evaluate("""[...document.querySelectorAll('table')].map(t => {
      const box = t.closest('.scroll'), cell = t.rows[0].cells[t.rows[0].cells.length - 1];
      if (!box) return {words: t.textContent.slice(0, 40), box: 1e9, last: 0, wide: false};
      box.scrollLeft = 1e6;
      const found = {words: t.textContent.slice(0, 40), box: box.getBoundingClientRect().right,
                     last: cell.getBoundingClientRect().right, wide: box.scrollWidth > box.clientWidth + 1};
      box.scrollLeft = 0;
      return found;})""")
    problems = [f"{name}: table ends at pixel {t['box']:.0f}, its last column at {t['last']:.0f} of {width}: {t['words']}"
                for t in tables if t["box"] > width or t["last"] > t["box"] + 1]
    if mobile and not any(t["wide"] for t in tables):
        problems.append(f"{name}: no table of {len(tables)} is wider than the screen, so scrolling was not tested")
    return problems


def check_view(browser, url, name, folder):
    width, height, mobile = VIEWS[name]
    browser.open(url, width, height, mobile)
    problems = [f"{name}: {complaint}" for complaint in complaints(browser.events, url)]
    page = browser.evaluate("""({
      width: document.documentElement.scrollWidth, height: document.documentElement.scrollHeight,
      images: document.images.length, broken: [...document.images].filter(i => !i.naturalWidth).length,
      wide: [...document.querySelectorAll('body *')].filter(e => !e.closest('.scroll') &&
            e.getBoundingClientRect().right > document.documentElement.clientWidth + 1).map(e => e.tagName + ' ' +
            e.textContent.slice(0, 40)),
      letter: parseFloat(getComputedStyle(document.body).fontSize), text: document.body.innerText.length})""")
    if page["width"] > width:
        problems.append(f"{name}: {page['width']} pixels wide on a screen of {width}: {page['wide'][:5]}")
    if page["images"] < 10 or page["broken"] or page["text"] < 2000 or page["letter"] < 14:
        problems.append(f"{name}: not all there: {page}")
    problems += check_tables(browser, name)
    shot = base64.b64decode(browser.call(
        "Page.captureScreenshot", format="png", captureBeyondViewport=True,
        clip={"x": 0, "y": 0, "width": width, "height": min(page["height"], 6000), "scale": 1})["data"])
    with open(os.path.join(folder, name + ".png"), "wb") as file:
        file.write(shot)
    pixels = matplotlib.image.imread(io.BytesIO(shot))[..., :3]
    # Something in every screen of the page, and colours among it.
    blank = [k for k in range(0, pixels.shape[0] - height + 1, height) if pixels[k:k + height].std() < 0.02]
    if blank or np.ptp(pixels, axis=2).max() < 0.2:
        problems.append(f"{name}: blank at pixels {blank} of {pixels.shape[0]}")
    return problems


def main():
    program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if program is None:
        print("skipped: the report is looked at with chromium, which is not installed")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="mesoslip-browser-") as root:
        shots = sys.argv[2] if len(sys.argv) > 2 else root
        os.makedirs(shots, exist_ok=True)
        report.write_chain(os.path.join(root, "chain"))
        report.report(root, os.path.join(root, "chain"))
        browser = Browser(program, os.path.join(root, "profile"))
        try:
            url = "file://" + os.path.join(root, "report.html")
            problems = [p for name in VIEWS for p in check_view(browser, url, name, shots)]
            printed = base64.b64decode(browser.call("Page.printToPDF", preferCSSPageSize=True)["data"])
            pages = printed.count(b"/Type /Page\n") or printed.count(b"/Type /Page ")
            if not printed.startswith(b"%PDF") or not 3 <= pages <= 40:
                problems.append(f"printed: {pages} pages")
            with open(os.path.join(shots, "printed.pdf"), "wb") as file:
                file.write(printed)
            # The checks see what they look for.
            with open(os.path.join(root, "report.html"), encoding="utf-8") as file:
                page = file.read()
            with open(os.path.join(root, "bad.html"), "w", encoding="utf-8") as file:
                file.write(page.replace("<body>", "<body><p style='width:500px'>x</p><script>console.error(1)</script>"
                                                  "<img src='http://localhost:9/x.png'>", 1))
            bad = "file://" + os.path.join(root, "bad.html")
            seen = " ".join(check_bad(browser, bad))
            problems += [f"not seen: {word}" for word in ("asks for http", "console", "pixels wide") if word not in seen]
        finally:
            browser.close()
    assert not problems, "\n".join(problems)
    print(f"report.html: {', '.join(VIEWS)} and {pages} printed pages")


def check_bad(browser, url):
    """Complaints about a page that is wrong in every way, without waiting for its image."""
    width, height, mobile = VIEWS["phone"]
    browser.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=mobile)
    browser.events = []
    browser.call("Page.navigate", url=url)
    browser.wait_for("Page.loadEventFired")
    found = complaints(browser.events, url)
    if any('"type": "error"' in complaint for complaint in found):
        found.append("console")
    if browser.evaluate("document.documentElement.scrollWidth") > width:
        found.append("pixels wide")
    return found


if __name__ == "__main__":
    main()
