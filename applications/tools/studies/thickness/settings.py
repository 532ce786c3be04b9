"""Files and loads that the runs of this study share."""

import os

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", ".."))
LOADS, STARTS = (0.5, 0.4), (0.45, 0.5, 0.55)  # MPa, m/s


def prm(name):
    return os.path.join(TOP, "prm", "thickness", name + ".prm")


def loading(load, start, dimension):
    return {"Supports/Top/Pressure": load * 1e6, "Body/Initial velocity": (start, *[0] * (dimension - 1))}
