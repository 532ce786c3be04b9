"""What makes a chain run again, what it refuses, and how it stops, with programs that only say when they are started."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from scenes import TOOLS, Folder

# Says that it was started, asked for its size or interrupted. Waits where "slow" or "ask" is in the .prm, and as the
# programs do it ends at the second Ctrl-C; the SIGTERM that the chain passes on with each is no other one.
PROGRAM = """#!/usr/bin/python3
import itertools, os, signal, sys, time
prm = next(word for word in sys.argv if word.endswith(".prm"))
name, folder, text = os.path.basename(prm), os.path.dirname(sys.argv[0]), open(prm).read()
asked, turns = "--validate" in sys.argv or "--print-parameters" in sys.argv, itertools.count()

def say(what):
    with open(os.path.join(folder, "started.txt"), "a") as file:
        file.write(what + " " + name + chr(10))

def interrupted(*_):
    if next(turns):
        os._exit(130)
    say("interrupt")

if not asked:
    signal.signal(signal.SIGINT, interrupted)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
say("ask" if asked else "run")
if "crash" in text:
    os.abort()
if "typo" in text:
    print("program: there is no key in " + prm, file=sys.stderr, flush=True)
    os._exit(2)
while "slow" in text and not asked or "ask" in text and asked:
    time.sleep(0.05)
if not asked:
    output = sys.argv[sys.argv.index("--output") + 1]
    os.makedirs(output, exist_ok=True)
    open(os.path.join(output, "summary.json"), "w").write("{}")
    open(os.path.join(output, "rve.h5"), "w").write("made")
"""


class Chain(Folder):
    """A folder of .prm files and what happens to it."""

    def __init__(self, path):
        super().__init__(path)
        self.programs, self.source, self.target = self("programs"), self("in"), self("out")
        for name in ("rve_homogenization", "contact_dynamics"):
            self.write("programs/" + name, PROGRAM)
            os.chmod(self("programs", name), 0o755)

    def command(self, *options):
        return [sys.executable, os.path.join(TOOLS, "run_chain.py"), self.source, "--output", self.target,
                "--programs", self.programs, "--no-report", *options]

    def run(self, *options):
        return subprocess.run(self.command(*options), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)

    def ran(self, *options):
        """Names of the steps that were not up to date."""
        done = self.run(*options)
        assert done.returncode == 0, done.stdout
        return [line.split(":")[0] for line in done.stdout.splitlines() if ": done in" in line]

    def started(self):
        """What the programs have said, in the order of time."""
        return self.read("programs", "started.txt").decode().splitlines() if os.path.exists(self("programs", "started.txt")) else []

    def refused(self, words, *options):
        """One sentence with these words, exit status 2, and no run was started."""
        before = [line for line in self.started() if line.startswith("run")]
        done = self.run(*options)
        assert done.returncode == 2 and len(done.stdout.splitlines()) == 1 and words in done.stdout, f"{words}: {done.returncode}, {done.stdout}"
        assert [line for line in self.started() if line.startswith("run")] == before, "a run was started"
        return done.stdout


def named_files(chain):
    """A file that a .prm names decides, whatever it is called and wherever it lies; others do not."""
    elsewhere = chain("elsewhere", "map.PNG")
    pictures = {"10-rve_homogenization-a": "in/G.PNG", "11-rve_homogenization-b": "in/maps/fine/p.dat", "12-rve_homogenization-c": elsewhere}
    for name, path in pictures.items():
        chain.write(path, "0")
        value = path if os.path.isabs(path) else path[3:]
        chain.write(f"in/{name}.prm", f"set File = {value}   # a picture\r\n")
    chain.write("in/20-contact_dynamics.prm", "  SET RVE file = \\\n ./10-rve_homogenization-a/rve.h5 # first\n")
    chain.write("in/30-contact_dynamics-law.prm", "set Heterogeneous run = 20-contact_dynamics \nset Other = 1, 2\ninclude more/load.inc # of both\n")
    chain.write("in/more/load.inc", "set Table = table.csv\ninclude load.inc\n")
    chain.write("in/more/table.csv", "0")
    chain.write("in/notes.txt", "1")
    assert len(chain.ran()) == 5
    assert chain.ran() == []
    chain.write("in/notes.txt", "2")
    assert chain.ran() == []
    for name, path in pictures.items():
        chain.write(path, "1")
        expected = {name} | ({"20-contact_dynamics", "30-contact_dynamics-law"} if name.endswith("a") else set())
        ran = chain.ran("--jobs", "3")
        assert set(ran) == expected, f"{path} was changed and {ran} ran"
    for path in ("in/more/load.inc", "in/more/table.csv"):
        chain.write(path, chain.read(path).decode() + "# changed\n")
        assert chain.ran() == ["30-contact_dynamics-law"], path
    assert chain.started().index("run 20-contact_dynamics.prm") < chain.started().index("run 30-contact_dynamics-law.prm")


def results_that_are_gone(chain):
    """A result that is missing or changed is made again, and only that; a copy with another time is as good."""
    chain.write("in/10-rve_homogenization.prm", "")
    chain.write("in/20-contact_dynamics.prm", "set RVE file = 10-rve_homogenization/rve.h5\n")
    assert len(chain.ran()) == 2
    path = os.path.join(chain.target, "10-rve_homogenization", "rve.h5")
    os.remove(path)
    assert chain.ran() == ["10-rve_homogenization"]
    chain.write(path, "mode")
    assert chain.ran() == ["10-rve_homogenization"], "a changed result counts as up to date"
    os.utime(path, (1, 1))
    assert chain.ran() == []
    chain.write("out/10-rve_homogenization/.up_to_date", "0" * 64)
    assert chain.ran() == ["10-rve_homogenization"], "an earlier version's stamp"


def refusals(chain):
    chain.write("in/10-rve_homogenization.prm", "set File = ../outside.png\n")
    cases = [("what lies outside", "../outside.png", {"outside.png": ""}, ())]
    cases += [("a file as output", "a-file", {"a-file": ""}, ("--output", os.path.join(chain.path, "a-file")))]
    cases += [("no place for output", "/proc/mesoslip cannot be written", {"in/10-rve_homogenization.prm": ""}, ("--output", "/proc/mesoslip"))]
    cases += [("no programs", "--programs", {}, ("--programs", chain.path))]
    cases += [("no jobs", "--jobs", {}, ("--jobs", "0"))]
    for what, words, files, options in cases:
        for name, text in files.items():
            chain.write(name, text)
        if what == "a file as output":
            chain.write("in/10-rve_homogenization.prm", "")
        done = chain.run(*options)
        assert done.returncode == 2 and len(done.stdout.splitlines()) == 1 and words in done.stdout, f"{what}: {done.returncode}, {done.stdout}"


def only_named_files(chain):
    """What no .prm names is not copied; all of a folder of pictures or of a pattern is."""
    chain.write("in/10-rve_homogenization.prm", "set File = slices\nset Output folder = old\n")
    chain.write("in/11-rve_homogenization.prm", "set File = more/s*.tif\n")
    for name in ("slices/1.tif", "slices/2.tif", "more/s1.tif", "more/s2.tif", "more/other.tif", "big.bin", "old/rve.h5"):
        chain.write("in/" + name, "x")
    assert len(chain.ran()) == 2
    copied = {os.path.relpath(os.path.join(folder, name), chain.target) for folder, _, names in os.walk(chain.target) for name in names}
    assert {"slices/1.tif", "slices/2.tif", "more/s1.tif", "more/s2.tif"} <= copied
    assert not {"more/other.tif", "big.bin", "old/rve.h5"} & copied, copied
    chain.write("in/slices/2.tif", "y")
    assert chain.ran() == ["10-rve_homogenization"]


def equal_names(chain):
    """The results of another folder, and what somebody has changed among the results, are not overwritten."""
    chain.write("in/10-rve_homogenization.prm", "set Title = a\n")
    chain.write("other/10-rve_homogenization.prm", "set Title = b\n")
    assert len(chain.ran()) == 1
    first, chain.source = chain.source, chain("other")
    assert "holds the results of" in chain.refused(os.path.realpath(first))
    assert chain.read("out", "10-rve_homogenization.prm") == b"set Title = a\n"
    chain.source = chain("moved")  # not refused: the folder itself, under another name
    os.rename(first, chain.source)
    chain.write("moved/10-rve_homogenization.prm", "set Title = c\n")
    assert len(chain.ran()) == 1 and chain.read("out", "10-rve_homogenization.prm") == b"set Title = c\n"
    chain.write("out/10-rve_homogenization.prm", "set Title = mine\n")
    chain.refused("is not as it was copied from")
    assert chain.read("out", "10-rve_homogenization.prm") == b"set Title = mine\n"
    chain.write("moved/10-rve_homogenization.prm", "set Title = mine\n")
    assert len(chain.ran()) == 1, "what was taken over into the source is no difference"


def checked_before(chain):
    """What is wrong in the last file stops the chain before the first has run, and --validate tells all that is wrong."""
    chain.write("in/10-rve_homogenization.prm", "")
    chain.write("in/20-contact_dynamics.prm", "set RVE file = 10-rve_homogenization/rve.h5\n")
    chain.write("in/30-contact_dynamics-x.prm", "set Run = 20-contact_dynamics/dynamics.h5\nset Title = typo\n")
    assert "30-contact_dynamics-x: there is no key in 30-contact_dynamics-x.prm" in chain.refused("run.sh: ")
    chain.write("in/20-contact_dynamics.prm", "set RVE file = 10-rve_homogenization/rve.h5\nset Title = typo\n")
    done = chain.run("--validate")
    assert done.returncode == 2 and done.stdout.count("there is no key") == 2, done.stdout
    assert not os.path.exists(chain.target), "a check leaves nothing"
    chain.write("in/20-contact_dynamics.prm", "set Title = crash\n")
    chain.refused("20-contact_dynamics: the check was ended by signal 6")
    for text, words in (("20-contact_dynamics/dynamic.h5", "reads 20-contact_dynamics/dynamic.h5, but 20-contact_dynamics makes dynamics.h5"),
                        ("20-contact_dynamics/dynamics.h5\nset Other = gone/rve.h5", "there is no file gone/rve.h5, and no step before"),
                        ("40-contact_dynamics/dynamics.h5", "runs later")):
        chain.write("in/20-contact_dynamics.prm", "")
        chain.write("in/40-contact_dynamics.prm", "")
        chain.write("in/30-contact_dynamics-x.prm", f"set Run = {text}\n")
        chain.refused(words)


def installed_scripts(chain):
    """Away from a checkout the results go to the current folder, wherever the scripts are."""
    tools = chain("prefix", "share", "mesoslip", "applications", "tools")
    for part in ("chain", "python"):
        shutil.copytree(os.path.join(TOOLS, part), os.path.join(tools, part))
    shutil.copy(os.path.join(TOOLS, "run_chain.py"), tools)
    chain.write("in/10-rve_homogenization.prm", "")
    os.makedirs(chain("here"))
    subprocess.run([sys.executable, os.path.join(tools, "run_chain.py"), chain.source, "--programs", chain.programs], cwd=chain("here"),
                   check=True, stdout=subprocess.PIPE)
    assert os.path.exists(chain("here", "results", "in", "10-rve_homogenization", "rve.h5"))


def interrupt(chain, at_lines, *options):
    """The chain gets SIGINT, as its programs do, each time that so many lines were written, and ends as it should."""
    child = subprocess.Popen(chain.command(*options), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
    for lines in at_lines:
        while child.poll() is None and len(chain.started()) < lines:
            time.sleep(0.02)
        time.sleep(0.3)
        os.killpg(child.pid, signal.SIGINT)
    said, _ = child.communicate(timeout=20)
    assert "Traceback" not in said and "--resume" in said, said
    assert child.returncode == 130, f"{child.returncode}: {said}"


def stopped_while_asking(chain):
    """Ctrl-C while the size of the last run is asked for: it is not started."""
    chain.write("in/10-contact_dynamics.prm", "set Title = ask\n")
    interrupt(chain, [1], "--jobs", "2")
    assert chain.started() == ["ask 10-contact_dynamics.prm"], chain.started()


def stopped_twice(chain):
    """The first Ctrl-C waits for a run that saves its state, the second does not."""
    chain.write("in/10-rve_homogenization.prm", "set Title = slow\n")
    interrupt(chain, [2, 3])
    assert chain.started() == [what + " 10-rve_homogenization.prm" for what in ("ask", "run", "interrupt")], chain.started()


def main():
    for part in (named_files, results_that_are_gone, only_named_files, equal_names, checked_before, installed_scripts, refusals, stopped_while_asking, stopped_twice):
        with tempfile.TemporaryDirectory() as folder:
            part(Chain(folder))
        print(f"{part.__name__}: ok")


if __name__ == "__main__":
    main()
