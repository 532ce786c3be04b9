"""Writes doc/paper/regimes.md: the map of regimes, the search for regime 2, the open choices."""

import os


import cycle_life
import diagrams
import growth_page
import open_choices
import regime_map
import rules
import seeds
from pages import table, write_csv, write_page
from tables import MEASURE_COLUMNS, measure_row, short

AT_REST = tuple(start for start in regime_map.STARTS if start not in regime_map.PUSHES)
EQUAL = 1e-11
# The paper's regime 2 with the room it leaves: separation of M 80 %, mu_inter 0.17 to 0.18, 39.6 kHz (bands +- 0.1, 0.005, 1 %).
CRITERIA = {"M is separated 70 to 90 % of the time": lambda m: 0.7 <= m.middle[2] <= 0.9,
            "μ_inter is 0.165 to 0.185": lambda m: 0.165 <= m.mu <= 0.185,
            "main frequency is 39.2 to 40.0 kHz": lambda m: 39.2e3 <= m.frequency <= 40.0e3}


def scaling(found):
    """The two lowest pressures at equal delta and start: how many pairs of runs there are, in how many no node stuck in either window, in
    how many of these the shares of slip and mean mu_app are equal to EQUAL, and the largest difference of mu_inter in those."""
    low, high = regime_map.PRESSURES[:2]
    pairs = [(found[low, d, s], found[high, d, s]) for (p, d, s) in found if p == low and (high, d, s) in found]
    slipping = [(a, b) for a, b in pairs if max(m.shares[1] for m in (*a, *b)) == 0]
    equal = [(a, b) for a, b in slipping if all(abs(x - y) < EQUAL for m, n in zip(a, b)
                                                for x, y in ((m.shares[0], n.shares[0]), (m.mu_app, n.mu_app)))]
    return len(pairs), len(slipping), len(equal), max(abs(m.mu - n.mu) for a, b in equal for m, n in zip(a, b))


def counts(found):
    """Rows (criterion, windows early, late) for each criterion and for all of them."""
    rows = []
    for label, rules_met in [*((name, [rule]) for name, rule in CRITERIA.items()), ("all three", list(CRITERIA.values()))]:
        rows.append([label] + [f"{sum(all(rule(pair[w]) for rule in rules_met) for pair in found.values())} of {len(found)}" for w in (0, 1)])
    return rows


def nearest(found, how_many=5):
    """The runs nearest to the paper's regime 2: distances in units of the bands of CRITERIA."""
    def distance(m):
        return ((m.middle[2] - 0.8) / 0.1)**2 + ((m.mu - 0.175) / 0.01)**2 + ((m.frequency - 39.6e3) / 0.4e3)**2
    every = [(distance(pair[w]), point, w, pair[w]) for point, pair in found.items() for w in (0, 1) if not pair[w].slides]
    return sorted(every, key=lambda row: row[0])[:how_many]


def coexisting(found):
    """Points (P, delta) with their late states from all starts, where these differ: [(P, delta, {start: Measures})]."""
    points = sorted({(p, d) for p, d, _ in found})
    result = []
    for p, d in points:
        states = {s: found[p, d, s][1] for s in regime_map.STARTS if (p, d, s) in found}
        mus = [m.mu for m in states.values()]
        noise = 4 * max(m.mu_error for m in states.values())
        if max(mus) - min(mus) > max(0.01, noise):
            result.append((p, d, states))
    return result


def write(folder, found, choice_results, lives, data):
    """`found` of regime_map.collect, the results of the part `choices`, `lives` of cycle_life.collect, `data` of the part
    `seeds` and of growth (rules.Data)."""
    choices = open_choices.collect(choice_results)
    pictures = os.path.join(folder, "regimes")
    write_csv(pictures, "regime_map.csv", ["P [Pa]", "delta [s]", "start", "window"] + MEASURE_COLUMNS,
              [[p, d, s, w, *measure_row(m)] for (p, d, s), pair in found.items() for w, m in zip(("early", "late"), pair)])
    write_csv(pictures, "open_choices.csv", ["choice", "window"] + MEASURE_COLUMNS,
              [[n, w, *measure_row(m)] for n, pair in choices.items() for w, m in zip(("early", "late"), pair)])
    growth_page.write_branches(pictures, data.growth)
    diagrams.growth_over_delta(pictures, data.growth.paper, data.growth.morphologies)
    diagrams.regime_maps(pictures, found, AT_REST, "regime_map_rest.png")
    diagrams.regime_maps(pictures, found, tuple(regime_map.PUSHES), "regime_map_pushed.png")
    diagrams.search(pictures, found)
    diagrams.cycle_life(pictures, cycle_life.over_d22(lives), cycle_life.windows() + 0.5 * cycle_life.WINDOW)
    write_csv(pictures, "cycle_life.csv", ["cells along x [-]", *(f"{entry} [Pa]" for entry in cycle_life.ENTRIES), "from [s]"] + MEASURE_COLUMNS,
              [[case.cells[0], *(f"{value:.6g}" for value in case.stiffness.values()), f"{begin:g}", *measure_row(m)] for case, line in lives.items() for begin, m in zip(cycle_life.windows(), line)])
    write_page(folder, "regimes.md", "\n\n".join(_sections(found, choices, choice_results, lives, data)) + "\n")


def _sections(found, choices, choice_results, lives, data):
    return [*_head(found), *_short(found, choices, data), *_identity(found), *growth_page.regimes_section(data.growth, found), *_map(), *_search(found),
            *_coexistence(found), *_over_delta(data), *cycle_life.section(lives), *_choices(choices), *_placements(choice_results)]


def _head(found):
    return ["# Regimes of the homogeneous pin",
            "Written by `./run.sh prediction`; every number but the paper's is from its runs. Stiffness of eq. (10), mu = 0.25, "
            f"beta = 4.4 ns, beta2 = 0.5, cells of {56 / regime_map.CELLS[0]:g} mm unless said otherwise. M is the middle "
            "contact node. Two windows: 0.25 to 1 ms, where the paper has its steady state, and a late one. "
            "± is twice the standard error of eight block means."]


def _is_regime_two(m):
    return all(rule(m) for rule in CRITERIA.values())


def _span(values, scale=1.0):
    """Smallest to largest of the values, as text."""
    low, high = min(values) / scale, max(values) / scale
    return f"{low:g}" if low == high else f"{low:g} to {high:g}"


def _short(found, choices, data):
    met = {point: m for point, pair in found.items() for m in pair if _is_regime_two(m)}
    if not met:
        raise RuntimeError("the map has no regime 2; the text of this page says it has")
    branch = [m for pair in found.values() for m in pair[1:] if 0.7 <= m.middle[2] <= 0.9]
    rest = sum(start in AT_REST for _, _, start in met)
    printed, lower = choices["printed-pushed"][1], choices["lower-pushed"][1]
    pins = {load: list(data.heterogeneous(load, seeds.LATE).values()) for load in seeds.LOADS}
    heterogeneous = "; ".join(
        f"{load.label}: mu_inter {min(m.mu for m in p):.3f} to {max(m.mu for m in p):.3f}, M separated {100 * min(m.middle[2] for m in p):.0f} to "
        f"{100 * max(m.middle[2] for m in p):.0f} %" for load, p in pins.items())
    return ["## In short",
            "* Alike but for the size, the printed 0.5 and 0.4 MPa give one motion of one pin (next section). What tells them apart is a start that does not scale "
            "with them, such as a given velocity of the pin.\n"
            f"* **Regime 2 exists under the printed equations.** {len(met)} of the {len(found)} runs of the map meet its three marks in a window, "
            f"with P = {_span([p for p, _, _ in met], 1e6)} MPa at 2 m/s and delta = {_span([d for _, d, _ in met], 1e-9)} ns, starts: "
            f"{', '.join(dict.fromkeys(s for s in regime_map.STARTS if s in {p[2] for p in met}))}. Of those that start from rest {rest or 'none'} does. "
            f"The pin pushed at 0.5 m/s has late, on cells of 0.4 mm, mu_inter = {lower.mu:.3f}, {lower.frequency / 1e3:.1f} kHz, M separated {100 * lower.middle[2]:.0f} % at 0.4 MPa "
            f"(paper: 0.17, 39.6, 80), and {printed.mu:.3f}, {printed.frequency / 1e3:.1f} kHz, {100 * printed.middle[2]:.0f} % at 0.5 MPa (0.21, 41.2, 30). How long "
            "regime 2 lasts: [paper](README.md).\n"
            f"* It is one end of a branch: in {len(branch)} runs, of all delta, M is separated 70 to 90 % of the time late, with main frequencies of {_span([round(m.frequency / 1e3, 1) for m in branch])} kHz "
            f"and mu_inter from {max(m.mu for m in branch):.2f} (small delta) to {min(m.mu for m in branch):.2f} (large delta).\n"
            "* From rest and at higher P/V the map has cycles near 124 and 176 kHz beside those near 41 kHz. Steady sliding has unstable modes near these "
            f"frequencies, and they grow faster than that at 41 kHz: the fastest is that {growth_page.fastest_branches(data.growth)}.\n"
            "* The platen and the push are readings, not findings. For the platen: the two modes of fig. 8. For the push: both regimes at both printed pressures.\n"
            f"* The {len(pins[seeds.LOADS[0]])} heterogeneous pins of [prediction](prediction.md), late. {heterogeneous}. In the paper one of two is in regime 2 at 0.4 MPa "
            "(table 3: 0.173 and 0.213), here all are."]


def _identity(found):
    total, slipping, equal, mu = scaling(found)
    low, high = regime_map.PRESSURES[:2]
    return ["## What P and V can do",
            "With the flat touching from the start, (u, P, V) → (s u, s P, s V) takes solutions into solutions: P and V count by "
            "P/V alone. While no node sticks or reverses its slip V does not count either, and the motion scales with P. Checked with "
            f"{low / 1e6:g} and {high / 1e6:g} MPa at 2 m/s: in {slipping} of {total} pairs of runs no node stuck in either window. In {equal} of these share of slip "
            f"and mean apparent friction are the same to {EQUAL:.0e}; in the others nodes stuck or turned outside the windows, after which motions part. mu_inter itself falls with P/V, by up to "
            f"{mu:.4f} there: it is the power of friction with the relative velocity, and part of the flat's work goes into the pin. So mean mu_app "
            "and mu_inter are not equal, unlike in the paper's remark 1."]


def _map():
    return ["## The map",
            "Starts: *at once*, P and V from the first step; *ramped*, P grows in 0.2 ms under the moving flat; *pressed, then dragged*, P "
            "likewise on the flat at rest, V at once at 0.3 ms; the pushes, at once with a velocity of P / (rho c_T) times "
            + ", ".join(f"{push:g} (*{name}*)" for name, push in regime_map.PUSHES.items())
            + f" along x. The 0.5 m/s of [paper](README.md) are 4.94 at 0.5 MPa and 6.2 at 0.4 MPa. State from {regime_map.LATE[0] * 1e3:g} to {regime_map.LATE[1] * 1e3:g} ms; grey: all nodes slide, no vibration. [Table](regimes/regime_map.csv).",
            "![map, from rest](regimes/regime_map_rest.png)", "![map, pushed](regimes/regime_map_pushed.png)"]


def _search(found):
    rows = [[f"{p / 1e6:g}", f"{d * 1e9:g}", s, "late" if w else "early", *short(m)[:3]] for _, (p, d, s), w, m in nearest(found)]
    largest = max((pair[w].middle[2], point, w) for point, pair in found.items() for w in (0, 1))
    return ["## Search for regime 2",
            "The paper's regime 2: M slips 20 % and is separated 80 % of the time, mu_inter 0.17 to 0.18, 39.6 kHz. Runs of the map that meet it:",
            table(["mark of regime 2"] + [f"{w[0] * 1e3:g} to {w[1] * 1e3:g} ms" for w in (regime_map.EARLY, regime_map.LATE)], counts(found)),
            "![search](regimes/regime2_search.png)",
            f"The largest separation of M in any run is {100 * largest[0]:.0f} % (P = {largest[1][0] / 1e6:g} MPa at 2 m/s, δ = {largest[1][1] * 1e9:g} ns, {largest[1][2]}). Early values above mu = 0.25 are "
            "those of hard pushes: friction takes the energy of the push as well. Nearest to regime 2:",
            table(["P [MPa]", "δ [ns]", "start", "window", "μ_inter", "kHz", "M slips / separated [%]"], rows)]


def _coexistence(found):
    states = coexisting(found)
    shown = sorted(states, key=lambda row: min(m.mu for m in row[2].values()) - max(m.mu for m in row[2].values()))[:8]
    rows = [[f"{p / 1e6:g}", f"{d * 1e9:g}"] + [f"{m[s].mu:.3f}, {m[s].frequency / 1e3:.0f} kHz" if s in m else "" for s in regime_map.STARTS]
            for p, d, m in shown]
    points = len({(p, d) for p, d, _ in found})
    return ["## States that depend on the start",
            f"At {len(states)} of {points} points (P, δ) the late mu_inter differs between starts by more than 0.01 and four standard errors. "
            "Some are coexisting cycles; with the ramped start and slow growth others are not at their end after 3 ms. The largest differences:",
            table(["P [MPa]", "δ [ns]", *regime_map.STARTS], rows)]


def _over_delta(data):
    rows = []
    for load in seeds.LOADS:
        for name, window in rules.WINDOWS.items():
            sweep = data.sweep(load, window)
            rows.append([load.label, name] + [f"{m.mu:.3f} ({100 * abs(m.middle[2]):.0f})" for m in sweep.measures])
    header = ["load", "window"] + [f"δ = {d * 1e9:g} ns" for d in data.sweep(seeds.LOADS[0], seeds.LATE).deltas]
    return ["## mu_inter over delta, as in fig. 11",
            f"mu_inter (M separated, %). At once, cells of {56 / seeds.COARSE[0]:g} mm, early 0.25 to 1 ms, late {seeds.LATE[0] * 1e3:g} to {seeds.LATE[1] * 1e3:g} ms. The paper says of its curve that the slope changes sign at 300 Δt = 1500 ns, "
            "which it puts down to the change from regime 2 to regime 1. Here a pushed pin keeps its regime over all delta and mu_inter falls; from rest "
            "mu_inter rises, up to steady sliding:", table(header, rows)]


def _choices(choices):
    paper = ["**paper, regime 1**", "", "0.21 (0.22: table 2)", "41.2", "70 / 30", "-0.80 to +0.80", "0.2"]
    rows = [paper]
    for name, (label, _) in open_choices.CHOICES.items():
        if name in choices:
            early, late = choices[name]
            rows += [[label, "early", *short(early)], ["", "late", *short(late)]]
    return ["## The open choices",
            f"One changed at a time from the first row, on cells of 0.4 mm; early 0.25 to 1 ms, late {open_choices.LATE[0] * 1e3:g} to {open_choices.LATE[1] * 1e3:g} ms. The velocity of M along x follows "
            "from the paper's relative velocity, 1.2 to 2.8 m/s (fig. 5); the lift is that of fig. 4. With u_x free on top nothing holds the "
            "pin: it is carried away with the flat.",
            table(["choice", "window", "μ_inter", "kHz", "M slips / separated [%]", "velocity of M [m/s]", "lift [µm]"], rows)]


def _placements(results):
    rows = [[label, f"{100 * area:.1f}", f"{100 * line:.1f}"] + [f"{100 * d:+.1f}" for d in differences]
            for (label, _), (area, line, differences) in zip(open_choices.PLACEMENTS.values(), open_choices.placements(results).values())]
    return ["## Placement of the fibres",
            f"Means over seeds {min(open_choices.PLACEMENT_SEEDS)} to {max(open_choices.PLACEMENT_SEEDS)}; the stiffness is the mean of KUBC and SUBC, its difference from eq. (10) in %:",
            table(["placement", "area [%]", "contact line [%]", "D11", "D12", "D22", "D33"], rows),
            "With all fibres inside hardly any reaches the contact, which the paper's element A does."]
