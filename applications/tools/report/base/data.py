"""Result folders of a chain: what ran, its summary, its HDF5 datasets. Nothing here raises on a
missing or broken file: a dataset that cannot be read is None, and the reason is kept as a note."""

import copy
import json
import os
import re

import h5py
import numpy as np

HDF5_NAMES = {
    "rve_homogenization": "rve.h5",
    "contact_dynamics": "dynamics.h5",
    "stress_localization": "localization.h5",
}
HDF5_OF_ANALYSIS = {"modal": "modal.h5", "complex modes": "complex_modes.h5", "friction homogenization": None, "map": "map.h5"}


def without_folders(found):
    """Texts, also those in lists and dictionaries, in which an absolute path is no more than the names of its folder and file: where the
    results lay is of no use to who reads the page elsewhere."""
    if isinstance(found, dict):
        return {key: without_folders(value) for key, value in found.items()}
    if isinstance(found, list):
        return [without_folders(value) for value in found]
    return re.sub(r"(?<![\w.)\]])/(?:[^\s/'\":;,]+/)+([^\s/'\":;,]+/[^\s/'\":;,]+)", r"\1", found) if isinstance(found, str) else found


def settings(folder):
    """{"Section/key": value} of parameters.prm in the folder of a run; empty where it cannot be read."""
    found, sections = {}, []
    try:
        with open(os.path.join(folder, "parameters.prm"), encoding="utf-8") as file:
            for line in file:
                words = line.strip()
                if words.startswith("subsection "):
                    sections.append(words[11:].strip())
                elif words == "end" and sections:
                    sections.pop()
                elif setting := re.match(r"set\s+([^=]+?)\s*=\s*(.*)", words):
                    found["/".join([*sections, setting[1]])] = setting[2]
    except (OSError, UnicodeDecodeError):
        return {}
    return found


class Missing(Exception):
    """What a section needs is not there; the message says what."""


class Run:
    """One result folder."""

    def __init__(self, folder, summary):
        self.folder = folder
        self.summary = without_folders(summary)
        self.program = summary.get("program", "")
        self.notes = []
        self.title = ""
        self.file = None
        self.name = os.path.basename(os.path.normpath(folder)) or folder
        file_name = HDF5_OF_ANALYSIS.get(summary.get("analysis"), HDF5_NAMES.get(self.program, ""))
        if file_name is not None:
            self._open(os.path.join(folder, file_name))

    def _open(self, path):
        try:
            self.file = h5py.File(path, "r")
        except (OSError, IsADirectoryError) as error:
            reason = "missing" if not os.path.isfile(path) else f"unreadable ({error})"
            self.notes.append(f"{path} is {reason}; its figures are left out")

    def below(self):
        """The counter body of the run, as its file has it; None without one."""
        path = self.file_path("counter_body.h5")
        if not os.path.isfile(path):
            return None
        lower = copy.copy(self)
        lower.name, lower.file = f"the counter body of {self.name}", None
        lower._open(path)
        return lower

    def get(self, dataset, rows=...):
        """Array of a dataset (or of some of its rows), or None."""
        try:
            data = self.file.get(dataset) if self.file is not None else None
            return np.asarray(data[rows]) if isinstance(data, h5py.Dataset) else None
        except (OSError, KeyError, RuntimeError) as error:
            self.notes.append(f"{self.folder}: {dataset} is unreadable ({error})")
        return None

    def last(self, dataset):
        """Last row of a dataset that may be too large to read as a whole, or None."""
        try:
            return self.get(dataset, -1)
        except (IndexError, ValueError):  # there is no row
            return None

    def need(self, *datasets):
        """Arrays of datasets, non-empty; Missing names the first one that is not there."""
        arrays = []
        for dataset in datasets:
            array = self.get(dataset)
            if array is None or array.size == 0:
                raise Missing(f"{dataset} is not in the HDF5 file of {self.name}")
            arrays.append(array)
        return arrays if len(arrays) > 1 else arrays[0]

    def file_path(self, name):
        return os.path.join(self.folder, name)

    def started(self):
        """Number of processes, date and parameter file of the run, as the first line of its log says; empty if it does not."""
        try:
            with open(self.file_path("log.txt"), encoding="utf-8") as log:
                found = re.match(r"\S+ \S+, (\d+ process(?:es)?), (\S+ \S+), (.+) -> ", log.readline())
        except (OSError, UnicodeDecodeError):
            found = None
        return [found[1], found[2], os.path.basename(found[3])] if found else []

    def per_thickness(self):
        """What the units of forces and energies end with: those of plane bodies are per metre of the thickness."""
        return "" if self.summary.get("dim") == 3 else "/m"

    def has_surface(self):
        """Whether its contact is a surface, that of a body in 3D, and known by node."""
        position = self.get("/contact/position", slice(0, 1))
        return position is not None and position.ndim == 2 and position.shape[1] == 3

    def is_solid(self):
        """Whether its mesh or grid is in 3D."""
        point, grid = self.get("/mesh/points", slice(0, 1)), self.grid()
        return point.shape[1] == 3 if point is not None else grid is not None and len(grid[0]) == 3

    def is_mesh_like(self):
        """Whether its cells are shown one by one, as those of a mesh: not those of a plane grid."""
        return bool(self.members("/mesh")) or self.is_solid()

    def members(self, group):
        """Names in a group, empty if there is none."""
        try:
            found = self.file.get(group) if self.file is not None else None
            return list(found.keys()) if isinstance(found, h5py.Group) else []
        except (OSError, KeyError, RuntimeError):
            return []

    def attribute(self, place, name):
        try:
            return np.asarray(self.file[place].attrs[name])
        except (OSError, KeyError, RuntimeError, TypeError):
            return None

    def grid(self):
        """(cells, spacing, origin) of the uniform grid, or None (imported meshes)."""
        values = [self.attribute("/grid", name) for name in ("cells", "spacing", "origin")]
        if values[0] is None or values[1] is None:
            return None
        if values[2] is None:
            values[2] = np.zeros(len(values[0]))
        return [np.atleast_1d(value).astype(float) for value in values]

    def extent(self):
        """Left, right, bottom, top of the grid in mm, for imshow; None without a grid."""
        grid = self.grid()
        if grid is None:
            return None
        cells, spacing, origin = grid
        spacing = np.broadcast_to(spacing, cells.shape)
        upper = origin + cells * spacing
        return [1e3 * origin[0], 1e3 * upper[0], 1e3 * origin[1], 1e3 * upper[1]]

    def number(self, *path):
        """A number of the summary, None where it is absent, null or not finite."""
        value = self.summary
        for key in path:
            value = value.get(key) if isinstance(value, dict) else None
        if isinstance(value, (int, float)) and not isinstance(value, bool) and np.isfinite(value):
            return float(value)
        return None

    def probe_position(self, name):
        position = self.attribute(f"/probes/{name}", "position")
        if position is None or position.size < 2 or not np.all(np.isfinite(position)):
            return None
        return position.ravel()

    def reference_probe(self):
        """Name of the probe at the middle of the contact line, or of the nearest one."""
        extent = self.extent()
        placed = [(name, self.probe_position(name)) for name in self.members("/probes")]
        placed = [(name, place) for name, place in placed if place is not None]
        if not placed or extent is None:
            return None
        middle = 1e-3 * np.array([0.5 * (extent[0] + extent[1]), extent[2]])
        return min(placed, key=lambda item: float(np.hypot(*(item[1][:2] - middle))))[0]

    def motion_of_flat(self):
        """Direction along x and y in which the flat moves; None where it is not known or changes."""
        speed, course = self.attribute("/run", "velocity"), self.attribute("/run", "velocity_history")
        if speed is None or not speed or course is None or course.astype(str) not in ("step", "linear", "smooth"):
            return None
        parts = [self.attribute("/run", f"flat_direction_{axis}") for axis in "xy"]
        return np.sign(speed) * np.array([1.0, 0.0] if any(part is None for part in parts) else parts, dtype=float)

    def steady_from(self):
        """s; the summary's, or half of the history."""
        value = self.number("steady_from")
        if value is None:
            time = self.get("/history/time")
            value = 0.5 * float(time[-1]) if time is not None and time.size else 0.0
        return value

    def steady_length(self):
        """s; of the steady part, None where it is not known."""
        time = self.get("/history/time")
        end = self.number("simulated_time") or (float(time[-1]) if time is not None and time.size else None)
        return end - self.steady_from() if end else None


def leading_number(name):
    found = re.match(r"\d+", name)
    return int(found[0]) if found else 0


class Chain:
    """All runs of a report, by kind."""

    def __init__(self, folders):
        self.notes = []
        self.runs = []
        for folder in folders:
            self._add(folder)
        for run in self.runs:
            phases = run.get("/material/phase_id")
            run.heterogeneous = phases is not None and phases.min() < phases.max()
            run.kind = run.program
            if run.program == "contact_dynamics":
                run.kind = "heterogeneous" if run.heterogeneous else "homogeneous"
        # By the number that a name begins with, as in a chain, else by program; sorting keeps the caller's order among equals.
        self.runs.sort(key=lambda run: (leading_number(run.name), list(HDF5_NAMES).index(run.program), run.heterogeneous))
        pick = lambda program: [run for run in self.runs if run.program == program]
        self.rve = pick("rve_homogenization")
        self.dynamics = pick("contact_dynamics")
        self.localization = pick("stress_localization")
        self.transient = [run for run in self.dynamics if run.members("/history")]
        self.modal = [run for run in self.dynamics if run.members("/modes") or run.summary.get("frequencies")]
        self.complex = [run for run in self.dynamics if isinstance(run.summary.get("complex_modes"), list)]
        self.static = [run for run in self.dynamics
                       if run.members("/static_contact") or run.summary.get("phase_contact_pressures")]
        self.maps = [run for run in self.dynamics if run.summary.get("analysis") == "map"]
        self.friction_law = [run for run in self.dynamics if run.summary.get("estimates")]
        kinds = [run.kind for run in self.transient]
        for run in self.runs:
            same = kinds.count(getattr(run, "kind", "")) > 1 or run not in self.transient
            run.label = run.name if same else run.kind
            run.title = run.label if len(self.dynamics) > 1 else ""  # in pictures of this run alone

    def _add(self, folder):
        """A result folder, or a folder of result folders (one level down)."""
        if not os.path.isdir(folder):
            self.notes.append(f"{folder} is not a folder")
            return
        if os.path.isfile(os.path.join(folder, "summary.json")):
            self._open(folder)
            return
        inside = [folder] + [os.path.join(folder, name) for name in sorted(os.listdir(folder))]
        holds = lambda path, name: os.path.isfile(os.path.join(path, name))
        complete = [path for path in inside if holds(path, "summary.json")]
        failed = [path for path in inside if holds(path, "log.txt") and path not in complete]
        self.notes += [f"{path}: its run has not ended or has failed, see log.txt there; what else is there is left out" for path in failed]
        if not complete and not failed:
            self.notes.append(f"{folder} holds no summary.json")
        for path in complete:
            self._open(path)

    def _open(self, folder):
        path = os.path.join(folder, "summary.json")
        try:
            with open(path, encoding="utf-8") as stream:
                summary = json.load(stream)
            if not isinstance(summary, dict):
                raise ValueError("not a JSON object")
        except (OSError, ValueError) as error:
            self.notes.append(f"{path} is unreadable ({error})")
            return
        if summary.get("program") not in HDF5_NAMES:
            self.notes.append(f'{path}: program "{summary.get("program")}" is not of this project')
            return
        if summary.get("draft"):
            self.notes.append(f"{folder} was made with --try from drafts, in which nothing was computed; it is left out")
            return
        self.runs.append(Run(folder, summary))

    def all_notes(self):
        return [without_folders(note) for note in self.notes + [note for run in self.runs for note in run.notes]]


def thinned(x, y, points=3000):
    """x and y with at most about `points` points, keeping minimum and maximum of every stretch."""
    n = min(len(x), len(y))
    if n <= points:
        return x[:n], y[:n]
    stretch = int(np.ceil(2 * n / points))
    whole = n // stretch
    block = np.asarray(y[: whole * stretch]).reshape(whole, stretch)
    block = np.nan_to_num(block, nan=0.0)
    picks = np.sort(np.stack([block.argmin(axis=1), block.argmax(axis=1)], axis=1), axis=1)
    index = (picks + stretch * np.arange(whole)[:, None]).ravel()
    return x[index], y[index]
