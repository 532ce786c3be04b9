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
    growth_page.write_morphologies(pictures, data.growth)
    diagrams.mu_over_delta(pictures, sweeps, {key: list(found.values()) for key, found in runs.items()})
    for key in keys:
        diagrams.rule_errors(pictures, {name: e["mu"] for name, e in errors[key].items()}, key)
    sections = [*_head(data), *_short(data, keys, errors, runs, sweeps, tried), *_theory(), *_scatter(data, keys, sweeps, runs), *growth_page.prediction_section(data, keys, runs), *_rules(keys, tried, errors, runs),
                *_verdict(keys, errors, runs, data)]
    write_page(folder, "prediction.md", "\n\n".join(sections) + "\n")


def _head(data):
    n = len(data.heterogeneous(seeds.LOADS[0], seeds.LATE))
    return ["# Can the regularization time of the homogeneous model be predicted?",
            "Written by `./run.sh prediction`; every number but the paper's is from its runs.",
            "The paper ends section 4 by saying that the contact homogenization is not predictive: delta* of the homogeneous "
            "model is read from the run of the heterogeneous one that it should replace. Here rules that need less are tried on "
            f"{n} morphologies (`prm/prediction`, seeds {min(seeds.SEEDS)} to {max(seeds.SEEDS)}) with V = 2 m/s, mu = 0.25, delta = 1500 ns in the heterogeneous pin, "
            "pressure and flat at once, under three loads: the printed pressures with a pin that starts with 0.5 m/s along x, which leads to the paper's regimes 1 (0.5 MPa) and "
            "2 (0.4 MPa, see [paper](README.md)), and 5 MPa from rest. "
            f"Windows: early, {seeds.EARLY[0] * 1e3:g} to {seeds.EARLY[1] * 1e3:g} ms; late, {seeds.LATE[0] * 1e3:g} to {seeds.LATE[1] * 1e3:g} ms. "
            "± is a 95 % confidence interval of the mean over the morphologies (Student's t).",
            f"The morphologies are run on cells of {56 / seeds.COARSE[0]:g} mm, each the mixture of four cells of 0.1 mm (`mixture.py`); "
            "the homogeneous pin has the mean of their effective stiffnesses, on the same cells."]


def _spread(values, digits=3, factor=1.0):
    return f"{min(values) * factor:.{digits}f} to {max(values) * factor:.{digits}f}"


def _exceeds(values, limit):
    """Whether the mean lies above the limit by more than its 95 % interval."""
    mean, _, half = delta_rules.interval(list(values))
    return mean - half > limit


def _named(keys):
    return "at " + ", ".join(f"{load.pressure / 1e6:g} MPa {window}" for load, window in keys) if keys else "nowhere"


def _short(data, keys, errors, runs, sweeps, tried):
    """What the tables below say, for the paper's reading first."""
    lines = []
    for key in keys:
        mean, _, half = delta_rules.interval([m.mu for m in runs[key].values()])
        lines.append(f"{key[0].label}, {key[1]}: morphologies {mean:.4f} ± {half:.4f}, homogeneous {sweeps[key].at(seeds.DELTA, delta_rules.mu_of):.4f}")
    late = [(load, "late") for load in seeds.LOADS[:2]]
    pushed = [key for key in keys if key[0].push]
    separated = " and ".join(f"{_spread([m.middle[2] for m in runs[k].values()], 0, 100)} % at {k[0].pressure / 1e6:g} MPa" for k in late)
    def stars(deltas):
        return "; ".join(f"{_mean([1e9 * d for d in deltas(k).values()], 0)} ns ({k[0].pressure / 1e6:g} MPa, {k[1]})" for k in pushed)

    told = stars(lambda k: tried[k]["best δ*"][2])
    fine = {k: rules.matched(data, k[0], rules.WINDOWS[k[1]], 0, seeds.FINE) for k in pushed}
    beyond = [k for k in pushed if _exceeds(fine[k].values(), seeds.DELTA)]

    def rms(rule):
        return ", ".join(f"{delta_rules.rms(errors[k][rule]['mu']):.4f}" for k in pushed)

    def better(rule, than="δ* = δ"):
        return f"{sum(delta_rules.rms(errors[k][rule]['mu']) < delta_rules.rms(errors[k][than]['mu']) for k in pushed)} of {len(pushed)}"

    def significant(rule):
        gains = {k: delta_rules.interval(np.abs(errors[k]["δ* = δ"]["mu"]) - np.abs(errors[k][rule]["mu"])) for k in pushed}
        return ", ".join(f"{k[0].pressure / 1e6:g} MPa {k[1]}" for k, (mean, _, half) in gains.items() if mean > half) or "none"

    rest = (seeds.LOADS[2], "late")
    return ["## In short",
            f"* mu_inter at delta = 1500 ns in both. {'; '.join(lines)}. The paper at 0.5 MPa: 0.2145 (mean of four) and 0.220 (table 2).\n"
            f"* In the paper's reading (pushed at 0.5 m/s) every morphology is in the regime of the homogeneous pin: late, M is separated {separated}. "
            "The homogeneous pin has more friction at the same delta, and its mu_inter falls with delta: both as in the paper.\n"
            f"* So δ* lies above delta = 1500 ns, as in the paper (1700 ns in table 2, 1750 ns in table 3): {told}. On cells of 0.1 mm: {stars(fine.get)}; "
            f"beyond its interval that is above 1500 ns {_named(beyond)}.\n"
            f"* Errors of mu_inter (rms over the morphologies; {', '.join(f'{k[0].pressure / 1e6:g} MPa {k[1]}' for k in pushed)}): δ* = δ {rms('δ* = δ')}; "
            f"a coarse run of the morphology {rms('coarse run')}; δ* of the other morphologies {rms('other morphologies')}; "
            f"δ* of the same morphology at the other pressure {rms('other pressure')}; growth of the fastest mode {rms('growth, fastest mode')}; "
            f"eq. (13), the paper's own, {rms('eq. (13)')}.\n"
            f"* δ* of the other morphologies is better than δ* = δ in {better('other morphologies')} cases, δ* of the other pressure in {better('other pressure')}: δ* belongs to the composite "
            "under its load, more than to a single morphology, and has to be found anew for another pressure. "
            f"A coarse run is better than δ* = δ in {better('coarse run')} cases and than δ* of the others in {better('coarse run', 'other morphologies')}, but its own mu_inter is then as good an "
            f"answer (last table). Beyond its 95 % interval the gain over δ* = δ is only in these cases: δ* of the others, {significant('other morphologies')}; coarse run, "
            f"{significant('coarse run')}. Growth rates of steady sliding (better in {better('growth, fastest mode')}) do not predict δ*. Eq. (13) with T_G over all nodes asks for a δ* below delta, on "
            "the wrong side.\n"
            "* How far a rule gets: the error of mu_inter left by the better ones is the scatter of the morphologies or less, 1 to 3 % of mu_inter. That is the accuracy of "
            "one morphology for another; in this sense the contact homogenization is predictive for the composite, once one load of it is calibrated.\n"
            f"* In the other reading ({rest[0].label}) the morphologies part among several cycles ({_lines(runs[rest].values())} kHz late). There even the best δ* leaves "
            f"{delta_rules.rms(errors[rest]['best δ*']['mu']):.4f}: the homogeneous pin has some of these mu_inter at no delta from "
            f"{delta_rules.RANGE[0] * 1e9:g} to {delta_rules.RANGE[1] * 1e9:g} ns.\n"
            "* No rule for δ* is offered in the programs."]


def _theory():
    return ["## What theory says",
            "The law of eq. (7) is linear in the normal force as long as a node slips in one direction. Summed over the nodes of a patch of "
            "contact it is the same law with the same delta: d(Σ f_t)/dt = -(Σ f_t - mu Σ f_n)/delta. So while all nodes slip, delta* = delta as far as "
            "the body can be replaced by a homogeneous one. Only nodes that separate or stick, each at its own time, can ask for another "
            "delta*. The growth rates of steady sliding test the first, the runs the second."]


def _scatter(data, keys, sweeps, runs):
    rows = []
    for key in keys:
        found = list(runs[key].values())
        mean, deviation, half = delta_rules.interval([m.mu for m in found])
        own = [measure(data.results[seeds.own_name(s, key[0])].folder, *rules.WINDOWS[key[1]]).mu for s in seeds.SEEDS]
        slip = delta_rules.interval([m.shares[0] for m in found])
        hom = sweeps[key].measures[int(np.argmin(np.abs(sweeps[key].deltas - seeds.DELTA)))]
        rows.append([key[0].label, key[1], f"{mean:.4f} ± {half:.4f}", f"{deviation:.4f}", f"{np.mean([m.mu_error for m in found]):.4f}",
                     f"{hom.mu:.4f} ± {2 * hom.mu_error:.4f}", f"{np.std(own, ddof=1):.4f}", f"{mean - hom.mu:+.4f}",
                     f"{slip[0]:.3f} ± {slip[2]:.3f}", f"{hom.shares[0]:.3f}", _lines(found), f"{hom.frequency / 1e3:.1f}"])
    header = ["load", "window", "μ_inter, morphologies", "their deviation", "their standard error in time", "homogeneous, δ = 1500 ns",
              "deviation with own stiffness", "difference of means", "slip, morphologies", "slip, homogeneous", "kHz, morphologies",
              "kHz, homogeneous"]
    return ["## Morphologies and the homogeneous pin", table(header, rows),
            "*Deviation with own stiffness*: homogeneous pins, each with the effective stiffness of one morphology. It is what the scatter of the "
            "stiffness alone does. The heterogeneous frequencies are listed with the number of morphologies.",
            "![mu over delta](prediction/mu_over_delta.png)", *_fine(data, runs)]


def _lines(found):
    """Main frequencies to a kHz with the number of runs that have them."""
    values, counts = np.unique([round(m.frequency / 1e3) for m in found], return_counts=True)
    return ", ".join(f"{v} ({c})" for v, c in zip(values, counts))


def _fine(data, runs):
    """The same bodies on the morphologies' own grid; an empty list where nothing was run there."""
    rows = [_fine_row(data, load, window, runs[load, window]) for load in seeds.LOADS for window in rules.WINDOWS]
    rows = [row for row in rows if row]
    header = ["load", "window", "morphologies", "μ_inter, 0.1 mm", "0.2 mm", "rms difference", "homogeneous, δ = 1500 ns, 0.1 mm", "0.2 mm", "δ* [ns], 0.1 mm", "0.2 mm"]
    return ["The same bodies on the morphologies' own cells of 0.1 mm, beside those of 0.2 mm (*rms difference*: morphology by morphology):",
            table(header, rows)] if rows else []


def _fine_row(data, load, window, coarse):
    times = rules.WINDOWS[window]
    fine = data.heterogeneous(load, times, 0)
    if not fine:
        return []
    coarse = {seed: coarse[seed] for seed in fine}
    row = [load.label, window, len(fine), *(_mean([m.mu for m in found.values()]) for found in (fine, coarse)),
           f"{delta_rules.rms([m.mu - coarse[s].mu for s, m in fine.items()]):.4f}"]
    sweeps = [data.sweep(load, times, cells) for cells in (seeds.FINE, seeds.COARSE)]
    row += [f"{sweep.at(seeds.DELTA, delta_rules.mu_of):.4f}" for sweep in sweeps]
    if len(sweeps[0].deltas) == 1:
        return row + ["–", "–"]
    return row + [_mean([1e9 * sweep.delta_for(m.mu) for m in found.values()], 0) for sweep, found in zip(sweeps, (fine, coarse))]


def _mean(values, digits=4):
    mean, _, half = delta_rules.interval(values)
    return f"{mean:.{digits}f} ± {half:.{digits}f}"


def _rules(keys, tried, errors, runs):
    result = ["## The rules",
              "*growth*: δ* of the table above. *short run*: δ* with which the homogeneous pin has the heterogeneous one's mu_inter from "
              f"{rules.SHORT[0] * 1e3:g} to {rules.SHORT[1] * 1e3:g} ms. *coarse run*: the same over the whole window, both pins on cells of 0.4 mm. "
              "*other morphologies*: the mean best δ* of the other morphologies at this load. *other pressure*: the best δ* of the same morphology under the other printed pressure. "
              "*eq. (13)*: the paper's way, from mu_inter and T_G of the full run, not predictive. *best δ\\**: the sweep of the homogeneous pin "
              "inverted at the mu_inter of the full run, what any rule can reach. *cost*: CPU time of what has to be run anew of the morphology in question, over that of its "
              "full heterogeneous run; what is run once for all is not counted: the sweep of the homogeneous pin, and for *other morphologies* the full runs of these. Eigenvalues "
              "were not timed (–). Errors are those of the homogeneous pin with δ* against the "
              "heterogeneous one: mean, and root mean square with its bootstrap interval."]
    for key in keys:
        rows = []
        for name, (needs, cost, deltas) in tried[key].items():
            stars = [1e9 * d for d in deltas.values() if np.isfinite(d)]
            star, mu = delta_rules.interval(stars), delta_rules.interval(errors[key][name]["mu"])
            low, high = delta_rules.rms_interval(errors[key][name]["mu"])
            rows.append([name, needs, "–" if cost is None else f"{100 * cost:.0f} %", len(stars), f"{star[0]:.0f} ± {star[2]:.0f}",
                         f"{mu[0]:+.4f} ± {mu[2]:.4f}", f"{delta_rules.rms(errors[key][name]['mu']):.4f} ({low:.4f} to {high:.4f})",
                         f"{np.sum(np.abs(errors[key][name]['frequency']) < 0.05)} of {len(stars)}", f"{delta_rules.rms(errors[key][name]['slip']):.3f}"])
        result += [f"### {key[0].label}, {key[1]}",
                   table(["rule", "needs", "cost", "morphologies", "δ* [ns]", "error of μ_inter", "its rms", "frequency within 5 %", "rms error, slip"], rows),
                   f"![rules](prediction/rules_{key[0].key}_{key[1]}.png)"]
    return result


def _verdict(keys, errors, runs, data):
    rows = []
    for key in keys:
        spread = np.std([m.mu for m in runs[key].values()], ddof=1)
        naive = delta_rules.rms(errors[key]["δ* = δ"]["mu"])
        predictive = {name: delta_rules.rms(e["mu"]) for name, e in errors[key].items() if name not in ("δ* = δ", "eq. (13)", "best δ*")}
        best = min(predictive, key=predictive.get)
        gain = delta_rules.interval(np.abs(errors[key]["δ* = δ"]["mu"]) - np.abs(errors[key][best]["mu"]))
        coarse = data.heterogeneous(key[0], rules.WINDOWS[key[1]], 2)
        direct = [coarse[s].mu - m.mu for s, m in runs[key].items()]
        low, high = delta_rules.rms_interval(direct)
        rows.append([key[0].label, key[1], f"{spread:.4f}", f"{naive:.4f}", best, f"{predictive[best]:.4f}", f"{gain[0]:+.4f} ± {gain[2]:.4f}",
                     f"{delta_rules.rms(direct):.4f} ({low:.4f} to {high:.4f})"])
    return ["## What is gained",
            "The best predictive rule beside the naive choice δ* = δ. *Gain*: by how much its error is smaller, morphology by morphology; the rule was picked "
            "on these same morphologies, which flatters it. *Coarse run itself*: mu_inter of the heterogeneous pin on cells of 0.4 mm, no homogeneous pin.",
            table(["load", "window", "deviation over morphologies", "rms error of δ* = δ", "best rule", "its rms error", "gain",
                      "rms error of the coarse run itself"], rows)]
