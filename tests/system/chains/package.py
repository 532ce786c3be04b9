#!/usr/bin/env python3
"""Installs mesoslip, builds doc/extending against the installed package as another project would, runs what
it built and what was installed."""

import os
import re
import subprocess
import sys
import tempfile

from scenes import PROGRAMS, TOP, Folder, ccache


def call(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        print(done.stdout)
        sys.exit(f"failed: {' '.join(command)}")
    return done.stdout


def numbers(text):
    return [float(n) for n in re.findall(r"[-+]?\d+\.\d+", text)]


def check_example(build):
    stopped, exact = numbers(call(os.path.join(build, "block_on_flat")))
    assert abs(stopped / exact - 1.0) < 2e-3, (stopped, exact)
    swung, exact = numbers(call(os.path.join(build, "block_on_springs")))
    assert abs(swung / exact - 1.0) < 3e-4, (swung, exact)
    d11, exact11, d33, exact33 = numbers(call(os.path.join(build, "checkerboard_stiffness")))
    assert exact11 < d11 < 1.004 * exact11, "Q1 elements are too stiff, but not by much"
    assert abs(d33 / exact33 - 1.0) < 1e-6, (d33, exact33)


def check_installed(prefix):
    for program in ("rve_homogenization", "contact_dynamics", "stress_localization"):
        assert program in call(os.path.join(prefix, "bin", program), "--version")
    share = os.path.join(prefix, "share", "mesoslip")
    call(sys.executable, os.path.join(share, "applications", "tools", "run_chain.py"), os.path.join(share, "prm", "examples", "image"),
         "--output", os.path.join(prefix, "results"))
    assert os.path.getsize(os.path.join(prefix, "results", "report.html")) > 1e5
    # Nothing points back at the build.
    for folder, _, names in os.walk(os.path.join(prefix, "lib", "cmake")):
        for name in names:
            assert TOP.encode() not in Folder(folder).read(name), f"{name} names the source folder"


def main():
    with tempfile.TemporaryDirectory() as scratch:
        prefix, example = os.path.join(scratch, "installed"), os.path.join(scratch, "example")
        call("cmake", "--install", os.path.dirname(PROGRAMS), "--prefix", prefix)
        call("cmake", "-S", os.path.join(TOP, "doc", "extending"), "-B", example, "-G", "Ninja",
             f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_COMPILER_LAUNCHER=" + ";".join(ccache(scratch)))
        call("cmake", "--build", example)
        check_example(example)
        check_installed(prefix)
    print("ok")


if __name__ == "__main__":
    main()
