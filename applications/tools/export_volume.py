#!/usr/bin/env python3
"""A volume of voxels as input of another program for volumes.

    python3 applications/tools/export_volume.py output/rve --to fans --output export
    python3 applications/tools/export_volume.py output/rve --to damask --output export

reads the rve.h5 of a volume in 3D and writes, for FANS, volume.h5 and fans.json, whose FE_type HEX8 are the cells of rve_homogenization (BBAR: those
with mean dilatation); for DAMASK 3 grid.vti and material.yaml with Hooke's law of each phase. All six unit strains are loads of FANS; DAMASK wants a
load.yaml of your own. SI units. Phases of other axes than those of the box have their stiffness in the axes of the box.
"""

import argparse
import base64
import json
import os
import struct
import sys

sys.dont_write_bytecode = True  # leave no __pycache__ in a source tree
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "python"))

import h5py  # noqa: E402
import numpy as np  # noqa: E402

import mesoslip  # noqa: E402

FANS_ORDER = [0, 1, 2, 5, 4, 3]  # xx, yy, zz, xy, xz, yz, in Mandel's notation


class ExportError(Exception):
    """One sentence for the user."""


class Volume:
    """Material of each voxel [nz][ny][nx], stiffness of each material [n][6][6] (Pa), names, edges of the box (m)."""

    def __init__(self, path):
        with mesoslip.open(path) as file:
            if getattr(file, "format", "") != "mesoslip-rve":
                raise ExportError(f"{path} is no result of rve_homogenization")
            if "mesh" in file or len(file.grid.cells) != 3:
                raise ExportError(f"{file.path} is no volume of voxels; programs of this kind take nothing else (Dimension = 3 and no Mesh/File)")
            self.edges = [n * h for n, h in zip(file.grid.cells, file.grid.spacing)]
            self.spacing, self.path = file.grid.spacing, file.path
            stiffness, names = np.asarray(file["phase/stiffness"]), file["phase/name"]
            if "orientation/id" in file:
                self.id = np.asarray(file["orientation/id"])
                phase, angles = np.asarray(file["orientation/phase"]), np.asarray(file["orientation/euler_angles"])
                self.stiffness = np.array([turned(stiffness[p], a) for p, a in zip(phase, angles)])
                self.names = [f"{names[p]}_{k}" for k, p in enumerate(phase)]
            else:
                self.id, self.stiffness, self.names = np.asarray(file["phase/id"]), stiffness, names


def turned(D, angles):
    """D turned by Bunge's angles (degrees)."""
    (c1, c, c2), (s1, s, s2) = (f(np.radians(angles)) for f in (np.cos, np.sin))
    R = np.array([[c1 * c2 - s1 * s2 * c, -c1 * s2 - s1 * c2 * c, s1 * s], [s1 * c2 + c1 * s2 * c, -s1 * s2 + c1 * c2 * c, -c1 * s], [s2 * s, c2 * s, c]])
    pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    C = np.zeros((3, 3, 3, 3))
    for i, (a, b) in enumerate(pairs):
        for j, (d, e) in enumerate(pairs):
            C[a, b, d, e] = C[b, a, d, e] = C[a, b, e, d] = C[b, a, e, d] = D[i, j]
    C = np.einsum("ia,jb,kc,ld,abcd->ijkl", R, R, R, R, C)
    return np.array([[C[(*p, *q)] for q in pairs] for p in pairs])


def write_fans(volume, folder, mean_dilatation):
    with h5py.File(os.path.join(folder, "volume.h5"), "w") as file:
        data = file.create_dataset("material", data=volume.id.astype(np.uint16))
        data.attrs.create("permute_order", "zyx", dtype=h5py.string_dtype())
    scale = np.array([1, 1, 1, np.sqrt(2), np.sqrt(2), np.sqrt(2)])
    mandel = (volume.stiffness * np.outer(scale, scale))[:, FANS_ORDER][:, :, FANS_ORDER]
    constants = {f"C_{i + 1}{j + 1}": mandel[:, i, j].tolist() for i in range(6) for j in range(i, 6)}
    description = {
        "microstructure": {"filepath": "volume.h5", "datasetname": "/material", "L": volume.edges}, "problem_type": "mechanical", "strain_type": "small",
        "materials": [{"phases": list(range(len(volume.names))), "matmodel": "LinearElasticTriclinic", "material_properties": constants}],
        "FE_type": "BBAR" if mean_dilatation else "HEX8", "method": "cg",
        "error_parameters": {"measure": "L2", "type": "relative", "tolerance": 1e-8}, "n_it": 1000,
        "macroscale_loading": [[np.eye(6)[k].tolist() for k in range(6)]], "results": ["homogenized_tangent", "stress_average"]}
    with open(os.path.join(folder, "fans.json"), "w", encoding="utf-8") as file:
        json.dump(description, file, indent=1)
    return ["volume.h5", "fans.json"]


def write_damask(volume, folder):
    lines = ["homogenization:", "  direct:", "    N_constituents: 1", "    mechanical: {type: pass}", "phase:"]
    for name, D in zip(volume.names, volume.stiffness):
        if not np.allclose(D, cubic(D), rtol=0, atol=1e-9 * np.abs(D).max()):
            raise ExportError(f"{volume.path}: phase {name} is not cubic in the axes of the box, as Hooke's law of DAMASK needs it for lattice: cI; "
                              "export to FANS")
        lines += [f"  {json.dumps(name)}:", "    lattice: cI", "    mechanical:", "      output: [F, P]",
                  f"      elastic: {{type: Hooke, C_11: {D[0, 0]:.9e}, C_12: {D[0, 1]:.9e}, C_44: {D[3, 3]:.9e}}}"]
    lines.append("material:")
    for name in volume.names:
        lines += ["  - homogenization: direct", f"    constituents: [{{phase: {json.dumps(name)}, v: 1.0, O: [1.0, 0.0, 0.0, 0.0]}}]"]
    nz, ny, nx = volume.id.shape
    data = volume.id.astype("<i4").tobytes()
    encoded = base64.b64encode(struct.pack("<Q", len(data)) + data).decode()  # one line: DAMASK reads this form alone
    with open(os.path.join(folder, "grid.vti"), "w", encoding="utf-8") as file:
        file.write(f'''<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<ImageData WholeExtent="0 {nx} 0 {ny} 0 {nz}" Origin="0 0 0" Spacing="{" ".join(repr(float(h)) for h in volume.spacing)}">
<Piece Extent="0 {nx} 0 {ny} 0 {nz}">
<CellData>
<DataArray type="Int32" Name="material" format="binary">
{encoded}
</DataArray>
</CellData>
</Piece>
</ImageData>
</VTKFile>
''')
    with open(os.path.join(folder, "material.yaml"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    return ["grid.vti", "material.yaml"]


def cubic(D):
    """The cubic stiffness with the first constants of D."""
    C = np.diag([D[0, 0] - D[0, 1]] * 3 + [D[3, 3]] * 3)
    C[:3, :3] += D[0, 1]
    return C


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volume", help="rve.h5, or the folder of the run")
    parser.add_argument("--to", choices=("fans", "damask"), required=True, help="the program that reads the files")
    parser.add_argument("--output", metavar="DIR", required=True, help="folder of the files")
    parser.add_argument("--mean-dilatation", action="store_true", help="FANS: cells with mean dilatation (BBAR) in all phases")
    arguments = parser.parse_args()
    try:
        volume = Volume(arguments.volume)
        if os.path.exists(arguments.output) and not os.path.isdir(arguments.output):
            raise ExportError(f"--output: {arguments.output} is a file")
        os.makedirs(arguments.output, exist_ok=True)
        names = write_fans(volume, arguments.output, arguments.mean_dilatation) if arguments.to == "fans" else write_damask(volume, arguments.output)
    except (ExportError, mesoslip.FormatError, FileNotFoundError) as error:
        sys.exit(f"export_volume.py: {error}")
    print("wrote " + " and ".join(os.path.join(arguments.output, name) for name in names))


if __name__ == "__main__":
    main()
