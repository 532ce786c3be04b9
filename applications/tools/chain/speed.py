"""How long a run takes on this machine: it is begun, and stopped once its progress tells what remains."""

import os
import re
import subprocess
import threading
import time

PATIENCE = 25.0  # s; the programs tell their progress every ten seconds or tenth of the run
UNITS = {"s": 1.0, "min": 60.0, "h": 3600.0}


def remaining_seconds(line):
    """Of a line of progress, "... remaining 2 min 05 s"; None of another one."""
    found = re.search(r"remaining ((?:[\d.]+ (?:h|min|s) ?)+)", line)
    if not found:
        return None
    words = found[1].split()
    return sum(float(number) * UNITS[unit] for number, unit in zip(words[::2], words[1::2]))


def measure(step, folder, environment):
    """Seconds on one core of a step, which may read drafts, and of which the results go to `folder`: until it ended, or what it has taken
    and what it says that remains. None if it says nothing in time or does not run."""
    begin, said, total = time.monotonic(), None, None
    child = subprocess.Popen([step.program, step.prm, "--try", "--output", os.path.join(folder, step.name)], env=environment, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    limit = threading.Timer(PATIENCE, child.terminate)
    limit.start()
    try:
        for line in child.stdout:
            said = remaining_seconds(line)
            elapsed = time.monotonic() - begin
            # After two seconds the start of the program counts for little.
            if said is not None and elapsed > 2:
                total = elapsed + said
                break
        else:
            total = time.monotonic() - begin if child.wait() == 0 else None
    finally:
        limit.cancel()
        stop(child)
    return total


def stop(child):
    """A second request, some seconds later, ends a program that is busy saving."""
    if child.poll() is None:
        child.terminate()
    try:
        child.communicate(timeout=5)
    except subprocess.TimeoutExpired:
        child.kill()
        child.communicate()
