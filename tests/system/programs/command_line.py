"""What every program does with its command line, seen from the shell by a program without physics (io_program.cc)."""

import os
import subprocess
import tempfile

from scenes import ENVIRONMENT, PROGRAMS, Folder

PROGRAM = "../tests/io_program"
WRONG = [  # words of the command line, of the only sentence
    ("", "a parameter file (.prm) is needed; see --help"), ("no.prm", "there is no file no.prm"), (".", ". is a folder"),
    ("empty.prm", "empty.prm is empty"), ("--bogus a.prm", "'--bogus'"), ("a.prm b.prm", "'a.prm' and 'b.prm' are given"),
    ("bad.prm", "bad.prm:2: there is no subsection 'Tme step'"), ("in/b.prm --output file", "is not a folder; give another one"),
    ("in/b.prm --output none --resume", "nothing to resume"), ("in/b.prm --output link", "it is a link to what is not there"),
    ("in/b.prm --set=/Input/Of=1", "'/Input/Of' has a slash too many"), ("in/b.prm --set=Input//Of=1", "'Input//Of' has a slash too many"),
    ("in/b.prm --set=Input/Image\0file=x.png", "Input/Image file: there is no file {}; draw one first")]
BEHAVIOURS = [  # of the program, exit status, the only sentence or its beginning
    ("nan", 3, "summary.json: 'speed/mean' is not a finite number\n"),
    ("fail", 3, "the velocity is not finite in step 12 at t = 1.5e-06 s, node (3, 4)\n"),
    ("logic", 1, "internal error: the program asks for the parameter 'Undeclared' without declaring it"),
    ("solver", 3, "a linear solver did not converge: residual 0.5 after 7 iter")]


def files_of(folder):
    return {name for _, folders, names in os.walk(folder.path) for name in folders + names}


def check_bad_input(folder):
    before = files_of(folder)
    for words, said in WRONG:
        status, out, err = folder.end(PROGRAM, *(word.replace("\0", " ") for word in words.split()))
        assert status == 2 and out == "" and err.startswith("io_program: ") and err.count("\n") == 1, (words, status, out, err)
        assert said.format(folder("x.png")) in err, (said, err)
    assert files_of(folder) == before, "bad input creates nothing"
    assert "memory 1 MB" in folder.run(0, PROGRAM, "a.prm", "--validate") and files_of(folder) == before


def check_surroundings(folder):
    """Options of PETSc, which deal.II starts, are not ours; a current folder may be gone."""
    folder.write(".petscrc", "not an option")
    environment = {**os.environ, "PETSC_OPTIONS": "-log_view"}
    assert folder.run(0, PROGRAM, "a.prm", "-q", "-o", "quiet", env=environment) == ""
    os.remove(folder(".petscrc"))
    gone = folder("gone")
    os.mkdir(gone)
    program = os.path.join(PROGRAMS, PROGRAM)
    done = subprocess.run(f"rmdir '{gone}' && exec '{program}' '{folder('a.prm')}' -o '{folder('res0')}'", shell=True, cwd=gone, text=True,
                          stderr=subprocess.PIPE, env=ENVIRONMENT, check=False)
    assert (done.returncode, done.stderr.splitlines()[-1]) == (2, "io_program: the current folder is not there any more; "
                                                               "change to another one"), done


def check_printed_parameters(folder):
    printed = folder.run(0, PROGRAM, "--print-parameters")
    assert "  # Of the limit [-]; a number in (0, 1]\n  set Fraction = 0.3333333333333333\n" in printed, printed
    folder.write("all.prm", printed)
    assert folder.run(0, PROGRAM, "--print-parameters", "all.prm") == printed
    assert "  subsection b\n" in folder.run(0, PROGRAM, "--print-parameters", "all.prm", "--set", "Phases/Names=matrix, b")


def check_papers(folder):
    """What a run leaves beside its results; its effective parameters say the same without any --set."""
    said = folder.run(0, PROGRAM, "in/a.prm", "-o", "res", "--profile", "--set", "Phases/Names = matrix,fibre",
                      "--set", "Phases/fibre/Density=7")
    assert "\n  Work " in said, said
    assert folder.read("res", "original.prm") == folder.read("in", "a.prm")
    summary = folder.summary("res")
    assert (summary["program"], summary["dim"], summary["cells"], summary["ranks"]) == ("io_program", 3, None, 1), summary
    assert summary["peak_memory_bytes"] > 1e6 and summary["seconds"]["total"] > 0, summary
    assert b"io_program 0.2.0, 1 process" in folder.read("res", "log.txt")
    assert folder.run(0, PROGRAM, "res/parameters.prm", "-q", "-o", "res2") == ""
    one, two = (folder.read(name, "parameters.prm").decode() for name in ("res", "res2"))
    assert "set Density = 7" in one and one[one.index("set "):] == two[two.index("set "):], (one, two)
    # Paths in a .prm start at its folder; results go to output/ and the name of the .prm.
    folder.run(0, PROGRAM, "in/b.prm")
    assert os.path.exists(folder("output", "b", "summary.json"))


def check_failures(folder):
    folder.run(0, PROGRAM, "a.prm", "--set", "Behaviour=succeed")
    for behaviour, status, said in BEHAVIOURS:
        text = folder.run(status, PROGRAM, "a.prm", "--quiet", "--set", "Behaviour=" + behaviour)
        assert text.startswith("io_program: " + said) and text.count("\n") == 1, (behaviour, text)
        assert not os.path.exists(folder("out", "summary.json")), "not even the old one"
        assert behaviour != "fail" or b"stopped: the velocity is not finite" in folder.read("out", "log.txt")


def check_ranks(folder):
    """Several ranks speak with one voice; one that fails does not wait for the others, which wait for it."""
    folder.run(0, PROGRAM, "a.prm", ranks=2)
    assert folder.summary("out")["ranks"] == 2
    for status, said, arguments in (
            (3, "the velocity is not finite", ["a.prm", "--set", "Behaviour=fail"]), (2, "there is no file", ["no.prm"]),
            (2, "io_program (process 1): only this rank is in trouble", ["a.prm", "--set", "Behaviour=one rank"])):
        text = folder.end(PROGRAM, *arguments, ranks=2)
        assert text[0] == status and text[2].count(said) == 1, (arguments, text)


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"a": "set Output folder = out\n", "bad": "set Dimension = 2\nsubsection Tme step\nend\n", "empty": " \n",
                               "in/a": "set Dimension = 3 # odd   spacing \r\n", "in/b": "subsection Input\nset Image file = x.png\nend\n"})
        folder.write("in/x.png", "x")
        folder.write("file", "x")
        os.symlink("nowhere/at/all", folder("link"))
        for check in (check_bad_input, check_surroundings, check_printed_parameters, check_papers, check_failures, check_ranks):
            check(folder)


if __name__ == "__main__":
    main()
