"""Runs that are stopped or killed and resumed end as if nothing had happened, bit by bit.

    resume.py <folder with the programs> [--long] [--kills N] [--seed N] [--only PART]

--long kills 100 times instead of 20, and stops a homogeneous body on two ranks, too.
"""

import argparse
import concurrent.futures
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

from comparison import Comparison
from scenes import ENVIRONMENT, PROGRAMS, TOOLS, Folder, prm, rve, sets

RUN_CHAIN = os.path.join(TOOLS, "run_chain.py")
CHECKPOINT = "contact_dynamics.checkpoint"
# What tells of a process and not of the body: log, checkpoint, and of the summary what the clock says.
SKIPPED = rf"log\.txt|\.lock|{re.escape(CHECKPOINT)}", r"summary\.json:(seconds(/|$)|peak_memory_bytes$|cell_updates_per_second$)", "$^"

RVE = rve("60, 24", "0.006, 0.0024", 2e-4, 6e-4, **{"Microstructure/Random fibres/Cut by border": "true"})
# Everything that has a state: histories, energy, probes, snapshots, blocks, a platen that is held.
CONTACT = prm({
    "Body/RVE file": "rve/rve.h5", "Time/End time": 5.003e-4, "Time/Time step": 5e-9, "Supports/Top/Hold from": 3e-4, "Supports/Top/Platen mass": 0.02,
    "Friction/Law": "slip rate", "Friction/Coefficient law": "exponential slip weakening", "Friction/Coefficient": 0.4,
    "Friction/Normal stress": "constant time", "Observation/Energy interval": 30, "Observation/Probes": "contact, bulk",
    "Observation/contact/Position": "0.00305, 0.00005", "Observation/bulk/Position": "0.00305, 0.00125", "Snapshots/Interval": 6.6e-6,
    "Checkpoints/Interval": 1e-5})


# Several runs go side by side here: ranks that wait leave the processor to others.
PATIENT = dict(ENVIRONMENT, OMPI_MCA_mpi_yield_when_idle="1")


class Scene(Folder):
    """A folder with the files of a run, and how to start it."""

    def start(self, output, options=(), ranks=1, program="contact_dynamics", prm="contact.prm"):
        return super().start(program, prm, "--output", output, "--quiet", *options, ranks=ranks, env=PATIENT)

    def expect(self, status, words, output, options=(), **keywords):
        if status == 2 and not keywords:  # soon over
            found, *texts = Folder(self.path).end("contact_dynamics", "contact.prm", "--output", output, "--quiet", *options)
        else:
            child = self.start(output, options, **keywords)
            texts, found = child.communicate(), child.returncode
        text = "".join(texts)
        assert found == status, f"{output} {options}: exit status {found} instead of {status}: {text}"
        for word in words:
            assert word in text, f"{output} {options}: '{word}' is missing in: {text}"

    def wait_for_checkpoint(self, output, child, after=None):
        """Until there is a checkpoint other than `after` (or the run has ended); returns what tells it apart."""
        path = self(output, CHECKPOINT)
        while child.poll() is None:
            found = identity(path)
            if found not in (None, after):
                return found
            time.sleep(0.002)
        return None

    def log(self, output):
        return self.read(output, "log.txt").decode()


def identity(path):
    try:
        status = os.stat(path)
        return status.st_ino, status.st_mtime_ns, status.st_size
    except OSError:
        return None


def options_of(material):
    return ["--set", f"Body/Material={material}"]


def expect_same(scene, reference, output, but="$^"):
    same = Comparison(f"{SKIPPED[0]}|{but}", *SKIPPED[1:])
    wrong = same.differences(scene(reference), scene(output))
    assert not wrong and same.n_compared > 100, f"{output} is not like {reference}:\n" + "\n".join(wrong)


def stop(scene, output, options, ranks, by_signal=False):
    """Stops a run once it has written a checkpoint; False if it came to its end before, which a busy machine makes possible."""
    child = scene.start(output, options, ranks=ranks)
    scene.wait_for_checkpoint(output, child, identity(scene(output, CHECKPOINT)))
    if by_signal:
        child.send_signal(signal.SIGTERM)
    else:
        scene.write(output + "/terminate", "")
    _, text = child.communicate()
    assert child.returncode == 0 or (child.returncode == 130 and "--resume" in text), f"{output}: {child.returncode}, {text}"
    return child.returncode == 130


def expect_first_part(scene, output, whole):
    """A stopped run does not look complete and holds the first samples of the whole run."""
    assert not os.path.exists(scene(output, "summary.json")), f"{output} looks complete"
    with h5py.File(scene(output, "dynamics.h5"), "r") as part, h5py.File(scene(whole, "dynamics.h5"), "r") as all_samples:
        for key in ("history/top_displacement", "energy/kinetic", "probes/bulk/stress", "snapshots/displacement"):
            n = len(part[key])
            assert 0 < n < len(all_samples[key]) and np.array_equal(part[key][...], all_samples[key][:n]), f"{output}: {key}"


def stopped_twice(scene, output, whole, options, ranks):
    """By a file, then by a signal (with several ranks by a file again: mpirun passes signals on when it finds the time)."""
    if not stop(scene, output, options, ranks):
        return False
    expect_first_part(scene, output, whole)
    return stop(scene, output, options + ["--resume", "--set", "Performance/Temporal blocking=3"], ranks, by_signal=ranks == 1)


def stopped_and_resumed(scene, material, ranks, attempts=10):
    """What is resumed may have other steps in flight."""
    name = f"{material}-{ranks}"
    options = options_of(material)
    scene.expect(0, [], name, options, ranks=ranks)

    output = name + "-stopped"
    while not stopped_twice(scene, output, name, options, ranks):
        attempts -= 1
        assert attempts > 0, f"{output}: ended each time before it was stopped"
        shutil.rmtree(scene(output))
    scene.expect(0, [], output, options + ["--resume", "--set", "Performance/Temporal blocking=2"], ranks=ranks)
    assert scene.log(output).count("Resumed at step") == 2, scene.log(output)
    expect_same(scene, name, output, but=r"parameters\.prm")


def ranks_of(child):
    """Processes that mpirun started."""
    with open(f"/proc/{child.pid}/task/{child.pid}/children", encoding="utf-8") as file:
        return [int(word) for word in file.read().split()]


def kill_again_and_again(scene, material, lane, kills, seed, ranks=1):
    """Kills a run at random moments and resumes it; whenever it comes to its end, compares and begins anew."""
    chance = random.Random(seed * 1000 + lane)
    output, reference = f"{material}-{ranks}-killed-{lane}", f"{material}-{ranks}"
    options, done, finished, resumed = options_of(material), 0, 0, 0
    begin = time.monotonic()
    while done < kills or finished == 0 or os.path.exists(scene(output)):
        folder = os.path.exists(scene(output))
        child = scene.start(output, options + (["--resume"] if folder else []), ranks=ranks)
        if done < kills:
            # In turns soon after the start and soon after a checkpoint, so that it goes on.
            if done % 2 == 0:
                time.sleep(chance.uniform(0, 0.6))
            else:
                scene.wait_for_checkpoint(output, child, identity(scene(output, CHECKPOINT)))
                time.sleep(chance.uniform(0, 0.05))
            if child.poll() is None:
                for pid in ranks_of(child)[:1] if ranks > 1 else [child.pid]:
                    os.kill(pid, signal.SIGKILL)
                done += 1
        text = "".join(child.communicate())
        if child.returncode == 0:
            expect_same(scene, reference, output)
            resumed += scene.log(output).count("Resumed at step")
            shutil.rmtree(scene(output))
            finished += 1
        elif "killed while it wrote the file" in text:  # in the last millisecond, which is rare
            shutil.rmtree(scene(output))
        else:
            # mpirun ends with 128 + 9 and says so, but what it prints may stop before it names the signal.
            killed = child.returncode == -9 or (ranks > 1 and (child.returncode == 137 or "signal 9" in text))
            assert killed, f"{output}: {child.returncode}, {text}"
    assert resumed > 0, f"{output}: never resumed"
    return f"{output}: {done} kills, {finished} times to the end, {time.monotonic() - begin:.1f} s"


def refusals(scene):
    """What cannot be continued is refused with both values and left as it was."""
    options = options_of("homogeneous")
    child = scene.start("r", options)
    scene.wait_for_checkpoint("r", child)
    child.send_signal(signal.SIGSTOP)
    # The folder is in use.
    scene.expect(2, ["in use by a run that has not ended", str(child.pid)], "r", options)
    scene.expect(2, ["in use"], "r", options + ["--resume"])
    child.kill()
    child.communicate()
    good = scene.read("r", CHECKPOINT)
    os.remove(scene("r", ".lock"))  # a killed run's, which the next one clears away
    before = sorted(os.listdir(scene("r")))

    resume = options + ["--resume"]
    refused = [
        (["Friction/Coefficient is 0.3 instead of 0.4", "start again without --resume"], ["Friction/Coefficient=0.3"]),
        (["Body/Material is heterogeneous instead of homogeneous"], ["Body/Material=heterogeneous"]),
        (["Observation/Blocks is 7 instead of 200", "Observation/bulk/Position is 0, 0 instead of"],
         ["Observation/bulk/Position=0, 0", "Observation/Blocks=7"]),
        (["End time lies before the checkpoint"], ["Time/End time=1e-8"])]
    if not scene.summary("homogeneous-1")["kernel"].startswith("x86-64 "):
        refused.append((["Performance/Instruction set is x86-64 instead of x86-64-v"], ["Performance/Instruction set=x86-64"]))
    for words, settings in refused:
        scene.expect(2, words, "r", ["--resume", *sets({"Body/Material": "homogeneous", **dict(x.split("=") for x in settings)})])
    scene.expect(2, ["Number of MPI ranks is 2 instead of 1"], "r", resume, ranks=2)
    scene.expect(2, ["nothing to resume", "does not exist"], "nowhere", resume)
    for spoilt, word in ((good[:-3], "truncated"), (good[:200] + b"x" + good[201:], "CRC-32"),
                         (b"\x89HDF" + good[4:], "not a checkpoint"), (good, "")):
        with open(scene("r", CHECKPOINT), "wb") as file:
            file.write(spoilt)
        if word:
            scene.expect(2, [CHECKPOINT, word], "r", resume)
    part = scene("r", "dynamics.h5.part")
    os.rename(part, scene("elsewhere"))
    scene.expect(2, ["there is no file", "dynamics.h5", "start again without --resume"], "r", resume)
    os.rename(scene("elsewhere"), part)
    after = sorted(os.listdir(scene("r")))
    assert after == before, f"a refusal changed the folder: {set(after) ^ set(before)}"

    # What only says how and how often is free to change.
    free = ["--set", "Checkpoints/Interval=0", "--set", "Performance/Temporal blocking=1", "--set", "Performance/Instruction set=auto"]
    scene.expect(0, [], "r", resume + free)
    # Complete: says so and does nothing, unless something else is asked for.
    times = {name: identity(scene("r", name)) for name in os.listdir(scene("r")) if name != "log.txt"}
    scene.expect(0, [], "r", resume)
    assert "is complete: there is nothing to resume" in scene.log("r")
    assert times == {name: identity(scene("r", name)) for name in times}, "a complete run was touched"
    assert not os.path.exists(part), "dynamics.h5.part of a complete run is left"
    scene.expect(2, ["Beta2 is 0.6 instead of 0.5"], "r", resume + ["--set", "Time/Beta2=0.6"])
    scene.expect(2, ["was complete at", "Checkpoints/Keep"], "r", resume + ["--set", "Time/End time=1.2e-3"])


def edited(scene):
    """An RVE file or results that were edited meanwhile are not gone on with."""
    shutil.copytree(scene("rve"), scene("rve-edited"))
    options = ["--set", "Body/RVE file=rve-edited/rve.h5"]
    assert stop(scene, "edited", options, ranks=1), "ended before it was stopped"
    for path, dataset, words in (("rve-edited/rve.h5", "stiffness/effective", ["Content of Body/RVE file is"]),
                                 ("edited/dynamics.h5", "history/top_displacement", ["dynamics.h5 has changed since it was written"])):
        good = scene.read(*path.split("/"))
        with h5py.File(scene(*path.split("/")), "r+") as file:
            file[dataset][...] = 0.5 * file[dataset][...]
        scene.expect(2, words, "edited", options + ["--resume"])
        with open(scene(*path.split("/")), "wb") as file:
            file.write(good)
    scene.expect(0, [], "edited", options + ["--resume"])


def later_end(scene):
    """With Keep, a complete run goes on to a later end; its blocks keep their length."""
    short = ["--set", "Time/End time=1.0e-4", "--set", "Snapshots/Interval=7e-7", "--set", "Observation/Blocks=40"]
    whole = ["--set", "Time/End time=2.0e-4", "--set", "Snapshots/Interval=7e-7", "--set", "Observation/Blocks=80"]
    keep = ["--set", "Checkpoints/Keep=true"]
    scene.expect(0, [], "long", whole)
    scene.expect(0, [], "extended", short + keep)
    scene.expect(0, [], "extended", short[2:] + ["--set", "Time/End time=2.0e-4", "--resume"])
    # The number of blocks is a key of its own and differs; the snapshots, their times and all else are the same.
    expect_same(scene, "long", "extended", but=r"parameters\.prm")


def other_programs(scene):
    """They keep no checkpoints and start from the beginning."""
    scene.expect(0, [], "rve-again", ["--resume"], program="rve_homogenization", prm="rve.prm")
    assert "starts from the beginning" in scene.log("rve-again")
    scene.write("modal.prm", prm({"Analysis": "modal", "Body/RVE file": "rve/rve.h5"}))
    scene.expect(0, [], "modal", ["--resume"], prm="modal.prm")


# The last run of a chain takes several ranks if it is long and cores are idle; here it always does.
ON_RANKS = "import run_chain; from chain import runner; runner.ranks_worth = lambda said, most: most; run_chain.main()"


def chain(scene, ranks):
    """Ctrl-C during ./run.sh, then ./run.sh --resume: runs that had not begun start, stopped ones go on."""
    source, output = scene(f"chain-in-{ranks}"), f"chain-{ranks}"
    Folder(source, {"10-rve_homogenization": RVE, "20-contact_dynamics": CONTACT.replace("rve/rve.h5", "10-rve_homogenization/rve.h5")})
    start = [RUN_CHAIN] if ranks == 1 else ["-c", ON_RANKS]
    command = [sys.executable, "-B", *start, source, "--programs", PROGRAMS, "--output", scene(output),
               "--no-report", "--resume", "--jobs", str(ranks)]
    call = {"text": True, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT,
            "env": dict(ENVIRONMENT, PYTHONPATH=os.path.dirname(RUN_CHAIN))}
    child = subprocess.Popen(command, **call)
    scene.wait_for_checkpoint(f"{output}/20-contact_dynamics", child)
    child.send_signal(signal.SIGINT)
    text, _ = child.communicate()
    assert child.returncode == 130 and "--resume" in text, f"chain: {child.returncode}, {text}"
    done = subprocess.run(command, check=False, **call)
    assert done.returncode == 0 and "10-rve_homogenization: up to date" in done.stdout, done.stdout
    log = scene.log(f"{output}/20-contact_dynamics")
    assert "Resumed at step" in log and (f"{ranks} processes" in log) == (ranks > 1), log + done.stdout


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs")
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--kills", type=int)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6))
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    kills = arguments.kills if arguments.kills is not None else 100 if arguments.long else 20
    print(f"seed {arguments.seed}", flush=True)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(4) as pool:
        scene = Scene(folder, {"rve": RVE, "contact": CONTACT})
        scene.expect(0, [], "rve", program="rve_homogenization", prm="rve.prm")
        materials = ("homogeneous", "heterogeneous")
        parts = [(stopped_and_resumed, scene, m, r) for r in (2, 1) for m in materials if arguments.long or (m, r) != ("homogeneous", 2)]
        parts += [(refusals, scene), (edited, scene), (later_end, scene), (other_programs, scene), (chain, scene, 1), (chain, scene, 2)]
        if kills > 0:
            lanes = 4
            each = -(-kills // lanes)
            parts += [(kill_again_and_again, scene, materials[k % 2], k, each, arguments.seed) for k in range(lanes)]
            parts += [(kill_again_and_again, scene, "heterogeneous", lanes, -(-kills // 10), arguments.seed, 2)]
        failures = []
        first = [p for p in parts if p[0] is stopped_and_resumed]
        for batch in (first, [p for p in parts if p not in first]):
            running = [pool.submit(*p) for p in batch if arguments.only in p[0].__name__ or p in first]
            for future in running:
                try:
                    print(future.result() or "", flush=True)
                except AssertionError as error:
                    failures.append(str(error))
            assert not failures, "\n".join(failures)


if __name__ == "__main__":
    main()
