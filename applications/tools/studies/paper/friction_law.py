"""Figure 2."""

import numpy as np

from report.base.figures import BLACK, BLUE, GREY, ORANGE, above, panels

STEP_AT = 2e-6  # s; of the pressure in prm/paper


def step_runs(cases):
    return [cases.friction_law(law) for law in ("constant time", "coulomb")]


def step(fragment, runs, names):
    regularized, coulomb = (runs[name] for name in names)
    figure, axes = panels(1, 3.4)
    time, normal, tangential = _stresses(regularized)
    axes[0].plot(1e6 * time, normal / 1e6, color=GREY, lw=2, label=r"$|\sigma_n|$")
    axes[0].plot(*_scaled(coulomb), color=ORANGE, lw=2, label=r"$\sigma_t$, Coulomb")
    axes[0].plot(1e6 * time, tangential / 1e6, color=BLUE, lw=2, label=r"$\sigma_t$, regularized")
    mu, delta = regularized.number("friction_coefficient"), regularized.number("regularization_time")
    since = np.clip(time - STEP_AT, 0, None)
    exact = mu * normal[-1] * (1 - np.exp(-since / delta))
    axes[0].plot(1e6 * time[::160], exact[::160] / 1e6, "o", ms=4.5, mfc="none", color=BLACK, label="eq. (11)")
    axes[0].set(xlabel="time (µs)", ylabel="stress (MPa)")
    above(axes[0], columns=4)
    error = np.abs(tangential - exact)[time > STEP_AT].max() / (mu * normal[-1])
    fragment.text("A step of 0.5 MPa presses a body of 10 micrometres on the moving flat. The tangential stress differs from the exact solution of eq. (7), μ|σ_n|(1 − exp(−t/δ)), by at "
                  f"most {100 * error:.2f} % of μ|σ_n|.")
    fragment.figure(figure, "Tangential contact stress after a step of the normal stress")


def _stresses(run):
    """Time, normal and tangential stress of the contact, mean over its 10 micrometres."""
    time, normal, tangential = run.need("/history/time", "/history/contact_normal_force", "/history/contact_tangential_force")
    x = run.need("/contact/x")
    return time, normal / (x[-1] - x[0]), tangential / (x[-1] - x[0])


def _scaled(run):
    time, _, tangential = _stresses(run)
    return 1e6 * time, tangential / 1e6
