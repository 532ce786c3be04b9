"""Disks that are full or may not be written to: one sentence, exit status 2, and what was there stays there.

    disk.py <folder with the programs>

No file of the results may exceed a limit: a library loaded beforehand answers such writes as a full disk does. (The
limit of the file size that the system offers would stop MPI.) Root writes everywhere, so the runs in a folder without
permission are of another user.
"""

import os
import subprocess
import sys
import tempfile

from scenes import PHASES

NOBODY = 65534
FULL_DISK = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

/* Whether the file is below FULL_FOLDER, and so many bytes at this place would pass FULL_BYTES. */
static int full(int fd, off_t at, size_t n)
{
  const char *folder = getenv("FULL_FOLDER");
  char link[64], path[4096] = "";
  struct stat status;
  snprintf(link, sizeof(link), "/proc/self/fd/%d", fd);
  if (!folder || readlink(link, path, sizeof(path) - 1) < 0 || strncmp(path, folder, strlen(folder)) || fstat(fd, &status))
    return 0;
  errno = ENOSPC;
  return (at < 0 ? status.st_size : at) + (off_t)n > atol(getenv("FULL_BYTES"));
}
#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
ssize_t write(int fd, const void *data, size_t n) { return full(fd, -1, n) ? -1 : NEXT(write)(fd, data, n); }
ssize_t pwrite(int fd, const void *data, size_t n, off_t at) { return full(fd, at, n) ? -1 : NEXT(pwrite)(fd, data, n, at); }
ssize_t pwrite64(int fd, const void *data, size_t n, off64_t at) { return full(fd, at, n) ? -1 : NEXT(pwrite64)(fd, data, n, at); }
ssize_t writev(int fd, const struct iovec *v, int k)
{
  size_t n = 0;
  for (int i = 0; i < k; ++i)
    n += v[i].iov_len;
  return full(fd, -1, n) ? -1 : NEXT(writev)(fd, v, k);
}
"""
RVE = PHASES + """
subsection Grid
  set Cells = 60, 40
  set Size = 0.006, 0.004
end
subsection Microstructure
  subsection Random fibres
    set Minimum height = 4e-4
    set Maximum height = 6e-4
  end
end
"""
CONTACT = """
subsection Body
  set Cells = 60, 40
  set Size = 0.006, 0.004
end
subsection Time
  set End time = 2e-6
end
subsection Snapshots
  set Interval = 1e-7
end
"""
RESULTS = {"rve_homogenization": "rve.h5", "contact_dynamics": "dynamics.h5"}
TEXTS = {"rve_homogenization": RVE, "contact_dynamics": CONTACT}


class Bench:
    def __init__(self, programs, folder):
        self.programs, self.folder, self.problems = programs, folder, []
        for name, text in TEXTS.items():
            with open(self.path(name + ".prm"), "w", encoding="utf-8") as file:
                file.write(text)
        with open(self.path("full.c"), "w", encoding="utf-8") as file:
            file.write(FULL_DISK)
        subprocess.run(["cc", "-shared", "-fPIC", "-w", self.path("full.c"), "-o", self.path("full.so"), "-ldl"], check=True)

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def run(self, program, output, *options, prepare=None, largest_file=None):
        environment = dict(os.environ)
        if largest_file is not None:
            environment.update(LD_PRELOAD=self.path("full.so"), FULL_FOLDER=self.path(output), FULL_BYTES=str(largest_file))
        return subprocess.run([os.path.join(self.programs, program), program + ".prm", "--quiet", "--output", output,
                               *options], cwd=self.folder, env=environment, text=True, capture_output=True,
                              preexec_fn=prepare)

    def expect(self, what, done, status, *words):
        lines = done.stderr.strip().splitlines()
        if done.returncode != status or len(lines) != (status != 0):
            self.problems.append(f"{what}: exit status {done.returncode}, {len(lines)} lines: {done.stderr[:400]}")
        self.problems += [f"{what}: '{word}' is missing in: {done.stderr[:400]}" for word in words
                          if word not in done.stderr]


def contents(folder):
    found = {}
    for name in os.listdir(folder):
        with open(os.path.join(folder, name), "rb") as file:
            found[name] = file.read()
    return found


def fills_up(bench, program):
    """A run that fits, then the same into a folder where no file may grow that large."""
    result = RESULTS[program]
    bench.expect(f"{program} that fits", bench.run(program, program), 0)
    assert not bench.problems, bench.problems
    before = contents(bench.path(program))
    again = ["--set", "Homogenization/Reuse=false"] if "rve" in program else []
    for limit, word in ((1000, "No space left"), (len(before[result]) // 2, result),
                        (len(before[result]) - 1000, result)):
        what = f"{program} with files of {limit} bytes at most"
        done = bench.run(program, program, *again, largest_file=limit)
        bench.expect(what, done, 2, "cannot be", word)
        after = contents(bench.path(program))
        if limit > 1000 and result in after:
            bench.problems.append(f"{what}: there is a {result} though it could not be written")
        if limit > 1000 and "summary.json" in after:
            bench.problems.append(f"{what}: a failed run left a summary.json")
    bench.expect(f"{program} that fits again", bench.run(program, program, *again), 0)


def become_nobody():
    if os.getuid() == 0:
        os.setgid(NOBODY)
        os.setuid(NOBODY)


def not_permitted(bench):
    os.chmod(bench.folder, 0o755)
    os.mkdir(bench.path("read-only"), 0o555)
    try:
        bench.run("contact_dynamics", "x", "--version", prepare=become_nobody)
    except PermissionError:
        print("the programs are where another user may not start them: folders without permission left out")
        return
    for program in ("rve_homogenization", "contact_dynamics"):
        for output in ("read-only", "read-only/below"):
            for options in ([], ["--validate"]):
                bench.expect(f"{program} --output {output} {options}",
                             bench.run(program, output, *options, prepare=become_nobody), 2,
                             output, "Permission denied", "--output")


def no_temporary_folder(bench):
    """Open MPI's is shared by all processes that start and end side by side: one may remove it under another."""
    path = os.path.join(bench.programs, "contact_dynamics")
    done = subprocess.run([path, "--version"], env=dict(os.environ, TMPDIR="/dev/null/none"), text=True, capture_output=True)
    bench.expect("a start without a temporary folder", done, 0)


def full_device(bench):
    """What is asked for only to be printed, and a log: without them the exit status is not that of success."""
    path = lambda program: os.path.join(bench.programs, program)
    for program in RESULTS:
        for options in (["--help"], ["--version"], ["--print-parameters"], ["--validate", program + ".prm"]):
            with open("/dev/full", "w", encoding="utf-8") as full:
                done = subprocess.run([path(program), *options], cwd=bench.folder, stdout=full, stderr=subprocess.PIPE, text=True)
            bench.expect(f"{program} {options} > /dev/full", done, 2, "standard output cannot be written")
    os.mkdir(bench.path("logless"))
    os.symlink("/dev/full", bench.path("logless", "log.txt"))
    bench.expect("a log on a full device", bench.run("contact_dynamics", "logless"), 2, "log.txt: cannot be written", "the results are")
    if "summary.json" not in os.listdir(bench.path("logless")):
        bench.problems.append("a log on a full device: the results are not complete")


def main():
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(os.path.abspath(sys.argv[1]), folder)
        for program in RESULTS:
            fills_up(bench, program)
        full_device(bench)
        not_permitted(bench)
        no_temporary_folder(bench)
    assert not bench.problems, "\n".join(bench.problems)
    print("full disks, no temporary folder and folders without permission: refused or stopped, nothing lost")


if __name__ == "__main__":
    main()
