"""What a transient run says about its steady part, against numpy on its own histories, and that it does not depend on how dense these are."""

import math
import os
import tempfile

import h5py
import numpy as np

from scenes import Folder, prm, sets

# The paper's pin on cells of 1 mm, which vibrates at 124 and 221 kHz: 45 and 25 steps a period.
PIN = prm({"Body/Cells": "56, 16", "Time/End time": 2e-3, "Flat/Velocity": 2, "Supports/Top/Pressure": 5e6})
LENGTH, PRESSURE, VELOCITY, MU = 0.056, 5e6, 2., 0.25
SPARSE = "their spectra would show frequencies that are not there"


class Run:
    def __init__(self, path, settings, ranks=1):
        folder, name = Folder(path, {"pin": PIN}), str(len(os.listdir(path)))
        folder.run(0, "contact_dynamics", "pin.prm", "--output", name, *sets(settings), ranks=ranks)
        self.folder, self.summary, self.log = folder(name), folder.summary(name), folder.read(name, "log.txt").decode()

    def __getitem__(self, name):
        return self.summary[name]

    def data(self, name):
        with h5py.File(os.path.join(self.folder, "dynamics.h5")) as file:
            return file[name][()]

    def window(self):
        time = self.data("history/time")
        return (time >= self["window_begin"] - 1e-12) & (time <= self["window_end"] + 1e-12)

    def slope(self, values):
        chosen = self.window()
        return np.polyfit(self.data("history/time")[chosen], values[chosen], 1)[0]

    def load_that_acted(self, velocity):
        """W/m; the mean of F_N |V|, by the slope of its integral."""
        time, force = self.data("history/time"), self.data("history/contact_normal_force")
        return self.slope(np.cumsum(force * np.abs(velocity(time))) * (time[1] - time[0]))


def close(found, expected, relative, what):
    assert abs(found / expected - 1) <= relative, f"{what}: {found} instead of {expected}"


def says(run, words, what):
    assert words in run.log, f"{what}: nothing says '{words}' in\n{run.log}"


def highest_peak(run):
    """Hz; of the samples in dynamics.h5, by numpy."""
    time, u = run.data("reference/time"), run.data("reference/displacement")[:, 0]
    u = u[time >= run["steady_from"]]
    u = np.hanning(len(u)) * (u - u.mean())
    spectrum = np.abs(np.fft.rfft(u, 8 * len(u)))
    frequency = np.fft.rfftfreq(8 * len(u), time[1] - time[0])
    spectrum[frequency < 2 / (len(u) * (time[1] - time[0]))] = 0
    return frequency[spectrum.argmax()]


def check_sampling(folder):
    """Histories of any density: the same motion, the same statement."""
    runs = {n: Run(folder, {"Observation/History interval": n}) for n in (1, 2, "auto", 20, 50, 200)}
    first = runs[1]
    peak = highest_peak(first)
    for n, run in runs.items():
        close(run["main_frequency"], peak, 1e-3, f"main frequency, every {n} steps")
    assert peak > 1e5 and highest_peak(runs[50]) < 6e4, "samples every 50 steps are to fold the main frequency"
    for n, run in runs.items():
        for key in ("main_frequency", "global_interface_friction_coefficient", "global_interface_friction_coefficient_95",
                    "mean_apparent_friction_coefficient", "window_begin", "window_end", "steady_from", "limit_cycle", "slip_fraction",
                    "friction_energy"):
            assert run[key] == first[key], f"{key}: {run[key]} with samples every {n} steps, {first[key]} with every step"
        for name in ("spectrum/amplitude", "phase_diagram/velocity"):
            assert np.array_equal(run.data(name), first.data(name)), name
        assert (SPARSE in run.log) == (n in (20, 50, 200)), f"every {n} steps:\n{run.log}"
    close(highest_peak(runs["auto"]), peak, 1e-3, "main frequency of the samples of auto")
    # All whole periods of the steady part, and no more; eq. (9) over P S |V|.
    end, period = first["window_end"], 1 / first["main_frequency"]
    periods = math.floor((end - first["steady_from"]) / period)
    assert periods > 100 and abs((end - first["window_begin"]) / period - periods) < 1e-6, (periods, first["window_begin"])
    mu = first.slope(first.data("history/friction_energy")) / (PRESSURE * LENGTH * VELOCITY)
    close(first["global_interface_friction_coefficient"], mu, 1e-4, "mu_inter")
    close(first["global_interface_friction_load"], PRESSURE * LENGTH * VELOCITY, 1e-14, "P S |V|")
    close(first.load_that_acted(lambda t: VELOCITY + 0 * t), PRESSURE * LENGTH * VELOCITY, 2e-3, "mean of F_N |V|")
    says(first, "over P S |V| = 5.6e+05 W/m", "what mu_inter is over")
    chosen = first.window()
    close(first["mean_apparent_friction_coefficient"], first.data("history/apparent_friction")[chosen].mean(), 1e-3, "mean mu_app")
    # Of the body on the platen, of the flat on the body: both along x, as the flat moves.
    forces = [first.data(f"history/{at}_tangential_force")[chosen].mean() for at in ("top", "contact")]
    assert forces[0] > 0 and abs(forces[0] / forces[1] - 1) < 0.02, forces


def check_loads(folder):
    """mu_inter is over the load that acted; where there is none, nothing is said about it."""
    every = {"Observation/History interval": 1, "Time/End time": 3e-4, "Observation/Steady from": 1.5e-4}

    def compare(settings, velocity, what, relative=1e-3):
        run = Run(folder, {**every, **settings})
        load = run.load_that_acted(velocity)
        close(run["global_interface_friction_load"], load, relative, f"{what}: load")
        power = run.slope(run.data("history/friction_energy"))
        close(run["global_interface_friction_coefficient"], power / load, relative, f"{what}: mu_inter")
        says(run, "over the mean of F_N |V|", what)
        return run

    held = compare({"Supports/Top/Kind": "held", "Body/Acceleration": "0, -2e5"}, lambda t: VELOCITY + 0 * t, "held top")
    assert 0.1 < held["global_interface_friction_coefficient"] < MU, held["global_interface_friction_coefficient"]
    compare({"Supports/Top/Hold from": 1.4e-4}, lambda t: VELOCITY + 0 * t, "top that stops")
    compare({"Body/Acceleration": "0, -2e4"}, lambda t: VELOCITY + 0 * t, "weight")
    compare({"Flat/Expression": "20"}, lambda t: 20 + 0 * t, "velocity by expression")
    compare({"Flat/Expression": "2 + sin(2*pi*3e4*t)"}, lambda t: 2 + np.sin(2 * np.pi * 3e4 * t), "velocity that varies")
    compare({"Flat/Expression": "1/(t-2e-4)"}, lambda t: 1 / (t - 2e-4), "velocity with a pole", 5e-3)
    # Some nodes touch now and then, for a few steps.
    compare({"Supports/Top/Kind": "held", "Flat/Gap": 1e-7, "Body/Initial velocity": "0.5, -2"}, lambda t: VELOCITY + 0 * t, "body that bounces")
    compare({"Supports/Top/Expression": "5e6*(1 + 0.5*sin(2*pi*2e4*t))"}, lambda t: VELOCITY + 0 * t, "pressure that varies")

    slow = Run(folder, {**every, "Flat/Velocity": 1e-12})
    assert slow["global_interface_friction_coefficient"] > MU
    says(slow, "is above the largest friction coefficient, 0.25", "very slow flat")
    for what, settings in {"flat at rest": {"Flat/Velocity": 0}, "nothing touches": {"Flat/Gap": 1}}.items():
        run = Run(folder, {**every, **settings})
        for key in ("coefficient", "coefficient_95", "load", "load_meaning"):
            assert run[f"global_interface_friction_{key}"] is None, f"{what}: {key}"
        assert run["global_interface_friction_warning"] in run.log
        says(run, "mu_inter is left out: the mean of F_N |V| in the steady part is 0 W/m", what)
    for pressure, words in ((0, "is 0 Pa, which presses nothing"), (-1e6, "is -1e+06 Pa, which pulls the body off the flat")):
        run = Run(folder, {**every, "Supports/Top/Pressure": pressure, "Flat/Gap": 1e-6})
        says(run, f"no node touched the flat in the steady part: Supports/Top/Pressure {words}", f"pressure {pressure}")


def check_periodic(folder):
    """With periodic sides the last node is the first one again, in all that is said of the nodes."""
    run = Run(folder, {"Sides/Periodic": "true", "Time/End time": 3e-4})
    for state in ("slip", "stick", "separated"):
        shares, blocks = run.data(f"contact/{state}"), run.data(f"contact/blocks/{state}")
        assert shares.shape == (57,) and blocks.shape[1:] == (57,), (shares.shape, blocks.shape)
        assert shares[-1] == shares[0] and np.array_equal(blocks[:, -1], blocks[:, 0]), f"{state}: {blocks[:, [0, -1]]}"
    assert 0 < run.data("contact/blocks/slip")[:, -1].max()


def check_energy(folder):
    """A balance is checked from two samples on."""
    step = 1.7e-7
    for steps, n_samples in ((200, 1), (201, 2), (401, 3)):
        run = Run(folder, {"Time/Time step": step, "Time/End time": steps * step})
        assert len(run.data("energy/time")) == n_samples
        if n_samples == 1:
            assert run["energy_balance_residual"] is None and run["energy_balance_scale"] is None
            says(run, f"The energy balance is not checked: with Observation/Energy interval = 200 the run of {steps} steps has no sample "
                      "but that of the start", "one sample")
        else:
            assert run["energy_balance_residual"] > 0
            says(run, "Energy balance closes to", f"{n_samples} samples")
    none = Run(folder, {"Time/End time": 1e-5, "Observation/Energy interval": 0})
    assert none["energy_balance_residual"] is None and "nergy balance" not in none.log


def check_scale(folder):
    """A body twice as long and 2^14 times as soft vibrates 256 times as slowly, and all is as of the pin; no number is that of its size."""
    growing = {"Time/End time": 1e-3, "Time/Time step": 5e-8, "Time/Rayleigh beta": 8.8e-8, "Friction/Regularization time": 1.5e-6}
    steady = {**growing, "Time/End time": 4e-3, "Flat/Ramp time": 5e-4, "Supports/Top/Ramp time": 5e-4}
    moduli = np.array([36.54e9, 9.1e9, 47.26e9, 13.785e9])
    for settings in (steady, growing):
        ramps, runs = {f"{of}/Ramp": "smooth" for of in ("Flat", "Supports/Top") if settings is steady}, []
        for softer, time in ((1, 1), (2**14, 256)):
            scaled = {key: value * time for key, value in settings.items()}
            scaled.update({**ramps, "Body/Stiffness": ", ".join(repr(float(x)) for x in moduli / softer), "Supports/Top/Pressure": 5e6 / softer,
                           "Body/Size": "0.056, 0.016" if time == 1 else "0.112, 0.032", "Flat/Velocity": 2. if time == 1 else 4. / time})
            runs.append(Run(folder, scaled))
        pin, soft = runs
        close(soft["main_frequency"] * 256, pin["main_frequency"], 1e-9, "main frequency of a soft body")
        close(soft["steady_from"] / 256, pin["steady_from"], 1e-9, "steady part of a soft body")
        close(soft["global_interface_friction_coefficient"], pin["global_interface_friction_coefficient"], 1e-9, "mu_inter of a soft body")
        assert soft["limit_cycle_reached"] == pin["limit_cycle_reached"] == (settings is steady)


def check_slow_motion(folder):
    """A motion of less than two periods in the steady part has no frequency; one that is larger than what has is told."""
    gently = {"Flat/Ramp": "smooth", "Flat/Ramp time": 4e-4, "Time/Rayleigh beta": 8.8e-8, "Time/Time step": 5e-8, "Friction/Regularization time": 1.5e-6,
              "Supports/Top/Expression": "5e6*(1 + 0.9*sin(2*pi*1500*t))*(1 - exp(-t/2e-4))"}
    slow = Run(folder, {**gently, "Time/End time": 1e-3, "Observation/Steady from": 5e-4})
    says(slow, "the reference node moves more at less than 4 kHz, of which the steady part has not two periods", "slow pressure")
    assert slow["main_frequency"] > 4e3
    longer = Run(folder, {**gently, "Time/End time": 4e-3, "Observation/Steady from": 2e-3})
    assert "of which the steady part has not two periods" not in longer.log, longer.log
    close(longer["main_frequency"], 1500, 0.02, "main frequency of a slow pressure")


def check_separation(folder):
    """A damped body thrown off the flat vibrates less and less; nothing brings it back, unless a load presses it."""
    thrown = {"Body/Cells": "112, 32", "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 0, "Body/Initial velocity": "0, 1", "Time/End time": 4e-3,
              "Time/Rayleigh beta": 8.8e-8, "Observation/Stop at limit cycle": "true"}
    free = Run(folder, thrown)
    says(free, "Separation from", "a free body")
    assert free["limit_cycle_reached"] and free["simulated_time"] < 1.5e-3, free["limit_cycle"]
    assert not (free.data("history/sticking_nodes") + free.data("history/slipping_nodes"))[1:].any()
    for load in ({"Supports/Top/Pressure": 1e3}, {"Body/Acceleration": "0, -1e3"},
                 {"Supports/Top/Kind": "springs", "Supports/Top/Spring stiffness": "0, 1e3"}):
        pressed = Run(folder, {**thrown, "Time/End time": 1.5e-3, **load})
        assert "Separation from" not in pressed.log, (load, pressed["limit_cycle"])


def main():
    for check in (check_sampling, check_loads, check_periodic, check_energy, check_scale, check_slow_motion, check_separation):
        with tempfile.TemporaryDirectory() as folder:
            check(folder)


if __name__ == "__main__":
    main()
