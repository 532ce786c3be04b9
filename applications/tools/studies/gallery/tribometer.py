"""The picture of tribometer_map.prm over stiffnesses of the spring and velocities of the flat, beside a rigid block."""

import os

import h5py
import numpy as np

from chain.inputs import settings
from report.base.figures import BLACK, BLUE, GREEN, ORANGE, above_all, plt

FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), *[".."] * 4, "prm", "examples", "tribometer_map.prm")
STIFFNESSES, VELOCITIES = (2.5e9, 1e10, 4e10, 1.6e11), (0.025, 0.05, 0.1, 0.16)  # Pa/m, m/s
CHANGES = tuple((f"{k:g} {v:g}", {"Supports/Top/Spring stiffness": k, "Flat/Velocity": v}) for k in STIFFNESSES for v in VELOCITIES)
REGIMES = (0.4, "stick and slip: sticks ≥ 40 % of the time", ORANGE), (1e-9, "mixed: less than 40 %", BLUE), (0, "continuous sliding: 0 %", GREEN)  # from
SHOWN = 6  # periods of the spring
FINENESS = 0.01  # of them, over which numbers of nodes are averaged


def constants():
    """Mass (kg/m^2), dashpot (Pa s/m), both limits of friction (Pa) and the pressure (Pa) of the example."""
    given = dict(settings(FILE))
    width, height = (float(part) for part in given["Size"].split(","))
    mass, dashpot, density, pressure, at_rest, kinetic = (float(given[key]) for key in ("Platen mass", "Dashpot", "Density", "Pressure", "Coefficient",
                                                                                        "Kinetic coefficient"))
    return mass / width + density * height, dashpot, at_rest * pressure, kinetic * pressure, pressure


def rigid_block(k, v):
    """Share of the time in which a rigid block sticks, and the smallest and largest force of spring and dashpot over that of the pressure."""
    m, z, at_rest, kinetic, pressure = constants()
    omega, zeta = np.sqrt(k / m), z / (2 * np.sqrt(k * m))
    root = omega * np.sqrt(zeta**2 - 1 + 0j)
    time = np.linspace(0, 2 * np.pi / abs(root), 20001)
    start = np.array([(at_rest - z * v - kinetic) / k, v])  # displacement from the equilibrium of sliding, velocity
    roots = np.array([-zeta * omega + root, -zeta * omega - root])
    swing = np.linalg.solve([[1, 1], roots], start)[:, None] * np.exp(roots[:, None] * time)
    displacement, velocity = swing.sum(axis=0).real, (roots[:, None] * swing).sum(axis=0).real
    again = np.flatnonzero(velocity[2:] >= v)  # at the speed of the flat
    if not again.size:
        return 0, kinetic / pressure, kinetic / pressure
    end = again[0] + 2
    sticking = (displacement[0] - displacement[end]) / v
    force = (kinetic + k * displacement + z * velocity)[:end + 1] / pressure
    return sticking / (sticking + time[end]), force.min(), force.max()


def panel(axis, folder, k, v):
    """The apparent friction of the last periods of a run, in the colour of its regime, and above it the shares of the time that stick."""
    with h5py.File(os.path.join(folder, f"{k:g} {v:g}", "dynamics.h5")) as file:
        time, friction, sticking, slipping = (file[f"/history/{name}"][:].astype(float) for name in
                                              ("time", "apparent_friction", "sticking_nodes", "slipping_nodes"))
        steady = time >= file["run"].attrs["steady_from"]
    period = 2 * np.pi * np.sqrt(constants()[0] / k)
    share = np.mean(sticking[steady] >= slipping[steady])
    formula, smallest, largest = rigid_block(k, v)
    time = (time - time[-1]) / period + SHOWN
    samples = max(1, int(FINENESS / (time[1] - time[0])))
    time, friction, nodes = (array[-(array.size // samples * samples):].reshape(-1, samples).mean(axis=1)
                             for array in (time, friction, sticking / (sticking + slipping)[-1]))
    colour = next(colour for least, _, colour in REGIMES if share >= least)
    axis.fill_between(time, 0, nodes, color="#e3e7eb", lw=0, transform=axis.get_xaxis_transform())
    for level in {smallest, largest}:
        axis.axhline(level, color=BLACK, lw=0.9, ls=(0, (4, 3)))
    axis.plot(time, friction, color=colour, lw=1.6)
    axis.set(xlim=(0, SHOWN), ylim=(0, 0.45))
    axis.set_title(f"sticks {100 * share:.0f} % ({100 * formula:.0f} %)", color=colour, fontsize=10, pad=3)


def draw(folder, path):
    """Draws the runs of CHANGES in `folder`."""
    figure, axes = plt.subplots(len(STIFFNESSES), len(VELOCITIES), figsize=(8.2, 7.4), sharex=True, sharey=True)
    for row, k in zip(axes[::-1], STIFFNESSES):
        row[0].set_ylabel(f"{1e-9 * k:g} GPa/m")
        for axis, v in zip(row, VELOCITIES):
            panel(axis, folder, k, v)
            axis.grid(False)
    for axis, v in zip(axes[-1], VELOCITIES):
        axis.set_xlabel(f"{v:g} m/s")
    figure.supxlabel("velocity of the flat (inner axes: time in periods of the spring)", fontsize=11.5)
    figure.supylabel(r"stiffness of the spring (inner axes: $\mu_\mathrm{app}$)", fontsize=11.5)
    lines = [plt.Line2D([], [], color=colour, label=label) for _, label, colour in REGIMES]
    lines += [plt.Line2D([], [], color=BLACK, lw=0.9, ls=(0, (4, 3)), label="rigid block: extremes (share of the time)"),
              plt.Rectangle((0, 0), 1, 1, color="#e3e7eb", label="share of the contact that sticks")]
    above_all(figure, lines, columns=2)
    figure.savefig(path, dpi=110)
    plt.close(figure)
