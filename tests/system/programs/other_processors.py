"""The kernels of rows compiled for ARM (aarch64) give the bits that they give here: compiles them with Debian's cross compiler and
runs them in QEMU. Exit status 77: cross compiler or emulator are not installed.

    other_processors.py
"""

import concurrent.futures
import os
import shutil
import subprocess
import sys
import tempfile

from scenes import TOP, ccache

HERE, CROSS, EMULATOR = "g++", "aarch64-linux-gnu-g++", "qemu-aarch64"
SOURCES = ["tests/system/programs/other_processors.cc", "lib/elasticity/row_kernel.cc", "lib/elasticity/element_kernel.cc",
           "lib/statics/multigrid/kernels/kernels_table.cc",
           "lib/contact/contact_kernel.cc"]
# Contraction off everywhere: the baseline has no fused multiply-add.
OPTIONS = ["-std=c++17", "-O1", "-ffp-contract=off", "-Wno-psabi", "-Ilib"]


def compiled(compiler, program):
    """Whether the compiler, two of which go side by side, makes the program."""
    objects = [f"{program}.{k}.o" for k in range(len(SOURCES))]
    commands = [[*ccache(TOP), compiler, *OPTIONS, "-c", source, "-o", name] for source, name in zip(SOURCES, objects)]
    return all(subprocess.call(command, cwd=TOP) == 0 for command in [*commands, [compiler, "-static", *objects, "-o", program]])


def main():
    missing = [name for name in (HERE, CROSS, EMULATOR) if not shutil.which(name)]
    if missing:
        print(f"not installed: {', '.join(missing)}")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        here, there = os.path.join(folder, "here"), os.path.join(folder, "there")
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            assert all(pool.map(compiled, (HERE, CROSS), (here, there)))
        ours, theirs = (subprocess.check_output(command, text=True).splitlines() for command in ([here], [EMULATOR, there]))
    assert len(ours) > 100 and len(ours) == len(theirs)
    different = sorted({one.rsplit(" ", 1)[0] for one, two in zip(ours, theirs) if one != two})
    assert not different, f"other bits on aarch64: {different}"
    print(f"{len(ours)} results of the kernels have the same bits on x86-64 and aarch64")


if __name__ == "__main__":
    main()
