"""Drafts (--validate --draft) against the results of the same runs: what is in both is equal, fields are empty, and stress_localization
--validate says the same of both; the disk that it tells is that of its file. Nothing but --validate and --try takes a draft."""

import os
import re
import sys
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import PHASES, SMALL_GRID, SMALL_RVE, TOOLS, Folder, prm

sys.path[:0] = [TOOLS, os.path.join(TOOLS, "python")]

RUN = {"Flat/Velocity": 2, "Supports/Top/Pressure": 5e6, "Friction/Coefficient": 0.25, "Time/End time": 2e-6, "Snapshots/From": 1.1e-6,
       "Snapshots/Interval": 1e-7}
PROBES = {"Observation/Probes": "A, B", "Observation/A/Position": "1.03e-3, 0", "Observation/A/Nearest node": "true",
          "Observation/B/Position": "0.55e-3, 0.35e-3"}
BODY, GRAINS = {"Body/RVE file": "rve/rve.h5"}, {"Body/RVE file": "rve/rve.h5", "Body/Material": "heterogeneous"}
STATIC = {"Analysis": "static contact", "Flat/Velocity": 2, "Supports/Top/Pressure": 5e6, "Supports/Top/Kind": "platen", "Friction/Coefficient": 0.25}
MESH = {"Mesh/File": "mesh.msh", "Mesh/Scale": 0.001}
# Name: program, text; volumes before the bodies that read them.
VOXELS = "set Dimension = 3\n" + prm({"Grid/Cells": "6, 4, 5", "Grid/Size": "0.006, 0.004, 0.005", "Microstructure/Type": "voxels",
                                      "Microstructure/File": "voxels.npy"}) + PHASES
BOX = "set Dimension = 3\n" + prm({**RUN, "Flat/Velocity": "2, 0", "Time/Time step": 2e-8, "Body/RVE file": "rve-box/rve.h5",
                                    "Observation/Probes": "A", "Observation/A/Position": "2.2e-3, 1.1e-3, 0.7e-3"})
RUNS = {
    "rve": ("rve_homogenization", SMALL_RVE),
    "rve-mesh": ("rve_homogenization", PHASES + prm(MESH)),
    "rve-box": ("rve_homogenization", VOXELS),
    "grid": ("contact_dynamics", prm({**BODY, **RUN, **PROBES})),
    "grains": ("contact_dynamics", prm({**GRAINS, **RUN, **PROBES})),
    "static": ("contact_dynamics", prm({**BODY, **STATIC})),
    "static-grains": ("contact_dynamics", prm({**GRAINS, **STATIC})),
    "mesh": ("contact_dynamics", prm({**MESH, "Body/RVE file": "rve-mesh/rve.h5", **RUN, **PROBES})),
    "mesh-grains": ("contact_dynamics", PHASES + prm({**MESH, **RUN, **PROBES})),
    # Half-way between steps rounding decides which of them is nearer: none may be taken twice.
    "mesh-steps": ("contact_dynamics", PHASES + prm({**MESH, **RUN, "Time/Time step": 2e-9, "Snapshots/From": 1e-9, "Snapshots/Interval": 2e-9})),
    "static-mesh": ("contact_dynamics", prm({**MESH, "Body/RVE file": "rve-mesh/rve.h5", **STATIC})),
    "box": ("contact_dynamics", BOX),
    "box-grains": ("contact_dynamics", BOX + prm({"Body/Material": "heterogeneous"}))}
WINDOW = {"Window/From": 1e-6}
# Name: volume, homogeneous run, direct run, more.
LOCALIZATIONS = {
    "of grids": ("rve", "grid", "grains", {**WINDOW, "Localization/Variant": "both"}),
    "of grids alone": ("rve", "grid", "", {**WINDOW, "Probes/Of the run": "B", "Localization/Fields": "mean stress"}),
    "of statics": ("rve", "static", "static-grains", {"Probes/Further": "C", "Probes/C/Position": "1e-3, 2e-4"}),
    "of meshes": ("rve-mesh", "mesh", "mesh-grains", {**WINDOW, "Probes/Further": "C", "Probes/C/Position": "1.01e-3, 2.1e-4"}),
    "of a mesh": ("rve-mesh", "static-mesh", "", {"Localization/Variant": "mean strain"}),
    "of boxes": ("rve-box", "box", "box-grains", WINDOW),
    "at points": ("rve", "mesh", "", {**WINDOW, "Volume element/Points": "P", "Volume element/P/Position": "1e-3, 2e-4"})}
FROM_THE_RUN = {"steady_from", "limit_cycle_reached"}  # which a draft does not know


def prepare(folder):
    np.save(folder("voxels.npy"), np.random.default_rng(3).integers(0, 2, (5, 4, 6), dtype=np.uint8))
    box = Box([2, 1], [20, 10], lambda x: "fibre" if (x[0] - 1) ** 2 + (x[1] - 0.5) ** 2 < 0.09 else "matrix")
    box.name_side("Contact", 1, False).name_side("Top", 1, True).write(folder("mesh.msh"))
    for name, (program, text) in RUNS.items():
        folder.write(name + ".prm", text)
        folder.run(0, program, name + ".prm", "--validate", "--draft", "drafts/" + name)
        folder.run(0, program, name + ".prm", "--quiet", "--output", name)


def check_content(folder):
    """All of a draft is in the result, and the same; but for fields, which take no place, and the guess of the stiffness."""
    def compare(name, drafted):
        here = f"{run}: {name}"
        found = made[name]
        for key, value in drafted.attrs.items():
            if not (name == "run" and key in FROM_THE_RUN):
                assert np.array_equal(value, found.attrs[key]), (here, key, value, found.attrs[key])
        if name == "run":
            assert set(drafted.attrs) == set(found.attrs), here
        if not isinstance(drafted, h5py.Dataset) or name == "summary":  # the program's text for itself
            return
        assert drafted.shape == found.shape and drafted.dtype == found.dtype, (here, drafted.shape, found.shape)
        if drafted.id.get_storage_size() == 0:
            empty.append(name)
            assert not drafted[...].any(), here
        elif not name.startswith("stiffness"):
            assert np.array_equal(drafted[...], found[...]), here

    for run, (program, _) in RUNS.items():
        name, empty = ("rve.h5" if program.startswith("rve") else "dynamics.h5"), []
        with h5py.File(folder("drafts", run, name)) as draft, h5py.File(folder(run, name)) as made:
            assert draft.attrs["digest"] == b"draft" != made.attrs["digest"], run
            draft.visititems(compare)
            if "snapshots" in made:
                times = made["snapshots/time"][()]
                assert (np.diff(times) > 0).all() and (run != "mesh-steps" or len(times) > 900), (run, len(times))
        fields = {"concentration/KUBC", "stress_concentration/SUBC"} if name == "rve.h5" else {"snapshots/displacement"}
        recorded = {"grid": "AB", "grains": "AB", "mesh": "AB", "mesh-grains": "AB", "box": "A", "box-grains": "A"}.get(run, "")
        fields |= {f"probes/{probe}/{of}" for probe in recorded for of in ("strain", "stress")}
        assert set(empty) == fields, (run, empty)


def check_ranks(folder):
    """The same file, whatever the number of ranks; where the time step is given, as the bound of a mesh depends on them in the last digits."""
    for name, ranks in (("rve", 3), ("rve-box", 2), ("grains", 2), ("grains", 3), ("mesh-steps", 2), ("mesh-steps", 3), ("box", 2)):
        program, here = RUNS[name][0], f"ranks/{name}-{ranks}"
        folder.run(0, program, name + ".prm", "--validate", "--draft", here, ranks=ranks)
        file = "rve.h5" if program.startswith("rve") else "dynamics.h5"
        assert folder.read(here, file) == folder.read("drafts", name, file), here


def check_localizations(folder):
    """The same words of drafts and results, but for the names of the files and that they are drafts; and as much on the disk as was told."""
    for name, (volume, run, direct, more) in LOCALIZATIONS.items():
        said = []
        for place in ("drafts/", ""):
            inputs = {"Input/RVE file": place + volume, "Input/Homogeneous run": place + run, **({"Input/Direct run": place + direct} if direct else {})}
            folder.write("l.prm", prm({**inputs, **({"Comparison/Edge distance": 2e-4} if direct else {}), **more}))
            lines = folder.run(0, "stress_localization", "l.prm", "--validate").replace("drafts/", "").splitlines()
            said.append([line for line in lines if not line.startswith("warning: ")])
            notes = sum("is a draft for --validate" in line for line in lines)
            assert notes == ((3 if direct else 2) if place else 0), (name, lines)
        assert said[0] == said[1], (name, *said)
        folder.run(0, "stress_localization", "l.prm", "--output", name)
        number, unit = re.search(r"^([\d.]+) ([kM]?)B? on the disk$|^([\d.]+) bytes", "\n".join(said[0]), re.M).groups()[:2]
        told, found = float(number) * {"k": 1e3, "M": 1e6}[unit], os.path.getsize(folder(name, "localization.h5"))
        print(f"{name}: {told:.3g} bytes told, {found} written")
        assert abs(told - found) < max(0.03 * found, 3e3), (name, told, found)


def check_refused(folder):
    """One sentence and exit status 2, and the folder stays as it is; --try makes drafts of drafts."""
    def refused(words, program, *arguments):
        before = sorted(os.listdir(folder.path))
        said = folder.run(2, program, *arguments)
        assert said.count("\n") == 1 and words in said, said
        assert sorted(os.listdir(folder.path)) == before, "something was written"

    draft = "is a draft for --validate, in which nothing was computed"
    folder.write("begun/dynamics.h5.part", "snapshots")
    folder.write("modes.prm", prm({"Analysis": "modal", **BODY}))
    folder.write("l.prm", prm({"Input/RVE file": "rve", "Input/Homogeneous run": "drafts/grid", **WINDOW}))
    refused("drafts/grid/dynamics.h5: " + draft, "stress_localization", "l.prm")
    refused("drafts/rve/rve.h5: " + draft, "stress_localization", "l.prm", "--set=Input/RVE file=drafts/rve", "--set=Input/Homogeneous run=grid")
    refused("drafts/rve/rve.h5: " + draft, "contact_dynamics", "grid.prm", "--set=Body/RVE file=drafts/rve/rve.h5", "--output", "new")
    refused("drafts/mesh/dynamics.h5: " + draft, "stress_localization", "l.prm", "--set=Input/RVE file=rve-mesh",
            "--set=Input/Homogeneous run=drafts/mesh")
    # No result is replaced, nor what a run is about to write.
    kept = folder.read("grid", "dynamics.h5")
    refused("there is a file grid/dynamics.h5 already", "contact_dynamics", "grid.prm", "--validate", "--draft", "grid")
    refused("there is a file grid/dynamics.h5 already", "contact_dynamics", "grid.prm", "--validate", "--draft", "nope/../grid")
    assert folder.read("grid", "dynamics.h5") == kept
    refused("there is a file begun/dynamics.h5.part already", "contact_dynamics", "grid.prm", "--validate", "--draft", "begun")
    refused("there is a folder grid already", "contact_dynamics", "grid.prm", "--try", "--output", "grid")
    # Where there is nothing to be drafted.
    refused("leave --draft out", "contact_dynamics", "modes.prm", "--validate", "--draft", "new")
    refused("unrecognised option '--draft'", "stress_localization", "l.prm", "--validate", "--draft", "new")
    for program, words in (("rve_homogenization", "an rve.h5"), ("contact_dynamics", "a dynamics.h5"), ("stress_localization", None)):
        said = folder.run(0, program, "--help")
        assert ("--draft DIR" in said) == (words is not None) and (words or "") in " ".join(said.split()), said

    said = folder.run(0, "contact_dynamics", "grid.prm", "--set=Body/RVE file=drafts/rve/rve.h5", "--try", "--output", "tried")
    assert "what it writes are drafts" in said and folder.summary("tried")["draft"] is True, said
    refused("tried/dynamics.h5: " + draft, "stress_localization", "l.prm", "--set=Input/Homogeneous run=tried")
    for table in ("history.csv", "energy.csv"):
        assert folder.read("tried", table).startswith(b"# draft: made with --try") and folder.read("grid", table).startswith(b"time [s]"), table
    # A table of a run is read where rectangles are.
    folder.run(0, "rve_homogenization", "rve.prm", "--try", "--output", "tried-rve")
    folder.write("listed.prm", PHASES + SMALL_GRID + prm({"Microstructure/Type": "rectangles", "Microstructure/File": "tried-rve/rectangles.csv"}))
    refused("tried-rve/rectangles.csv is a draft", "rve_homogenization", "listed.prm", "--output", "new")
    import mesoslip
    friction = {"summary.json": '{"draft": true}', "friction_homogenization.csv": "x\n1\n"}  # no HDF5
    for name, text in friction.items():
        folder.write("tried-friction/" + name, text)
    for path in ("drafts/rve/rve.h5", "tried/dynamics.h5", "tried-friction"):
        try:
            mesoslip.open(folder(path))
            raise AssertionError(f"{path} was opened")
        except mesoslip.FormatError as error:
            assert "in which nothing was computed" in str(error), error
    from report.base.data import Chain
    read = Chain([folder("tried"), folder("grid")])
    assert [run.name for run in read.runs] == ["grid"] and any("made with --try" in note for note in read.all_notes()), read.all_notes()


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        prepare(folder)
        for check in (check_content, check_ranks, check_localizations, check_refused):
            check(folder)
            print(f"{check.__name__}: ok", flush=True)


if __name__ == "__main__":
    main()
