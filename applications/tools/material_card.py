#!/usr/bin/env python3
"""The effective material of a volume as a card for another program.

    python3 applications/tools/material_card.py output/rve --to calculix --name COMPOSITE > composite.inp

reads the rve.h5 of a volume in 3D and writes stiffness, density (where all phases have one) and thermal expansion (where a phase has one) for
calculix, abaqus or aster (code_aster). SI units: m, kg, s, K. An orthotropic stiffness becomes an orthotropic card, any other one the
anisotropic card of calculix and abaqus. A plane volume says nothing of the stiffness along z: compute its section as voxels one cell deep.
"""

import argparse
import json
import os
import re
import sys

sys.dont_write_bytecode = True  # leave no __pycache__ in a source tree
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "python"))

import numpy as np  # noqa: E402

import mesoslip  # noqa: E402

XX, YY, ZZ, YZ, XZ, XY = range(6)
# Abaqus and CalculiX: D1111, D1122, D2222, D1133, D2233, D3333, then D1212, D1313, D2323, or all 21 with 12, 13, 23 in the place of 6, 5, 4.
ORTHOTROPIC = [(XX, XX), (XX, YY), (YY, YY), (XX, ZZ), (YY, ZZ), (ZZ, ZZ), (XY, XY), (XZ, XZ), (YZ, YZ)]
ANISOTROPIC = [(XX, XX), (XX, YY), (YY, YY), (XX, ZZ), (YY, ZZ), (ZZ, ZZ), (XX, XY), (YY, XY), (ZZ, XY), (XY, XY), (XX, XZ), (YY, XZ), (ZZ, XZ), (XY, XZ),
               (XZ, XZ), (XX, YZ), (YY, YZ), (ZZ, YZ), (XY, YZ), (XZ, YZ), (YZ, YZ)]
NEGLIGIBLE = 1e-9  # of couplings, over the root of the diagonal entries


class CardError(Exception):
    """One sentence for the user."""


class Material:
    """Stiffness D [6][6] (Pa) in Voigt order xx, yy, zz, yz, xz, xy, density (kg/m^3) or None, expansion [3] (1/K) or None."""

    def __init__(self, path, of):
        with mesoslip.open(path) as file:
            if getattr(file, "format", "") != "mesoslip-rve":
                raise CardError(f"{path} is no result of rve_homogenization")
            if of not in file.hdf5["stiffness"] or not of.strip("/"):
                raise CardError(f"{file.path} has no stiffness '{of}'; it has {', '.join(file.hdf5['stiffness'])}")
            self.D = np.asarray(file[f"stiffness/{of}"])
            if self.D.shape != (6, 6):
                raise CardError(f"{file.path} is of a plane volume, which says nothing of the stiffness along z; compute the section as voxels one cell deep "
                                "(Dimension = 3)")
            self.D = (self.D + self.D.T) / 2
            density = np.asarray(file["phase/density"])
            summary = json.loads(file["summary"][0])  # of the run that wrote the file
            fractions = [phase["volume_fraction"] for phase in summary.get("phases", [])]
            known = len(fractions) == len(density) and all(rho > 0 for rho, f in zip(density, fractions) if f > 0)
            self.density = float(density @ fractions) if known else None
            if self.density is None:
                print("material_card.py: not all phases have a density, so the card has none", file=sys.stderr)
            self.expansion = np.asarray(file[f"expansion/{of}"]) if f"expansion/{of}" in file else None
        root = np.sqrt(np.diag(self.D))
        coupled = np.abs(self.D) / np.outer(root, root) > NEGLIGIBLE
        coupled[:3, :3] = False
        np.fill_diagonal(coupled, False)
        self.is_orthotropic = not coupled.any()
        if self.expansion is not None:
            if np.abs(self.expansion[3:]).max() > 1e-6 * np.abs(self.expansion[:3]).max():
                raise CardError(f"{path}: the expansion has shears, which these cards do not take; turn the volume, or take the effective one with "
                                "Homogenization/Effective symmetry = orthotropic")
            self.expansion = self.expansion[:3]


def abaqus(material, name, calculix):
    """Keywords of CalculiX or Abaqus: eight numbers a line."""
    entries = ORTHOTROPIC if material.is_orthotropic else ANISOTROPIC
    kind = ("ORTHO" if calculix else "ORTHOTROPIC") if material.is_orthotropic else ("ANISO" if calculix else "ANISOTROPIC")
    values = [f"{material.D[i, j]:.9e}" for i, j in entries]
    lines = [f"*MATERIAL, NAME={name}", f"*ELASTIC, TYPE={kind}"]
    lines += [", ".join(values[k : k + 8]) for k in range(0, len(values), 8)]
    if material.density is not None:
        lines += ["*DENSITY", f"{material.density:.9e}"]
    if material.expansion is not None:
        lines += ["*EXPANSION, TYPE=ORTHO", ", ".join(f"{value:.9e}" for value in material.expansion)]
    return lines


def aster(material, name):
    """DEFI_MATERIAU of code_aster, axes L, T, N along x, y, z."""
    if not material.is_orthotropic:
        raise CardError("code_aster's ELAS_ORTH takes orthotropic stiffnesses alone; turn the volume, or set Homogenization/Effective symmetry = orthotropic")
    S = np.linalg.inv(material.D)
    values = {"E_L": 1 / S[XX, XX], "E_T": 1 / S[YY, YY], "E_N": 1 / S[ZZ, ZZ], "NU_LT": -S[XX, YY] / S[XX, XX], "NU_LN": -S[XX, ZZ] / S[XX, XX],
              "NU_TN": -S[YY, ZZ] / S[YY, YY], "G_LT": 1 / S[XY, XY], "G_LN": 1 / S[XZ, XZ], "G_TN": 1 / S[YZ, YZ]}
    if material.density is not None:
        values["RHO"] = material.density
    if material.expansion is not None:
        values |= dict(zip(("ALPHA_L", "ALPHA_T", "ALPHA_N"), material.expansion))
    lines = [f"    {key}={value:.9e}," for key, value in values.items()]
    return [f"{name} = DEFI_MATERIAU(ELAS_ORTH=_F(", *lines, "))"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volume", help="rve.h5, or the folder of the run")
    parser.add_argument("--to", choices=("calculix", "abaqus", "aster"), required=True, help="the program that reads the card")
    parser.add_argument("--name", default="COMPOSITE", help="of the material (default: COMPOSITE)")
    parser.add_argument("--of", default="effective", help="effective, or a boundary condition such as PBC (default: effective)")
    arguments = parser.parse_args()
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", arguments.name):
        parser.error(f"--name: '{arguments.name}' is no name of a material; take letters, digits and _")
    try:
        material = Material(arguments.volume, arguments.of)
        comment = f"mesoslip, {arguments.of} stiffness of {os.path.abspath(arguments.volume)}; m, kg, s, K; axes 1, 2, 3 are x, y, z"
        if arguments.to == "aster":
            lines = ["# " + comment, *aster(material, arguments.name)]
        else:
            lines = ["** " + comment, *abaqus(material, arguments.name, arguments.to == "calculix")]
    except (CardError, mesoslip.FormatError, FileNotFoundError) as error:
        sys.exit(f"material_card.py: {error}")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
