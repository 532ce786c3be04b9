"""The picture of the examples of friction laws: what every contact node that slips made of its coefficient, and the formula."""

import os

import h5py
import numpy as np

from chain.inputs import settings
from report.base.figures import BLACK, BLUE, GREEN, GREY, ORANGE, lettered, plt

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), *[".."] * 4, "prm", "examples", "friction_laws")
MOST = 400  # points of a panel
SLIP = 2  # number of the state in a map


def constants(name, *keys):
    """Numbers of section Friction in the .prm of an example."""
    given = dict(settings(os.path.join(EXAMPLES, name + ".prm")))
    return [float(given[key]) for key in keys]


def slipping(folder, name, other="slip_velocity"):
    """Traction over pressure, `other`, pressure (Pa) and place (m) of nodes and samples of a run in which a node slipped."""
    with h5py.File(os.path.join(folder, name, "dynamics.h5")) as file:
        fields = {key: file[f"/contact_map/{key}"][:].astype(float) for key in ("pressure", "traction", other, "state")}
        fields["place"] = np.broadcast_to(file["/contact/x"][:], fields["pressure"].shape)
    chosen = np.flatnonzero((fields["state"] == SLIP) & (fields["pressure"] > 1e3))
    chosen = np.random.default_rng(1).permutation(chosen)[:MOST]
    values = {key: field.ravel()[chosen] for key, field in fields.items()}
    return np.abs(values["traction"]) / values["pressure"], np.abs(values[other]), values["pressure"], values["place"]


def points(axis, x, mu, colour=BLUE, label="nodes that slip"):
    axis.plot(x, mu, "o", ms=4, mfc="none", mew=0.8, color=colour, label=label)


def formula(axis, x, mu, label="formula"):
    axis.plot(x, mu, color=BLACK, lw=1.2, label=label)


def up_to(largest):
    return np.linspace(0, largest, 300)


def static_and_kinetic(axis, folder):
    at_rest, kinetic, critical = constants("static_and_kinetic", "Coefficient", "Kinetic coefficient", "Critical velocity")
    mu, rate, *_ = slipping(folder, "static_and_kinetic")
    points(axis, rate, mu)
    rate = up_to(rate.max())
    formula(axis, rate, kinetic + (at_rest - kinetic) * np.exp(-rate / critical))


def stribeck(axis, folder):
    at_rest, kinetic, critical, exponent, viscous = constants("stribeck", "Coefficient", "Kinetic coefficient", "Critical velocity",
                                                              "Stribeck exponent", "Viscous coefficient")
    mu, rate, *_ = slipping(folder, "stribeck")
    points(axis, rate, mu)
    rate = up_to(rate.max())
    formula(axis, rate, kinetic + (at_rest - kinetic) * np.exp(-(rate / critical)**exponent) + viscous * rate)


def slip_weakening(axis, folder):
    at_rest, kinetic, critical = constants("slip_weakening", "Coefficient", "Kinetic coefficient", "Critical slip")
    mu, slip, *_ = slipping(folder, "slip_weakening", "law_state")
    points(axis, 1e6 * slip, mu)
    slip = up_to(slip.max())
    formula(axis, 1e6 * slip, kinetic + (at_rest - kinetic) * np.exp(-slip / critical))


def table(axis, folder):
    rate_of, pressure_of, mu_of = np.loadtxt(os.path.join(EXAMPLES, "brake_pad.csv"), delimiter=",", skiprows=1, unpack=True)
    mu, rate, pressure, _ = slipping(folder, "table")
    limits = [0, *np.unique(pressure_of), np.inf]
    for low, high, colour in zip(limits, limits[1:], (GREY, GREEN, BLUE, ORANGE)):
        inside = (pressure >= low) & (pressure < high)
        name = f"{low / 1e6:.0f} to {high / 1e6:.0f} MPa" if high < np.inf else f"above {low / 1e6:.0f} MPa"
        points(axis, rate[inside], mu[inside], colour, name)
    for k, level in enumerate(np.unique(pressure_of)):
        formula(axis, rate_of[pressure_of == level], mu_of[pressure_of == level], None if k else "of the table")


def expression(axis, folder):
    """The formula is that of the head of the example."""
    mu, rate, _, place = slipping(folder, "expression")
    coated = np.abs(place - 0.006) < 0.002
    points(axis, rate[~coated], mu[~coated])
    points(axis, rate[coated], mu[coated], ORANGE, "coated")
    rate = up_to(rate.max())
    for share in (1, 0.5):
        formula(axis, rate, share * (0.15 + 0.45 * np.minimum(1, 0.5 / np.maximum(rate, 1e-9))), "formula" if share == 1 else None)


def holds(axis, folder):
    with h5py.File(os.path.join(folder, "slip_weakening", "dynamics.h5")) as file:
        time, normal, tangential = (file[f"/history/{name}"][:] for name in ("time", "contact_normal_force", "contact_tangential_force"))
    pressed = normal > 0.5 * normal.max()
    axis.plot(1e3 * time[pressed], tangential[pressed] / normal[pressed], color=BLUE)
    axis.set(title="slide, hold, slide of (c)", xlabel="time (ms)", ylabel="tangential / normal force", ylim=(0, None))


PANELS = ((static_and_kinetic, "static and kinetic"), (stribeck, "Stribeck"), (slip_weakening, "exponential slip weakening"),
          (table, "table"), (expression, "expression"))


def draw(folder, path):
    """Draws the runs in `folder`, each named as its .prm."""
    figure, axes = plt.subplots(3, 2, figsize=(8.2, 8.4))
    for axis, (panel, title) in zip(axes.flat, PANELS):
        panel(axis, folder)
        axis.set(title=title, xlabel="slip D (µm)" if panel is slip_weakening else "slip rate V (m/s)", ylabel="traction / pressure",
                 ylim=(0, None))
        axis.legend()
    holds(axes.flat[-1], folder)
    for axis in axes.flat:  # as lettered() wants them
        axis.set_title(axis.get_title(), loc="left")
        axis.set_title("", loc="center")
    lettered(axes.flat)
    figure.savefig(path, dpi=110)
    plt.close(figure)
