"""Cattaneo and Mindlin's sphere, pressed and then displaced, as incremental_friction.py has the cylinder and says what the limits feel."""

import tempfile

from incremental_friction import check_sphere
from scenes import Folder

with tempfile.TemporaryDirectory() as path:
    coarse, fine = check_sphere(Folder(path), 3, 1.7), check_sphere(Folder(path), 4, 1.6)
    assert abs(coarse[0]) < 0.02 and abs(coarse[1]) < 0.2
    assert abs(fine[0]) < 0.06 and abs(fine[1]) < 0.5 * abs(coarse[1])  # 0.051 and 0.044 with 6 cells: what is left is the coupling
