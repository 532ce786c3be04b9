"""Hertz: a sphere pressed on the rigid flat without friction, as hertz.py has the cylinder, on meshes of a quarter of the body."""

from hertz import check

check(3, (3, 6), 1.5, 0.005)
