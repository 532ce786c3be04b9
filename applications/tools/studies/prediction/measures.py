"""What a transient run did within a window of time, with standard errors from block means.

The programs evaluate from the limit cycle they detect, which may be a long transient. Here every run of a study
is evaluated over the same windows, from the histories in dynamics.h5."""

import dataclasses
import json
import os

import h5py
import numpy as np

BLOCKS = 8  # of equal length, whose means give the standard error
LOWEST_FREQUENCY = 5e3  # Hz; below lies what the detrending left


@dataclasses.dataclass
class Measures:
    """mu_inter (eq. 9) and its standard error; mean mu_app; main frequency (Hz) and amplitude (m) of u_x of the middle
    contact node M; shares of time of all nodes and of M as (slip, stick, separated); range of the velocity of M along x
    (m/s); highest lift of M (m)."""
    mu: float
    mu_error: float
    mu_app: float
    frequency: float
    amplitude: float
    shares: tuple
    middle: tuple
    velocity: tuple
    lift: float

    @property
    def slides(self):
        """Steady sliding: no node leaves the flat or sticks."""
        return self.shares[0] > 0.999


def measure(folder, begin, end):
    """Measures of the run in `folder` between the times `begin` and `end` (s)."""
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    with h5py.File(os.path.join(folder, "dynamics.h5"), "r") as file:
        time = file["history/time"][:]
        if time[-1] < 0.99 * end:
            raise ValueError(f"{folder}: ends at {time[-1]:g} s, before the window up to {end:g} s")
        energy = file["history/friction_energy"][:]
        inside = (time >= begin) & (time <= end)
        displacement = file["reference/displacement"][:][inside]
        velocity = file["reference/velocity"][:][inside, 0]
        apparent = file["history/apparent_friction"][:][inside]
        block_ends = file["contact/blocks/time"][:]
        shares = np.array([file[f"contact/blocks/{state}"][:][(block_ends > begin * (1 + 1e-9)) &
                                                              (block_ends <= end * (1 + 1e-9))].mean(axis=0)
                           for state in ("slip", "stick", "separated")])
        width = file["grid"].attrs["cells"][0] * file["grid"].attrs["spacing"][0]  # of the contact line (m)
    power = summary["pressure"] * width * abs(summary["flat_velocity"])
    edges = np.linspace(begin, min(end, time[-1]), BLOCKS + 1)
    blocks = np.diff(np.interp(edges, time, energy)) / np.diff(edges) / power
    frequency, amplitude = main_line(time[inside], displacement[:, 0])
    numbers = [blocks.mean(), amplitude, shares.sum()]
    if not np.all(np.isfinite(numbers)):
        raise ValueError(f"{folder}: not a number in the window {begin:g} to {end:g} s")
    return Measures(mu=blocks.mean(), mu_error=blocks.std(ddof=1) / np.sqrt(BLOCKS), mu_app=apparent.mean(),
                    frequency=frequency, amplitude=amplitude, shares=tuple(shares.mean(axis=1)),
                    middle=tuple(shares[:, shares.shape[1] // 2]), velocity=(velocity.min(), velocity.max()),
                    lift=displacement[:, 1].max())


def main_line(time, values):
    """Frequency (Hz) and amplitude of the highest peak of the spectrum: Hann window, zero padding to eight times, a parabola
    through the logarithms of three bins."""
    values = values - np.polyval(np.polyfit(time, values, 1), time)
    window = np.hanning(len(values))
    length = 8 * len(values)
    amplitudes = 2 * np.abs(np.fft.rfft(values * window, length)) / window.sum()
    frequencies = np.fft.rfftfreq(length, (time[-1] - time[0]) / (len(time) - 1))
    amplitudes[frequencies < LOWEST_FREQUENCY] = 0
    peak = int(np.argmax(amplitudes[:-1]))
    left, top, right = np.log(amplitudes[peak - 1:peak + 2] + 1e-300)
    shift = 0.5 * (left - right) / (left - 2 * top + right)
    return float(frequencies[peak] + shift * frequencies[1]), float(amplitudes[peak])


def rates(values, step, length=160, noise=1e-10):
    """Growth rate + i angular frequency (1/s) of the exponentials of which `values`, `step` (s) apart, are a sum: the matrix
    pencil method with windows of `length` steps; what is below `noise` of the largest singular value is left out."""
    windows = np.lib.stride_tricks.sliding_window_view(values, length + 1)
    _, sizes, rows = np.linalg.svd(windows, full_matrices=False)
    rows = rows[sizes > noise * sizes[0]]
    return np.log(np.linalg.eigvals(np.linalg.lstsq(rows[:, :-1].T, rows[:, 1:].T, rcond=None)[0]).astype(complex)) / step


def sliding_rates(folder, begin, end):
    """`rates` of u_x of the middle contact node in the run in `folder` between two times (s); all nodes have to slide there."""
    with h5py.File(os.path.join(folder, "dynamics.h5"), "r") as file:
        time, displacement = file["reference/time"][:], file["reference/displacement"][:, 0]
        history = file["history/time"][:]
        other = file["history/sticking_nodes"][:] + file["history/separated_nodes"][:]
    if np.any(other[(history >= begin) & (history <= end)]):
        raise ValueError(f"{folder}: a node sticks or leaves the flat between {begin:g} and {end:g} s")
    inside = (time >= begin) & (time <= end)
    return rates(displacement[inside], time[1] - time[0])
