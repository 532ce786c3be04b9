"""The page of the maps of the paper's pin."""

import contextlib
import re
from itertools import combinations

import mesoslip
import numpy as np
from map_pictures import MU, disc, homogenization, regimes, spring
from pages import save_picture, table, write_csv, write_page
from report.runs.sweep_map import GROWTH, REGIMES

NUMBERS = {MU: "mu_inter [-]", MU + "_95": "half width [-]", "main_frequency": "main frequency [Hz]", "slip_fraction": "slip [-]",
           "stick_fraction": "stick [-]", "separation_fraction": "separation [-]", GROWTH: "growth of the fastest complex mode [1/s]"}
REACHED = "limit_cycle_reached"
# Axis of a map: column of the table of all points, value where the map has no such axis.
COLUMNS = {"pressure": ("pressure [Pa]", 5e6), "velocity": ("velocity [m/s]", 2.0), "friction": ("friction [-]", 0.25),
           "delta": ("delta [s]", 1.5e-6), "beta": ("beta [s]", 4.4e-9), "stiffness": ("spring stiffness [Pa/m]", None)}
TITLES = {"pressure-friction": "pressure and friction", "pressure-velocity": "pressure and velocity", "delta-friction": "delta and friction",
          "beta-friction": "beta and friction", "spring": "velocity and spring stiffness, on a spring", "disc": "pressure and friction, on a disc"}
PAGE = """# Maps of the paper's pin

{summary}

![Regimes](pin_regimes.png)

*The homogenized pin: regime of the node in the middle of the contact. Other keys: P = 5 MPa, V = 2 m/s, mu = 0.25, delta = 1.5 µs, \
beta = 4.4 ns. Black lines: the fastest complex mode neither grows nor decays; map (b) has no complex modes. Circles: the \
loads of the paper, 0.4 and 0.5 MPa ([how the paper was read](../paper/reading.md)).*

## Where the pin slips, sticks and separates

The table has the share of the points of each map in each [regime](../glossary.md#regime).

{shares}

{borders}

## On a spring

![Pin on a spring](pin_spring.png)

*The homogenized pin below a holder of 50 kg/m² on a spring along x. (a) Regime of the node in the middle. (b) Main frequency divided by the natural \
frequency of pin and holder on the spring.*

{on_spring}

## On a steel disc

![Rigid flat and disc](pin_disc.png)

*(a) On the rigid flat. (b) On a steel disc of 10 mm with [absorbing sides](../theory.md#4-supports-libdynamicssupports).*

{on_disc}

## What homogenization gets right

The table compares two pins at {drawn} random points within the ranges of the maps above. Compared with another \
[morphology](../glossary.md#morphology) of the same material, {verdict}

{comparison}

![Homogenized and with fibres](pin_friction.png)

*mu_inter of the pin with fibres over mu_inter of the homogenized pin at the random points; bars: range of the morphologies. Orange: the morphologies \
with fibres have different regimes.*

## How certain an early end is

{early}

## How it was obtained

`./run.sh maps` makes {maps} [maps](../maps.md), {runs} runs of `contact_dynamics`. The pin is the paper's, 56 x 16 mm with 10 % of stiff fibres. Maps \
of the homogenized pin have 70 x 20 cells and end with their limit cycle or after 8 ms, on the spring after 12 ms. The comparison has {seeds} \
morphologies, each with all fibres on 560 x 160 cells in [single precision](../performance/work_precision.md#single-precision) and homogenized on \
140 x 40 cells, and results from the second half of 2 ms. The pin starts with \
0.5 m/s along x; on the spring it starts at rest, the flat reaches its velocity in 3 ms, the pressure is 1 MPa, and friction falls from 0.3 to 0.2 \
within a slip of 0.1 µm. [pin.csv](pin.csv) has all points.

## Limits

{reached} of the {compared} runs of the comparison reached a limit cycle within 2 ms. In the other {unsettled} runs, and after an early end, a \
slowly growing vibration may still change the result. The regime describes one node. Near a border between regimes a small change of the load changes \
the regime, but hardly mu_inter.
"""


def percent(share, digits=0):
    return f"{100 * share:.{digits}f} %"


def compared(couples):
    """Differences of couples of maps: same regime, mu_inter, main frequency, share of separation."""
    off = np.array([one[MU] / other[MU] - 1 for one, other in couples])
    frequency = np.array([one["main_frequency"] / other["main_frequency"] - 1 for one, other in couples])
    separation = np.array([one["separation_fraction"] - other["separation_fraction"] for one, other in couples])
    same = np.array([one["regime"] == other["regime"] for one, other in couples])
    return [f"{np.sum(same)} of {same.size} pairs ({percent(np.mean(same))})", percent(np.nanmedian(np.abs(off)), 1), percent(np.nanmax(np.abs(off))),
            percent(np.nanmedian(np.abs(frequency)), 1), percent(np.nanmean(np.abs(separation)))]


def comparison(maps, seeds):
    """Rows of the table on homogenization."""
    pairs = [(maps[f"homogenized-{seed}"], maps[f"fibres-{seed}"]) for seed in seeds]
    return [["homogenized against fibres", *compared(pairs)],
            ["homogenized, 560 x 160 against 140 x 40 cells", *compared([(maps["fine"], pairs[0][0])])],
            ["two homogenized morphologies", *compared(list(combinations([h for h, _ in pairs], 2)))],
            ["two morphologies with fibres", *compared(list(combinations([f for _, f in pairs], 2)))]]


def verdict(homogenized, fibres):
    """Whether a homogenized pin is as close to a pin with fibres as another morphology with fibres; from both rows of the table."""
    as_good = {True: [], False: []}
    for name, column, sign in (("for the regime", 1, 1), ("for the median of mu_inter", 2, -1)):
        one, other = (re.search(r"([\d.]+) %", row[column]) for row in (homogenized, fibres))
        as_good[sign * float(one[1]) >= sign * float(other[1])].append(f"{name} ({one[0]} against {other[0]})")
    parts = [f"{words} good {' and '.join(as_good[key])}" for key, words in ((True, "as"), (False, "not as")) if as_good[key]]
    return f"the homogenized pin is {', but '.join(parts)}."


def shares(maps):
    """Rows: share of each regime in each map of the homogenized pin."""
    names = [name for name in REGIMES if any((maps[key]["regime"] == name).any() for key in TITLES)]
    rows = [[f"{title} ({maps[key].status.size} points)", *(percent(np.mean(maps[key]["regime"] == name)) for name in names)] for key, title in TITLES.items()]
    return table(["map over", *names], rows, right=True)


def at_border(maps):
    """How often complex modes that decay mean steady sliding, and modes that grow a vibration with stick or separation."""
    decays, slides, separated = [], [], []
    for key in TITLES:
        if GROWTH in maps[key]:
            growth = np.ravel(maps[key][GROWTH])
            decays.append(~(growth > 0))
            slides.append(np.ravel(maps[key]["regime"]) == "permanent slip")
            separated.append(np.ravel(maps[key]["separation_fraction"]))
    decays, slides, separated = (np.concatenate(parts) for parts in (decays, slides, separated))
    grows, still = np.sum(~decays), np.sum(~decays & slides)
    return (f"The maps (a), (c) and (d) have complex modes. Where all modes decay, the node in the middle slips permanently at {np.sum(decays & slides)} of "
            f"{np.sum(decays)} points, in spite of the push; at low pressure up to {percent(np.max(separated[decays]))} of the contact is separated. Where a "
            f"mode grows ({grows} points), the node in the middle sticks or separates at {grows - still} points; at the other {still} its vibration is still "
            "small at the end of the run.")


def on_spring(one, own):
    """What the pin does on the spring: points whose main frequency is at most that of the spring."""
    slow = np.asarray(one["main_frequency"]) < 1.1 * own[None, :]
    sticks = np.asarray(one["stick_fraction"]) > 0.01
    fastest = max((float(v) for v, row in zip(one.axes["slow"], slow & sticks) if row.any()), default=0.0)
    middle = np.sum(["stick" in regime for regime in np.ravel(one["regime"])])
    return (f"Averaged over all contact nodes, sticking takes more than 1 % of the time at {np.sum(sticks)} of {sticks.size} points (the table counts the node in "
            f"the middle: {middle} points). At {np.sum(slow & sticks)} of these points pin and holder stick and slip together, at most as fast as they vibrate on the "
            f"spring; the flat moves there at {fastest:.2g} m/s at most. At the other {np.sum(sticks & ~slow)} points nodes stick in faster vibrations of the pin itself.")


def early_ends(stopped, whole):
    """How far points that ended with their limit cycle are from the same points run to the end."""
    reached = np.asarray(stopped[REACHED]) > 0
    off = np.abs(np.asarray(stopped[MU]) / np.asarray(whole[MU]) - 1)[reached]
    return (f"With `Observation/Stop at limit cycle` {np.sum(reached)} of {reached.size} random points of the homogenized pin ended before 8 ms. Against the same "
            f"points run for 8 ms, mu_inter differs by {percent(np.median(off), 2)} in the median and by {percent(np.max(off), 2)} at most.")


def on_disc(flat, one):
    """Difference of disc and rigid flat over the map."""
    mean = np.nanmean(np.asarray(one[MU]) / np.asarray(flat[MU]) - 1)
    both = [np.asarray(m["regime"]) != "permanent slip" for m in (flat, one)]
    return (f"Disc and rigid flat have the same regime at {percent(np.mean(flat['regime'] == one['regime']))} of the points. The pin slides on at "
            f"{np.sum(~both[0])} points on the flat and at {np.sum(~both[1])} on the disc. On average mu_inter is {percent(abs(mean), 1)} "
            f"{'smaller' if mean < 0 else 'larger'} on the disc.")


def point_rows(name, one):
    """Rows of the table of all points."""
    axes = {("velocity" if axis == "slow" else axis): np.asarray(values) for axis, values in one.axes.items()}
    is_grid = len(one.shape) == len(axes)
    base = {axis: value for axis, (_, value) in COLUMNS.items()} | ({"pressure": 1e6, "friction": 0.3} if name == "spring" else {})
    for index in np.ndindex(*one.shape):
        at = base | {axis: float(values[index[k] if is_grid else index[0]]) for k, (axis, values) in enumerate(axes.items())}
        numbers = [float(one[key][index]) if key in one else None for key in NUMBERS]
        yield [name, *(at[axis] for axis in COLUMNS), str(one["regime"][index]), *(None if n is not None and np.isnan(n) else n for n in numbers)]


def write(folder, folders, seeds):
    with contextlib.ExitStack() as stack:
        write_of(folder, {name: stack.enter_context(mesoslip.open(path)).map for name, path in folders.items()}, seeds)


def write_of(folder, maps, seeds):
    own = np.sqrt(np.asarray(maps["spring"].axes["stiffness"]) * 0.056 / (2.8 + 1770 * 0.056 * 0.016)) / (2 * np.pi)
    save_picture(regimes(maps), folder, "pin_regimes.png")
    save_picture(spring(maps["spring"], own), folder, "pin_spring.png")
    save_picture(disc(maps["pressure-friction"], maps["disc"]), folder, "pin_disc.png")
    save_picture(homogenization(maps, seeds), folder, "pin_friction.png")
    rows = comparison(maps, seeds)
    last = [one for name, one in maps.items() if name.startswith(("homogenized", "fibres"))]
    n, runs = maps["fibres-1"].status.size, sum(one.status.size for one in last)
    reached = int(sum(np.nansum(one[REACHED]) for one in last))
    summary = (f"**Homogenized pin and pin with fibres have the same regime in {rows[0][1]}: {len(seeds)} morphologies at {n} random points in pressure, "
               f"velocity, friction, regularization time and damping. Two morphologies with fibres have the same regime in {rows[3][1]}.** "
               f"The median difference of mu_inter is {rows[0][2]} between the homogenized pin and the pin with fibres, {rows[3][2]} between two "
               "morphologies with fibres.")
    write_csv(folder, "pin.csv", ["map", *(title for title, _ in COLUMNS.values()), "regime", *NUMBERS.values()],
              [row for name, one in maps.items() for row in point_rows(name, one)])
    headings = ["", "same regime", *(f"difference of {what}" for what in ("mu_inter, median", "mu_inter, largest", "main frequency, median",
                                                                          "share of separation, mean"))]
    write_page(folder, "pin.md", PAGE.format(
        summary=summary, shares=shares(maps), borders=at_border(maps), on_spring=on_spring(maps["spring"], own),
        on_disc=on_disc(maps["pressure-friction"], maps["disc"]), drawn=n, early=early_ends(maps["stopped"], maps["whole"]), comparison=table(headings, rows), verdict=verdict(rows[0], rows[3]),
        maps=len(maps), runs=sum(one.status.size for one in maps.values()), seeds=len(seeds),
        reached=reached, unsettled=runs - reached, compared=runs))
