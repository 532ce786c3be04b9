"""What the programs leave: units of every dataset, XDMF that ParaView reads, tables, logs, warnings."""

import csv
import glob
import os
import re
import tempfile
import xml.etree.ElementTree as xml

import h5py
import numpy as np

from scenes import PROGRAMS, TOP, Folder, prm

from served_study import ServedStudy

CHAIN = os.path.join(TOP, "tests", "system", "chains", "reference")
SMALL = {"Time/End time": 4e-6, "Snapshots/From": 1e-6, "Observation/Energy interval": 10}
STATIC = prm({"Analysis": "static contact", "Body/Material": "heterogeneous"})
MODAL = prm({"Analysis": "modal", "Body/Material": "heterogeneous", "Modal/Number of modes": 2})


def run_chain(folder, beside=True):
    """A chain with its shapes of modes, and `beside` it the runs that are looked at here alone."""
    study = ServedStudy(folder, PROGRAMS)
    study.add("rve", "rve_homogenization", os.path.join(CHAIN, "10-rve_homogenization.prm"))
    for name, number in [("homogeneous", 20), ("heterogeneous", 30)]:
        prm = os.path.join(CHAIN, f"{number}-contact_dynamics-{name}.prm")
        # The reference node and a probe at the left side of a cell of the fibre.
        study.add(name, "contact_dynamics", prm,
                  {**SMALL, "Body/RVE file": "{rve}/rve.h5", "Observation/Reference x": 0.0026,
                   "Observation/fibre_at_contact/Position": [0.0026, 0.0]})
    study.add("modal", "contact_dynamics", Folder(folder, {"modal": MODAL})("modal.prm"), {"Body/RVE file": "{rve}/rve.h5"})
    study.add("local", "stress_localization", os.path.join(CHAIN, "40-stress_localization.prm"),
              {"Input/RVE file": "{rve}/rve.h5", "Input/Homogeneous run": "{homogeneous}/dynamics.h5",
               "Input/Direct run": "{heterogeneous}/dynamics.h5", "Window/From": 1e-6})
    if beside:
        add_more(study)
    results = study.run()
    for name, result in results.items():
        assert result.status == 0, f"{name}: {result.message}"
    return results


def add_more(study):
    homogeneous = os.path.join(CHAIN, "20-contact_dynamics-homogeneous.prm")
    study.add("dense", "contact_dynamics", homogeneous,
              {"Body/RVE file": "{rve}/rve.h5", "Time/End time": 1e-6, "Snapshots/From": 5e-7, "Snapshots/Interval": 1e-12})
    study.add("at rest", "contact_dynamics", homogeneous,
              {"Body/RVE file": "{rve}/rve.h5", "Flat/Velocity": 0, "Observation/Energy interval": 1,
               "Observation/Steady from": 1.5e-5})
    study.add("statics", "contact_dynamics", Folder(study.folder, {"statics": STATIC})("statics.prm"), {"Body/RVE file": "{rve}/rve.h5"})
    study.add("mixed_rve", "rve_homogenization", os.path.join(CHAIN, "10-rve_homogenization.prm"),
              {"Homogenization/Boundary conditions": "MUBC", "Homogenization/Effective": "MUBC"})
    study.add("mixed", "stress_localization", os.path.join(CHAIN, "40-stress_localization.prm"),
              {"Input/RVE file": "{mixed_rve}/rve.h5", "Input/Homogeneous run": "{homogeneous}/dynamics.h5", "Input/Direct run": "",
               "Localization/Concentration": "MUBC", "Window/From": 1e-6})


def log_of(result):
    return Folder(result.folder).read("log.txt").decode()


def check_units(folder):
    """Every dataset of every file says its unit."""
    n, missing = 0, []
    for path in sorted(glob.glob(os.path.join(folder, "*", "*.h5"))):
        with h5py.File(path) as file:
            def visit(name, item):
                nonlocal n
                if isinstance(item, h5py.Dataset):
                    n += 1
                    if not item.attrs.get("unit"):
                        missing.append(f"{os.path.relpath(path, folder)}: {name}")
            file.visititems(visit)
    assert n > 150, n
    assert not missing, "datasets without the attribute unit:\n" + "\n".join(missing)


def check_xdmf(folder):
    """Vectors are vectors, so no plane grid has both; every array referred to has the shape it is said to have."""
    paths = sorted(glob.glob(os.path.join(folder, "*", "*.xdmf")))
    names = {os.path.relpath(path, folder) for path in paths}
    assert {"heterogeneous/dynamics.xdmf", "heterogeneous/dynamics-phases.xdmf", "homogeneous/dynamics.xdmf",
            "modal/modal-phases.xdmf", "rve/rve.xdmf", "local/localization.xdmf"} <= names, names
    assert "homogeneous/dynamics-phases.xdmf" not in names
    for path in paths:
        root = xml.parse(path).getroot()
        for grid in root.iter("Grid"):
            assert len({a.get("Center") for a in grid.findall("Attribute")}) <= 1, f"{path}: nodes and cells in one grid"
        for attribute in root.iter("Attribute"):
            if attribute.get("Name") in ("displacement", "bottom_free", "bottom_held"):
                assert attribute.get("AttributeType") == "Vector", (path, attribute.get("Name"))
        for item in root.iter("DataItem"):
            if item.get("Format") == "HDF":
                file, dataset = item.text.strip().split(":")
                with h5py.File(os.path.join(os.path.dirname(path), file)) as data:
                    stored = [n for n in data[dataset].shape if n > 1]
                said = [int(n) for n in item.get("Dimensions").split() if int(n) > 1]
                assert said == stored, (path, dataset, said, stored)


def check_localization(results):
    summary = results["local"].summary
    assert summary["dofs"] == 2 * 81 * 33, summary["dofs"]
    assert summary["phases"] == ["matrix", "fibre"]
    assert set(summary["field_errors"]["mean_von_mises"]) == {
        "all", "surface", "bulk", "interior", "surface_inner", "matrix", "matrix_interior", "fibre", "fibre_interior"}
    log = log_of(results["local"])
    assert "snapshots of the homogeneous run" in log
    assert not re.search(r"\d\.\d{9,}", log), "numbers with more digits than anyone reads:\n" + log


def check_mixed_conditions(results):
    """MUBC prescribe the orthotropic part of the mean of L alone: a smaller tolerance does not change the rest."""
    with h5py.File(os.path.join(results["mixed_rve"].folder, "rve.h5")) as file:
        defect = np.abs(file["concentration/MUBC"][()].mean(axis=(0, 1)) - np.eye(3))
    coupling = max(defect[2, :2].max(), defect[:2, 2].max())
    assert defect[:2, :2].max() < 1e-6 and defect[2, 2] < 1e-6 < coupling, defect
    log = log_of(results["mixed"])
    assert "smaller tolerance" not in log and ("couples shear to other strains" in log) == (coupling > 0.01), log


def check_reference_phase(results):
    for name, phase in [("heterogeneous", 1), ("homogeneous", 0)]:
        with h5py.File(os.path.join(results[name].folder, "dynamics.h5")) as file:
            assert file["probes/fibre_at_contact"].attrs["phase"] == phase, name
            assert file["reference"].attrs["phase"] == phase, name


def check_phase_means(results):
    """L of KUBC and PBC, B of SUBC; the mean over the phases is the identity."""
    with open(os.path.join(results["rve"].folder, "phase_means.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {(row["condition"], row["tensor"]) for row in rows} == {
        ("KUBC", "L (strain)"), ("SUBC", "B (stress)"), ("PBC", "L (strain)")}
    for condition in ("KUBC", "SUBC", "PBC"):
        mean = sum(float(row["fraction [-]"]) * float(row["mean_yy_yy [-]"])
                   for row in rows if row["condition"] == condition)
        assert abs(mean - 1.0) < 1e-9, (condition, mean)


def check_reused(results):
    """A second run reads rve.h5 and prints the same table."""
    said = Folder(CHAIN).run(0, "rve_homogenization", "10-rve_homogenization.prm", "--output", results["rve"].folder)
    log = log_of(results["rve"])
    assert "up to date" in said, said
    rows = re.findall(r"^(KUBC|SUBC|PBC|effective) +([\d. -]+)$", said, re.MULTILINE)
    assert len(rows) == 4, said
    for name, numbers in rows:
        assert f"{name} " in log and numbers.strip() in log
    effective = results["rve"].summary["stiffness"]["effective"]
    assert f"{effective[0][0] * 1e-9:.3f}" in dict(rows)["effective"], rows


def check_dense_snapshots(results):
    """An interval below the time step, of 5 ns here, is one of every step."""
    with h5py.File(os.path.join(results["dense"].folder, "dynamics.h5")) as file:
        times = file["/snapshots/time"][:]
    assert np.allclose(times, 5e-9 * np.arange(100, 200), rtol=1e-12, atol=0), times


def check_energy_scale(results):
    """On a flat at rest little is rubbed off: the residual is relative to what the loads do."""
    summary = results["at rest"].summary
    assert summary["limit_cycle"].endswith(", statistics from 1.5e-05 s on"), summary["limit_cycle"]
    assert summary["energy_balance_scale"] == "the work of the loads", summary["energy_balance_scale"]
    assert summary["energy_balance_residual"] < 1e-12, summary["energy_balance_residual"]
    with open(os.path.join(results["at rest"].folder, "energy.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    column = {name.split(" ")[0]: name for name in rows[0]}
    largest = lambda name: max(abs(float(row[column[name]])) for row in rows)
    assert 0 < largest("friction") < 0.1 * largest("external_work"), rows[-1]


def check_contact_duration(results):
    """4 microseconds after the start nearly every node still presses on the flat."""
    summary = results["homogeneous"].summary
    share, warning = summary["mean_contact_duration_node_share"], summary["mean_contact_duration_warning"]
    log = log_of(results["homogeneous"])
    assert 0 <= share < 0.5, share
    if summary["mean_contact_duration"] is not None:
        assert f"{100 * share:.3g} % of the contact nodes" in warning and warning in log, (share, warning)
    else:
        assert warning is None


def main():
    with tempfile.TemporaryDirectory() as folder:
        results = run_chain(folder)
        check_units(folder)
        check_xdmf(folder)
        check_localization(results)
        check_mixed_conditions(results)
        check_reference_phase(results)
        check_phase_means(results)
        check_contact_duration(results)
        check_dense_snapshots(results)
        check_energy_scale(results)
        check_reused(results)
    print(f"files: {len(results)} runs")


if __name__ == "__main__":
    main()
