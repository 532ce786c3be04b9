"""Disks that are full or may not be written to: one sentence, exit status 2, and what was there stays there.

No file of the results may exceed a limit: a library loaded beforehand answers such writes as a full disk does. (The
limit of the file size that the system offers would stop MPI.) Root writes everywhere, so the runs in a folder without
permission are of another user.
"""

import os
import shutil
import subprocess
import tempfile
import time

from scenes import Folder, prm, rve, sets

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
  if (getenv("FULL_NOW"))
    return !access(getenv("FULL_NOW"), F_OK);
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
RVE = rve("60, 40", "0.006, 0.004", 4e-4, 6e-4)
CONTACT = prm({"Body/Cells": "60, 40", "Body/Size": "0.006, 0.004", "Time/End time": 2e-6, "Snapshots/Interval": 1e-7})
RESULTS = {"rve_homogenization": "rve.h5", "contact_dynamics": "dynamics.h5"}
TEXTS = {"rve_homogenization": RVE, "contact_dynamics": CONTACT}


class Bench(Folder):
    def __init__(self, folder):
        super().__init__(folder, TEXTS)
        self.problems = []
        self.write("full.c", FULL_DISK)
        subprocess.run(["cc", "-shared", "-fPIC", "-w", self("full.c"), "-o", self("full.so"), "-ldl"], check=True)

    def expect(self, what, status, words, *command, **keywords):
        found, _, err = self.end(*command, **keywords)
        missing = [word for word in words if word not in err]
        if found != status or err.count("\n") != (status != 0) or missing:
            self.problems.append(f"{what}: exit status {found}, {missing} missing in: {err[:400]}")

    def job(self, what, status, words, program, output, *options, largest_file=None, **keywords):
        environment = dict(os.environ)
        if largest_file is not None:
            environment.update(LD_PRELOAD=self("full.so"), FULL_FOLDER=self(output), FULL_BYTES=str(largest_file))
        self.expect(what, status, words, program, program + ".prm", "--quiet", "--output", output, *options, env=environment, **keywords)


def fills_up(bench, program):
    """A run that fits, then the same into a folder where no file may grow that large."""
    result, again = RESULTS[program], sets(["Homogenization/Reuse=false"]) if "rve" in program else []
    bench.job(f"{program} that fits", 0, [], program, program)
    assert not bench.problems, bench.problems
    size = os.path.getsize(bench(program, result))
    for limit, word in ((1000, "No space left"), (size // 2, result), (size - 1000, result)):
        what = f"{program} with files of {limit} bytes at most"
        bench.job(what, 2, ["cannot be", word], program, program, *again, largest_file=limit)
        left = {result, "summary.json"} & set(os.listdir(bench(program)))
        if limit > 1000 and left:
            bench.problems.append(f"{what}: left {left}")
    bench.job(f"{program} that fits again", 0, [], program, program, *again)


def fills_up_late(bench):
    """A disk that fills up after a checkpoint: the sentence says how the run goes on, and so it does."""
    settings = sets({"Time/End time": 3e-3, "Snapshots/Interval": 1e-5, "Checkpoints/Interval": 0.001})
    environment = dict(os.environ, LD_PRELOAD=bench("full.so"), FULL_FOLDER=bench("late"), FULL_NOW=bench("now"))
    run = bench.start("contact_dynamics", "contact_dynamics.prm", "--quiet", "--output", "late", *settings, env=environment)
    while run.poll() is None and not os.path.exists(bench("late", "contact_dynamics.checkpoint")):
        time.sleep(0.01)
    bench.write("now", "")
    _, err = run.communicate()
    if run.returncode != 2 or "the same command with --resume goes on from the last checkpoint" not in err or err.count("\n") != 1:
        bench.problems.append(f"a disk that fills up late: exit status {run.returncode}, {err}")
    bench.job("the same with --resume", 0, [], "contact_dynamics", "late", "--resume", *settings)
    if "Resumed at step" not in bench.read("late", "log.txt").decode():
        bench.problems.append("the run on the disk that was full did not go on")


def leaves_no_draft(bench):
    """A draft that does not fit leaves nothing."""
    for program in RESULTS:
        os.makedirs(bench("draft"))
        bench.job(f"a draft of {program}", 2, [RESULTS[program]], program, "draft", "--validate", "--draft", "draft", largest_file=2000)
        if os.listdir(bench("draft")):
            bench.problems.append(f"a draft of {program} on a full disk left {os.listdir(bench('draft'))}")
        shutil.rmtree(bench("draft"))


def become_nobody():
    if os.getuid() == 0:
        os.setgid(NOBODY)
        os.setuid(NOBODY)


def not_permitted(bench):
    os.chmod(bench.path, 0o755)
    os.mkdir(bench("read-only"), 0o555)
    try:
        bench.end("contact_dynamics", "--version", preexec_fn=become_nobody)
    except PermissionError:
        print("the programs are where another user may not start them: folders without permission left out")
        return
    for program in RESULTS:
        for output in ("read-only", "read-only/below"):
            for options in ([], ["--validate"]):
                bench.job(f"{program} --output {output} {options}", 2, [output, "Permission denied", "--output"], program, output, *options,
                          preexec_fn=become_nobody)


def full_device(bench):
    """What is asked for only to be printed, and a log: without them the exit status is not that of success."""
    for program in RESULTS:
        for options in (["--help"], ["--version"], ["--print-parameters"], ["--validate", program + ".prm"]):
            with open("/dev/full", "w", encoding="utf-8") as full:
                bench.expect(f"{program} {options} > /dev/full", 2, ["standard output cannot be written"], program, *options, stdout=full)
    os.mkdir(bench("logless"))
    os.symlink("/dev/full", bench("logless", "log.txt"))
    bench.job("a log on a full device", 2, ["log.txt: cannot be written", "the results are"], "contact_dynamics", "logless")
    if "summary.json" not in os.listdir(bench("logless")):
        bench.problems.append("a log on a full device: the results are not complete")


def main():
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(folder)
        for program in RESULTS:
            fills_up(bench, program)
        fills_up_late(bench)
        leaves_no_draft(bench)
        full_device(bench)
        not_permitted(bench)
        # Open MPI's is shared by all processes that start and end side by side: one may remove it under another.
        bench.expect("a start without a temporary folder", 0, [], "contact_dynamics", "--version",
                     env=dict(os.environ, TMPDIR="/dev/null/none"))
    assert not bench.problems, "\n".join(bench.problems)


if __name__ == "__main__":
    main()
