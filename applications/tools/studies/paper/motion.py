"""Motion of the contact node M: figures 4 and 5."""

import numpy as np

from cases import P1, P2, PUSHED
from measures import frequency, mu_text, reference, relative_velocity
from report.base.figures import BLACK, BLUE, GREEN, GREY, ORANGE, above_all, lettered, plt
from report.runs import paper_values as paper

SHOWN_PERIODS = 5


def trajectory_runs(cases):
    return [cases.homogeneous(PUSHED, P1), cases.heterogeneous(PUSHED, P1), cases.homogeneous(PUSHED, P2)]


LABELS = ("0.5 MPa, homogeneous", "0.5 MPa, heterogeneous 1", "0.4 MPa, homogeneous")


def trajectory(fragment, runs, names):
    found = [runs[name] for name in names]
    figure, axes = plt.subplots(1, 3, figsize=(9.0, 3.4), sharey=True)
    for axis, run, label, colour in zip(axes, found, LABELS, (BLUE, ORANGE, GREEN)):
        _, u, _, _ = reference(run, run.number("simulated_time") - SHOWN_PERIODS / frequency(run))
        axis.plot(1e6 * u[:, 0], 1e6 * u[:, 1], color=colour, lw=1)
        axis.axhline(0, color=BLACK, lw=1.2)
        axis.axhline(1e6 * paper.SEPARATION, color=GREY, lw=1, ls="--")
        axis.set(xlabel="$u_x$ (µm)")
        axis.set_title(label, loc="left")
    axes[0].set_ylabel("$u_y$ (µm)")
    lettered(axes)
    fragment.figure(figure, f"Trajectory of node M over {SHOWN_PERIODS} periods", "Last periods. u_y = 0 is the rigid flat; dashed: the paper's largest distance (table above).")


def convergence_runs(cases):
    return [cases.resolved((560, 160), 5), cases.resolved((700, 200), 2.5)]


def convergence(fragment, runs, names):
    coarse, fine = (runs[name] for name in names)
    labels = ("h = 0.1 mm, Δt = 5 ns", "h = 0.08 mm, Δt = 2.5 ns")
    velocities = [relative_velocity(run) for run in (coarse, fine)]
    rows = [["main frequency [kHz]", "40", *[f"{frequency(run) / 1e3:.2f}" for run in (coarse, fine)]],
            ["relative velocity of the flat, mean cycle [m/s]", "1.2 to 2.8",
             *[f"{low:.2f} to {high:.2f}" for low, high in velocities]],
            ["mu_inter", "-", *[mu_text(run) for run in (coarse, fine)]],
            ["slip of node M [%]", "70", *[f"{100 * run.number('reference_node', 'slip'):.0f}" for run in (coarse, fine)]]]
    fragment.table(["", "paper", *labels], rows)
    fragment.text("Runs of 1 ms at 0.5 MPa with the paper's cells and time steps; statistics from 0.25 ms on.")
    figure, axes = plt.subplots(1, 3, figsize=(9.0, 3.6), gridspec_kw={"width_ratios": [1.4, 1, 1.2]})
    for run, label, colour, width in zip((coarse, fine), labels, (BLUE, ORANGE), (1.6, 1.0)):
        time, u, _, _ = reference(run, 0.0)
        axes[0].plot(1e3 * time, 1e6 * u[:, 0], color=colour, lw=0.6 * width)
        x, v = run.need("/phase_diagram/displacement", "/phase_diagram/velocity")
        axes[1].plot(1e6 * np.append(x, x[0]), np.append(v, v[0]), color=colour, lw=width, label=label)
        f, a = run.need("/spectrum/frequency", "/spectrum/amplitude")
        shown = (f > 5e3) & (f < 2.5e5)
        axes[2].semilogy(f[shown] / 1e3, 1e6 * a[shown], color=colour, lw=width)
    for harmonic in paper.HARMONICS:
        axes[2].axvline(harmonic / 1e3, color=GREY, lw=0.9, ls="--")
    axes[0].set(xlabel="time (ms)", ylabel="$u_x$ of node M (µm)", xlim=(0, None))
    axes[1].set(xlabel="$u_x$ (µm)", ylabel="$v_x$ (m/s)")
    axes[2].set(xlabel="frequency (kHz)", ylabel="amplitude of $u_x$ (µm)")
    lettered(axes)
    above_all(figure, axes[1].get_legend_handles_labels()[0])
    fragment.figure(figure, "Node M at two grids and time steps", "(a) Transient and steady part, (b) mean phase diagram, (c) spectrum; dashed: the paper's 40, 80 and 120 kHz.")
