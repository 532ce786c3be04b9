"""Writes doc/paper/regimes.md: the map of regimes, the search for regime 2, the open choices."""

import os

import cycle_life
import diagrams
import growth_page
import open_choices
import regime_map
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
        rows.append([label] + [str(sum(all(rule(pair[w]) for rule in rules_met) for pair in found.values())) for w in (0, 1)])
    return rows


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
    write_csv(pictures, "open_choices.csv", ["choice", "what is changed", "window"] + MEASURE_COLUMNS,
              [[n, open_choices.CHOICES[n.split("-fine")[0]][0], w, *measure_row(m)] for n, pair in choices.items() for w, m in zip(("early", "late"), pair)])
    growth_page.write_branches(pictures, data.growth)
    growth_page.write_bodies(pictures, data.growth)
    diagrams.growth_over_delta(pictures, data.growth.paper, data.growth.morphologies)
    diagrams.regime_maps(pictures, found, AT_REST, "regime_map_rest.png")
    diagrams.regime_maps(pictures, found, tuple(regime_map.PUSHES), "regime_map_pushed.png")
    diagrams.search(pictures, found)
    diagrams.cycle_life(pictures, cycle_life.over_d22(lives), cycle_life.windows() + 0.5 * cycle_life.WINDOW)
    write_csv(pictures, "cycle_life.csv", ["cells along x [-]", *(f"{entry} [Pa]" for entry in cycle_life.ENTRIES), "from [s]"] + MEASURE_COLUMNS,
              [[case.cells[0], *(f"{value:.6g}" for value in case.stiffness.values()), f"{begin:g}", *measure_row(m)] for case, line in lives.items() for begin, m in zip(cycle_life.windows(), line)])
    write_page(folder, "regimes.md", "\n\n".join(_sections(found, choices, choice_results, lives, data)) + "\n")


def _sections(found, choices, choice_results, lives, data):
    return [*_summary(found, choices, data), *_both(choices, data), *_search(found), *_obtained(), *_coexistence(found), *_identity(found),
            *growth_page.regimes_section(data.growth, found), *cycle_life.section(lives), *_choices(choices), *_placements(choice_results)]


def _is_regime_two(m):
    return all(rule(m) for rule in CRITERIA.values())


def _span(values, scale=1.0):
    """Smallest to largest of the values, as text."""
    low, high = min(values) / scale, max(values) / scale
    return f"{low:g}" if low == high else f"{low:g} to {high:g}"


def _summary(found, choices, data):
    met = {point: m for point, pair in found.items() for m in pair if _is_regime_two(m)}
    if not met:
        raise RuntimeError("the map has no regime 2; the text of this page says it has")
    branch = [m for pair in found.values() for m in pair[1:] if 0.7 <= m.middle[2] <= 0.9]
    rest = sum(start in AT_REST for _, _, start in met)
    starts = dict.fromkeys(s for s in regime_map.STARTS if s in {p[2] for p in met})
    return ["# Regimes of the homogeneous pin",
            "**The paper's regime 2 exists under the printed equations and pressures, if the pin starts with a push.**\n"
            "\n"
            "* A start of 0.5 m/s along x leads to regime 1 at 0.5 MPa and to regime 2 at 0.4 MPa (table 1).\n"
            f"* Of the {len(found)} runs of the map over pressure, δ and start, {len(met)} have the three marks of regime 2 (below), with P = {_span([p for p, _, _ in met], 1e6)} MPa "
            f"at 2 m/s, δ = {_span([d for _, d, _ in met], 1e-9)} ns and the starts {' and '.join(f'*{s}*' for s in starts)}; {rest or 'none'} "
            "starts from rest.\n"
            f"* In {len(branch)} runs node M is separated 70 to 90 % of the time from 2 to 3 ms, at {_span([round(m.frequency / 1e3, 1) for m in branch])} "
            f"kHz, with mu_inter from {max(m.mu for m in branch):.2f} (small δ) to {min(m.mu for m in branch):.2f} "
            "(large δ).\n"
            "* From rest and at higher P/V there are also cycles near 124 and 176 kHz, where modes of steady sliding grow faster. The fastest mode is "
            f"{growth_page.fastest_branches(data.growth)}.",
            "![Separation of M and mu_inter in all runs; stars: the paper](regimes/regime2_search.png)"]


def _both(choices, data):
    def row(label, m):
        return [label, f"{m.mu:.3f}", f"{m.frequency / 1e3:.1f}", f"{100 * m.middle[2]:.0f}"]

    def pins(load):
        found = list(data.heterogeneous(load, seeds.LATE).values())
        shares = [100 * m.middle[2] for m in found]
        return [f"{len(found)} heterogeneous pins" + ("" if load.push else f", {load.label}"), f"{min(m.mu for m in found):.3f} to {max(m.mu for m in found):.3f}", "",
                f"{min(shares):.0f} to {max(shares):.0f}"]

    high, low, other = seeds.LOADS
    return ["## Both regimes",
            "Table 1. From 1 to 2 ms. The homogeneous pin has cells of 0.4 mm; the heterogeneous pins are those of [prediction](prediction.md).",
            table(["", "mu_inter", "kHz", "M separated [%]"], [
                ["paper, regime 1", "0.21", "41.2", "30"], row(high.label, choices["printed-pushed"][1]), pins(high),
                ["paper, regime 2", "0.17", "39.6", "80"], row(low.label, choices["lower-pushed"][1]), pins(low), pins(other)]),
            "[Paper](README.md#how-the-loading-was-read-both-regimes) has runs on finer cells and of 10 ms."]


def _identity(found):
    total, slipping, equal, mu = scaling(found)
    low, high = regime_map.PRESSURES[:2]
    return ["## Scaling with P and V",
            "If body and flat touch from the start, only P/V counts. While no node sticks or reverses its slip, the motion does not depend on V either and is proportional to P. "
            f"In {slipping} of {total} pairs of runs at {low / 1e6:g} and {high / 1e6:g} MPa no node stuck; {equal} of these pairs agree to {EQUAL:.0e} in the share of slip and mean "
            f"mu_app. Their mu_inter falls with P/V, by up to {mu:.4f}: it is the power of friction with the relative velocity, and part of the work of the flat goes into the pin. "
            "Therefore mean mu_app and mu_inter differ, unlike in remark 1 of the paper."]


def _obtained():
    return ["## How it was obtained",
            "`./run.sh prediction` makes the runs and this page. The pin has the stiffness of eq. (10), mu = 0.25, beta = 4.4 ns, beta2 = 0.5 and cells of "
            f"{56 / regime_map.CELLS[0]:g} mm unless said otherwise. The early window is 0.25 to 1 ms, the paper's "
            f"steady state; the late window of the map is {regime_map.LATE[0] * 1e3:g} to {regime_map.LATE[1] * 1e3:g} "
            "ms. The CSV have standard errors over eight blocks. The starts are:",
            "* *at once*: P and V act from the first step on.\n"
            "* *ramped*: P grows in 0.2 ms under the moving flat.\n"
            "* *pressed, then dragged*: P grows in 0.2 ms on the flat at rest; V acts from 0.3 ms on.\n"
            f"* pushes: at once, and the pin starts with P / (rho c_T) times {', '.join((f'{push:g} (*{name}*)' for name, push in regime_map.PUSHES.items()))} "
            "along x. The 0.5 m/s of table 1 are 4.94 at 0.5 MPa and 6.2 at 0.4 MPa.",
            "Grey: all nodes slide and nothing vibrates. [regime_map.csv](regimes/regime_map.csv) has all runs.",
            "![Late state of the runs from rest over P/V and delta](regimes/regime_map_rest.png)", "![Late state of the pushed runs over P/V and delta](regimes/regime_map_pushed.png)"]


def _search(found):
    return ["## Search for regime 2",
            f"How many of the {len(found)} runs of the map have the paper's marks of regime 2:",
            table(["mark of regime 2"] + [f"{w[0] * 1e3:g} to {w[1] * 1e3:g} ms" for w in (regime_map.EARLY, regime_map.LATE)], counts(found))]


def _coexistence(found):
    states = coexisting(found)
    p, d, most = min(states, key=lambda row: min(m.mu for m in row[2].values()) - max(m.mu for m in row[2].values()))
    ends = " to ".join(f"{most[s].mu:.3f} at {most[s].frequency / 1e3:.0f} kHz (*{s}*)" for s in (choose(most, key=lambda s: most[s].mu) for choose in (max, min)))
    points = len({(p, d) for p, d, _ in found})
    return ["## States that depend on the start",
            f"At {len(states)} of {points} points (P, δ) the late mu_inter of two starts differs by more than 0.01 and four standard errors. The largest range is {ends} at "
            f"{p / 1e6:g} MPa and δ = {d * 1e9:g} ns."]


def _choices(choices):
    rows = [[label, *short(choices[name][1])] for name, (label, _) in open_choices.CHOICES.items() if name in choices and not name.endswith("-pushed")]
    return ["## The open choices",
            f"Each row changes one choice of the first run; {open_choices.LATE[0] * 1e3:g} to {open_choices.LATE[1] * 1e3:g} "
            "ms. The paper's regime 1 has 0.21, 41.2 kHz and 70 / 30 %. [open_choices.csv](regimes/open_choices.csv) adds the early window, velocity and lift of M. If u_x is free on top, "
            "the flat carries the pin away.",
            table(["choice", "μ_inter", "kHz", "M slips [%]", "separated [%]"], rows)]


def _placements(results):
    rows = [[label, f"{100 * area:.1f}", f"{100 * line:.1f}"] + [f"{100 * d:+.1f}" for d in differences]
            for (label, _), (area, line, differences) in zip(open_choices.PLACEMENTS.values(), open_choices.placements(results).values())]
    return ["## Placement of the fibres",
            f"Means over seeds {min(open_choices.PLACEMENT_SEEDS)} to {max(open_choices.PLACEMENT_SEEDS)}. D11 to D33: "
            "mean of KUBC and SUBC, difference from eq. (10) in %.",
            table(["placement", "area [%]", "contact line [%]", "D11", "D12", "D22", "D33"], rows),
            "With all fibres inside, hardly any fibre reaches the contact; but the paper's element A is a fibre at the contact."]
