"""The scripts of the example meshes write meshes that the programs describe as those in the repository: phases, boundaries, box, quality.
So does a .vtu file with the lines of the page on meshes.

    mesh_scripts.py <folder with the programs>
"""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap

import numpy as np

from scenes import TOP, Folder

EXAMPLES = os.path.join(TOP, "prm", "examples", "mesh")
SCRIPTS = {"chamfered_pin": "chamfered_pin.prm", "cylinder": "cylinder.prm", "fibre_cell": "fibre_cell.prm", "spheres": "spheres.prm",
           "round_fibres/round_fibres": "round_fibres/10-rve_homogenization.prm"}


NUMBER = re.compile(r"-?\d[\d.]*(?:e[-+]\d+)?")


def told(folder, prm, mesh):
    """What --validate says of the mesh, but for its worst cell and the round-off of pairs, which change with the version of Gmsh: words
    and numbers."""
    program = "rve_homogenization" if "subsection Homogenization" in folder.read(prm).decode() else "contact_dynamics"
    text = folder.run(0, program, prm, "--set", f"Mesh/File={mesh}", "--validate").replace(os.path.basename(mesh), "mesh")
    lines = "\n".join(line for line in text.splitlines() if not re.search(r"worst|opposite", line))
    return NUMBER.sub("#", lines), np.array([float(number) for number in NUMBER.findall(lines)])


def compare(folder, name, prm, made, kept):
    (words, numbers), (expected, of_kept) = (told(folder, prm, mesh) for mesh in (made, kept))
    assert words == expected, f"{name}: {words} instead of {expected}"
    assert len(numbers) > 10 and np.allclose(numbers, of_kept, rtol=1e-3, atol=0), f"{name}: {numbers} instead of {of_kept}"
    print(f"{name}: {len(numbers)} numbers agree", flush=True)


def check_vtu(folder):
    import meshio
    kept = os.path.join(EXAMPLES, "spheres.msh")
    mesh = meshio.read(kept)
    os.chdir(folder())
    meshio.write("body.vtu", meshio.Mesh(mesh.points, {"tetra": mesh.cells_dict["tetra"]},
                                         cell_data={"phase": [mesh.cell_data_dict["gmsh:physical"]["tetra"]]}))
    lines = re.search(r"(    import meshio.*?)\n\n", Folder(TOP).read("doc", "meshes.md").decode(), re.DOTALL)[1]
    exec(textwrap.dedent(lines), {})
    compare(folder, "vtu", SCRIPTS["spheres"], folder("body.msh"), kept)


def main():
    if not all(importlib.util.find_spec(name) for name in ("gmsh", "meshio")):
        sys.exit(77)
    with tempfile.TemporaryDirectory() as path:
        copy = Folder(shutil.copytree(EXAMPLES, os.path.join(path, "mesh")))
        for script, prm in SCRIPTS.items():
            place, name = os.path.split(script)
            os.remove(copy(script + ".msh"))
            environment = dict(os.environ, PYTHONPATH=copy(), PYTHONDONTWRITEBYTECODE="1")
            subprocess.run([sys.executable, name + ".py"], cwd=copy(place), env=environment, check=True, capture_output=True)
            compare(copy, script, prm, copy(script + ".msh"), os.path.join(EXAMPLES, script + ".msh"))
        check_vtu(copy)


if __name__ == "__main__":
    main()
