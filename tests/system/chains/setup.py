"""What cmake/setup.sh does with a checkout that was moved or copied, or that may not be written, on a project of one script."""

import os
import re
import shutil
import subprocess
import tempfile

from scenes import TOP, Folder

PROJECT = """cmake_minimum_required(VERSION 3.18)
project(one NONE)
file(WRITE ${CMAKE_BINARY_DIR}/program "#!/bin/sh\\n")
execute_process(COMMAND chmod +x ${CMAKE_BINARY_DIR}/program)
add_custom_target(program)
"""
STEPS = """cmake_minimum_required(VERSION 3.18)
project(steps NONE)
file(GLOB found CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/*.nothing)
foreach(k RANGE 1 20)
  add_custom_command(OUTPUT ${k}.txt COMMAND ${CMAKE_COMMAND} -E touch ${k}.txt)
  list(APPEND made ${k}.txt)
endforeach()
add_custom_target(program DEPENDS ${made})
"""
BUILD = "cmake_options=(); . cmake/setup.sh; build build program"


def build(folder, as_nobody=False):
    """Exit status and what the build says."""
    user = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if as_nobody and os.getuid() == 0 else []
    done = subprocess.run([*user, "bash", "-euc", BUILD, "run.sh"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


def expect(folder, status, words="", **how):
    found, said = build(folder, **how)
    assert found == status and words in said, (folder, found, said)
    assert status == 0 or said.count("\n") <= 2, said


def progress(path):
    """A build of twenty steps tells each tenth, one without anything to do nothing; a step that fails is named."""
    folder = Folder(path)
    folder.write("CMakeLists.txt", STEPS)
    folder.write("cmake/setup.sh", Folder(TOP).read("cmake", "setup.sh").decode())
    status, said = build(path)
    # Ninja 1.12 counts the target itself, too, without a line for it.
    told = re.findall(r"^  (\d+) %: \d+ of 2[01] steps$", said, re.M)
    assert status == 0 and told in ([str(k) for k in range(10, 101, 10)], [str(k) for k in range(10, 91, 10)]), said
    assert folder.read("build", "build.log").count(b"\n") >= 20
    assert "\nBuilding" in said, said
    status, said = build(path)
    assert status == 0 and said == "", said
    folder.write("CMakeLists.txt", STEPS.replace("-E touch", "-E no_such_command"))
    status, said = build(path)
    assert status == 2 and "the build failed, see build/build.log" in said, said


def first_build(folder):
    """Says beforehand how long it takes, on so many cores; nothing where the programs are there."""
    says = "nproc() { echo 3; }; . cmake/setup.sh; say_how_long build program"
    told = [subprocess.run(["bash", "-euc", says, "run.sh"], cwd=folder, stdout=subprocess.PIPE, check=True, text=True).stdout
            for _ in (0, 1) if not _ or build(folder)[0] == 0]
    assert "16 minutes of one core, so some 6 minutes on the 3" in told[0] and told[1:] == [""], told


def moved_or_copied(path):
    first, second = os.path.join(path, "first"), os.path.join(path, "second")
    first_build(first)
    expect(first, 0)
    expect(first, 0)
    shutil.copytree(first, second)
    expect(second, 2, f"remove it (rm -rf '{second}/build')")
    shutil.rmtree(first)  # now it is one that was moved
    expect(second, 2, f"{second}/build was made for the sources in {first}")
    shutil.rmtree(os.path.join(second, "build"))
    expect(second, 0)
    os.symlink(second, first)  # another name of the same place
    expect(first, 0)
    os.remove(first)
    return second


def not_writable(folder):
    subprocess.run(["chmod", "-R", "a=rX", folder], check=True)
    subprocess.run(["chmod", "a+x", os.path.join(folder, "build", "program")], check=True)
    try:
        expect(folder, 0, "are used as they are", as_nobody=True)
        os.chmod(os.path.join(folder, "build"), 0o755)
        os.remove(os.path.join(folder, "build", "program"))
        os.chmod(os.path.join(folder, "build"), 0o555)
        expect(folder, 2, "does not hold what has to be built: program", as_nobody=True)
    finally:
        subprocess.run(["chmod", "-R", "u+w", folder], check=True)
    shutil.rmtree(os.path.join(folder, "build"))
    os.chmod(folder, 0o555)
    try:
        expect(folder, 2, "nothing is built in it", as_nobody=True)
    finally:
        os.chmod(folder, 0o755)


def main():
    with tempfile.TemporaryDirectory() as path:
        os.chmod(path, 0o755)
        first = Folder(os.path.join(path, "first"))
        first.write("CMakeLists.txt", PROJECT)
        first.write("cmake/setup.sh", Folder(TOP).read("cmake", "setup.sh").decode())
        not_writable(moved_or_copied(path))
        progress(os.path.join(path, "steps"))
    print("ok")


if __name__ == "__main__":
    main()
