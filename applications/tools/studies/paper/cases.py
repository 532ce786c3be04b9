"""Every run behind the page, by name. A run is one of the files in prm/paper with a few keys changed."""

import dataclasses
import os

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", ".."))
DYNAMICS = "contact_dynamics"

RVE_SEEDS = (1, 2, 3, 4, 5, 6)  # 1, 2, 4 and 6 are the numbers of the heterogeneous models in table 2


@dataclasses.dataclass(frozen=True)
class Reading:
    """What the paper leaves open: pressure over the printed one, tangential velocity of the pin at the start (m/s),
    duration and begin of the steady part (s)."""
    name: str
    meaning: str
    factor: float
    start: float
    end: float
    steady_from: float


PUSHED = Reading("pushed", "P, pushed", 1.0, 0.5, 2e-3, 1e-3)


def pushed(velocity):
    """PUSHED with another velocity (m/s), and half as long: enough to tell the regime."""
    return Reading(f"pushed{velocity:g}", f"P, pushed with {velocity:g} m/s", 1.0, velocity, 1e-3, 5e-4)


P1, P2 = 0.5e6, 0.4e6  # Pa, as printed for the regimes 1 and 2


def prm(name):
    return os.path.join(TOP, "prm", "paper", name + ".prm")


def loading(reading, pressure):
    return {"Supports/Top/Pressure": reading.factor * pressure, "Body/Initial velocity": (reading.start, 0),
            "Time/End time": reading.end, "Observation/Steady from": reading.steady_from}


def friction(mu, delta):
    return {"Friction/Coefficient": mu, "Friction/Regularization time": delta * 1e-9}


class Cases:
    """Adds runs to a study, each once, with what they need. Every method returns the name of its run.
    Pressures are the printed ones in Pa; delta is in ns."""

    def __init__(self, study, extra=None):
        """extra: {name of the .prm: settings} for all its runs, such as a coarser grid in a test."""
        self.study, self.extra = study, extra or {}

    def _add(self, name, program, file, settings=None):
        if name not in self.study.cases:
            self.study.add(name, program, prm(file), {**(settings or {}), **self.extra.get(file, {})})
        return name

    def rve(self, seed):
        return self._add(f"rve-{seed}", "rve_homogenization", "10-rve_homogenization",
                         {"Microstructure/Random fibres/Seed": seed})

    def _rve_file(self, seed):
        return {"Body/RVE file": f"{{{self.rve(seed)}}}/rve.h5"}

    def modes(self, top="platen", seed=None):
        """Of eq. (10), or of a morphology."""
        settings = {"Supports/Top/Kind": top, "Supports/Top/Held": "u_x" if top == "pressure" else ""}
        if seed is not None:
            settings.update({"Body/Material": "heterogeneous", **self._rve_file(seed)})
        return self._add(f"modes-{top}" + (f"-{seed}" if seed is not None else ""), DYNAMICS,
                         "20-contact_dynamics-modes", settings)

    def friction_law(self, law):
        return self._add(f"friction_law-{law.replace(' ', '_')}", DYNAMICS, "21-contact_dynamics-friction_law",
                         {"Friction/Law": law})

    def homogeneous(self, reading, pressure=P1, delta=1500, mu=0.25):
        if (reading, pressure, delta, mu) == (PUSHED, P1, 1700, 0.25):
            return self.adapted()
        name = f"homogeneous-{reading.name}-{pressure / 1e6:g}MPa-{delta:g}ns" + (f"-mu{mu:g}" if mu != 0.25 else "")
        file = "32-contact_dynamics-homogeneous_regime_2" if (reading, pressure) == (PUSHED, P2) else "30-contact_dynamics-homogeneous"
        return self._add(name, DYNAMICS, file, {**loading(reading, pressure), **friction(mu, delta)})

    def adapted(self):
        """The homogeneous run with 1700 ns whose stresses are localized."""
        return self._add("homogeneous-pushed-0.5MPa-1700ns", DYNAMICS, "31-contact_dynamics-homogeneous_1700ns")

    def heterogeneous(self, reading, pressure=P1, seed=1, by_phase=False):
        """delta = 1500 ns. That of seed 1 which localization reads keeps its snapshots."""
        settings = {**self._rve_file(seed), **loading(reading, pressure)}
        if by_phase:
            settings["Friction/Coefficient from"] = "phases"
        if (reading, pressure, seed, by_phase) != (PUSHED, P1, 1, False):
            settings["Snapshots/Interval"] = 0
        name = f"heterogeneous-{reading.name}-{pressure / 1e6:g}MPa-{seed}" + ("-by_phase" if by_phase else "")
        return self._add(name, DYNAMICS, "40-contact_dynamics-heterogeneous", settings)

    def resolved(self, cells, time_step):
        """Figure 5: other cells and a fixed time step (ns)."""
        return self._add(f"resolved-{cells[0]}x{cells[1]}-{time_step:g}ns", DYNAMICS,
                         "30-contact_dynamics-homogeneous",
                         {"Body/Cells": cells, "Time/Time step": time_step * 1e-9, "Time/End time": 1e-3,
                          "Observation/Steady from": 2.5e-4})

    def coarse(self, velocity, pressure=P1, delta=1500, end=3e-3):
        """The homogeneous pin on cells of 0.2 mm, pushed with a velocity (m/s); the second half counts as steady."""
        return self._add(f"coarse-{pressure / 1e6:g}MPa-{delta:g}ns-{velocity:g}", DYNAMICS,
                         "30-contact_dynamics-homogeneous",
                         {**loading(PUSHED, pressure), **friction(0.25, delta), "Body/Cells": (280, 80),
                          "Body/Initial velocity": (velocity, 0), "Time/End time": end,
                          "Observation/Steady from": end / 2})

    def static_contact(self, seed):
        return self._add(f"static_contact-{seed}", DYNAMICS, "41-contact_dynamics-static_contact",
                         self._rve_file(seed))

    def localization(self):
        return self._add("localization", "stress_localization", "60-stress_localization",
                         {"Input/RVE file": f"{{{self.rve(1)}}}/rve.h5",
                          "Input/Homogeneous run": f"{{{self.adapted()}}}/dynamics.h5",
                          "Input/Direct run": f"{{{self.heterogeneous(PUSHED)}}}/dynamics.h5"})
