"""How many processes a run is worth on this machine, as it is at the moment, and with how many one was begun."""

import os
import re
import time

KEPT = ".ranks"  # in the folder of the results


def idle_cores(seconds=0.2):
    """Number of the cores that this process may use on which nothing has run for so long; all where the system does not tell."""
    allowed = os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else set(range(os.cpu_count() or 1))
    before = _ticks()
    time.sleep(seconds)
    after = _ticks()
    if not before:
        return len(allowed)
    shares = {core: _idle_share(before[core], after[core]) for core in allowed if core in before and core in after}
    return sum(share > 0.8 for share in shares.values())


def _idle_share(before, after):
    spent = [b - a for a, b in zip(before, after)]
    return (spent[3] + spent[4]) / max(sum(spent), 1)  # idle, and waiting for a disk


def _ticks():
    """Of each core by its number: user, nice, system, idle, waiting for input, interrupts (two kinds), stolen by other machines."""
    try:
        with open("/proc/stat", encoding="ascii") as file:
            return {int(name): [int(n) for n in numbers.split()[:8]] for name, numbers in re.findall(r"^cpu(\d+) (.*)$", file.read(), re.MULTILINE)}
    except OSError:
        return {}


def ranks_worth(said, most, idle=idle_cores):
    """At most `most` ranks for a run of which `--validate` said that: those that are of use, on cores that are idle. A rank on a core that
    does anything else makes all others wait for it: then one is faster."""
    useful = re.search(r"^up to (\d+) ranks", said, re.MULTILINE)
    useful = min(int(useful[1]) if useful else 1, most)
    return max(1, min(useful, idle())) if useful > 1 else 1


def start_of(ranks):
    """The words before a program that start it on so many ranks. Where others work beside them, ranks may change their cores. The variable
    keeps mpirun of Open MPI 4 silent when they fail; its option --quiet is unknown to Open MPI 5."""
    if ranks == 1:
        return []
    unbound = ["--bind-to", "none"] if ranks < (os.cpu_count() or 1) else []
    return ["env", "OMPI_MCA_orte_execute_quiet=1", "mpirun", "--oversubscribe", *unbound, "-np", str(ranks)]


def ranks_begun_with(output):
    """Of the run in a folder: it is resumed with as many."""
    try:
        with open(os.path.join(output, KEPT), encoding="utf-8") as file:
            return int(file.read())
    except (OSError, ValueError):
        return 1


def keep_ranks(output, ranks):
    """For ranks_begun_with()."""
    path = os.path.join(output, KEPT)
    if ranks > 1:
        os.makedirs(output, exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(str(ranks))
    elif os.path.exists(path):
        os.remove(path)
