"""One .prm file of a chain: its program, what it needs, whether its result is up to date."""

import hashlib
import json
import os

from chain.inputs import ChainError, digest_of, input_files, is_unchanged, output_named, state_of, values
from program_choice import PROGRAMS
from ranks import start_of

STAMP = ".up_to_date"
RESULTS = (".h5", ".csv", ".xdmf")


def results_in(folder):
    """What the last run wrote for those after it: {name: [bytes, time in ns, SHA-256]}."""
    names = [n for n in sorted(os.listdir(folder)) if n == "summary.json" or n.endswith(RESULTS)]
    paths = {name: os.path.join(folder, name) for name in names}
    return {name: state_of(path) for name, path in paths.items()}


def program_path(name, programs):
    """Raises ChainError."""
    path = os.path.join(programs, name)
    if not os.path.isfile(path):
        raise ChainError(f"there is no program {path}; build it, or name the folder of the programs with --programs")
    return path


class Step:
    def __init__(self, name, folder, programs, earlier):
        self.name = name
        self.prm = os.path.join(folder, name + ".prm")
        self.output = os.path.join(folder, name)
        found = [p for p in PROGRAMS if p in name]
        if not found:
            raise ChainError(f"{name}.prm names no program; put one of {', '.join(PROGRAMS)} into the file's name")
        self.program = program_path(found[0], programs)
        names = [step.name for step in earlier]
        used = {output_named(value, folder, names) for value in values(self.prm)}
        self.needs = [step for step in earlier if step.name in used]
        self.stamp = self._digest([self.prm, self.program, *(os.path.join(folder, f) for f in input_files(self.prm, [name, *names]))])

    def _digest(self, files):
        """Of all that decides the result."""
        digest = hashlib.sha256()
        for path in files:
            digest.update(digest_of(path).encode())
        for step in self.needs:
            digest.update(step.stamp.encode())
        return digest.hexdigest()

    def up_to_date(self):
        """Made from the same, and all results are there as the run left them."""
        try:
            with open(os.path.join(self.output, STAMP), encoding="utf-8") as file:
                stamp = json.load(file)
            return stamp["made_from"] == self.stamp and "summary.json" in stamp["results"] and all(
                is_unchanged(os.path.join(self.output, name), *known) for name, known in stamp["results"].items())
        except (OSError, ValueError, KeyError, TypeError):  # no stamp, a result that is gone, or a stamp of an earlier version
            return False

    def mark_done(self):
        with open(os.path.join(self.output, STAMP), "w", encoding="utf-8") as file:
            json.dump({"made_from": self.stamp, "results": results_in(self.output)}, file)

    def begun(self):
        """What is complete and yet not up to date was asked for differently: it starts anew."""
        return os.path.isdir(self.output) and not os.path.exists(os.path.join(self.output, "summary.json"))

    def hangs_on(self, other):
        return any(need is other or need.hangs_on(other) for need in self.needs)

    def command(self, ranks, resume):
        return start_of(ranks) + [self.program, self.prm, "--output", self.output] + (["--resume"] if resume else [])

    def ask_to_stop(self):
        with open(os.path.join(self.output, "terminate"), "w", encoding="utf-8"):
            pass
