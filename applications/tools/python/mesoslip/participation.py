"""Which modes of steady sliding take part in a run: its snapshots as a superposition of the shapes of complex_modes.h5.

    import mesoslip
    from mesoslip.participation import assurance, instability_index, participation
    with mesoslip.open("output/run") as run, mesoslip.open("output/complex_modes") as modes:
        found = participation(run, modes, window=1e-4)
        found.amplitude[:, 0]                   # m, of the fastest growing mode over found.time
        instability_index(found, modes)         # 1/s, [windows][modes]
        assurance(run, modes, frequency=123e3)  # [modes]: 1 where a mode has the shape of the vibration at 123 kHz
"""

import collections

import numpy as np

from .array import Array

Participation = collections.namedtuple("Participation", "time amplitude explained")
Participation.__doc__ = """What participation() finds: `time` [windows] (s), the middle of each window; `amplitude` [windows][modes] (m), the largest
displacement that each mode has by itself; `explained` [windows], the share of the square of the motion about its mean that the modes
together account for, over all points alike."""


def participation(run, modes, window, chosen=None):
    """The Participation of modes in the snapshots of a run, over successive windows of time.

    Within a window the displacement is u(x, t) = u_0(x) + Re sum_k a_k phi_k(x) exp(s_k (t - t_m)), with the eigenvalues s_k (1/s) and
    the shapes phi_k of the file and any mean u_0. All a_k follow from one least-squares fit over points and snapshots; |a_k| is the
    amplitude. A fit says what of the motion looks like the modes, also where nodes stick or lift and the modes are none.

    run, modes: opened result files with the same points, of a transient run with snapshots and of complex modes with shapes.
    window: length of a window (s), some periods of the slowest mode, in which amplitudes change little.
    chosen: numbers of modes from 0, all that have shapes by default.
    Raises ValueError for files that do not fit, and for windows with too few snapshots to tell the modes apart."""
    rates, shapes = _shapes(modes, chosen)
    basis = _orthonormal(np.concatenate([shapes.real, shapes.imag]))
    coordinates = shapes @ basis.T  # of each shape
    times, amplitudes, explained = [], [], []
    for moments, fluctuation, square in _windows(run, window, basis):
        middle = 0.5 * (moments[0] + moments[-1])
        found, rest = _fit(moments - middle, fluctuation, rates, coordinates)
        outside = max(0.0, square - (np.abs(fluctuation - fluctuation.mean(axis=0)) ** 2).sum())
        times.append(middle)
        amplitudes.append(np.abs(found))
        explained.append(1 - (rest + outside) / square if square > 0 else np.nan)
    if not times:
        raise ValueError(f"{run.path} has no {window:g} s of snapshots; give a shorter window")
    return Participation(Array(times, "s"), Array(amplitudes, "m"), Array(explained))


def instability_index(found, modes, chosen=None):
    """Growth rate of each mode (1/s) times its share of the kinetic energy of all, [windows][modes]: which modes feed the vibration, and how fast. A mode
    that grows fast counts little where hardly anything vibrates like it. All points have the same mass.

    found: the Participation of the modes; modes, chosen: as in participation()."""
    rates, shapes = _shapes(modes, chosen)
    energy = (np.asarray(found.amplitude) * np.abs(rates)) ** 2 * np.sum(np.abs(shapes) ** 2, axis=1)
    total = energy.sum(axis=1, keepdims=True)
    return Array(rates.real * np.divide(energy, total, out=np.full_like(energy, np.nan), where=total > 0), "1/s")


def assurance(run, modes, frequency, chosen=None):
    """The modal assurance criterion |phi_k^H w|^2 / (|phi_k|^2 |w|^2) [modes] of the shapes phi_k of complex modes and of the vibration w of a run at
    a frequency (Hz): 1 for the same shape, 0 for one that is orthogonal, all points alike. w is the Fourier component of the snapshots, in Hann's window.

    run, modes, chosen: as in participation().
    Raises ValueError for files that do not fit, and for fewer than ten periods or two snapshots a period."""
    _, shapes = _shapes(modes, chosen)
    times = np.asarray(run["snapshots/time"])
    length = times[-1] - times[0] if len(times) > 2 else 0.0
    if length * frequency < 10 or len(times) < 2 * length * frequency:
        raise ValueError(f"{run.path} has {len(times)} snapshots in {length:g} s; the vibration at {frequency:g} Hz needs ten periods and two snapshots in each")
    waves = np.sin(np.pi * (times - times[0]) / length) ** 2 * np.exp(-2j * np.pi * frequency * times)
    waves -= waves.mean()  # which takes the mean displacement away
    component = 0.0
    for wave, (_, u) in zip(waves, _displacements(run, shapes.shape[1])):
        component = component + wave * u
    product = np.abs(shapes.conj() @ component) ** 2
    return Array(product / (np.sum(np.abs(shapes) ** 2, axis=1) * np.sum(np.abs(component) ** 2)))


def _shapes(modes, chosen):
    """s_k [modes] (1/s) and shapes [modes][unknowns]."""
    if "complex_modes/shape_real" not in modes:
        raise ValueError(f"{modes.path} has no shapes; run complex modes with 'Complex modes/Number of shapes' above 0")
    rates = np.asarray(modes["complex_modes/growth_rate"]) + 2j * np.pi * np.asarray(modes["complex_modes/frequency"])
    shapes = np.asarray(modes["complex_modes/shape_real"]) + 1j * np.asarray(modes["complex_modes/shape_imaginary"])
    chosen = np.arange(len(shapes)) if chosen is None else np.asarray(chosen)
    return rates[chosen], shapes[chosen].reshape(len(chosen), -1)


def _displacements(run, n):
    """Time (s) and the n displacements (m) of each snapshot."""
    for time, displacement in run.snapshots():
        u = np.asarray(displacement, float).ravel()
        if len(u) != n:
            raise ValueError(f"{run.path} has {len(u)} displacements, the shapes have {n}; both need the same cells")
        yield time, u


def _orthonormal(rows):
    """An orthonormal basis [n][unknowns] of what the rows span."""
    _, sizes, basis = np.linalg.svd(rows, full_matrices=False)
    return basis[sizes > 1e-10 * sizes[0]]


def _windows(run, window, basis):
    """Times, coordinates of displacements in the basis, less those of the first, and the sum of squares about the mean over all
    unknowns, of each full window."""
    begin, moments, inside, total, squares, first = None, [], [], 0.0, 0.0, None
    for time, u in _displacements(run, basis.shape[1]):
        if begin is None or time >= begin + window * (1 - 1e-9):
            if begin is not None:
                yield np.array(moments), np.array(inside), squares - np.sum(total**2) / len(moments)
            begin = time if begin is None else begin + window * np.floor((time - begin) / window + 1e-9)
            moments, inside, total, squares, first = [], [], 0.0, 0.0, u
        u = u - first
        moments.append(time)
        inside.append(basis @ u)
        total, squares = total + u, squares + u @ u


def _fit(times, values, rates, coordinates):
    """a_k, and the square that is left; `values` [times][n] are c + Re sum_k a_k coordinates[k] exp(s_k t)."""
    n_times, n = values.shape
    if n_times < 4 or 2 * len(rates) > n * (n_times - 1):
        raise ValueError(f"{n_times} snapshots in a window are too few; give a longer window, or a shorter 'Snapshots/Interval'")
    waves = np.exp(np.outer(times, rates))[:, None, :] * coordinates.T[None]  # [times][n][modes]
    waves = waves - waves.mean(axis=0)  # which takes the place of c
    matrix = np.concatenate([waves.real, -waves.imag], axis=2).reshape(n_times * n, -1)
    right = (values - values.mean(axis=0)).ravel()
    found = np.linalg.lstsq(matrix, right, rcond=None)[0]
    return found[: len(rates)] + 1j * found[len(rates) :], float(np.sum((matrix @ found - right) ** 2))
