"""doc/guide/tomogram.md by the letter: the scan is what its script draws and segments, and what the page says is printed is printed."""

import importlib.util
import os
import re
import tempfile

import numpy as np
from scipy import ndimage

import first_steps
from scenes import TOP, Folder, run_chain

EXAMPLE = os.path.join(TOP, "prm", "examples", "tomogram")
BODY = (slice(6, -6),) * 3  # what file 10 cuts out


def script(name):
    spec = importlib.util.spec_from_file_location(name, os.path.join(EXAMPLE, name + ".py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def check_scan(text):
    """The arrays of the example, and what the page says of filter and crop."""
    grey, phases = (np.load(os.path.join(EXAMPLE, name + ".npy")) for name in ("tomogram", "phases"))
    assert np.abs(script("tomogram").draw().astype(int) - grey).max() <= 1
    assert np.array_equal(script("segment").segment(grey), phases), "segment.py does not make phases.npy"
    shares = [f"{100 * found[BODY].mean():.1f} %" for found in (phases, grey >= 127)]
    pieces = [str(ndimage.label(found[BODY])[1]) for found in (phases, grey >= 127)]
    plain = " ".join(text.split())
    for word in (f"{100 * phases.mean():.1f} %", *shares, *pieces):
        assert word in plain, (word, shares, pieces)


def check_cells(text):
    """The table of stiffness against cells."""
    rows = re.findall(r"^\| (\d) \| (\d+) x (\d+) x (\d+) \| [\d.]+ \| ([\d.]+) \| ([\d.]+) \|", text, re.MULTILINE)
    assert len(rows) == 3
    for coarsening, nx, ny, nz, d11, d33 in rows:
        with tempfile.TemporaryDirectory() as path:
            printed = Folder(path).run(0, "rve_homogenization", os.path.join(EXAMPLE, "10-rve_homogenization.prm"), "--output", "out",
                                       "--set", f"Microstructure/Coarsening={coarsening}", "--set", f"Grid/Cells={nx},{ny},{nz}")
            D = np.array(Folder(path).summary("out")["stiffness"]["effective"]) / 1e9
        assert np.allclose([D[0, 0], D[2, 2]], [float(d11), float(d33)], rtol=1e-3), (coarsening, D, printed)


def main():
    text = Folder(TOP).read("doc", "guide", "tomogram.md").decode()
    check_scan(text)
    first_steps.check_validation(text)
    check_cells(text)
    with tempfile.TemporaryDirectory() as folder:
        first_steps.check_outputs(text, run_chain(EXAMPLE, "--output", os.path.join(folder, "results"), "--no-report"), fewest=12)
    print("ok")


if __name__ == "__main__":
    main()
