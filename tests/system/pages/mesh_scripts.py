"""The scripts of the example meshes, in Python and in Gmsh's language, write meshes that the programs describe as those in the repository:
phases, boundaries, box, quality. So does a .vtu file with the lines of the page on meshes.

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

# Scripts in Gmsh's language.
GEO = {"own_body/cell": "own_body/10-rve_homogenization.prm", "own_body/pin": "own_body/20-contact_dynamics-homogeneous.prm",
       "own_body/pin_with_fibres": "own_body/30-contact_dynamics-heterogeneous.prm"}

NUMBER = re.compile(r"-?\d[\d.]*(?:e[-+]\d+)?")


def told(folder, prm, mesh):
    """What --validate says of the mesh, but for its worst cell, the round-off of pairs and the disk, which change with the version of Gmsh: words
    and numbers."""
    program = "rve_homogenization" if "subsection Homogenization" in folder.read(prm).decode() else "contact_dynamics"
    text = folder.run(0, program, prm, "--set", f"Mesh/File={mesh}", "--validate").replace(os.path.basename(mesh), "mesh")
    lines = "\n".join(line for line in text.splitlines() if not re.search(r"worst|opposite|on the disk", line))
    return NUMBER.sub("#", lines), np.array([float(number) for number in NUMBER.findall(lines)])


def same_gmsh():
    """Whether it has made the kept meshes and the numbers of the page: others make up to twice as many cells."""
    import gmsh
    return gmsh.GMSH_API_VERSION.startswith("4.8")


def compare(folder, name, prm, made, kept):
    (words, numbers), (expected, of_kept) = (told(folder, prm, mesh) for mesh in (made, kept))
    assert words == expected, f"{name}: {words} instead of {expected}"
    same = not (same_gmsh() or name == "vtu") or np.allclose(numbers, of_kept, rtol=1e-3, atol=0)
    assert len(numbers) > 10 and same, f"{name}: {numbers} instead of {of_kept}"
    print(f"{name}: {len(numbers)} numbers agree", flush=True)


def check_geo(folder):
    """Meshes of the chain of a body that is no box, whose materials are those of its first step."""
    rve = "own_body/10-rve_homogenization"
    folder.run(0, "rve_homogenization", rve + ".prm", "--output", rve)
    code = "import gmsh; gmsh.initialize(); gmsh.open('{0}.geo'); gmsh.model.mesh.generate(2); gmsh.write('{0}.msh')"
    for script, prm in GEO.items():
        place, name = os.path.split(script)
        os.remove(folder(script + ".msh"))
        subprocess.run([sys.executable, "-c", code.format(name)], cwd=folder(place), check=True, capture_output=True)
        compare(folder, script, prm, folder(script + ".msh"), os.path.join(EXAMPLES, script + ".msh"))
        assert os.path.getsize(folder(script + ".msh")) > 1e4


def check_facets(script, said):
    """What facets cut off is printed of each group, and is what the page says."""
    lost = dict(re.findall(r"^(\S+): \S+ mm\S+ in the mesh, \S+ in the geometry, (\S+) %$", said, re.MULTILINE))
    expected = {"spheres": ("particle", -5.8), "fibre_cell": ("fibre", -2.6), "chamfered_pin": ("steel", 0)}.get(script)
    limit = 0.3 if same_gmsh() else 1
    assert lost and (expected is None or abs(float(lost[expected[0]]) - expected[1]) < limit), (script, said)


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
            said = subprocess.run([sys.executable, name + ".py"], cwd=copy(place), env=environment, check=True, capture_output=True, text=True).stdout
            check_facets(script, said)
            compare(copy, script, prm, copy(script + ".msh"), os.path.join(EXAMPLES, script + ".msh"))
        check_geo(copy)
        check_vtu(copy)


if __name__ == "__main__":
    main()
