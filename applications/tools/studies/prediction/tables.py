"""Columns of what was measured in the runs of the prediction study."""

MEASURE_COLUMNS = ["mu_inter [-]", "standard error [-]", "mu_app [-]", "main frequency [Hz]", "amplitude [m]", "slip [-]", "stick [-]",
                   "separated [-]", "M slip [-]", "M stick [-]", "M separated [-]", "M velocity min [m/s]",
                   "M velocity max [m/s]", "M lift [m]"]


def measure_row(m):
    """Values of MEASURE_COLUMNS, to five digits."""
    values = [m.mu, m.mu_error, m.mu_app, m.frequency, m.amplitude, *m.shares, *m.middle, *m.velocity, m.lift]
    return [f"{float(v):.5g}" for v in values]


def short(m):
    """mu_inter, frequency, shares of slip and separation of M: as strings for a page."""
    frequency = "–" if m.slides and m.amplitude < 1e-8 else f"{m.frequency / 1e3:.1f}"
    return [f"{m.mu:.3f}", frequency, f"{100 * m.middle[0]:.0f}", f"{100 * abs(m.middle[2]):.0f}"]
