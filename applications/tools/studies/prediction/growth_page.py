"""The sections on growth of steady sliding of both pages, and their tables."""

import numpy as np
from scipy import stats

import delta_rules
import growth
import regime_map
from growth import AT
from pages import table, write_csv

SHOWN = (5e6, 20e6)  # Pa; ramped runs of the map beside the fastest modes


def kilohertz(s):
    return s.imag / (2e3 * np.pi)


def cell_size(cells):
    return f"{1e3 * growth.SIZE[0] / cells[0]:g} mm"


def write_branches(folder, found):
    """growth.csv of the page on regimes."""
    write_csv(folder, "growth.csv", ["stiffness", "delta [s]", "mode", "growth [1/s]", "frequency [Hz]"],
              [[name, d, k, f"{s.real:.6g}", f"{s.imag / 2 / np.pi:.7g}"] for name, branches in (("eq. (10)", found.paper), ("mean of the morphologies", found.mean))
               for d, line in zip(growth.DELTAS, branches) for k, s in enumerate(line)])


def write_morphologies(folder, found):
    """growth.csv of the page on prediction: mode -1 is the fastest."""
    rows = [[seed, k, s, o] for seed, line in found.morphologies.items() for k, (s, o) in enumerate(zip(line, found.overlaps[seed]))]
    rows += [[seed, "fastest", line[0], ""] for seed, line in found.leading.items()]
    write_csv(folder, "growth.csv", ["seed", "mode", "growth [1/s]", "frequency [Hz]", "overlap with the homogeneous pin's mode [-]"],
              [[seed, k, f"{s.real:.6g}", f"{s.imag / 2 / np.pi:.7g}", o and f"{o:.3f}"] for seed, k, s, o in rows])


def regimes_section(found, runs):
    """`runs` of regime_map.collect."""
    start = found.paper[AT]
    fastest, slow = max(start, key=lambda s: s.real), min(start, key=lambda s: abs(kilohertz(s) - 41.6))
    return ["## Growth of steady sliding",
            f"At 1500 ns the fastest mode, at {kilohertz(fastest):.2f} kHz, grows by {fastest.real:.0f} 1/s, the mode "
            f"at {kilohertz(slow):.2f} kHz, near the paper's main frequency, by {slow.real:.0f} 1/s (time constant {1e3 / slow.real:.1f} "
            "ms). Motion near 41 kHz in a run of 1 ms therefore comes mostly from the start. Growth depends neither on P nor on V. Picture and [table](regimes/growth.csv): eq. (10), "
            f"cells of {cell_size(growth.CELLS)}, modes followed over δ by the overlap of their shapes.",
            "![Growth rates over delta; strokes: ten morphologies](regimes/growth.png)",
            *_search(found), *_beside_runs(found, runs)]


def _search(found):
    return ["`Analysis = complex modes` of `contact_dynamics` ([theory](../theory.md#11-complex-modes-libeigenvaluescomplex)) finds all growing modes up to "
            f"{found.searched / 1e3:.0f} kHz; the argument principle counts {found.missing or 'no'} others. "
            "[growth_bodies.csv](regimes/growth_bodies.csv) has these modes in a transient run, on finer cells and with the mean stiffness of the morphologies."]


def write_bodies(folder, found):
    """The modes that grow at START: of eq. (10), in a run whose pressure grows for 1 ms (matrix pencil method on u_x of M in growth.WINDOW), on finer cells and with
    the other stiffness."""
    start = found.paper[AT][found.paper[AT].real > 0]
    if len(found.mean[AT]) != len(start):
        raise RuntimeError(f"{len(start)} modes grow with eq. (10), {len(found.mean[AT])} with the mean stiffness")
    columns = {f"eq. (10), {cell_size(growth.CELLS)}": start, f"run, {cell_size(growth.CELLS)}": found.seen,
               **{f"eq. (10), {cell_size(cells)}": line for cells, line in found.refined.items()},
               f"mean stiffness, {cell_size(growth.CELLS)}": found.mean[AT]}
    write_csv(folder, "growth_bodies.csv", ["body", "mode", "growth [1/s]", "frequency [kHz]"],
              [[body, k, f"{s.real:.1f}", f"{kilohertz(s):.3f}"] for body, line in columns.items() for k, s in enumerate(line)])


def fastest_branches(found):
    """Which mode of eq. (10) grows fastest at which delta, as text."""
    fastest = np.argmax(found.paper.real, axis=1)
    parts = []
    for k in dict.fromkeys(fastest):
        at = [1e9 * d for d, which in zip(growth.DELTAS, fastest) if which == k]
        parts.append(f"near {kilohertz(found.paper[AT][k]):.0f} kHz at {min(at):g} to {max(at):g} ns")
    return ", ".join(parts)


def _beside_runs(found, runs):
    """Ramped runs beside the fastest modes: {delta: largest relative difference of the main frequency}"""
    apart = {}
    for delta, line in zip(growth.DELTAS, found.paper):
        late = [runs.get((p, d, "ramped")) for p in SHOWN for d in regime_map.DELTAS if abs(d - delta) < 1e-12]
        if len(late) == len(SHOWN) and all(late):
            tone = kilohertz(max(line, key=lambda s: s.real))
            apart[delta] = max(abs(m.frequency / 1e3 / tone - 1) for _, m in late)
    near = [delta for delta, difference in apart.items() if difference < 0.05]
    if growth.START not in near or max(apart) in near:
        raise RuntimeError("the text of this page on ramped runs is not what they show")
    return [f"Ramped runs at {' and '.join(f'{p / 1e6:g}' for p in SHOWN)} "
            f"MPa vibrate from {regime_map.LATE[0] * 1e3:g} to {regime_map.LATE[1] * 1e3:g} ms at the frequency of "
            f"the fastest mode within {100 * max((apart[d] for d in near)):.0f} % for δ = {min(near) * 1e9:g} to {max(near) * 1e9:g} "
            "ns."]


def write_correlations(folder, found, keys, runs):
    """Spearman's rank correlation over the morphologies of growth with mu_inter, by mode of the homogeneous pin."""
    write_csv(folder, "growth_correlations.csv", ["mode, homogeneous [kHz]", "load", "window", "rank correlation [-]"],
              [[mode, load.label, window, value] for mode, values in correlations(found, keys, runs).items() for (load, window), value in zip(keys, values)])


def correlations(found, keys, runs):
    """{mode: texts for each of `keys`}"""
    values = {f"{kilohertz(s):.2f}": [_rank_correlation(found.morphologies, runs[key], lambda line, k=k: line[k].real) for key in keys] for k, s in enumerate(found.mean[AT])}
    return {**values, "fastest": [_rank_correlation(found.leading, runs[key], lambda line: line[0].real) for key in keys]}


def prediction_section(data, keys, runs):
    """`keys` (load, window), `runs` {key: {seed: Measures}}."""
    found = data.growth
    rows = []
    for k, s in enumerate(found.mean[AT]):
        lines = list(found.morphologies.values())
        rates = delta_rules.interval([line[k].real for line in lines])
        tones = delta_rules.interval([kilohertz(line[k]) for line in lines])
        alike = [overlaps[k] for overlaps in found.overlaps.values()]
        stars = delta_rules.interval([1e9 * growth.matching_delta(found, k, line[k]) for line in lines])
        rows.append([f"{kilohertz(s):.2f}", f"{tones[0]:.2f} ± {tones[2]:.2f}", f"{min(alike):.2f} to {max(alike):.2f}", *_rates(s.real, rates, stars)])
    leading = [line[0] for line in found.leading.values()]
    rates, stars = (delta_rules.interval(values) for values in (
        [s.real for s in leading], [1e9 * growth.matching_delta_of_fastest(found, seed) for seed in found.leading]))
    rows.append(["fastest", "–", "–", *_rates(found.fastest[AT], rates, stars)])
    near = {k: sum(np.argmin(abs(line - values[0])) == k and abs(line - values[0]).min() < 1e-3 * abs(values[0])
                   for line, values in zip(found.morphologies.values(), found.leading.values())) for k in range(len(found.mean[AT]))}
    counts = sorted({len(line) for line in found.leading.values()})
    every = [float(value) for values in correlations(found, keys, runs).values() for value in values]
    level = _significant(len(lines))
    return ["## Growth rates of steady sliding",
            f"Table 3. All growing eigenvalues of the sliding pin at 1500 ns on cells of {cell_size(growth.CELLS)}, "
            "found as in [regimes](regimes.md#growth-of-steady-sliding). A mode of a morphology belongs to the homogeneous mode with "
            "the most similar shape (overlap 1: equal). At δ* the homogeneous mode grows as the mode of the morphology. "
            f"{search_of_morphologies(found)}.",
            table(["kHz, homogeneous", "kHz, morphologies", "overlap", "growth, homogeneous [1/s]", "growth, morphologies [1/s]", "deviation", "δ* [ns]", "deviation"], rows),
            f"In each morphology {counts[0]} to {counts[-1]} modes grow; the fastest is near "
            f"{' or '.join(f'{kilohertz(found.mean[AT][k]):.0f} kHz ({n})' for k, n in near.items() if n)} (number "
            "of morphologies). Frequencies agree within a per cent. Growth rates differ widely, as each is a small difference between energy supplied by friction and energy lost. "
            f"{sum(abs(value) > level for value in every)} of the {len(every)} rank correlations of growth with mu_inter "
            f"([table](prediction/growth_correlations.csv)) exceed {level:.2f}, the 5 % level of a single one."]


def search_of_morphologies(found):
    others = f"counts {found.missing} others in all runs" if found.missing else "counts no others there"
    return (f"The modes of the morphologies were searched up to {found.searched_morphologies / 1e3:.0f} kHz; the argument "
            f"principle {others}. Contact nodes that are separated in the static state (at most {max(found.separated.values())}) are free")


def _rates(homogeneous, rates, stars):
    return [f"{homogeneous:.0f}", f"{rates[0]:.0f} ± {rates[2]:.0f}", f"{rates[1]:.0f}", f"{stars[0]:.0f} ± {stars[2]:.0f}", f"{stars[1]:.0f}"]


def _rank_correlation(lines, found, rate):
    names = [s for s in lines if s in found]
    return f"{stats.spearmanr([rate(lines[s]) for s in names], [found[s].mu for s in names])[0]:+.2f}"


def _significant(n, level=0.05):
    """|r| of n pairs beyond which a correlation is significant (Student's t)."""
    t = stats.t.ppf(1 - level / 2, n - 2)
    return t / np.sqrt(n - 2 + t * t)
