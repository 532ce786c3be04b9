"""Writes doc/paper/prediction.md: scatter over morphologies, rules for delta*, and how far each gets."""

import os

import numpy as np

import delta_rules
import diagrams
import growth_page
import rules
import seeds
from measures import measure
from pages import table, write_csv, write_page
from tables import MEASURE_COLUMNS, measure_row


def write(folder, data):
    pictures = os.path.join(folder, "prediction")
    keys = [(load, name) for load in seeds.LOADS for name in rules.WINDOWS]
    sweeps = {key: data.sweep(key[0], rules.WINDOWS[key[1]]) for key in keys}
    runs = {key: data.heterogeneous(key[0], rules.WINDOWS[key[1]]) for key in keys}
    tried = {key: rules.all_rules(data, key[0], rules.WINDOWS[key[1]]) for key in keys}
    errors = {key: {name: delta_rules.errors(sweeps[key], deltas, runs[key]) for name, (_, _, deltas) in tried[key].items()}
              for key in keys}
    write_csv(pictures, "morphologies.csv", ["load", "window", "seed"] + MEASURE_COLUMNS,
              [[load.label, w, s, *measure_row(m)] for (load, w), found in runs.items() for s, m in found.items()])
    write_csv(pictures, "homogeneous.csv", ["load", "window", "delta [s]"] + MEASURE_COLUMNS,
              [[load.label, w, d, *measure_row(m)] for (load, w), sweep in sweeps.items() for d, m in zip(sweep.deltas, sweep.measures)])
    write_csv(pictures, "rules.csv", ["load", "window", "rule", "seed", "delta* [s]"],
              [[key[0].label, key[1], name, s, f"{d:.5g}"] for key in keys for name, (_, _, deltas) in tried[key].items() for s, d in deltas.items()])
    write_csv(pictures, "comparison.csv", COMPARISON_COLUMNS, [_comparison(data, key, sweeps[key], runs[key]) for key in keys])
    write_csv(pictures, "rule_errors.csv", ERROR_COLUMNS, [row for key in keys for row in _error_rows(key, tried[key], errors[key], _coarse_run(data, key, runs[key]))])
    growth_page.write_morphologies(pictures, data.growth)
    growth_page.write_correlations(pictures, data.growth, keys, runs)
    diagrams.mu_over_delta(pictures, sweeps, {key: list(found.values()) for key, found in runs.items()})
    for key in keys:
        diagrams.rule_errors(pictures, {name: e["mu"] for name, e in errors[key].items()}, key)
    sections = [*_summary(data, keys, errors), *_scatter(data, keys, sweeps, runs, tried), *_rules(data, keys, tried, errors, runs), *_obtained(data, keys),
                *growth_page.prediction_section(data, keys, runs), *_theory(), *_limits(errors, runs)]
    write_page(folder, "prediction.md", "\n\n".join(sections) + "\n")


def _case(key):
    """A load and a window in few words."""
    load, window = key
    return f"{load.pressure / 1e6:g} MPa, " + ("" if load.push else "from rest, ") + window


def _pushed(keys):
    """Those in the paper's reading."""
    return [key for key in keys if key[0].push]


def _rms(errors, key, rule):
    return delta_rules.rms(errors[key][rule]["mu"])


def _better(errors, keys, rule, than="δ* = δ"):
    """In how many cases a rule has the smaller error, as text."""
    return f"{sum(_rms(errors, k, rule) < _rms(errors, k, than) for k in keys)} of {len(keys)}"


def _fine_stars(data, key):
    """{seed: best δ*} on cells of 0.1 mm."""
    return rules.matched(data, key[0], rules.WINDOWS[key[1]], 0, seeds.FINE)


def _summary(data, keys, errors):
    pushed = _pushed(keys)
    beyond = [k for k in pushed if _exceeds(_fine_stars(data, k).values(), seeds.DELTA)]
    return ["# Can the regularization time of the homogeneous model be predicted?",
            "**Yes, within 1 to 3 % of mu_inter, from other morphologies under the same load. No rule works across pressures.**\n"
            "\n"
            "δ* is the δ with which the homogeneous pin has the mu_inter of the heterogeneous pin, which has all fibres. A case is a load and a window of time; only cases with a push "
            "are counted.\n"
            "\n"
            "* At the same δ the homogeneous pin has more friction, and mu_inter falls with δ. Therefore δ* exceeds the "
            f"{seeds.DELTA * 1e9:g} ns of the heterogeneous pin, as in the paper (1700 and 1750 ns). On cells of 0.1 "
            f"mm the difference exceeds its 95 % interval in {len(beyond)} of {len(pushed)} cases (table 1).\n"
            f"* The paper's eq. (13), with T_G over all nodes, gives a δ* below {seeds.DELTA * 1e9:g} ns.\n"
            f"* Growth rates of steady sliding predict better than δ* = δ in {_better(errors, pushed, 'growth, fastest mode')} "
            f"cases, a coarse run of the morphology in {_better(errors, pushed, 'coarse run')} (table 2). But mu_inter "
            "of the coarse run is then as good an answer.\n"
            "* The programs offer no rule for δ*.",
            "![mu_inter over delta for each load and window](prediction/mu_over_delta.png)"]


def _obtained(data, keys):
    n = len(data.heterogeneous(seeds.LOADS[0], seeds.LATE))
    return ["## How it was obtained",
            "According to the paper (section 4) its contact homogenization is not predictive, because δ* is read from the heterogeneous run that it should replace. "
            "`./run.sh prediction` makes the runs and this page.",
            f"* Bodies: {n} morphologies of `prm/prediction` (seeds {min(seeds.SEEDS)} to {max(seeds.SEEDS)}) on cells "
            f"of {56 / seeds.COARSE[0]:g} mm, each cell the mixture of four cells of 0.1 mm (`mixture.py`); the homogeneous "
            "pin has the mean of their effective stiffnesses\n"
            f"* Settings: V = 2 m/s, mu = 0.25, δ = {seeds.DELTA * 1e9:g} ns in the heterogeneous pin; pressure and "
            "flat act at once\n"
            "* Loads: 0.5 and 0.4 MPa with a start of 0.5 m/s along x ([regimes 1 and 2 of the paper](README.md)); 5 MPa from rest",
            "Errors of each morphology, by rule:",
            "\n\n".join(f"![Errors, {_case(key)}](prediction/rules_{key[0].key}_{key[1]}.png)" for key in keys)]


def _exceeds(values, limit):
    """Whether the mean lies above the limit by more than its 95 % interval."""
    mean, _, half = delta_rules.interval(list(values))
    return mean - half > limit


def _theory():
    return ["## Theory",
            "While nodes slip in one direction, eq. (7) is linear in the normal force, so that its sum over a patch of contact has the same δ. Therefore δ* = δ while all nodes slip, as "
            "far as a homogeneous body can replace the heterogeneous one. Only nodes that separate or stick at different times can require another δ*."]


def _scatter(data, keys, sweeps, runs, tried):
    rows = []
    for key in keys:
        hom = _at_delta(sweeps[key])
        stars = [tried[key]["best δ*"][2], *([_fine_stars(data, key)] if key[0].push else [])]
        rows.append([_case(key), _mean([m.mu for m in runs[key].values()]), f"{hom.mu:.4f} ± {2 * hom.mu_error:.4f}",
                     *(_mean([1e9 * d for d in of.values()], 0) for of in stars), *["–"] * (2 - len(stars))])
    return ["## Morphologies and the homogeneous pin",
            f"Table 1. mu_inter at δ = {seeds.DELTA * 1e9:g} ns on cells of 0.2 mm, and the best δ* on both sizes of "
            f"cells; early: {seeds.EARLY[0] * 1e3:g} to {seeds.EARLY[1] * 1e3:g} ms, late: {seeds.LATE[0] * 1e3:g} "
            f"to {seeds.LATE[1] * 1e3:g} ms. ± is the 95 % interval of the mean over the morphologies, "
            "for the homogeneous pin over time.",
            table(["case", "μ_inter, morphologies", "homogeneous", "δ* [ns], 0.2 mm", "δ* [ns], 0.1 mm"], rows),
            "In the four pushed cases every morphology is in the regime of the homogeneous pin ([regimes](regimes.md#both-regimes)). [comparison.csv](prediction/comparison.csv) "
            "adds deviations, slip, frequencies and the runs on cells of 0.1 mm."]


def _at_delta(sweep):
    """The homogeneous pin at the morphologies' delta."""
    return sweep.measures[int(np.argmin(np.abs(sweep.deltas - seeds.DELTA)))]


COMPARISON_COLUMNS = ["load", "window", "mu_inter, morphologies [-]", "half width [-]", "deviation [-]", "mean standard error in time [-]", "mu_inter, homogeneous [-]",
                      "its half width in time [-]", "deviation of homogeneous pins with the stiffness of each morphology [-]", "difference of means [-]", "slip, morphologies [-]",
                      "its half width [-]", "slip, homogeneous [-]", "main frequencies [kHz] (morphologies)", "main frequency, homogeneous [kHz]",
                      "morphologies on cells of 0.1 mm", "their mu_inter, 0.1 mm [-]", "half width, 0.1 mm [-]", "their mu_inter, 0.2 mm [-]", "half width, 0.2 mm [-]",
                      "rms difference of the cells [-]", "homogeneous, 0.1 mm [-]", "homogeneous, 0.2 mm [-]", "delta*, 0.1 mm [ns]", "its half width [ns]", "delta*, 0.2 mm [ns]",
                      "its half width, 0.2 mm [ns]"]


def _comparison(data, key, sweep, runs):
    """A row of COMPARISON_COLUMNS, as texts; the last columns are empty where nothing was run on cells of 0.1 mm."""
    load, window = key
    found, times = list(runs.values()), rules.WINDOWS[window]
    mean, deviation, half = delta_rules.interval([m.mu for m in found])
    own = [measure(data.results[seeds.own_name(s, load)].folder, *times).mu for s in seeds.SEEDS]
    slip, hom = delta_rules.interval([m.shares[0] for m in found]), _at_delta(sweep)
    row = [load.label, window, f"{mean:.4f}", f"{half:.4f}", f"{deviation:.4f}", f"{np.mean([m.mu_error for m in found]):.4f}", f"{hom.mu:.4f}", f"{2 * hom.mu_error:.4f}",
           f"{np.std(own, ddof=1):.4f}", f"{mean - hom.mu:+.4f}", f"{slip[0]:.3f}", f"{slip[2]:.3f}", f"{hom.shares[0]:.3f}", _lines(found), f"{hom.frequency / 1e3:.1f}"]
    return row + (_fine(data, load, times, runs) or [""] * (len(COMPARISON_COLUMNS) - len(row)))


def _lines(found):
    """Main frequencies to a kHz with the number of runs that have them."""
    values, counts = np.unique([round(m.frequency / 1e3) for m in found], return_counts=True)
    return ", ".join(f"{v} ({c})" for v, c in zip(values, counts))


def _fine(data, load, times, coarse):
    """The same bodies on the morphologies' own cells; an empty list where nothing was run there."""
    fine = data.heterogeneous(load, times, 0)
    if not fine:
        return []
    coarse = {seed: coarse[seed] for seed in fine}
    row = [len(fine), *(cell for found in (fine, coarse) for cell in _mean([m.mu for m in found.values()]).split(" ± ")),
           f"{delta_rules.rms([m.mu - coarse[s].mu for s, m in fine.items()]):.4f}"]
    sweeps = [data.sweep(load, times, cells) for cells in (seeds.FINE, seeds.COARSE)]
    row += [f"{sweep.at(seeds.DELTA, delta_rules.mu_of):.4f}" for sweep in sweeps]
    if len(sweeps[0].deltas) == 1:
        return row + [""] * 4
    return row + [cell for sweep, found in zip(sweeps, (fine, coarse)) for cell in _mean([1e9 * sweep.delta_for(m.mu) for m in found.values()], 0).split(" ± ")]


def _mean(values, digits=4):
    mean, _, half = delta_rules.interval(values)
    return f"{mean:.{digits}f} ± {half:.{digits}f}"


ERROR_COLUMNS = ["load", "window", "rule", "needs", "cost [%]", "morphologies", "delta* [ns]", "its half width [ns]", "error of mu_inter [-]", "its half width [-]", "rms error [-]",
                 "rms error from [-]", "to [-]", "gain over delta* = delta [-]", "its half width (gain) [-]", "main frequency within 5 %", "rms error of slip [-]"]
ITSELF = "coarse run itself"


def _coarse_run(data, key, runs):
    """Error of mu_inter of the heterogeneous pin on cells of 0.4 mm, morphology by morphology."""
    coarse = data.heterogeneous(key[0], rules.WINDOWS[key[1]], 2)
    return [coarse[s].mu - m.mu for s, m in runs.items()]


def _error_rows(key, tried, errors, coarse):
    """Rows of ERROR_COLUMNS, as texts. Gain: by how much the error is smaller than that of δ* = δ, morphology by morphology."""
    rows, load = [], [key[0].label, key[1]]
    for name, (needs, cost, deltas) in tried.items():
        stars = [1e9 * d for d in deltas.values() if np.isfinite(d)]
        star, mu = delta_rules.interval(stars), delta_rules.interval(errors[name]["mu"])
        rows.append([*load, name, needs, "" if cost is None else f"{100 * cost:.0f}", len(stars), f"{star[0]:.0f}", f"{star[2]:.0f}", f"{mu[0]:+.4f}", f"{mu[2]:.4f}",
                     *_rms_texts(errors[name]["mu"]), *_gain(errors, name), int(np.sum(np.abs(errors[name]["frequency"]) < 0.05)), f"{delta_rules.rms(errors[name]['slip']):.3f}"])
    return rows + [[*load, ITSELF, "run on cells of 0.4 mm", "", len(coarse), *[""] * 4, *_rms_texts(coarse), *[""] * 4]]


def _rms_texts(values):
    """Root mean square with its bootstrap interval."""
    return [f"{value:.4f}" for value in (delta_rules.rms(values), *delta_rules.rms_interval(values))]


def _gain(errors, name):
    """Mean and half width; empty where the errors have other morphologies than those of δ* = δ."""
    naive, own = (np.abs(errors[rule]["mu"]) for rule in ("δ* = δ", name))
    if name == "δ* = δ" or len(naive) != len(own):
        return ["", ""]
    mean, _, half = delta_rules.interval(naive - own)
    return [f"{mean:+.4f}", f"{half:.4f}"]


# What δ* of a rule is.
MEANING = {"δ* = δ": "δ of the heterogeneous pin", "growth, 41.6 kHz mode": "this mode grows as in the morphology", "growth, fastest mode": "the fastest mode grows as in the morphology",
           "short run": f"equal mu_inter from {rules.SHORT[0] * 1e3:g} to {rules.SHORT[1] * 1e3:g} ms", "coarse run": "equal mu_inter, both pins on cells of 0.4 mm",
           "other morphologies": "mean best δ* of the others at this load", "other pressure": "best δ* of this morphology at the other pressure",
           "eq. (13)": "from mu_inter and T_G of the full run", "best δ*": "equal mu_inter of the full run", ITSELF: "no homogeneous pin"}


def _rules(data, keys, tried, errors, runs):
    keys = _pushed(keys)
    rows = [[name, MEANING[name], "–" if cost is None else f"{100 * cost:.0f}", *(f"{_rms(errors, key, name):.4f}" for key in keys)] for name, (_, cost, _) in tried[keys[0]].items()]
    rows += [[ITSELF, MEANING[ITSELF], "", *(_rms_texts(_coarse_run(data, key, runs[key]))[0] for key in keys)],
             ["scatter of mu_inter", "", "", *(f"{np.std([m.mu for m in runs[key].values()], ddof=1):.4f}" for key in keys)]]

    def significant(rule):
        gains = {k: delta_rules.interval(np.abs(errors[k]["δ* = δ"]["mu"]) - np.abs(errors[k][rule]["mu"])) for k in keys}
        return " and ".join(_case(k) for k, (mean, _, half) in gains.items() if mean > half) or "nowhere"

    return ["## The rules",
            "Table 2. Error of mu_inter, homogeneous pin with δ* minus heterogeneous pin: root mean square over the morphologies. Cost: CPU time of the runs for a new morphology over the time "
            "of its full heterogeneous run, without runs that are made once for all. Eq. (13) and the best δ* need the full run and predict nothing.",
            table(["rule", "δ*", "cost [%]", *map(_case, keys)], rows),
            f"*Other morphologies* is better than δ* = δ in {_better(errors, keys, 'other morphologies')} cases, *other "
            f"pressure* in {_better(errors, keys, 'other pressure')}: δ* has to be found anew for another pressure. "
            f"The gain exceeds its 95 % interval for *other morphologies* at {significant('other morphologies')}, "
            f"for *coarse run* at {significant('coarse run')}. [rule_errors.csv](prediction/rule_errors.csv) adds "
            "the runs from rest, intervals, gains, slip and frequency; [rules.csv](prediction/rules.csv) has each δ*."]


def _limits(errors, runs):
    rest = (seeds.LOADS[2], "late")
    return ["## Limits",
            "* The better rules leave an error of about the scatter of the morphologies; they were picked on the same morphologies, which flatters them.\n"
            "* From rest under 5 MPa the morphologies reach several cycles (late, with the number of morphologies: "
            f"{_lines(runs[rest].values())} kHz). Even the best δ* leaves an rms error of {_rms(errors, rest, 'best δ*'):.4f}, "
            f"because the homogeneous pin has some of these mu_inter at no δ from {delta_rules.RANGE[0] * 1e9:g} to {delta_rules.RANGE[1] * 1e9:g} "
            "ns."]
