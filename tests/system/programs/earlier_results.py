"""Runs in a folder with results of an earlier one, which go when a run begins; nothing else is lost, and neither inputs nor
results of another program or analysis are replaced. Files that were changed or damaged since are told apart."""

import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import PHASES, SMALL_RVE as RVE, TOOLS, Folder as AnyFolder, prm

sys.path[:0] = [os.path.join(TOOLS, "python"), TOOLS]
import mesoslip
from report.base.data import Chain

CONTACT = prm({"Body/RVE file": "rve/rve.h5", "Time/End time": 1e-5, "Snapshots/Interval": 1e-6})
LOCALIZATION = prm({"Input/RVE file": "rve/rve.h5", "Input/Homogeneous run": "run/dynamics.h5"})
PICTURE = PHASES + prm({"Grid/Cells": "4, 2", "Grid/Size": "4e-3, 2e-3", "Microstructure/Type": "image",
                        "Microstructure/File": "picture/map.txt"})
FAILS = ["--set", "Flat/Expression=sqrt(5e-6 - t)"]


class Folder(AnyFolder):
    def run(self, status, program, output, *options):
        executable = {"friction": "contact_dynamics", "modal": "contact_dynamics", "static contact": "contact_dynamics",
                      "picture": "rve_homogenization"}.get(program, program)
        return super().run(status, executable, program + ".prm", "--output", output, *options)

    def restore(self, path, content):
        with open(path, "wb") as file:
            file.write(content)


def check_failed_run(folder):
    """Results that a run is going to write anew go when it begins, so that none is left of another run; all else stays."""
    folder.run(0, "rve_homogenization", "rve")
    folder.run(0, "contact_dynamics", "run")
    results = {"dynamics.h5", "dynamics.xdmf", "energy.csv", "history.csv"}
    there = lambda: set(os.listdir(folder("run")))
    assert results < there(), there()
    folder.write("run/notes.csv", "mine")
    before = {name: folder.read("run", name) for name in there()}
    folder.run(2, "contact_dynamics", "run", "--set", "Friction/Coefficient=-1")
    assert before == {name: folder.read("run", name) for name in there()}, "a run that was refused touched something"
    folder.run(3, "contact_dynamics", "run", *FAILS)
    assert not results & there() and folder.read("run", "notes.csv") == b"mine", there()
    said = folder.run(2, "stress_localization", "local")
    assert "Input/Homogeneous run" in said and "there is no file" in said, said
    assert any(folder("run") in note and "has failed" in note for note in Chain([folder.path]).notes), "the report is silent"
    folder.run(0, "contact_dynamics", "run")
    os.remove(folder("run", "notes.csv"))
    folder.run(0, "contact_dynamics", "run", "--set", "Observation/Energy interval=0")
    assert results - there() == {"energy.csv"}, there()
    folder.run(0, "contact_dynamics", "run")
    folder.run(0, "stress_localization", "local")


def check_reuse(folder):
    """An rve.h5 that is up to date is its run's result, though it was there before."""
    folder.run(2, "rve_homogenization", "rve", "--set", "Homogenization/Boundary conditions=")
    before = {name: folder.read("rve", name) for name in os.listdir(folder("rve")) if name.endswith((".h5", ".csv", ".xdmf"))}
    assert "rve.h5 is up to date" in folder.run(0, "rve_homogenization", "rve")
    assert before == {name: folder.read("rve", name) for name in before}


def fnv(state, data):
    """64-bit FNV-1a of bytes, going on from `state`."""
    for byte in data:
        state = ((state ^ byte) * 0x100000001b3) % 2**64
    return state


def digested_parameters(path):
    """What alone identified an rve.h5 before the computation had a revision: the keys with their values, in their order."""
    sections, text = [], ""
    with open(path, encoding="utf-8") as file:
        for line in (line.strip() for line in file):
            if line.startswith("subsection "):
                sections.append(line[len("subsection "):].strip())
            elif line == "end":
                sections.pop()
            elif line.startswith("set "):
                key, value = (part.strip() for part in line[len("set "):].split("=", 1))
                key = "/".join([*sections, key])
                if key not in ("Output folder", "Homogenization/Reuse"):
                    text += f"{key} = {value}\n"
    data = text.encode()
    return data + struct.pack("<Q", len(data))


def check_revision(folder):
    """An rve.h5 is made again when its program or the revision of the computation is another, with the same parameters."""
    start, parameters = 0xcbf29ce484222325, digested_parameters(folder("rve", "parameters.prm"))
    with h5py.File(folder("rve", "rve.h5"), "r+") as file:
        version = file.attrs["program_version"]
        program = fnv(start, version + struct.pack("<Q", len(version)))
        assert file.attrs["digest"].decode() in {f"{fnv(fnv(program, struct.pack('<d', k)), parameters):016x}" for k in range(2, 100)}
        file.attrs.modify("digest", np.bytes_(f"{fnv(start, parameters):016x}"))
    assert "up to date" not in folder.run(0, "rve_homogenization", "rve")
    assert "rve.h5 is up to date" in folder.run(0, "rve_homogenization", "rve")


def check_numbers_that_do_not_fit(folder):
    """Phases of an edited rve.h5 that are no phases are refused, not replaced by the nearest number that HDF5 can hold."""
    before = folder.read("rve", "rve.h5")
    for changed in (-1, 2**20):
        with h5py.File(folder("rve", "rve.h5"), "r+") as file:
            phases = file["phase/id"][...].astype(np.int32)
            del file["phase/id"]
            phases[phases == 1] = changed
            file["phase/id"] = phases
        said = folder.run(2, "contact_dynamics", "none", "--set", "Body/Material=heterogeneous")
        assert "/phase/id" in said and "negative or too large" in said, said
        folder.restore(folder("rve", "rve.h5"), before)


def check_output_that_fails(folder):
    """What was computed is in the checkpoint: --resume writes it, the same as without the failure."""
    os.makedirs(folder("late", "dynamics.xdmf"))
    said = folder.run(2, "contact_dynamics", "late")
    assert "dynamics.xdmf" in said and "--resume" in said, said
    os.rmdir(folder("late", "dynamics.xdmf"))
    said = folder.run(0, "contact_dynamics", "late", "--resume")
    assert "Resumed at step" in said, said
    for name in ("history.csv", "energy.csv"):
        assert folder.read("late", name) == folder.read("run", name), name
    with mesoslip.open(folder("late")) as late, mesoslip.open(folder("run")) as run:
        assert sorted(late) == sorted(run)
        assert all((late[name] == run[name]).all() for name in run if not name.startswith("material/name"))
    shutil.rmtree(folder("late"))


def flip_bit(path, dataset):
    """One bit of the last number of a dataset, far from all that describes the file."""
    with h5py.File(path) as file:
        stored = file[dataset].id
        last = stored.get_chunk_info(stored.get_num_chunks() - 1)
    position = last.byte_offset + last.size - 8
    with open(path, "r+b") as file:
        file.seek(position)
        byte = file.read(1)[0]
        file.seek(position)
        file.write(bytes([byte ^ 1]))


def check_changed_files(folder):
    """Numbers that someone else has written are told apart, used as they are, and made again where they can be."""
    path, changed = folder("rve", "rve.h5"), "rve.h5 has changed since rve_homogenization wrote it"
    before = folder.read("rve", "rve.h5")
    flip_bit(path, "concentration/KUBC")
    for program, output in (("contact_dynamics", "other"), ("stress_localization", "local")):
        for options in ([], ["--validate"]):
            said = folder.run(0, program, output, *options)
            assert said.count(changed) == 1, said
    with h5py.File(path, "r+") as file:
        file["stiffness/effective"][0, 0] *= 2
    assert changed in folder.run(0, "contact_dynamics", "other")
    # A mesh, and below a box, with a stiffness of the volume, too.
    Box([2, 1], [4, 2], lambda x: "body").name_side("Contact", 1, False).name_side("Top", 1, True).write(folder("mesh.msh"))
    on_mesh = [f"--set={key}" for key in ("Mesh/File=mesh.msh", "Mesh/Scale=0.001", "Snapshots/Interval=0")]
    for options in (on_mesh, [*on_mesh, "--validate"]):
        said = folder.run(0, "contact_dynamics", "on_mesh", *options)
        assert said.count(changed) == 1, said
    said = folder.run(0, "rve_homogenization", "rve")
    assert "up to date" not in said and folder.read("rve", "rve.h5") == before, said
    with h5py.File(path, "r+") as file:
        file["stiffness/effective"].attrs["unit"] = np.bytes_("GPa")
    said = folder.run(2, "contact_dynamics", "other")
    assert "/stiffness/effective has the unit 'GPa' instead of 'Pa'" in said, said
    folder.run(0, "rve_homogenization", "rve")

    run = folder.read("run", "dynamics.h5")
    with h5py.File(folder("run", "dynamics.h5"), "r+") as file:
        file["snapshots/displacement"][-1, ::2] = 1e200
    said = folder.run(3, "stress_localization", "local")
    assert "dynamics.h5 has changed since contact_dynamics wrote it" in said, said
    assert "localization.h5: the dataset /mean_von_mises would hold a value that is not finite" in said, said
    folder.restore(folder("run", "dynamics.h5"), run)
    said = folder.run(2, "stress_localization", "local", "--set", "Localization/Out-of-plane ratio=1e300")
    assert "Localization/Out-of-plane ratio" in said, said
    folder.run(0, "stress_localization", "local")


def rewrite(path, copy):
    """The same content as h5py writes it with other options; texts have variable length, as they do there by default."""
    with h5py.File(path) as old, h5py.File(copy, "w", libver="latest", track_order=True) as new:
        def copy_object(name, item):
            target = new.create_dataset(name, data=item[...], chunks=True if item.shape else None) \
                if isinstance(item, h5py.Dataset) else new.require_group(name)
            for key, value in item.attrs.items():
                target.attrs[key] = value.decode() if isinstance(value, bytes) else value
        old.visititems(copy_object)
        for key, value in old.attrs.items():
            new.attrs[key] = value.decode() if isinstance(value, bytes) else value
        new["phase/density"].make_scale("phases")
        new["phase/friction_coefficient"].dims[0].attach_scale(new["phase/density"])


def check_foreign_files(folder):
    """Files that h5py or h5repack write are read, with a warning and the same results."""
    path = folder("rve", "rve.h5")
    good = folder.read("rve", "rve.h5")
    folder.run(0, "contact_dynamics", "other")
    with h5py.File(folder("other", "dynamics.h5")) as file:
        expected = file["history/contact_normal_force"][...]
    rewrite(path, folder("new.h5"))
    variants = [folder("new.h5")]
    if shutil.which("h5repack"):
        subprocess.run(["h5repack", "-l", "CHUNK=2x2", path, folder("repacked.h5")], check=True)
        variants.append(folder("repacked.h5"))
    for variant in variants:
        os.replace(variant, path)
        for program, output in (("contact_dynamics", "other"), ("stress_localization", "local")):
            said = folder.run(0, program, output)
            assert said.count("rve.h5 has no checksum") == 1, said
        with h5py.File(folder("other", "dynamics.h5")) as file:
            assert (file["history/contact_normal_force"][...] == expected).all()
    for name, value, words in (("stiffness/effective", h5py.SoftLink("/nowhere"), "/stiffness/effective cannot be opened"),
                               ("phase/density", h5py.Empty("d"), "/phase/density holds nothing")):
        folder.restore(path, good)
        with h5py.File(path, "r+") as file:
            del file[name]
            file[name] = value
        said = folder.run(2, "contact_dynamics", "other")
        assert words in said, said
    folder.restore(path, good)


def check_folder_in_the_way(folder):
    os.makedirs(folder("way", "dynamics.h5"))
    said = folder.run(2, "contact_dynamics", "way")
    assert "has a folder dynamics.h5" in said, said
    os.rmdir(folder("way", "dynamics.h5"))


def check_damage(folder):
    """No byte that is lost or flipped passes in silence: a warning, a refusal, or (in what HDF5 itself reads) its end."""
    path, chance = folder("rve", "rve.h5"), random.Random(1)
    good = folder.read("rve", "rve.h5")
    for k in range(16):
        bad = bytearray(good[:chance.randrange(600, len(good))] if k < 4 else good)
        if k >= 4:
            bad[chance.randrange(513, len(bad))] ^= 1 << chance.randrange(8)
        folder.restore(path, bad)
        status, out, err = folder.end("contact_dynamics", "contact_dynamics.prm", "--output", "other", "--validate")
        said = out + err
        assert status != 0 or "rve.h5 has changed since" in said, f"case {k}: {said}"
        assert k >= 4 or status == 2 and "rve.h5" in said and said.count("\n") == 1, f"case {k}: {status} {said}"
    folder.restore(path, good)


def check_other_loads(folder):
    """The difference of runs under other loads is not the error of localization; what was adapted or is of the method is."""
    folder.run(0, "contact_dynamics", "het", "--set", "Body/Material=heterogeneous", "--set", "Friction/Coefficient=0.4",
               "--set", "Friction/Regularization time=1e-6", "--set", "Flat/Velocity=-2")
    direct = ["--set", "Input/Direct run=het/dynamics.h5"]
    for options in (direct, direct + ["--validate"]):
        said = folder.run(2, "stress_localization", "local", *options)
        assert "(velocity is 2 m/s and -2 m/s, friction_coefficient is 0.25 and 0.4)" in said, said
    said = folder.run(0, "stress_localization", "local", *direct, "--set", "Input/Allow different loads=true")
    assert "warning: the homogeneous run" in said and "differ: regularization_time is 1.5e-06 s and 1e-06 s, time_step is" in said, said
    with mesoslip.open(folder("local")) as local:
        differences = local.summary["differences_of_the_runs"]
    assert [d["condition"] for d in differences if d["of_load"]] == ["velocity", "friction_coefficient"], differences
    folder.run(0, "contact_dynamics", "het", "--set", "Body/Material=heterogeneous", "--set", "Friction/Regularization time=1e-6")
    said = folder.run(0, "stress_localization", "local", *direct, "--set", "Window/From=0")
    assert "warning: the homogeneous run" not in said, said
    said = folder.run(2, "stress_localization", "local", "--set", "Input/Homogeneous run=het/dynamics.h5")
    assert "is one of a heterogeneous body" in said, said
    with h5py.File(folder("het", "dynamics.h5"), "r+") as file:
        del file["run"]
    assert "dynamics.h5 does not tell its loads" in folder.run(0, "stress_localization", "local", *direct, "--set", "Window/From=0")


def check_inputs_in_output(folder):
    """An output folder that holds an input, by whatever name, or results of another kind is refused before it is touched."""
    for analysis in ("modal", "static contact"):
        folder.write(analysis + ".prm", prm({"Analysis": analysis, "Body/RVE file": "rve/rve.h5"}))
    folder.write("friction.prm", prm({"Analysis": "friction homogenization", "Friction homogenization/Heterogeneous run": "run"}))
    os.symlink("run", folder("link to run"))
    os.mkdir(folder("hard"))
    os.link(folder("rve", "rve.h5"), folder("hard", "rve.h5"))
    state = lambda: {(name, os.stat(os.path.join(base, name)).st_mtime_ns) for base, _, names in os.walk(folder.path) for name in names}
    before, cases = state(), []
    for program, key, name, outputs in (
            ("stress_localization", "Input/Homogeneous run", "run/dynamics.h5", ("run", "./rve/../run", "nope/../run", "link to run")),
            ("stress_localization", "Input/RVE file", "rve/rve.h5", ("rve", "hard")),
            ("contact_dynamics", "Body/RVE file", "rve/rve.h5", ("rve", "rve/", "hard")),
            ("friction", "Friction homogenization/Heterogeneous run", "run is the output folder", ("run", "link to run"))):
        cases += [(program, output, [], [key, name, "--output"]) for output in outputs]
    cases += [(analysis, "run", [], ["output folder run", "'transient' of contact_dynamics", f"'{analysis}'", "remove"])
              for analysis in ("modal", "static contact")]
    cases += [("rve_homogenization", "run", [], ["output folder run", "'transient' of contact_dynamics", "those of rve_homogenization"]),
              ("contact_dynamics", "local", [], ["output folder local", "results of stress_localization", "'transient'"])]
    for program, output, options, words in cases:
        for validate in ([], ["--validate"]):
            said = folder.run(2, program, output, *options, *validate)
            assert all(word in said for word in words), f"{program} --output {output} {options}: {words} not in {said}"
            assert state() == before, f"{program} --output {output} {options} {validate}: {state() ^ before}"

    # A picture is no result, and nobody else's log is lost beside it: --output . is fine.
    folder.write("picture.prm", PICTURE)
    folder.write("picture/map.txt", "0 0 1 1\n1 1 0 0\n")
    for _ in range(2):
        folder.run(0, "picture", "picture")
    os.rename(folder("picture", "map.txt"), folder("picture", "log.txt"))
    said = folder.run(2, "picture", "picture", "--set", "Microstructure/File=picture/log.txt")
    assert "Microstructure/File" in said and "log.txt lies in the output folder" in said, said

    # What a .prm includes is an input as well.
    folder.write("included.prm", "include picture/log.txt\n" + PICTURE)
    folder.write("picture/log.txt", "# a user's own\n")
    said = super(type(folder), folder).run(2, "rve_homogenization", "included.prm", "--output", "picture")
    assert "included.prm includes a file" in said and "log.txt lies in the output folder" in said, said
    assert folder.read("picture", "log.txt") == b"# a user's own\n"


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"rve_homogenization": RVE, "contact_dynamics": CONTACT, "stress_localization": LOCALIZATION})
        for check in (check_failed_run, check_reuse, check_revision, check_numbers_that_do_not_fit, check_output_that_fails, check_changed_files,
                      check_foreign_files, check_folder_in_the_way, check_damage, check_other_loads, check_inputs_in_output):
            check(folder)


if __name__ == "__main__":
    main()
