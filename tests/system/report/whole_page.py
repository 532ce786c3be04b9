"""make_report.py on synthetic result folders: the complete chain, every subset, broken files; and on a box in 3D that is run.

    whole_page.py <folder with the programs> [folder to keep the synthetic chain in]
"""

import contextlib
import html
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse
import warnings
from unittest import mock

import h5py
import numpy as np

from scenes import PHASES, TOOLS, Folder, prm

sys.path.insert(0, TOOLS)

from matplotlib.figure import Figure  # noqa: E402
from report import make_report  # noqa: E402
from report.base.common_scales import comparable  # noqa: E402
from report.base.data import Chain  # noqa: E402
from report.bodies import contact_surface, loads  # noqa: E402
from report.runs import key_numbers, probes, verdict  # noqa: E402
from synthetic_chain import add_to_summary, write, write_analyses, write_chain, write_foreign_body  # noqa: E402



def check_localization(page):
    """Errors of a stress that is 2 % too large have a plus, though it is compression; regions in words, with what is not known left out."""
    row = re.search(r"<tr><td class=\"text\">A</td><td class=\"text\">σ<sub>yy</sub></td>(.*?)</tr>", page)[1]
    mean, direct, error = re.findall("<td>(.*?)</td>", row)[:3]
    assert mean.startswith("−") and direct.startswith("−") and error == "+2.0 %", row
    rows = re.findall(r'<td class="text">([^<]*)</td><td>([^<]*)</td></tr>', page[page.index("<th>von Mises</th>"):])
    assert rows[:7] == [("all cells", "25 %"), ("interior", "3.10 %"), ("surface", "48 %"), ("surface without its ends", "11 %"),
                        ("phase matrix", "5.80 %"), ("phase matrix, interior", "3.30 %"), ("phase surface", "55.0 %")], rows


def check_words(page, folder):
    """How many blocks would show waves; which words the page explains; what localization was made with."""
    text = re.sub("<.*?>", "", re.sub('"data:[^"]*"', "", page))
    blocks, needed = map(int, re.search("Observation/Blocks is (\\d+); with (\\d+) or more they would show waves", text).groups())
    period = 1 / Folder(folder).summary()["main_frequency"]
    assert blocks == 80 and 48 <= 6 * period / (1e-3 / needed) < 48 + 10 * 6 * period / 1e-3, (blocks, needed)
    words = re.findall("<li><b>(.*?)</b>", page)
    assert "KUBC" in words and "The paper" in words and "Regime" in words and "P S |V|" not in words, words
    assert "Localized with the tensors of KUBC. The interior lies at least 1.6 mm from all edges; the surface is what lies within 0.4 mm" in text
    assert "MUBC are better for them" in text and "Averaged from 0.7 ms to 1 ms, over 2 snapshots." in text
    assert "The steady part of" not in text, "a window in the steady parts"


def localize_with_other_tensors(folder):
    """Another window and tensors, and a parameters.prm of elsewhere."""
    Folder(folder).write("parameters.prm", prm({"Input/Homogeneous run": "/of/another/machine/homogeneous/dynamics.h5"}))
    add_to_summary(folder, concentration="MUBC", window=[1e-4, 2e-4])


def check_other_tensors(page):
    """Advice on MUBC is given for other tensors; a window before the steady part of a run that it compares is said."""
    text = re.sub("<.*?>", "", re.sub('"data:[^"]*"', "", page))
    assert "with the tensors of MUBC." in text and "MUBC are better" not in text and "The interior lies" not in text
    assert "The steady part of the homogeneous run begins after that, at 300 µs;" in text and "of the heterogeneous run begins" not in text


def check_error_of_mean():
    """None where the direct mean is small beside its deviation, or has the other sign."""
    assert [probes.error_of_mean(*found) for found in ((1.02, 1.0, 5.0), (1.0, 0.04, 0.5), (1.0, -1.0, 0.1), (-1.1, -1.0, 0.0))] == \
        ["+2.0 %", "–", "–", "+10.0 %"]


def verdict_of(folders):
    """{the first words of a sentence: the whole with its mark}"""
    text = verdict.verdict(None, Chain(folders))
    sentences = [html.unescape(re.sub("<.*?>", "", item)) for item in re.findall("<li>(.*?)</li>", text)]
    return {re.sub("^Care: ", "", sentence)[:15]: sentence for sentence in sentences}


def check_verdict(root, folders):
    """What the runs say together, of a chain as it should be, and of one with every fault; nothing of a run without results."""
    good = verdict_of(folders)
    assert good["Stiffness of rv"] == "Stiffness of rve: the bounds KUBC and SUBC differ by 2.0 % at most (D11).", good
    assert "41.32 kHz and 41.32 kHz, 0 % apart." in good["Main frequencie"] and "0.2190 and 0.2140, 2.3 % apart." in good["Global interfac"], good
    assert good["Mean stresses o"] == "Care: Mean stresses of localization differ from direct ones by 25 % (von Mises, all cells; 3.1 % in the interior).", good
    assert [sentence[:5] for sentence in good.values()].count("Care:") == 1 and len(good) == 4, good
    bad = [shutil.copytree(folder, os.path.join(root, "bad", os.path.basename(folder))) for folder in folders]
    add_to_summary(bad[0], ensemble={"members": 4, "KUBC": {"mean": np.diag([3.0, 9, 2]).tolist()}, "SUBC": {"mean": np.diag([2.0, 3, 2]).tolist()}})
    add_to_summary(bad[1], main_frequency=53717.3, limit_cycle_reached=True, warnings=["a", "b"])
    add_to_summary(bad[2], limit_cycle_reached=False, limit_cycle="No limit cycle by t = 1 s: x (the criterion: y)")
    found = verdict_of(bad)
    assert "by a factor of 3 at most (D22): this piece alone" in found["Stiffness of rv"] and found["Main frequencie"].startswith("Care:"), found
    assert "53.72 kHz and 41.32 kHz, 30 % apart; they do not vibrate alike" in found["Main frequencie"], found
    assert found["No limit cycle "] == "Care: No limit cycle in the run heterogeneous by t = 1 s: x. Its means may still change.", found
    assert found["Limit cycle rea"] == "Limit cycle reached: homogeneous." and found["2 warnings of t"] == "Care: 2 warnings of the programs below (homogeneous).", found
    add_to_summary(bad[1], limit_cycle="Steady sliding from 1 s on")
    assert verdict_of(bad)["Steady sliding,"] == "Steady sliding, without vibration: homogeneous." and "Limit cycle rea" not in verdict_of(bad)
    add_to_summary(bad[2], pressure=1.0)
    assert "Main frequencie" not in verdict_of(bad) and verdict_of(folders[1:2]) == {}, "runs under other loads, and a run alone"


def check_tables(root):
    """Steps in the order of their numbers; couplings that are not round-off but round to zero are left out; stresses of a column have one
    unit, and boundary conditions the order of theory."""
    names = ["20-b", "50-a", "30-c", "60-d", "40-e"]
    for name in names:
        write(os.path.join(root, "order", name), "dynamics.h5", {"program": "stress_localization" if name == "40-e" else "contact_dynamics"}, {})
    assert [run.name for run in Chain([os.path.join(root, "order", name) for name in names]).runs] == sorted(names)
    matrix = 1e9 * (np.diag([30.0] * 6) + 1e-4 * np.ones((6, 6)))
    matrix[0, 5] = 2e7
    entries, left_out = key_numbers.stiffness_entries({"KUBC": matrix}, (1e9, "GPa", 2))
    assert len(entries) == 10 and entries[3][1:] == (0, 5) and abs(left_out - 1e5) < 1, (entries, left_out)
    assert not key_numbers.apart({"KUBC": matrix}) and "0.0" not in key_numbers.apart({"KUBC, mean of 2": 2 * matrix, "SUBC, mean of 2": matrix})
    state = {"xx": 1e3, "yy": 0.0, "xy": 0.0}
    phase = lambda stress: {"von_mises": dict.fromkeys(("mean", "standard_deviation", "maximum"), stress) | {"maximum_at": [0, 0]},
                            "principal_1": {"maximum": stress}}
    entry = lambda name, condition: {"name": name, "condition": condition, "strain": state, "stress": state, "phases": {"a": phase(3e3), "b": phase(2e6)}}
    add_to_summary(os.path.join(root, "order", "40-e"), loads=[entry(name, condition) for name in "zy" for condition in ("KUBC", "MUBC", "SUBC")])
    run = Chain([os.path.join(root, "order", "40-e")]).runs[0]
    assert [load["name"] + load["condition"] for load in loads.loads_of(run)] == ["zSUBC", "zMUBC", "zKUBC", "ySUBC", "yMUBC", "yKUBC"]
    assert "<td>0.00300 MPa</td>" in loads.tables(None, run) and "kPa" not in loads.tables(None, run)
    rows = probes.in_one_unit([["A", 2e3, "+1.0 %"], ["B", 3e6, "–"]])
    assert rows == [["A", "0.00200 MPa", "+1.0 %"], ["B", "3 MPa", "–"]], rows


def in_this_process(*words):
    """Exit status of make_report.py and what it says on standard error, without the second that its start takes."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as said, warnings.catch_warnings():
        return make_report.main(words), said.getvalue()


def unpainted(*words):
    """In this process, with pictures that are laid out and not painted: where words and numbers matter."""
    with mock.patch.object(Figure, "savefig", lambda figure, *_, **__: figure.draw_without_rendering()):
        return in_this_process(*words)


def in_its_own(*words):
    """The same as a user starts it."""
    done = subprocess.run([sys.executable, "-B", make_report.__file__, *words], capture_output=True, text=True, check=False)
    return done.returncode, done.stderr


def report(root, *folders, status=0, start=in_this_process):
    """The page, after checks that hold for every one."""
    output = os.path.join(root, "report.html")
    if os.path.exists(output):
        os.remove(output)
    found, said = start("--output", output, *folders)
    assert found == status, f"{folders}: status {found}\n{said}"
    assert "Traceback" not in said and "Warning" not in said, said
    if status:
        assert said and not os.path.exists(output)
        return ""
    page = Folder(root).read("report.html").decode()
    assert page.endswith("</html>\n") and "Traceback" not in page
    check_links(root, page)
    check_data(page)
    return page


def check_links(root, page):
    """Pictures and data are in the page; other links are relative and lead to files; no path of this machine is told."""
    assert not re.search(r'src="(?!data:)', page), "the page is not self-contained"
    for link in re.findall(r'href="(?!data:)([^"]*)"', page):
        where = os.path.join(root, urllib.parse.unquote(html.unescape(link)))
        assert f'id="{link[1:]}"' in page if link.startswith("#") else not os.path.isabs(link) and os.path.isfile(where), link
    told = re.sub(r'"data:[^"]*"', "", page)
    assert root not in told and "/home/" not in told and "/root/" not in told, re.findall(".{60}" + root + ".{60}", told)


def check_data(page):
    """Beside every figure stands its data as CSV, with numbers and what they are; alternative texts are whole."""
    for number, figure in enumerate(re.findall("<figure.*?</figure>", page, re.DOTALL), 1):
        found = re.search(r'download="figure-(\d+).csv" href="data:text/csv;charset=utf-8,([^"]*)"', figure)
        assert found and int(found[1]) == number, f"figure {number} has no data: " + re.sub(r'"data:[^"]*"', "", figure)
        lines = urllib.parse.unquote(found[2]).splitlines()
        rows = [line for line in lines if not line.startswith("#")]
        assert rows[0] == "panel,curve,x,y,value" and len(rows) > 2 and lines[0].startswith("# panel 1"), rows[:2]
        assert all(float(x) == float(x) for row in rows[1:4] for x in row.split(",")[2:4]), rows[:4]
        assert len(found[2]) < 3e5, f"figure {number}: data of {len(found[2])} letters"
        assert not re.search(r"\d$", re.search('alt="([^"]*)"', figure)[1]) or "t =" in figure, "an alternative text cut at a decimal point"


def run_box(folder):
    """A chain of a box in 3D, three times as long as wide; its folders."""
    homogenize = PHASES + prm({"Grid/Cells": "12, 4, 5", "Grid/Size": "12e-4, 4e-4, 5e-4", "Microstructure/Type": "voxels",
                               "Microstructure/File": "voxels.npy"})
    slide = prm({"Body/RVE file": "rve/rve.h5", "Time/Time step": 5e-9, "Time/End time": 2e-6, "Supports/Top/Kind": "platen", "Supports/Top/Pressure": 5e6,
                 "Snapshots/Interval": 2e-7, "Observation/History interval": 1})
    localize = prm({"Input/RVE file": "rve/rve.h5", "Input/Homogeneous run": "homogeneous/dynamics.h5",
                    "Input/Direct run": "heterogeneous/dynamics.h5"})
    solid = "set Dimension = 3\n"
    folder = Folder(folder, {"rve": solid + homogenize, "homogeneous": solid + slide, "localization": localize,
                             "heterogeneous": solid + slide + prm({"Body/Material": "heterogeneous"})})
    np.save(folder("voxels.npy"), np.random.default_rng(3).integers(0, 2, (5, 4, 12), dtype=np.uint8))
    names = {"rve": "rve_homogenization", "homogeneous": "contact_dynamics", "heterogeneous": "contact_dynamics",
             "localization": "stress_localization"}
    for name, program in names.items():
        folder.run(0, program, name + ".prm", "--output", name)
    return [folder(name) for name in names]


def check_scales(folders):
    """Pressures of runs under one pressure have one scale, that of the larger values; another pressure has its own."""
    runs = Chain(folders).transient
    shown = comparable(runs[0], runs)
    ends = [contact_surface.pressure_ends(run) for run in runs]
    assert len(shown) == 2 and ends[0] != ends[1], ends
    for run in runs:
        figure, _ = contact_surface.pressure(run, shown)
        limits = 1e6 * np.array(next(found.get_clim() for axes in figure.axes for found in axes.collections if found.get_array() is not None))
        assert np.allclose(limits, [min(low for low, _ in ends), max(high for _, high in ends)], rtol=1e-12), (run.name, limits, ends)
    runs[1].summary["pressure"] = 1.0
    assert comparable(runs[0], runs) == (runs[0],)


def check_box(root):
    """Pictures of the contact surface and of planes through the middle."""
    folders = run_box(os.path.join(root, "box"))
    page = report(root, *folders)
    captions = " ".join(re.sub("<.*?>", "", caption) for caption in re.findall("<figcaption>(.*?)</figcaption>", page))
    assert "while drawing" not in page, re.findall("Left out[^<]*", page)
    for expected, count in [("Phases of rve, in the planes through the middle", 1), ("Shares of time that the contact nodes", 2),
                            ("Von Mises stress of the last snapshot", 2), ("Pressure on the contact surface of the", 2),
                            ("Von Mises stress averaged over time, in the planes through the middle: localized", 1),
                            ("Pressure on the contact surface, seen along z", 1), ("means of strips of the contact surface across", 2),
                            ("Shares of the contact nodes of the", 2), ("Spectrogram of the tangential velocity", 2),
                            ("Shares of time each contact node", 0)]:
        assert captions.count(expected) == count, f"{expected}: {captions.count(expected)} instead of {count}"
    assert captions.count("It is the same for all runs with this pressure.") == 4, captions
    check_scales(folders)
    page = report(root, folders[2], start=unpainted)
    assert "It is the same for all runs" not in page, "a run alone"
    assert "Phases of the body of heterogeneous, in the planes through the middle" in page, "phases of a run alone"
    page = report(root, folders[3])
    assert "tells its contact surface" in page and "while drawing" not in page, "a localization without its runs"


def main():
    root = tempfile.mkdtemp(prefix="mesoslip-report-")
    try:
        if len(sys.argv) > 2:
            write_chain(sys.argv[2])
        write_chain(os.path.join(root, "chain"))
        folders = [os.path.join(root, "chain", name) for name in ("rve", "homogeneous", "heterogeneous", "localization")]

        page = report(root, *folders, start=in_its_own)
        assert "Left out" not in page, re.findall("Left out[^<]*", page)
        assert page.count("<img") == 20, page.count("<img")
        assert "0.2190" in page and "−0.5 %" in page, "mu_inter 0.219 against 0.220"
        assert page.count("ahead of it by 50.00°") == 2, "phase of the normal motion"
        assert abs(float(re.search(r"in a period: ([0-9.]+) J/m²", page)[1]) / (np.pi * 1e5 * 3e-6) - 1) < 2e-3, "area of the loop"
        assert "36.90" in page and "(+1.0 %)" in page, "stiffness against eq. (10)"
        assert "Beside the paper" in page
        check_localization(page)
        check_words(page, folders[1])
        check_error_of_mean()
        check_verdict(root, folders)
        check_tables(root)
        own = os.path.join(root, "own")
        localize_with_other_tensors(folders[3])
        write_foreign_body(os.path.dirname(folders[0]), own)
        page = report(root, own, start=unpainted)
        assert page.count("<img") == 20 and "Left out" not in page, "a folder of folders"
        text = re.sub(r"data:[^\"]*|<pre>.*?</pre>", "", page, flags=re.DOTALL)
        assert "0.2190" in text and "36.90" in text
        assert not re.search(r"0\.2200|36\.54|regime 1,|figure 6|L2 below|Beside", text), "the paper's numbers beside another body"
        check_other_tensors(page)

        rve, heterogeneous, localization = alone = [report(root, folders[k], start=unpainted) for k in (0, 2, 3)]
        assert heterogeneous.count("<img") == 11 and "Left out" not in heterogeneous, "a run alone has its own stiffnesses and phases"
        assert "Morphology" not in localization, "no morphology without an RVE"
        assert "36.90" in rve and "KUBC, mean of" not in rve, "one volume"

        # Of an ensemble the means, in the heading and in the numbers; warnings of the runs.
        mean = (1e9 * np.array([[30.0, 9.0, 0], [9.0, 40.0, 0], [0, 0, 12.0]])).tolist()
        add_to_summary(folders[0], ensemble={"members": 7, "KUBC": {"mean": mean}, "SUBC": {"mean": mean}})
        page = report(root, folders[0], start=unpainted)
        assert "KUBC, mean of 7" in page and "30.00" in page, "means of the ensemble"
        assert "36.90" not in page, "the first member stands for the ensemble"
        add_to_summary(folders[1], mean_contact_duration_warning="T_G rests on 3 %",
                       warnings=["T_G rests on 3 %", "the unit of <P> looks wrong"])
        alone.append(report(root, folders[1], start=unpainted))
        page = alone[-1]
        assert all("Tension is positive" in page for page in alone)
        assert page.count("Warning: T_G rests on 3 %.") == 1 and "Warning: the unit of &lt;P&gt; looks wrong." in page

        # Analyses without a history.
        page = report(root, *write_analyses(root))
        assert "Left out" not in page and page.count("<img") == 2, "modes and tractions"
        assert "0.1348" in page and "2.538 µs" in page, "the homogenized friction law"
        assert "41.59 kHz" in page and "41.58 kHz" in page, "the mode nearest to one of the paper's"
        assert "2.100 MPa" in page and "+5.0 %" in page, "contact pressure of the fibres, table 4"

        check_box(root)

        # Files that are broken, empty, cut off, or not ours.
        shutil.copytree(folders[1], os.path.join(root, "cut"))
        with open(os.path.join(root, "cut", "dynamics.h5"), "r+b") as stream:
            stream.truncate(5000)
        assert "unreadable" in report(root, os.path.join(root, "cut"))
        with h5py.File(os.path.join(folders[1], "dynamics.h5"), "r+") as file:
            for name in ("/spectrum", "/history/apparent_friction", "/contact/blocks/stick"):
                del file[name]
            del file["/phase_diagram/velocity"]
            file["/phase_diagram/velocity"] = np.full(3, np.nan)
            file["/contact/blocks/stick"] = np.zeros((0, 3))
        page = report(root, folders[1])
        assert page.count("Left out") >= 4, page.count("Left out")
        write(os.path.join(root, "empty"), "dynamics.h5", {"program": "contact_dynamics"}, {})
        report(root, os.path.join(root, "empty"), os.path.join(root, "no such folder"))
        write(os.path.join(root, "other"), "other.h5", {"program": "something"}, {})
        report(root, os.path.join(root, "other"), status=2, start=in_its_own)
        Folder(root).write("other/summary.json", '{"program": ')
        report(root, os.path.join(root, "other"), status=2)
    finally:
        shutil.rmtree(root)
    print("report: complete, partial and broken chains are reported")


if __name__ == "__main__":
    main()
