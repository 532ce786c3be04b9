"""Memory of each rank on meshes of hexahedra against what --validate tells, on one and four ranks. Needs python3-gmsh, which writes format 4.1."""

import os
import re
import shutil
import subprocess
import sys

from mesh_files import Box

SIDES = {"homogenization": 40, "transient": 64, "modal": 40, "static contact": 40, "localization": 48}  # cells along each axis
SMALL = 4  # what the programs take without a body
RANKS = (1, 4)
FORMATS = {"transient": (4.1, 2.2)}  # of the file; else 4.1, which is Gmsh's own
MATERIAL = {"Names": "rock", "rock/Young modulus": 4e10, "rock/Poisson ratio": 0.2, "rock/Density": 1900}
PRESSED = {"Supports/Top/Pressure": 1e6, "Flat/Velocity": 1, "Friction/Coefficient": 0.3}
SETTINGS = {"homogenization": {"Homogenization/Boundary conditions": "KUBC", "Homogenization/Effective": "KUBC"},
            "transient": {"Time/End time": 1e-7, **PRESSED},
            "modal": {"Analysis": "modal", "Modal/Number of modes": 4, "Supports/Top/Kind": "platen"},
            "static contact": {"Analysis": "static contact", **PRESSED}}
PROGRAMS = {"homogenization": "rve_homogenization", "localization": "stress_localization"}  # of the others contact_dynamics
LIBRARIES = {"homogenization": 150e6, "localization": 160e6}  # bytes, which --validate of these adds
UNITS = {"kB": 1e3, "MB": 1e6, "GB": 1e9}
# Starts a program and writes its largest resident memory (kB) to a file that has the number of the rank.
MEASURED = ("import os, resource, subprocess, sys; status = subprocess.run(sys.argv[2:]).returncode; "
            "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, file=open(sys.argv[1] + os.environ['OMPI_COMM_WORLD_RANK'], 'w')); sys.exit(status)")


def run(bench):
    folder = os.path.join(bench.runs, "mesh_memory")
    os.makedirs(folder, exist_ok=True)
    rows = []
    for name, side in [(name, 16 if bench.quick else side) for name, side in SIDES.items()]:
        for version, ranks in [(version, ranks) for version in FORMATS.get(name, (4.1,)) for ranks in RANKS]:
            small, large = (memory(bench, folder, name, mesh_file(folder, n, version), ranks) for n in (SMALL, side))
            used = [b - a for a, b in zip(small, large)]
            rows.append({"analysis": name, "hexahedra": side**3, "format": version, "ranks": ranks,
                         "told_rank_0_bytes": told(bench, folder, name, mesh_file(folder, side, version), ranks),
                         "rank_0_bytes": used[0], "least_other_bytes": min(used[1:], default=0), "most_other_bytes": max(used[1:], default=0)})
    for row in rows:
        alone = next(other for other in rows if other["ranks"] == 1 and all(other[key] == row[key] for key in ("analysis", "format")))
        row["rank_0_of_one"] = row["rank_0_bytes"] / alone["rank_0_bytes"]
    bench.write("mesh-memory", rows, f"largest resident memory of a rank, less that with {SMALL**3} hexahedra, and what --validate tells of rank 0",
                ranks="1 and 4")


def mesh_file(folder, side, version):
    path = os.path.join(folder, f"box-{side}-{version}.msh")
    if not os.path.exists(path):
        box = Box([float(side)] * 3, [side] * 3, lambda middle: "rock")
        box.name_side("Contact", 2, False).name_side("Top", 2, True).write(path)
    if version != 2.2 and "$MeshFormat\n2.2" in open(path, encoding="latin-1").read(20):
        convert = "import sys, gmsh; gmsh.initialize(); gmsh.open(sys.argv[1]); gmsh.option.setNumber('Mesh.MshFileVersion', 4.1); gmsh.write(sys.argv[1])"
        subprocess.run([sys.executable, "-c", convert, path], check=True, capture_output=True)
    return path


def command(bench, folder, name, mesh, ranks, *more):
    job = os.path.join(folder, f"{name.replace(' ', '-')}.prm")
    body = {"Mesh/File": mesh, "Mesh/Scale": 1e-4, **{f"Phases/{key}": value for key, value in MATERIAL.items()}}
    settings = {**SETTINGS[name], **body} if name in SETTINGS else inputs_of_localization(bench, folder, mesh)
    with open(job, "w", encoding="utf-8") as file:
        file.write("set Dimension = 3\n" if name in SETTINGS else "subsection Input\nend\n")
    parts = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    return ["mpirun", "--oversubscribe", "-np", str(ranks)], [os.path.join(bench.programs, PROGRAMS.get(name, "contact_dynamics")), job, *parts, *more]


def inputs_of_localization(bench, folder, mesh):
    """Runs, unless they are there, the volume and the run on this mesh, which is that of the direct run as well."""
    made = os.path.splitext(mesh)[0]
    for name, more in (("homogenization", []), ("transient", ["--set", "Time/End time=1e-5", "--set", "Snapshots/Interval=2e-6"])):
        if not os.path.exists(f"{made}-{name}"):
            start, program = command(bench, folder, name, mesh, 1, "--quiet", "--output", f"{made}-{name}", *more)
            called([*start, *program])
    run = f"{made}-transient/dynamics.h5"
    return {"Input/RVE file": f"{made}-homogenization/rve.h5", "Input/Homogeneous run": run, "Input/Direct run": run}


def called(start):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return subprocess.run(start, env=environment, text=True, stdout=subprocess.PIPE, check=True).stdout


def memory(bench, folder, name, mesh, ranks):
    """Bytes of each rank."""
    files, output = os.path.join(folder, "rank-"), os.path.join(folder, "output")
    shutil.rmtree(output, ignore_errors=True)
    start, program = command(bench, folder, name, mesh, ranks, "--quiet", "--output", output)
    called([*start, sys.executable, "-c", MEASURED, files, *program])
    sizes = []
    for rank in range(ranks):
        with open(f"{files}{rank}", encoding="ascii") as file:
            sizes.append(1024 * int(file.read()))
    return sizes


def told(bench, folder, name, mesh, ranks):
    """Bytes of rank 0 that --validate tells."""
    start, program = command(bench, folder, name, mesh, ranks, "--validate")
    found = re.search(r"([\d.]+) (kB|MB|GB) of memory|about ([\d.]+) (MB), divided", called([*start, *program]))
    value, unit = (word for word in found.groups() if word)
    told = float(value) * UNITS[unit] - LIBRARIES.get(name, 0)
    return told / ranks if name == "homogenization" else told  # which is of all ranks
