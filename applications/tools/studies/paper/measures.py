"""What the parts read from a run: data.Run of applications/tools/report, and the numbers that the paper gives."""

import numpy as np

from report.base.data import Missing, Run


class Runs:
    """The results of a study by name of the run; Missing names one that did not end well."""

    def __init__(self, results):
        self.results = results

    def __getitem__(self, name):
        result = self.results.get(name)
        if result is None or result.status != 0:
            raise Missing(f"the run {name} " + ("was left out" if result is None else "failed: " + result.message))
        return Run(result.folder, result.summary)

    def cpu_seconds(self, names):
        return sum(self.results[name].cpu_seconds for name in names if name in self.results)


def mu(run):
    return run.number("global_interface_friction_coefficient")


def mu_text(run):
    """mu_inter with its 95 % half width in time."""
    error = run.number("global_interface_friction_coefficient_95")
    return f"{mu(run):.3f} ± {error:.3f}" if error else f"{mu(run):.3f}"


def frequency(run):
    return run.number("main_frequency")


def slip(run):
    return run.number("reference_node", "slip")


def separation(run):
    return run.number("reference_node", "separation")


def regime(run):
    """The paper's, by what node M does; '-' for a pin that hardly separates."""
    share = separation(run)
    return "-" if share < 0.1 else "1" if share < 0.5 else "2"


def reference(run, begin=None):
    """Time (s), displacement (m), velocity (m/s) and traction (Pa) of node M from `begin` (default: steady) on."""
    time, u, v, traction = run.need(*[f"/reference/{name}" for name in ("time", "displacement", "velocity", "traction")])
    first = np.searchsorted(time, run.steady_from() if begin is None else begin)
    return time[first:], u[first:], v[first:], traction[first:]


def height(run):
    """m; how far node M leaves the flat: largest distance of each period of the main frequency, on average."""
    time, u, _, _ = reference(run)
    n = max(1, int(round(1 / (frequency(run) * (time[1] - time[0])))))
    periods = len(u) // n
    return float(u[: periods * n, 1].reshape(periods, n).max(axis=1).mean())


def contact_time(run):
    """s; mean duration of the contacts of node M in the steady part, as sampled in the history; nan if it never lands."""
    time, _, _, traction = reference(run)
    touching = traction[:, 1] > 0
    landings = np.count_nonzero(touching[1:] & ~touching[:-1])
    return np.count_nonzero(touching) * (time[1] - time[0]) / landings if landings else np.nan


def relative_velocity(run):
    """m/s; smallest and largest speed of the flat relative to node M in the steady part, over mean cycles."""
    v = run.need("/phase_diagram/velocity")
    flat = run.number("flat_velocity")
    return flat - v.max(), flat - v.min()


def spectrum_of(signal, time):
    """Frequencies (Hz) and one-sided amplitudes, trend removed, Hann window, four times as long by zeros."""
    signal = signal - np.polyval(np.polyfit(time - time[0], signal, 1), time - time[0])
    window = np.hanning(len(signal))
    n = 4 * len(signal)
    amplitude = 2 * np.abs(np.fft.rfft(signal * window, n)) / window.sum()
    return np.fft.rfftfreq(n, time[1] - time[0]), amplitude


def within(run, begin, end):
    """mu_inter, share of slip of the reference node and main frequency (Hz) from `begin` to `end` (s)."""
    time, energy = run.need("/history/time", "/history/friction_energy")
    x = run.need("/contact/x")
    shown = (time >= begin) & (time <= end)
    slope = np.polyfit(time[shown], energy[shown], 1)[0]
    f, amplitude = spectrum_of(run.need("/reference/displacement")[shown, 0], time[shown])
    amplitude[f < 1e4] = 0
    blocks, slipping, sticking = run.need("/contact/blocks/time", "/contact/blocks/slip", "/contact/blocks/stick")
    inside = (blocks > begin) & (blocks <= end * (1 + 1e-9))
    middle = slipping.shape[1] // 2
    return {"mu": slope / (run.number("pressure") * (x[-1] - x[0]) * run.number("flat_velocity")),
            "slip": float((slipping + sticking)[inside, middle].mean()), "frequency": f[np.argmax(amplitude)]}
