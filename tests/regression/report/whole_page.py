"""make_report.py on synthetic result folders: the complete chain, every subset, broken files; and on a box in 3D that is run.

    whole_page.py <folder with the programs> [folder to keep the synthetic chain in]
"""

import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

import h5py
import numpy as np

from scenes import PHASES, TOOLS, Folder, prm

sys.path.insert(0, TOOLS)

from report.base.common_scales import comparable  # noqa: E402
from report.base.data import Chain  # noqa: E402
from report.bodies import contact_surface  # noqa: E402

MAKE_REPORT = os.path.join(TOOLS, "report", "make_report.py")
NX, NY, H = 140, 40, 4e-4
FREQUENCY = 41321.0


def write(folder, name, summary, datasets, attributes=None):
    Folder(folder).write("summary.json", json.dumps(summary))
    with h5py.File(os.path.join(folder, name), "w") as file:
        grid = file.create_group("grid")
        grid.attrs["cells"], grid.attrs["spacing"], grid.attrs["origin"] = [NX, NY], [H, H], [0.0, 0.0]
        for path, data in datasets.items():
            file[path] = data
        for path, (key, value) in (attributes or {}).items():
            file[path].attrs[key] = value


def add_to_summary(folder, **more):
    Folder(folder).write("summary.json", json.dumps({**Folder(folder).summary(), **more}))


def morphology():
    random = np.random.default_rng(4)
    ids = np.zeros((NY, NX), dtype=np.int32)
    while ids.mean() < 0.1:
        x, y, n = random.integers(NX), random.integers(-5, NY), random.integers(3, 9)
        ids[max(y, 0):max(y + n, 0), x] = 1
    return ids


def plane_strain(e, nu=0.2):
    f = e / ((1 + nu) * (1 - 2 * nu))
    return f * np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, (1 - 2 * nu) / 2]])


def write_rve(folder, ids):
    effective = 1e9 * np.array([[36.9, 9.2, 0], [9.2, 48.0, 0], [0, 0, 13.8]])
    random = np.random.default_rng(1)
    concentration = np.eye(3) + 0.1 * random.standard_normal((NY, NX, 3, 3)) - 0.5 * ids[..., None, None] * np.eye(3)
    write(folder, "rve.h5",
          {"program": "rve_homogenization", "version": "0.2.0", "dim": 2, "cells": [NX, NY], "dofs": 11562,
           "ranks": 1, "seconds": {"total": 12.3}, "peak_memory_bytes": 2.1e8,
           "phases": [{"name": "matrix", "volume_fraction": 0.9}, {"name": "fibre", "volume_fraction": 0.1}],
           "hill_mandel_residual": 3e-12, "symmetry_residual": 1e-13},
          {"/phase/id": ids, "/phase/name": np.array([b"matrix", b"fibre"]),
           "/phase/stiffness": np.array([plane_strain(30e9), plane_strain(240e9)]),
           "/stiffness/KUBC": effective, "/stiffness/SUBC": 0.98 * effective,
           "/stiffness/effective": 0.99 * effective, "/concentration/KUBC": concentration})


def write_dynamics(folder, ids, heterogeneous):
    random = np.random.default_rng(2 + heterogeneous)
    time = np.arange(20001) * 5e-8
    w = 2 * np.pi * FREQUENCY
    grown = 1 / (1 + np.exp(-(time - 2e-4) / 3e-5))
    wave = np.sin(w * time) + 0.25 * np.sin(2 * w * time) + 0.12 * np.cos(3 * w * time)
    rate = np.cos(w * time) + 0.5 * np.cos(2 * w * time) - 0.36 * np.sin(3 * w * time)
    u, v = 3e-6 * grown * wave, 3e-6 * w * grown * rate
    friction = 0.22 - 0.03 * heterogeneous * grown + 0.6 * grown * wave
    energy = np.concatenate([[0], np.cumsum(56e3 * 0.22 * (1 + 0.3 * grown[1:] * wave[1:]) * 5e-8)])
    x = np.arange(NX + 1) * H
    separated = 0.3 + 0.2 * np.cos(6 * np.pi * x / x[-1])
    stick = np.full_like(x, 0.05)
    blocks = np.arange(1, 81) * 1.25e-5
    moving = np.clip(separated + 0.3 * np.sin(2 * np.pi * blocks[:, None] / 9e-5 + 90 * x), 0, 0.95)
    frequency = np.linspace(0, 1e7, 20001)
    line = lambda f, a: a / (1 + ((frequency - f) / 700) ** 2)
    amplitude = line(FREQUENCY, 3e-6) + line(2 * FREQUENCY, 8e-7) + line(3 * FREQUENCY, 4e-7)
    nodes = np.zeros((2, NY + 1, NX + 1, 2))
    nodes[:, :, :, 1] = -1e-7 * np.arange(NY + 1)[None, :, None] / NY
    nodes[:, :, :, 0] = 1e-6 * np.sin(np.pi * np.arange(NX + 1) / NX) * (1 - np.arange(NY + 1) / NY)[:, None]
    data = {
        "/history/time": time, "/history/apparent_friction": friction, "/history/friction_energy": energy,
        "/energy/time": time, "/energy/friction": energy, "/energy/external_work": 1.25 * energy,
        "/energy/kinetic": 0.4 * grown * (1 + wave**2), "/energy/elastic": 0.5 * grown * (1 + rate**2),
        "/energy/damping": 0.1 * energy, "/energy/scheme": 0.06 * energy, "/energy/impact": 0.02 * energy,
        "/energy/residual": 1e-11 * random.standard_normal(len(time)),
        "/probes/M/time": time, "/probes/M/displacement": np.stack([u, 1e-7 * wave], axis=1),
        "/probes/M/velocity": np.stack([v, 0 * v], axis=1),
        "/contact/x": x, "/contact/separated": separated, "/contact/stick": stick,
        "/contact/slip": 1 - separated - stick, "/contact/blocks/time": blocks,
        "/contact/blocks/separated": moving, "/contact/blocks/stick": 0.05 * np.ones_like(moving),
        "/contact/blocks/slip": 0.95 - moving, "/spectrum/frequency": frequency,
        "/spectrum/amplitude": amplitude * (1 + 0.3 * random.random(len(frequency))) + 1e-11,
        "/phase_diagram/displacement": 3e-6 * wave[-484:] * (1 - 0.1 * heterogeneous),
        "/phase_diagram/velocity": 3e-6 * w * rate[-484:] * (1 - 0.1 * heterogeneous),
        "/snapshots/time": np.array([5e-4, 1e-3]), "/snapshots/displacement": nodes}
    if heterogeneous:
        data["/material/phase_id"] = ids
        data["/material/name"] = np.array([b"matrix", b"fibre"])
        data["/material/stiffness"] = np.array([plane_strain(30e9), plane_strain(240e9)])
    write(folder, "dynamics.h5",
          {"program": "contact_dynamics", "version": "0.2.0", "dim": 2, "cells": [NX, NY], "analysis": "transient",
           "steps": 20000, "time_step": 5e-8, "critical_time_step": 7e-8, "simulated_time": 1e-3,
           "seconds": {"total": 31.0}, "peak_memory_bytes": 9.1e7,
           "global_interface_friction_coefficient": 0.219 - 0.005 * heterogeneous,
           "mean_apparent_friction_coefficient": 0.221 - 0.006 * heterogeneous, "main_frequency": FREQUENCY,
           "reference_node": {"slip": 0.72, "stick": 0.0, "separation": 0.28}, "friction_energy": energy[-1],
           "regime": "slip-separation, regime 1 (mostly slipping)", "energy_balance_residual": 2e-12,
           "steady_from": 3e-4}, data, {"/probes/M": ("position", [0.028, 0.0])})


def write_localization(folder, ids):
    random = np.random.default_rng(9)
    time = np.arange(5001) * 2e-7
    data, positions = {}, {}
    for name, scale, place in [("A", 2e6, [0.0281, 0.0001]), ("B", 4e5, [0.02, 0.008])]:
        wave = np.sin(2 * np.pi * FREQUENCY * time)
        direct = scale * np.stack([0.2 * wave, -1 + wave + 0.2 * wave**2, 0.3 * wave], axis=1)
        data[f"/probes/{name}/time"], data[f"/probes/{name}/direct_stress"] = time, direct
        data[f"/probes/{name}/stress"] = 1.02 * direct + 0.02 * scale * random.standard_normal(direct.shape)
        positions[f"/probes/{name}"] = ("position", place)
    y = (np.arange(NY) + 0.5)[:, None] / NY
    field = 4e5 * (1 + 3 * ids) * (1.3 - y) * (1 + 0.1 * random.random((NY, NX)))
    data["/mean_von_mises"], data["/direct/mean_von_mises"] = field, field * (1 + 0.03 * random.standard_normal((NY, NX)))
    write(folder, "localization.h5",
          {"program": "stress_localization", "version": "0.2.0", "cells": [NX, NY], "seconds": {"total": 2.2},
           "peak_memory_bytes": 1.1e8, "probes": [{"name": "A", "phase": "fibre"}, {"name": "B", "phase": "matrix"}],
           "phases": ["matrix", "surface"], "field_errors": FIELD_ERRORS},
          data, positions)


# A phase that is called as a region is.
FIELD_ERRORS = {"mean_von_mises": {"all": 0.25, "interior": 0.031, "surface": 0.48, "surface_inner": 0.11, "matrix": 0.058, "matrix_interior": 0.033,
                                   "phase_surface": 0.55, "phase_surface_interior": None}}


def check_localization(page):
    """Errors of a stress that is 2 % too large have a plus, though it is compression; regions in words, with what is not known left out."""
    row = re.search(r"<tr><td class=\"text\">A</td><td class=\"text\">σ<sub>yy</sub></td>(.*?)</tr>", page)[1]
    mean, direct, error = re.findall("<td>(.*?)</td>", row)[:3]
    assert mean.startswith("−") and direct.startswith("−") and error == "+2.0 %", row
    rows = re.findall(r'<td class="text">([^<]*)</td><td>([^<]*)</td></tr>', page[page.index("<th>von Mises</th>"):])
    assert rows[:7] == [("all cells", "25 %"), ("interior", "3.10 %"), ("surface", "48 %"), ("surface without its ends", "11 %"),
                        ("phase matrix", "5.80 %"), ("phase matrix, interior", "3.30 %"), ("phase surface", "55.0 %")], rows


def write_analyses(root):
    """Modes, static contact, homogenized friction law: folders of runs without a history."""
    x = np.linspace(0, 1, NX + 1)
    shape = np.zeros((3, NY + 1, NX + 1, 2))
    for k in range(3):
        shape[k, ..., 0] = np.cos((k + 1) * np.pi * x)
    modes = {"/modes/free/shape": shape, "/modes/free/frequency": np.array([39500.0, 41589.0, 6e4])}
    modal = {"program": "contact_dynamics", "analysis": "modal", "frequencies": [39500.0, 41589.0, 6e4]}
    static = {"program": "contact_dynamics", "analysis": "static contact",
              "phase_contact_pressures": {"matrix": 0.33e6, "fibre": 2.1e6},
              "phase_pressures_eq_19": {"matrix": 0.3e6, "fibre": 2.4e6}}
    tractions = {"/static_contact/x": 0.056 * x, "/static_contact/pressure": 5e5 * (1 + x),
                 "/static_contact/shear_traction": 1e5 * (1 + x)}
    law = {"program": "contact_dynamics", "analysis": "friction homogenization", "mu_homo": 0.13482, "delta": 2.538e-6,
           "estimates": [{"pressures": "static contact", "duration_of": "homogeneous", "mu_homo": 0.13482,
                          "mean_contact_duration": 5.1e-5, "delta": 2.538e-6, "delta_calibrated": None}]}
    write(os.path.join(root, "modal"), "modal.h5", modal, modes)
    write(os.path.join(root, "static"), "dynamics.h5", static, tractions)
    Folder(root).write("law/summary.json", json.dumps(law))
    return [os.path.join(root, name) for name in ("modal", "static", "law")]


def write_foreign_body(source, target):
    """The same chain for a body of another size, which is not the paper's."""
    shutil.copytree(source, target)
    for folder, _, names in os.walk(target):
        for name in names:
            if name.endswith(".h5"):
                with h5py.File(os.path.join(folder, name), "r+") as file:
                    file["grid"].attrs["spacing"] = [2 * H, 2 * H]


def write_chain(root):
    ids = morphology()
    write_rve(os.path.join(root, "rve"), ids)
    write_dynamics(os.path.join(root, "homogeneous"), ids, 0)
    write_dynamics(os.path.join(root, "heterogeneous"), ids, 1)
    write_localization(os.path.join(root, "localization"), ids)


def report(root, *folders, status=0):
    """The page, after checks that hold for every one."""
    output = os.path.join(root, "report.html")
    if os.path.exists(output):
        os.remove(output)
    done = subprocess.run([sys.executable, "-B", MAKE_REPORT, "--output", output, *folders], capture_output=True,
                          text=True, check=False)
    assert done.returncode == status, f"{folders}: status {done.returncode}\n{done.stderr}"
    assert "Traceback" not in done.stderr and "Warning" not in done.stderr, done.stderr
    if status:
        assert done.stderr and not os.path.exists(output)
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
    slide = prm({"Body/RVE file": "rve/rve.h5", "Time/Time step": 5e-9, "Time/End time": 2e-6, "Top/Kind": "platen", "Top/Pressure": 5e6,
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
    page = report(root, folders[2])
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

        page = report(root, *folders)
        assert "Left out" not in page, re.findall("Left out[^<]*", page)
        assert page.count("<img") == 16, page.count("<img")
        assert "0.2190" in page and "−0.5 %" in page, "mu_inter 0.219 against 0.220"
        assert "36.90" in page and "(+1.0 %)" in page, "stiffness against eq. (10)"
        assert "Beside the paper" in page
        check_localization(page)
        own = os.path.join(root, "own")
        write_foreign_body(os.path.dirname(folders[0]), own)
        page = report(root, own)
        assert page.count("<img") == 16 and "Left out" not in page, "a folder of folders"
        text = re.sub(r"data:[^\"]*|<pre>.*?</pre>", "", page, flags=re.DOTALL)
        assert "0.2190" in text and "36.90" in text
        assert not re.search(r"0\.2200|36\.54|regime 1,|figure 6|L2 below|Beside", text), "the paper's numbers beside another body"

        alone = [report(root, folder) for folder in folders]
        assert all("Tension is positive" in page for page in alone)
        assert alone[2].count("<img") == 9 and "Left out" not in alone[2], "a run alone has its own stiffnesses and phases"
        assert "Morphology" not in alone[3], "no morphology without an RVE"

        # Of an ensemble the means, in the heading and in the numbers; warnings of the runs.
        mean = (1e9 * np.array([[30.0, 9.0, 0], [9.0, 40.0, 0], [0, 0, 12.0]])).tolist()
        add_to_summary(folders[0], ensemble={"members": 7, "KUBC": {"mean": mean}, "SUBC": {"mean": mean}})
        page = report(root, folders[0])
        assert "KUBC, mean of 7" in page and "30.00" in page, "means of the ensemble"
        assert "36.90" not in page, "the first member stands for the ensemble"
        add_to_summary(folders[1], mean_contact_duration_warning="T_G rests on 3 %",
                       warnings=["T_G rests on 3 %", "the unit of <P> looks wrong"])
        page = report(root, folders[1])
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
        report(root, os.path.join(root, "other"), status=2)
        Folder(root).write("other/summary.json", '{"program": ')
        report(root, os.path.join(root, "other"), status=2)
    finally:
        shutil.rmtree(root)
    print("report: complete, partial and broken chains are reported")


if __name__ == "__main__":
    main()
