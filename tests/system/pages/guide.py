#!/usr/bin/env python3
"""doc/guide.md and doc/guide/squeal.md by the letter: the micrograph is what its script writes and segments, the commands run, and
what the pages say is printed is printed."""

import importlib.util
import os
import re
import sys
import tempfile

import numpy as np
from PIL import Image, ImageFilter
from scipy import ndimage

import first_steps
from scenes import TOP, Folder, run_chain

sys.path.insert(0, os.path.join(TOP, "applications", "tools", "python"))
import mesoslip

EXAMPLE = os.path.join(TOP, "prm", "examples", "micrograph")


def script(path):
    spec = importlib.util.spec_from_file_location("script", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def check_pictures():
    """micrograph.png is that of micrograph.py, but for the last bit; phases.png is what the lines of the guide make of it."""
    with Image.open(os.path.join(EXAMPLE, "micrograph.png")) as file:
        grey = np.asarray(file)
    assert np.abs(script(os.path.join(EXAMPLE, "micrograph.py")).draw().astype(int) - grey).max() <= 1
    lines = re.findall(r"^ {4}(grey = Image.*\n {4}grey\.point.*)$", Folder(TOP).read("doc", "guide.md").decode(), re.MULTILINE)
    assert len(lines) == 1
    names = {"Image": Image, "ImageFilter": ImageFilter}
    with tempfile.TemporaryDirectory() as folder:
        code = lines[0].replace("    ", "").replace('"micrograph.png"', repr(os.path.join(EXAMPLE, "micrograph.png")))
        exec(code.replace('"phases.png"', repr(os.path.join(folder, "phases.png"))), names)
        with Image.open(os.path.join(folder, "phases.png")) as made, Image.open(os.path.join(EXAMPLE, "phases.png")) as kept:
            assert np.array_equal(np.asarray(made), np.asarray(kept))
            own = script(os.path.join(EXAMPLE, "segment.py")).segment(grey)
            assert np.array_equal(255 * own, np.asarray(kept)), "segment.py does not make phases.png"


def three_phases():
    """Grey values of 20 + 20 round grains in a matrix, with smoothed edges, noise, and light that falls by a third; and their phases."""
    random, height, width = np.random.default_rng(5), 240, 400
    y, x = np.mgrid[:height, :width]
    phases, taken = np.zeros((height, width), dtype=int), np.zeros((height, width), dtype=bool)
    for kind, radius in [(1, 15.0)] * 20 + [(2, 10.0)] * 20:
        while True:
            distance = np.hypot(x - random.uniform(0, width), y - random.uniform(0, height))
            if not taken[distance < radius + 5].any():
                break
        phases[distance < radius] = kind
        taken |= distance < radius
    smooth = np.asarray(Image.fromarray(np.array([70, 130, 195], dtype=np.uint8)[phases]).filter(ImageFilter.GaussianBlur(1)))
    lit = smooth * np.linspace(1.2, 0.8, width) + random.normal(0, 10, phases.shape)
    return np.clip(lit, 0, 255).astype(np.uint8), phases


def check_three_phases(text):
    """What even light and the removal of rims are worth."""
    grey, phases = three_phases()
    segment = script(os.path.join(EXAMPLE, "segment.py"))
    segment.THRESHOLDS = [int(x) for x in re.search(r"THRESHOLDS = \[(\d+), (\d+)\]", text).groups()]
    filtered = np.asarray(Image.fromarray(grey).filter(ImageFilter.MedianFilter(5)))
    thresholds = np.searchsorted(segment.THRESHOLDS, filtered)
    segment.UNEVEN_LIGHT = int(re.search(r"UNEVEN_LIGHT = (\d+)", text)[1])
    evened = np.searchsorted(segment.THRESHOLDS, segment.evened(filtered))
    both = segment.segment(grey)
    wrong = [np.mean(found != phases) for found in (thresholds, evened, both)]
    grains = [sum(ndimage.label(found == k)[1] for k in (1, 2)) for found in (thresholds, evened, both)]
    drawn = sum(ndimage.label(phases == k)[1] for k in (1, 2))
    assert grains[2] == drawn == 40 < min(grains[:2]), (grains, drawn, wrong)
    assert wrong[0] > wrong[1] > wrong[2] and wrong[0] > 0.03 and wrong[2] < 0.02, wrong


def check_spot():
    """Large bright grains, as coins, under a lamp beside the picture, whose light falls by more than half along a curve: no threshold fits all, and no
    plane fits the light. The borders are drawn around the grains."""
    y, x = np.mgrid[:300, :380]
    centres = [(45 + 58 * i, 50 + 65 * j) for i in range(6) for j in range(4)]
    grains = np.any([np.hypot(x - cx, y - cy) < 22 for cx, cy in centres], axis=0)
    light = 0.4 + 0.75 * np.exp(-((x - 60) ** 2 + (y - 40) ** 2) / 180.0**2)
    grey = np.clip(np.where(grains, 190, 95) * light + np.random.default_rng(1).normal(0, 5, x.shape), 0, 255).astype(np.uint8)
    segment = script(os.path.join(EXAMPLE, "segment.py"))
    wrong = {}
    for segment.UNEVEN_LIGHT in (0, 150):
        found = []
        for threshold in range(40, 160, 5):
            segment.THRESHOLDS = [threshold]
            found.append(np.mean(segment.segment(grey) != grains))
        wrong[segment.UNEVEN_LIGHT] = min(found)
    assert wrong[0] > 0.05 and wrong[150] < 0.01, wrong
    red = np.all(segment.checked(grey, grains.astype(int)) == (255, 0, 0), axis=-1)
    around = ndimage.binary_dilation(grains) & ndimage.binary_dilation(~grains)
    assert red.any() and not np.any(red & ~around), "borders"


def check_refusal(text):
    """The grey picture is refused in the sentence that the guide quotes."""
    said = re.search(r"^ {4}rve_homogenization: micrograph\.png: (.*)$", text, re.MULTILINE)[1]
    with tempfile.TemporaryDirectory() as folder:
        printed = Folder(folder).run(2, "rve_homogenization", os.path.join(EXAMPLE, "10-rve_homogenization.prm"), "--set", "Microstructure/File="
                                     + os.path.join(EXAMPLE, "micrograph.png"))
    assert said in printed, printed


def check_cells(text):
    """The table of stiffness against cells, but for its finest grid."""
    rows = re.findall(r"^\| (\d+) x (\d+) \| [\d.]+ \| ([\d.]+) \| ([\d.]+) \|", text, re.MULTILINE)
    assert len(rows) == 5
    for columns, n_rows, d11, d22 in rows[:4]:
        with tempfile.TemporaryDirectory() as folder:
            printed = Folder(folder).run(0, "rve_homogenization", os.path.join(EXAMPLE, "10-rve_homogenization.prm"), "--set",
                                         f"Grid/Cells={columns},{n_rows}", "--output", "out")
        found = re.search(r"effective +([\d.]+) +[\d.]+ +[\d.]+ +([\d.]+)", printed).groups()
        assert np.allclose([float(x) for x in found], [float(d11), float(d22)], rtol=1e-3), (columns, found)


def check_cut_grains(text, results):
    """The table of errors in the grains that an edge cuts, with the tensors of KUBC and of MUBC: as many grains and such errors."""
    made = Folder(results)
    made.run(0, "rve_homogenization", "10-rve_homogenization.prm", "--set", "Homogenization/Boundary conditions=KUBC, SUBC, MUBC", "--output", "mixed")
    made.run(0, "stress_localization", "40-stress_localization.prm", "--set", "Input/RVE file=mixed/rve.h5", "--set",
             "Localization/Concentration=MUBC", "--output", "localized")
    fields = []
    for name in ("40-stress_localization", "localized"):
        with mesoslip.open(os.path.join(results, name)) as run:
            fields.append(np.asarray(run["mean_von_mises"]))
            direct = np.asarray(run["direct/mean_von_mises"])
    with mesoslip.open(os.path.join(results, "10-rve_homogenization")) as run:
        grains, _ = ndimage.label(np.asarray(run["phase/id"]) == 1)
    for edges, said in (("left and right", [grains[:, 0], grains[:, -1]]), ("lower", [grains[0]]), ("upper", [grains[-1]])):
        cut = sorted(set(np.concatenate(said)) - {0})
        row = f"| {len(cut)} |"
        for localized in fields:
            errors = [100 * np.linalg.norm((localized - direct)[grains == k]) / np.linalg.norm(direct[grains == k]) for k in cut]
            row += f" {min(errors):.0f} to {max(errors):.0f} % |"
        assert re.search(rf"^\| {edges} \| [^|]* {re.escape(row)}$", text, re.MULTILINE), (edges, row)
    whole = [f"{100 * np.linalg.norm(localized - direct) / np.linalg.norm(direct):.0f} %" for localized in fields]
    assert f"| all cells | | | {whole[0]} | {whole[1]} |" in text, whole


def check_squeal():
    """Every quoted line of the page is printed by one of its two runs."""
    text = Folder(TOP).read("doc", "guide", "squeal.md").decode()
    with tempfile.TemporaryDirectory() as folder:
        printed = "".join(Folder(folder).run(0, "contact_dynamics", os.path.join(TOP, prm), "--output", name) for prm, name in
                          re.findall(r"build/applications/contact_dynamics (\S+) --output (\S+)", text))
    lines = [line.strip() for line in printed.split("\n")]
    said = [line.strip() for line in re.findall(r"^ {4}((?:\d+ (?:contact|growing)|  mode|mu_inter).*)$", text, re.MULTILINE)]
    assert len(said) == 9, said
    missing = [line for line in said if not any(first_steps.same(line, other) for other in lines)]
    assert not missing, "the guide says what is not printed:\n" + "\n".join(missing) + "\n" + printed


def main():
    text = Folder(TOP).read("doc", "guide.md").decode()
    check_pictures()
    check_refusal(text)
    first_steps.check_validation(text)
    check_three_phases(text)
    check_spot()
    check_cells(text)
    check_squeal()
    with tempfile.TemporaryDirectory() as folder:
        results = os.path.join(folder, "results")
        first_steps.check_outputs(text, run_chain(EXAMPLE, "--output", results, "--no-report"))
        check_cut_grains(text, results)
    print("ok")


if __name__ == "__main__":
    main()
