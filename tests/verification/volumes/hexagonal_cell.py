"""Fibres in a hexagonal lattice, with circles that the mesh follows, against published constants, and the order of convergence.

code_aster, V7.03.106 (HPLV106): glass, E = 70 GPa, nu = 0.22, in resin, 3.5 GPa, 0.35; fibres along z. Published to three or four digits.
"""

import tempfile

import numpy as np

from mesh_files import extruded, hexagonal_cell
from scenes import Folder, prm

# Volume fraction: E_z and E_x (Pa), G_xz (Pa), nu_zx, nu_xy.
NAMES = ("E_z", "E_x", "G_xz", "nu_zx", "nu_xy")
PUBLISHED = {0.2: (16813e6, 5216e6, 1876e6, 0.319, 0.466), 0.4: (30118e6, 7531e6, 2790e6, 0.290, 0.452)}
CELL = "set Dimension = 3\n" + prm({
    "Mesh/File": "cell.msh", "Mesh/Scale": 1e-6, "Phases/Names": "resin, glass", "Phases/resin/Young modulus": "3.5e9",
    "Phases/resin/Poisson ratio": 0.35, "Phases/glass/Young modulus": "70e9", "Phases/glass/Poisson ratio": 0.22,
    "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC", "Homogenization/Tolerance": 1e-9,
    "Homogenization/Write concentration": "false"})


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"cell": CELL})
        for fraction, published in PUBLISHED.items():
            found = []
            for n in (4, 8, 16):
                extruded(hexagonal_cell(n, fraction), 0.25 / n).write(folder("cell.msh"))
                folder.run(0, "rve_homogenization", "cell.prm", "--output", "cell")
                summary = folder.summary("cell")
                assert n < 16 or abs(summary["phases"][1]["volume_fraction"] - fraction) < 2e-3 * fraction, summary["phases"]
                found.append([summary["engineering_constants"][name] for name in NAMES])
            found = np.array(found)
            order = np.log2(np.abs((found[0] - found[1]) / (found[1] - found[2])))
            limit = found[2] + (found[2] - found[1]) / 3
            print(f"fraction {fraction}: limits {dict(zip(NAMES, limit))}; orders {order}; finest mesh off by {found[2] / limit - 1}")
            assert np.all(np.abs(order - 2) < 0.4) and abs(order.mean() - 2) < 0.2, order
            assert np.all(np.abs(found[2] / limit - 1) < 5e-4), found / limit - 1
            # As far as the published digits go.
            assert np.all(np.abs(limit / published - 1) < [1e-4, 1e-4, 3e-4, 2e-3, 2e-3]), limit / published - 1


if __name__ == "__main__":
    main()
