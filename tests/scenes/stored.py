"""Numbers that are stored: no truths, but a change of them has to be meant. With --update on the command line those found are stored."""

import json
import os
import sys

# Of no dimension and zero but for rounding: another compiler rounds otherwise.
ZERO = {"non_orthotropy": 1e-12}


def differences(a, b, tolerance, path=""):
    """Paths at which two JSON values differ by more than the relative tolerance."""
    if isinstance(a, dict):
        if not isinstance(b, dict) or a.keys() != b.keys():
            return [f"{path}: other keys"]
        return [d for key in a for d in differences(a[key], b[key], tolerance, f"{path}/{key}")]
    if isinstance(a, list):
        if not isinstance(b, list) or len(a) != len(b):
            return [f"{path}: other length"]
        scale = max([abs(x) for x in a if isinstance(x, float)] + [0.0])
        return [d for k, (x, y) in enumerate(zip(a, b))
                for d in ([] if isinstance(x, float) and isinstance(y, float) and abs(x - y) <= 1e-9 * scale
                          else differences(x, y, tolerance, f"{path}/{k}"))]
    if isinstance(a, float) and isinstance(b, (float, int)):
        rounding = ZERO.get(path.rsplit("/", 1)[-1], 0.0)
        return [] if abs(a - b) <= max(tolerance * max(abs(a), abs(b)), rounding) else [f"{path}: {a} and {b}"]
    return [] if a == b else [f"{path}: {a} and {b}"]


def one_line_a_key(found):
    """JSON with a line for each key of each summary."""
    return "{\n" + ",\n".join(f' "{name}": {{\n' + ",\n".join(f'  "{key}": {json.dumps(value, sort_keys=True)}' for key, value in values.items())
                              + "}" for name, values in found.items()) + "\n}\n"


def check_stored(path, found, tolerance):
    """Asserts that {name: {key: value}} is what the file has, to the relative tolerance."""
    if "--update" in sys.argv:
        with open(path, "w", encoding="utf-8") as file:
            file.write(one_line_a_key(found))
    with open(path, encoding="utf-8") as file:
        wrong = differences(json.load(file), found, tolerance)
    assert not wrong, "\n".join([f"differs from {os.path.basename(path)} ({os.path.basename(sys.argv[0])} --update renews it):"] + wrong)
