"""One .prm file of a chain: its program, what it needs, whether its result is up to date."""

import hashlib
import json
import os
import re
import subprocess

from chain.inputs import ChainError, digest_of, input_files, is_unchanged, output_named, state_of, values

PROGRAMS = ("rve_homogenization", "contact_dynamics", "stress_localization")
STAMP, RANKS = ".up_to_date", ".ranks"
RESULTS = (".h5", ".csv", ".xdmf")
LONG_RUN = 3e9  # cells times steps, some seconds: worth the start of several ranks
ROWS_A_RANK = 40


def results_in(folder):
    """What the last run wrote for those after it: {name: [bytes, time in ns, SHA-256]}."""
    names = [n for n in sorted(os.listdir(folder)) if n == "summary.json" or n.endswith(RESULTS)]
    paths = {name: os.path.join(folder, name) for name in names}
    return {name: state_of(path) for name, path in paths.items()}


class Step:
    def __init__(self, name, folder, programs, earlier):
        self.name = name
        self.prm = os.path.join(folder, name + ".prm")
        self.output = os.path.join(folder, name)
        found = [p for p in PROGRAMS if p in name]
        if not found:
            raise ChainError(f"{name}.prm names no program; put one of {', '.join(PROGRAMS)} into the file's name")
        self.program = os.path.join(programs, found[0])
        if not os.path.isfile(self.program):
            raise ChainError(f"there is no program {self.program}; build it, or name the folder of the programs with --programs")
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
        start = ["mpirun", "--quiet", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
        return start + [self.program, self.prm, "--output", self.output] + (["--resume"] if resume else [])

    def ask_to_stop(self):
        with open(os.path.join(self.output, "terminate"), "w", encoding="utf-8"):
            pass

    def ranks_begun_with(self):
        """A run is resumed with as many."""
        try:
            with open(os.path.join(self.output, RANKS), encoding="utf-8") as file:
                return int(file.read())
        except (OSError, ValueError):
            return 1

    def keep_ranks(self, ranks):
        path = os.path.join(self.output, RANKS)
        if ranks > 1:
            os.makedirs(self.output, exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(str(ranks))
        elif os.path.exists(path):
            os.remove(path)

    def useful_ranks(self):
        """How many ranks a long transient contact run is worth; 1 for everything else. KeyboardInterrupt when that ended the question."""
        if not self.program.endswith("contact_dynamics"):
            return 1
        asked = subprocess.run([self.program, "--validate", self.prm], capture_output=True, text=True, check=False)
        if asked.returncode < 0:
            raise KeyboardInterrupt
        cells, steps = re.search(r"(\d+) x (\d+) cells", asked.stdout), re.search(r"(\d+) steps", asked.stdout)
        if not cells or not steps or int(cells[1]) * int(cells[2]) * int(steps[1]) < LONG_RUN:
            return 1
        return max(1, int(cells[2]) // ROWS_A_RANK)
