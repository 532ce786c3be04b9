"""What a localization can be told about runs that have not been made: whether its window, its probes and its concentration tensors will be in
the results of the steps that it reads, and whether two runs have the same load, by the parameters of these steps."""

import os

from chain.inputs import ChainError, output_named

RUNS = ("Input/Homogeneous run", "Input/Direct run")
LOADS = ("Top/Kind", "Top/Pressure", "Top/Expression", "Flat/Velocity", "Flat/Expression")  # those that no default of the run replaces


def parameters(printed):
    """{section/.../key: value} of what `PROGRAM file.prm --print-parameters` prints."""
    found, sections = {}, []
    for line in printed.splitlines():
        word, _, rest = line.strip().partition(" ")
        if word == "subsection":
            sections.append(rest.strip())
        elif word == "end":
            sections.pop()
        elif word == "set":
            key, _, value = rest.partition("=")
            found["/".join([*sections, key.strip()])] = value.strip()
    return found


def words(value):
    return [word.strip() for word in value.split(",") if word.strip()]


def number(value):
    """A number, or None for auto."""
    try:
        return float(value)
    except ValueError:
        return None


def check(step, own, others, folder):
    """Raises ChainError for what the results of `others` {name: parameters} will not have. `own`: parameters of the step."""
    maker = lambda key: output_named(os.path.relpath(own.get(key) or folder, folder), folder, list(others)) if own.get(key) else None
    begin, end = number(own["Window/From"]), number(own["Window/To"])
    for key in RUNS:
        if maker(key):
            _check_window(step, maker(key), others[maker(key)], begin, end, fields=bool(own["Localization/Fields"]))
    if all(map(maker, RUNS)) and own["Input/Allow different loads"] == "false":
        _check_loads(step, *((maker(key), others[maker(key)]) for key in RUNS))
    if maker(RUNS[0]):
        _check_probes(step, own["Probes/Of the run"], maker(RUNS[0]), others[maker(RUNS[0])])
    if maker("Input/RVE file"):
        _check_tensors(step, own["Localization/Concentration"], maker("Input/RVE file"), others[maker("Input/RVE file")])


def _check_window(step, name, run, begin, end, fields):
    if run["Analysis"] != "transient":
        return
    last = number(run["Time/End time"])
    if last is None:
        return
    if begin is not None and begin >= last:
        raise ChainError(f"{step.name}.prm: Window/From = {begin:g} s lies after the end of {name}, {last:g} s; change Window/From or its Time/End time")
    interval, first = number(run["Snapshots/Interval"]), number(run["Snapshots/From"])
    if not fields:
        return
    if not interval:
        raise ChainError(f"{step.name}.prm: {name} keeps no snapshots to average; set its Snapshots/Interval, or leave Localization/Fields empty")
    if first is None:
        return
    last = min(last, number(run["Snapshots/To"]) or last)
    low, high = max(first, begin or 0.0), min(last, last if end is None else end)
    if high < low - 0.5 * interval:
        raise ChainError(f"{step.name}.prm: no snapshot of {name} lies in the window, which goes {_span(begin, end)}: they are from {first:g} to {last:g} s; "
                         "change Window/From and To, or the Snapshots there")


def _check_loads(step, homogeneous, direct):
    """Of pairs of a name and its parameters."""
    for key in LOADS:
        one, two = homogeneous[1][key], direct[1][key]
        if one != two and (number(one) is None or number(one) != number(two)):
            raise ChainError(f"{step.name}.prm compares runs under different loads: {key} is {one or 'empty'} in {homogeneous[0]} and {two or 'empty'} in "
                             f"{direct[0]}; give both the same, or set Input/Allow different loads = true")


def _span(begin, end):
    return f"from {'the steady part' if begin is None else f'{begin:g} s'} to {'the end' if end is None else f'{end:g} s'}"


def _check_probes(step, wanted, name, run):
    there = words(run["Observation/Probes"])
    for probe in words(wanted):
        if probe != "all" and probe not in there:
            raise ChainError(f"{step.name}.prm: Probes/Of the run names {probe}, but {name} observes {', '.join(there) or 'no probes'}; correct the name")


def _check_tensors(step, condition, name, volume):
    solved = words(volume["Homogenization/Boundary conditions"])
    if condition not in solved:
        raise ChainError(f"{step.name}.prm: Localization/Concentration is {condition}, but {name} solves {', '.join(solved)}; add it to its "
                         "Homogenization/Boundary conditions")
    if volume["Homogenization/Write concentration"] == "false":
        raise ChainError(f"{step.name}.prm: {name} writes no concentration tensors; set its Homogenization/Write concentration = true")
