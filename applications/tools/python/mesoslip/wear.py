"""Wear and flash temperature of the contact nodes, from the map of a run. Neither acts back on the run.

    import mesoslip
    with mesoslip.open("output/map") as run:
        depth = mesoslip.wear.depth(run, 1e-15)                            # Archard's k (1/Pa): [samples][nodes], m
        rise = mesoslip.wear.flash_temperature(run, effusivity=7290)       # [samples][nodes], K
        mesoslip.wear.coupling(run, depth, rise, expansion=5e-6, modulus=30e9)
"""

import collections

import numpy as np

from .array import Array

Coupling = collections.namedtuple("Coupling", "wear temperature")
Coupling.__doc__ = """What coupling() finds, both of the largest node over the mean pressure: `wear`, the worn depth over the displacement with which the
body's contact compliance answers the pressure, depth modulus / (pressure length); `temperature`, thermal stress, modulus expansion rise / pressure.
Below 0.01 a run that leaves the effect out has what it would have with it; from 0.1 on it has not."""


def _increments(run):
    """p |v| dt of each step between two samples, [samples - 1][nodes] (J/m^2)."""
    contact, time = run.contact_map, np.asarray(run.contact_map.time)
    for field in ("pressure", "slip velocity"):
        if field.replace(" ", "_") not in contact:
            raise KeyError(f"the map of {run.path} lacks {field}; add it to 'Contact map/Fields'")
    velocity = np.asarray(contact["slip_velocity"])
    speed = np.abs(velocity) if velocity.ndim == 2 else np.linalg.norm(velocity, axis=-1)
    rate = np.asarray(contact["pressure"]) * speed
    return 0.5 * (rate[1:] + rate[:-1]) * np.diff(time)[:, None]


def sliding_work(run):
    """p |v| summed over time (J/m^2) [samples][nodes], since the first sample: the trapezoidal rule, which needs samples that resolve the motion.

    Raises KeyError for a map without pressure or slip velocity."""
    parts = _increments(run)
    return Array(np.concatenate([np.zeros((1, parts.shape[1])), np.cumsum(parts, axis=0)]), "J/m^2", "sliding work")


def friction_work(run):
    """Work of friction of each node since the first sample (J/m^2) [samples][nodes]: that of every time step where the map has `friction work`, else
    traction times slip velocity by the trapezoidal rule.

    Raises KeyError for a map with neither."""
    contact = run.contact_map
    if "friction_work" in contact:
        work = np.abs(np.asarray(contact["friction_work"]))
        return Array(work - work[:1], "J/m^2", "friction work")
    if "traction" not in contact or "slip_velocity" not in contact:
        raise KeyError(f"the map of {run.path} has neither friction work nor traction and slip velocity; add one to 'Contact map/Fields'")
    power = np.asarray(contact["traction"]) * np.asarray(contact["slip_velocity"])
    power = np.abs(power if power.ndim == 2 else power.sum(axis=-1))
    parts = 0.5 * (power[1:] + power[:-1]) * np.diff(np.asarray(contact.time))[:, None]
    return Array(np.concatenate([np.zeros((1, parts.shape[1])), np.cumsum(parts, axis=0)]), "J/m^2", "friction work")


def depth(run, coefficient):
    """Archard's depth of wear k * integral of p |v| dt (m) [samples][nodes], since the first sample, with the `coefficient` k (1/Pa), the hardness in it."""
    if not coefficient >= 0:
        raise ValueError(f"the coefficient of wear is {coefficient}, and has to be at least 0 1/Pa")
    return Array(coefficient * np.asarray(sliding_work(run)), "m", "depth of wear")


def temperature_of(work, time, effusivity, share=1.0):
    """Rise of temperature (K) [samples][nodes] at the surface of a half-space into which the `share` of the `work` (J/m^2) [samples][nodes] flows as heat,

        T(t) = 1 / (e sqrt(pi)) integral of q(s) / sqrt(t - s) ds,

    with a flux q that is constant between two samples, for which it is exact; the heat flows along the normal alone. `effusivity` e = sqrt(conductivity
    density heat capacity), W s^0.5 / (m^2 K); samples have to be equally far apart."""
    time = np.asarray(time, dtype=float)
    step = np.diff(time)
    if not effusivity > 0 or not 0 <= share <= 1:
        raise ValueError(f"the effusivity has to be above 0 and the share between 0 and 1, not {effusivity} and {share}")
    if len(step) == 0:
        return Array(np.zeros(np.shape(work)), "K", "flash temperature")
    if np.ptp(step) > 1e-6 * step.mean():
        raise ValueError("the samples of the map are not equally far apart")
    flux = share * np.diff(np.asarray(work, dtype=float), axis=0) / step.mean()
    n = len(step)
    root = np.sqrt(step.mean() * np.arange(n + 1))
    kernel = 2 / (effusivity * np.sqrt(np.pi)) * np.diff(root)
    size = 2 * n
    rise = np.fft.irfft(np.fft.rfft(flux, size, axis=0) * np.fft.rfft(kernel, size)[:, None], size, axis=0)[:n]
    return Array(np.concatenate([np.zeros((1, flux.shape[1])), rise]), "K", "flash temperature")


def flash_temperature(run, effusivity, share=1.0):
    """temperature_of() the friction work of a run, since the first sample. With `share` = 1 all heat flows into the body, an upper bound; two halves of one
    material at rest against each other share it equally."""
    return temperature_of(friction_work(run), run.contact_map.time, effusivity, share)


def coupling(run, depth_of_wear, rise, expansion, modulus, length=None):
    """The Coupling numbers of a run: whether wear or heat, which the run leaves out, would have changed it.

    expansion (1/K), modulus (Pa): of the body at the contact. length (m): over which the body answers a pressure, by default the length of the
    contact, in 3D the root of its area."""
    contact = run.contact_map
    area = np.asarray(contact.area)
    pressure = float((np.asarray(contact["pressure"]) @ area).mean() / area.sum())
    length = length or float(area.sum() if np.asarray(contact["slip_velocity"]).ndim == 2 else np.sqrt(area.sum()))
    return Coupling(float(np.max(depth_of_wear)) * modulus / (pressure * length), modulus * expansion * float(np.max(rise)) / pressure)
