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
    rows = [[f"{kilohertz(s):.2f}"] + [f"{line[k].real:.0f}" for line in found.paper] for k, s in enumerate(start)]
    return ["## Growth of steady sliding",
            f"Eigenvalues of the pin of eq. (10) that slides steadily, on cells of {cell_size(growth.CELLS)}. They depend neither on P nor on V. All modes that grow at one of these δ, each followed over δ by the overlap of its shape; growth in 1/s:",
            table(["kHz at 1500 ns"] + [f"δ = {d * 1e9:g} ns" for d in growth.DELTAS], rows),
            "![growth](regimes/growth.png)",
            f"At 1500 ns the fastest mode, at {kilohertz(fastest):.2f} kHz, grows by {fastest.real:.0f} 1/s. That near 41.6 kHz, the paper's main frequency, grows by {slow.real:.0f} 1/s: a time "
            f"constant of {1e3 / slow.real:.1f} ms, and the fastest grows {fastest.real / slow.real:.0f} times as fast. What a run of 1 ms shows near 41 kHz is therefore mostly what the start put "
            "there; other modes take over later. The short strokes beside 1500 ns are the ten morphologies of [prediction](prediction.md).",
            *_search(found), *_other_bodies(found), *_beside_runs(found, runs)]


def _search(found):
    return ["All these are modes of steady sliding by `Analysis = complex modes` of `contact_dynamics`, which finds every mode that grows up to a frequency "
            f"([theory](../theory.md#11-complex-modes-libeigenvaluescomplex)); here up to {found.searched / 1e3:.0f} kHz. The argument principle counts "
            f"{found.missing or 'no'} others in any of the runs. No mode above {found.bound / 1e3:.0f} kHz can grow at 1500 ns on these cells, by the numerical range of friction in the "
            f"elastic energy; between the two frequencies nothing was searched. Residuals are below {found.residual:.0e} of the terms of the equation. "
            "Growth and frequency are also those of a run (next table, and `tests/system/pages/prediction.py`). Contact nodes that are separated in the static state are free; "
            f"there are {_separated(found)}."]


def _separated(found):
    grids = ", ".join(f"{found.separated[cells]} on cells of {cell_size(cells)}" for cells in (growth.CELLS, *growth.FINER))
    pins = [found.separated[seed] for seed in found.morphologies]
    return f"{grids}, and {min(pins)} to {max(pins)} in the morphologies"


def _other_bodies(found):
    """The modes that grow at START, on finer cells and with the other stiffness."""
    start = found.paper[AT][found.paper[AT].real > 0]
    if len(found.mean[AT]) != len(start):
        raise RuntimeError(f"{len(start)} modes grow with eq. (10), {len(found.mean[AT])} with the mean stiffness")
    columns = {f"eq. (10), {cell_size(growth.CELLS)}": start, f"run, {cell_size(growth.CELLS)}": found.seen,
               **{f"eq. (10), {cell_size(cells)}": line for cells, line in found.refined.items()},
               f"mean stiffness, {cell_size(growth.CELLS)}": found.mean[AT]}
    rows = [[f"{line[k].real:.1f} at {kilohertz(line[k]):.3f}" for line in columns.values()] for k in range(len(start))]
    return ["The modes that grow at 1500 ns, growth in 1/s at kHz: of eq. (10); in a run of `contact_dynamics` whose pressure grows for 1 ms, "
            f"from {growth.WINDOW[0] * 1e3:g} to {growth.WINDOW[1] * 1e3:g} ms, while all nodes slide (matrix pencil method on u_x of M); on finer cells; and with the mean stiffness of the "
            "ten morphologies:", table(list(columns), rows)]


def fastest_branches(found):
    """Which mode of eq. (10) grows fastest at which delta, as text."""
    fastest = np.argmax(found.paper.real, axis=1)
    parts = []
    for k in dict.fromkeys(fastest):
        at = [1e9 * d for d, which in zip(growth.DELTAS, fastest) if which == k]
        parts.append(f"near {kilohertz(found.paper[AT][k]):.0f} kHz at {min(at):g} to {max(at):g} ns")
    return ", ".join(parts)


def _beside_runs(found, runs):
    rows = []
    for delta, line in zip(growth.DELTAS, found.paper):
        late = [runs.get((p, d, "ramped")) for p in SHOWN for d in regime_map.DELTAS if abs(d - delta) < 1e-12]
        if len(late) == len(SHOWN) and all(late):
            fastest = max(line, key=lambda s: s.real)
            if delta == growth.START and any(abs(m.frequency / 1e3 - kilohertz(fastest)) > 2 for _, m in late):
                raise RuntimeError("the ramped runs at 1500 ns are not at the frequency of the fastest mode; the text of this page says they are")
            rows.append([f"{delta * 1e9:g}", f"{kilohertz(fastest):.1f}", f"{fastest.real:.0f}", *(f"{m.frequency / 1e3:.1f}" for _, m in late)])
    return ["A start with a ramp leaves the choice to growth. Main frequencies of such runs of the map from "
            f"{regime_map.LATE[0] * 1e3:g} to {regime_map.LATE[1] * 1e3:g} ms beside the fastest mode:",
            table(["δ [ns]", "fastest mode [kHz]", "its growth [1/s]", *(f"run at {p / 1e6:g} MPa [kHz]" for p in SHOWN)], rows),
            "The dominant frequency of the transient runs, near 124 kHz at 1500 ns, is that of the fastest mode, and so is that near 180 kHz at smaller δ; once nodes stick or leave the flat "
            "it shifts by some per cent. Where growth is slowest, at 3000 ns, the mode near 41.6 kHz that the ramp excited is still the largest after 3 ms."]


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
        rows.append([f"{kilohertz(s):.2f}", f"{tones[0]:.2f} ± {tones[2]:.2f}", f"{min(alike):.2f} to {max(alike):.2f}", *_rates(s.real, rates, stars),
                     *(_rank_correlation(found.morphologies, runs[key], lambda line, k=k: line[k].real) for key in keys)])
    leading = [line[0] for line in found.leading.values()]
    rates, stars = (delta_rules.interval(values) for values in (
        [s.real for s in leading], [1e9 * growth.matching_delta_of_fastest(found, seed) for seed in found.leading]))
    rows.append(["fastest", "–", "–", *_rates(found.fastest[AT], rates, stars), *(_rank_correlation(found.leading, runs[key], lambda line: line[0].real) for key in keys)])
    near = {k: sum(np.argmin(abs(line - values[0])) == k and abs(line - values[0]).min() < 1e-3 * abs(values[0])
                   for line, values in zip(found.morphologies.values(), found.leading.values())) for k in range(len(found.mean[AT]))}
    counts = sorted({len(line) for line in found.leading.values()})
    return ["## Growth rates of steady sliding",
            f"Eigenvalues of the sliding pin at 1500 ns on cells of {cell_size(growth.CELLS)}, homogeneous with the mean stiffness and with each morphology: all modes that grow, found as "
            "[regimes](regimes.md) says. Each morphology's mode is the one whose shape is most like that of the homogeneous pin (*overlap*: 1 for equal shapes), so that the "
            f"two modes near 124 kHz, {_apart(found.mean[AT]):.1f} kHz apart, are not mixed; the last row is the fastest mode of each, "
            "whichever it is. *δ\\**: where the homogeneous mode grows as that of the morphology (by the slope over δ at 1500 ns; for the fastest along its curve). "
            f"And Spearman's rank correlation over the morphologies of the growth rate with mu_inter. {search_of_morphologies(found)}:",
            table(["kHz, homogeneous", "kHz, morphologies", "overlap", "growth, homogeneous [1/s]", "growth, morphologies [1/s]", "deviation",
                      "δ* [ns]", "deviation"] + [f"correlation, {load.label}, {w}" for load, w in keys], rows),
            f"The fastest mode is that near {' or '.join(f'{kilohertz(found.mean[AT][k]):.0f} kHz ({n})' for k, n in near.items() if n)} (number of morphologies); "
            f"{counts[0]} to {counts[-1]} modes grow in each. "
            "The frequencies agree within a per cent. The growth rates part widely from one morphology to the next, though the effective stiffnesses agree "
            "within some tenths of a per cent: a growth rate is a percent or less of the angular frequency, a small difference between what friction feeds in "
            "and what is lost. Here morphologies differ that are equal in statics and in free vibration; the paper found no such difference (section 3.6.2). "
            f"With {len(lines)} morphologies a single correlation is significant at 5 % above {_significant(len(lines)):.2f}; {len(rows) * len(keys)} are shown, so that one such is to be expected."]


def search_of_morphologies(found):
    others = f"counts {found.missing} others in all runs" if found.missing else "counts no others there"
    return (f"The modes of the morphologies were looked for up to {found.searched_morphologies / 1e3:.0f} kHz, and the argument principle {others}. Contact nodes that "
            f"are separated in the static state are free: {by_seed({seed: found.separated[seed] for seed in found.morphologies})}")


def by_seed(numbers):
    """{seed: number of nodes} in words, the commonest number last: none in seeds 1 and 6, two in seed 8, one in each of the others."""
    seeds_of = {}
    for seed, count in sorted(numbers.items()):
        seeds_of.setdefault(count, []).append(str(seed))
    commonest = max(seeds_of, key=lambda count: (len(seeds_of[count]), -count))
    word = lambda count: {0: "none", 1: "one", 2: "two", 3: "three"}.get(count, str(count))
    parts = []
    for count, names in sorted(seeds_of.items()):
        if count != commonest:
            of = f"seeds {', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else f"seed {names[0]}"
            parts.append(f"{word(count)} in {'each of ' if count and len(names) > 1 else ''}{of}")
    return ", ".join([*parts, f"{word(commonest)} in each of the others" if parts else f"{word(commonest)} in each"])


def _apart(modes):
    """Distance in kHz of the two modes that are nearest to each other."""
    return np.diff(sorted(kilohertz(s) for s in modes)).min()


def _rates(homogeneous, rates, stars):
    return [f"{homogeneous:.0f}", f"{rates[0]:.0f} ± {rates[2]:.0f}", f"{rates[1]:.0f}", f"{stars[0]:.0f} ± {stars[2]:.0f}", f"{stars[1]:.0f}"]


def _rank_correlation(lines, found, rate):
    names = [s for s in lines if s in found]
    return f"{stats.spearmanr([rate(lines[s]) for s in names], [found[s].mu for s in names])[0]:+.2f}"


def _significant(n, level=0.05):
    """|r| of n pairs beyond which a correlation is significant (Student's t)."""
    t = stats.t.ppf(1 - level / 2, n - 2)
    return t / np.sqrt(n - 2 + t * t)
