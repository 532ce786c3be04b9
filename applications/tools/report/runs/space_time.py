"""Pictures of the map of the contact over time (/contact_map), of its means by node, and the spectrogram of the reference node."""

import functools

import numpy as np
from matplotlib import mlab
from matplotlib.colors import BoundaryNorm, ListedColormap

from report.base.common_scales import ends
from report.base.data import Missing
from report.base.figures import GREY, SEPARATED, SLIP, STICK, STRESSES, WIDTH, above_all, panels, plt, scaled, zoom_window
from report.bodies import contact_surface
from report.bodies.projections import Group, draw
from report.bodies.stress_maps import STRESS_MAP
from report.runs.contact_states import along_flat, contact_positions, direction_of_flat, states_with

MOST_ROWS, MOST_COLUMNS = 900, 700  # of a picture; more than its pixels
SHOWN = (2.5, 97.5)  # percentiles at the ends of a scale; the leading edge of a surface may have 2 % of the nodes
SIGNED_MAP = "RdBu_r"
STATE_MAP, STATE_NORM = ListedColormap([SEPARATED, STICK, SLIP]), BoundaryNorm([-0.5, 0.5, 1.5, 2.5], 3)
FIELDS = [("pressure", "pressure", STRESSES), ("traction", "shear traction", STRESSES),
          ("slip_velocity", "slip velocity", [(1e-6, "µm/s"), (1e-3, "mm/s"), (1.0, "m/s")]), ("state", "state", None),
          ("law_state", "state of the law", None), ("remembered_pressure", "remembered pressure", STRESSES),
          ("gap", "gap", [(1e-9, "nm"), (1e-6, "µm"), (1e-3, "mm")]),
          ("friction_work", "friction work", [(1e-3, "mJ/m²"), (1.0, "J/m²"), (1e3, "kJ/m²")])]


def line_of_nodes(run):
    """Numbers of the contact nodes along the motion of the flat, of a surface those in the middle, and their places (m)."""
    position = run.get("/contact/position")
    if position is None or position.shape[1] == 2:
        along = contact_positions(run)
        if along is None:
            raise Missing(f"the file of {run.name} does not say where its contact nodes are")
        order = np.argsort(along, kind="stable")
        return order, along[order]
    direction = direction_of_flat(run)
    along, across = position[:, :2] @ direction, position[:, :2] @ np.array([-direction[1], direction[0]])
    distance = np.abs(across - 0.5 * (across.min() + across.max()))
    nearest = across[distance.argmin()]
    picked = np.abs(across - nearest) < 1e-6 * np.ptp(position[:, :2])
    if picked.sum() ** 2 < 0.25 * len(position):  # of a mesh without rows of nodes
        spacing = np.sqrt(np.ptp(along) * np.ptp(across) / len(position))
        picked = distance <= 0.75 * spacing
    numbers = np.flatnonzero(picked)
    numbers = numbers[np.argsort(along[numbers], kind="stable")]
    return numbers, along[numbers]


def farthest(values, centre, n, axis):
    """At most `n` entries along an axis: of each stretch the value farthest from `centre`."""
    length = values.shape[axis]
    if length <= n:
        return values
    starts = np.unique(np.linspace(0, length, n, endpoint=False).astype(int))
    low, high = np.minimum.reduceat(values, starts, axis), np.maximum.reduceat(values, starts, axis)
    return np.where(centre - low > high - centre, low, high)


def field_on_line(run, name, nodes, rows):
    """Values [samples][nodes], of a vector along the motion of the flat, reduced for the picture; and whether they were."""
    data = run.file[f"/contact_map/{name}"]
    direction = direction_of_flat(run)
    block = max(1, int(4e6 / np.prod(data.shape[1:])))
    parts = []
    for start in range(rows.start, rows.stop, block):
        part = np.asarray(data[start:min(start + block, rows.stop)], dtype=float)[:, nodes]
        parts.append(part @ direction if part.ndim == 3 else part)
    values = np.concatenate(parts)
    if name == "state":  # the rarest state of a stretch is shown
        counts = [(values == state).sum() for state in range(3)]
        rank = np.argsort(np.argsort(counts, kind="stable"), kind="stable")
        rarity = farthest(rank[values.astype(int)], 9, MOST_ROWS, 0)  # far from 9: the smallest, that of the rarest
        return np.argsort(rank)[farthest(rarity, 9, MOST_COLUMNS, 1)], values.shape
    centre = np.median(values)
    return farthest(farthest(values, centre, MOST_ROWS, 0), centre, MOST_COLUMNS, 1), values.shape


def percentiles(values):
    """Ends of the scale of values, before those of other runs and zero widen it."""
    return tuple(np.percentile(values, SHOWN))


def limits_of(name, low, high):
    if name in ("traction", "slip_velocity") and low < 0:
        top = max(abs(low), abs(high)) or 1.0
        return -top, top
    return min(low, 0.0), max(high, 0.0) or 1.0


def units_of_law(run):
    """Of the state of the law of the coefficient, a slip or a time."""
    unit = run.file["/contact_map/law_state"].attrs["unit"]
    unit = unit.decode() if isinstance(unit, bytes) else str(unit)
    return [(factor, prefix + unit) for factor, prefix in ((1e-9, "n"), (1e-6, "µ"), (1e-3, "m"), (1.0, ""))]


def samples(run):
    time = run.need("/contact_map/time")
    names = [entry for entry in FIELDS if entry[0] in run.members("/contact_map")]
    if len(time) < 3 or not names:
        raise Missing(f"the map of the contact of {run.name} has fewer than three samples")
    return time, names


def first_of_last_periods(run):
    """Number of the sample from which on a picture of the last periods tells more than that of all; None if it would not."""
    time, _ = samples(run)
    return None if why_no_zoom(run) else int(np.searchsorted(time, zoom_window(run, time[-1])))


def why_no_zoom(run):
    """Why a picture of the last periods would not tell more than that of all samples; empty if it would."""
    time, _ = samples(run)
    begin = int(np.searchsorted(time, zoom_window(run, time[-1])))
    if begin <= 0.05 * len(time):
        return "the map is hardly longer than these"
    return "" if len(time) - begin >= 12 else f"they have {len(time) - begin} samples, and 12 are needed"


@functools.lru_cache(maxsize=64)
def shown_field(run, name, zoom):
    """Values [samples][nodes] of a picture and their numbers in the map."""
    time, _ = samples(run)
    return field_on_line(run, name, line_of_nodes(run)[0], range((first_of_last_periods(run) or 0) if zoom else 0, len(time)))


def field_ends(run, name, zoom):
    return percentiles(shown_field(run, name, zoom)[0])


def space_time(run, runs, zoom=False):
    """All fields side by side on the scales of `runs`, x to the right and time upwards; (figure, whether samples were left out)."""
    time, names = samples(run)
    rows = range(first_of_last_periods(run) if zoom else 0, len(time))
    _, place = line_of_nodes(run)
    figure, axes = plt.subplots(1, len(names), figsize=(WIDTH + 0.9 * max(0, len(names) - 2), 5.6), sharex=True, sharey=True,
                                squeeze=False)
    half = 0.5 * (time[1] - time[0])
    extent = [1e3 * place[0], 1e3 * place[-1], 1e3 * (time[rows.start] - half), 1e3 * (time[-1] + half)]
    reduced = False
    for axis, (name, label, units) in zip(axes[0], names):
        values, shape = shown_field(run, name, zoom)
        reduced = reduced or values.shape != shape
        show = lambda shown, **options: axis.imshow(shown, origin="lower", aspect="auto", extent=extent, interpolation="nearest", **options)
        if name == "state":
            show(values, cmap=STATE_MAP, norm=STATE_NORM)
            axis.set_title(label, fontsize=11)
        else:
            of_unit = runs if units else tuple(other for other in runs if "law_state" in other.members("/contact_map") and
                                               units_of_law(other) == units_of_law(run))
            limits = np.array(limits_of(name, *ends(field_ends, of_unit, name, zoom)[:2]))
            factor, unit = scaled(limits, units=units or units_of_law(run))
            low, high = limits / factor
            image = show(values / factor, cmap=SIGNED_MAP if low == -high else STRESS_MAP, vmin=low, vmax=high)
            over, under = values.max() > 1.000001 * high * factor, values.min() < low * factor
            bar = figure.colorbar(image, ax=axis, location="top", aspect=12, pad=0.02,
                                  extend="both" if over and under else "max" if over else "min" if under else "neither")
            bar.set_label(f"{label}\n({unit})", fontsize=11)
            bar.ax.tick_params(labelsize=9)
            bar.ax.locator_params(nbins=3)
        axis.grid(False)
        axis.locator_params(axis="x", nbins=4)
    axes[0][0].set_ylabel("time (ms)")
    figure.supxlabel("position along the contact (mm)", fontsize=11.5)
    if any(name == "state" for name, *_ in names):
        state = shown_field(run, "state", zoom)[0]
        above_all(figure, states_with(state == 2, state == 1, state == 0), title=run.title)
    elif run.title:
        figure.suptitle(run.title, fontsize=11.5)
    return figure, reduced


def profile_ends(run, name):
    """Of a curve that has its mean in it."""
    values = run.need(f"/contact/{name}")
    return min(0.0, 1.08 * values.min()), max(0.0, 1.08 * values.max())


def profile(run, runs):
    """Mean pressure, friction power of the steady part and friction work of the run along the contact of a plane body, on the scales of
    `runs`."""
    x, pressure, power, work = run.need(*[f"/contact/{name}" for name in ("area", "pressure", "friction_power", "friction_work")])
    nodes, place = line_of_nodes(run)
    figure, axes = panels(3, 6.0, sharex=True)
    for axis, values, name, units in [(axes[0], pressure, "pressure", STRESSES),
                                      (axes[1], power, "friction_power", [(1.0, "W/m²"), (1e3, "kW/m²"), (1e6, "MW/m²")]),
                                      (axes[2], work, "friction_work", FIELDS[-1][2])]:
        limits = np.array(ends(profile_ends, runs, name)[:2])
        factor, unit = scaled(limits, units=units)
        mean = np.average(values, weights=x)
        axis.plot(1e3 * place, values[nodes] / factor, color=SLIP, lw=1.4)
        axis.axhline(mean / factor, color=GREY, lw=1.0, ls="--")
        axis.set_ylabel(f"{'mean pressure' if name == 'pressure' else name.replace('_', ' ')}\n({unit})")
        axis.margins(x=0)
        axis.set_ylim(*(limits / factor) if np.any(limits) else (0, 1))
    axes[0].set_title(run.title, loc="left")
    axes[-1].set_xlabel("position along the contact (mm)")
    figure.align_ylabels()
    return figure


def mean_ends(run, name):
    return percentiles(run.need(f"/contact/{name}"))


def surface_means(run, runs):
    """Mean pressure of the steady part and friction work of the run on the contact surface of a body in 3D, on the scales of `runs`."""
    groups = []
    for name, label, units in [("pressure", "mean pressure", STRESSES), ("friction_work", "friction work", FIELDS[-1][2])]:
        values, area = run.need(f"/contact/{name}", "/contact/area")
        limits = np.array(limits_of(name, *ends(mean_ends, runs, name)[:2]))
        factor, unit = scaled(limits, units=units)
        low, high = limits / factor
        mean = np.average(values, weights=area) / factor
        groups.append(Group(values / factor, STRESS_MAP, (low, high), f"mean over the surface {mean:.4g} {unit}", f"{label} ({unit})"))
    return draw([contact_surface.nodes_view(run)], groups, title=run.title)


def has_surface_map(run):
    """Whether the map is that of a surface and has a field that surface_at_times shows."""
    return run.has_surface() and any(name in run.members("/contact_map") for name, *_ in FIELDS[:3])


def rows_at(run, time, times):
    """Numbers of the samples at given times (s), or else of four in the last periods."""
    if not times:
        begin = min(np.searchsorted(time, zoom_window(run, time[-1])), len(time) - 4)
        return np.unique(np.linspace(max(begin, 0), len(time) - 1, 4).astype(int))
    half = 0.5 * (time[1] - time[0])
    outside = [t for t in times if not time[0] - half <= t <= time[-1] + half]
    if outside:
        raise Missing(f"the map of the contact of {run.name} is that from {time[0]:.6g} s to {time[-1]:.6g} s, without the time "
                      f"{outside[0]:.6g} s of --surface-times")
    return np.unique([np.abs(time - t).argmin() for t in times])


def surface_fields(run, name, times):
    """Values [times][nodes] at given times (s), of a vector along the motion of the flat."""
    fields = [run.get(f"/contact_map/{name}", int(row)) for row in rows_at(run, samples(run)[0], times)]
    return np.array([values @ direction_of_flat(run) if values.ndim == 2 else values for values in fields])


def surface_ends(run, name, times):
    return percentiles(surface_fields(run, name, times))


def surface_at_times(run, times=(), runs=()):
    """Pressure, shear traction and slip velocity, as far as the map has them, side by side on the contact surface of a body in 3D, time by
    time, on the scales of `runs`; (figure, names of the fields)."""
    time, names = samples(run)
    rows = rows_at(run, time, times)
    columns = []
    for name, label, units in [entry for entry in names if entry in FIELDS[:3]]:
        fields = surface_fields(run, name, times)
        limits = np.array(limits_of(name, *ends(surface_ends, runs or (run,), name, tuple(times))[:2]))
        factor, unit = scaled(limits, units=units)
        limits = tuple(limits / factor)
        columns.append((fields / factor, SIGNED_MAP if limits[0] == -limits[1] else STRESS_MAP, limits, f"{label} ({unit})"))
    groups = [Group(fields[k], colours, limits, f"t = {1e3 * time[row]:.5g} ms", label)
              for k, row in enumerate(rows) for fields, colours, limits, label in columns]
    return draw([contact_surface.nodes_view(run)], groups, title=run.title), [name for name, *_ in names[:len(columns)]]


def spectrogram(run, runs=()):
    """Power of the velocity of the reference node along the motion of the flat over time and frequency, up to the same frequency for all of
    `runs`; (figure, length of a window in s)."""
    time, velocity = run.need("/reference/time", "/reference/velocity")
    if velocity.ndim != 2 or len(time) != len(velocity) or len(time) < 128:
        raise Missing(f"/reference of {run.name} has fewer than 128 samples")
    velocity = along_flat(run, velocity)
    if not np.any(velocity):
        raise Missing(f"the reference node of {run.name} does not move along the flat")
    interval = (time[-1] - time[0]) / (len(time) - 1)
    main = run.number("main_frequency")
    # Some periods in a window tell frequencies apart, and a twelfth of the run tells times apart.
    wanted = 8 / (main * interval) if main else len(time) / 16
    n = int(np.clip(wanted, 32, len(time) // 12 if len(time) > 400 else len(time) // 4))
    power, frequency, middle = mlab.specgram(velocity, NFFT=n, Fs=1 / interval, noverlap=n - max(1, min(n // 8, len(time) // 800 + 1)),
                                             detrend="linear", pad_to=4 * n)
    highest = max((other.number("main_frequency") or 0 for other in runs or (run,)), default=0)
    top = min(13 * highest if highest else frequency[-1], frequency[-1])
    shown = (frequency <= top) & (frequency > 0)
    level = 10 * np.log10(np.maximum(power[shown], 1e-12 * power[shown].max()) / power[shown].max())
    figure, (axis,) = panels(1, 3.8)
    image = axis.pcolormesh(1e3 * (time[0] + middle), 1e-3 * frequency[shown], level, cmap=STRESS_MAP, vmin=-60, vmax=0, shading="nearest",
                            rasterized=True)
    axis.grid(False)
    axis.set(xlabel="time (ms)", ylabel="frequency (kHz)")
    axis.set_title(run.title, loc="left")
    figure.colorbar(image, ax=axis, label="power over the largest (dB)", extend="min")
    return figure, n * interval
