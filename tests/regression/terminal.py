"""Colours and carriage returns go to terminals only.

    terminal.py <folder with the programs>
"""

import os
import pty
import subprocess
import sys
import tempfile

# Some seconds of steps would be enough for several updates; the run is stopped when they were seen.
PRM = """
subsection Body
  set Cells = 280, 80
end
subsection Time
  set End time = 1e-2
end
"""
CONTROLS = (b"\r", b"\033")


def chunks(master):
    """What arrives at a terminal until the program has left it."""
    while True:
        try:
            chunk = os.read(master, 4096)
        except OSError:
            return
        if not chunk:
            return
        yield chunk


def run(command, folder, on_terminal, **environment):
    """What the program writes in its first seconds, to a terminal or to a file."""
    env = {k: v for k, v in os.environ.items() if k != "NO_COLOR"} | environment
    if not on_terminal:
        # Lines of progress come every ten seconds or tenths; the run is stopped after some.
        process = subprocess.Popen(command, cwd=folder, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        output = b""
        for line in process.stdout:
            output += line
            if b"Sliding" in line:
                break
        process.terminate()
        output += process.stdout.read()
        return output, process.wait()
    master, slave = pty.openpty()
    process = subprocess.Popen(command, cwd=folder, env=env, stdout=slave, stderr=subprocess.STDOUT, close_fds=True)
    os.close(slave)
    output = b""
    for chunk in chunks(master):
        output += chunk
        if output.count(b"Sliding") >= 3:
            break
    process.terminate()
    output += b"".join(chunks(master))
    return output, process.wait()


def main():
    program = os.path.join(os.path.abspath(sys.argv[1]), "contact_dynamics")
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "case.prm"), "w", encoding="utf-8") as file:
            file.write(PRM)
        command = [program, "case.prm", "--output", "out"]
        log = lambda: open(os.path.join(folder, "out", "log.txt"), "rb").read()

        output, status = run(command, folder, on_terminal=False)
        problems += [f"{control} in a file: {output}" for control in CONTROLS if control in output]
        if b"Sliding" not in output or status != 130:
            problems.append(f"no progress in a file, or exit status {status}: {output}")
        problems += [f"{control} in log.txt: {log()}" for control in CONTROLS if control in log()]

        # mpirun gives each process a terminal of its own, whatever it writes to itself.
        mpi = dict(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        output, _ = run(["mpirun", "--oversubscribe", "-np", "2", *command], folder, on_terminal=False, **mpi)
        problems += [f"{control} under mpirun in a file: {output}" for control in CONTROLS if control in output]

        output, status = run(command, folder, on_terminal=True)
        if output.count(b"\r\033[36mSliding") < 3 or b"\033[0m" not in output or status != 130:
            problems.append(f"no coloured progress in one line on a terminal, or exit status {status}: {output}")
        problems += [f"{control} in log.txt after a terminal: {log()}" for control in CONTROLS if control in log()]

        output, _ = run(command, folder, on_terminal=True, NO_COLOR="1")
        if b"\033[36m" in output or output.count(b"\rSliding") < 3:
            problems.append(f"NO_COLOR: {output}")

        output, _ = run([program, "--print-parameters"], folder, on_terminal=False)
        problems += [f"{control} in --print-parameters" for control in CONTROLS if control in output]
    assert not problems, "\n".join(problems)


if __name__ == "__main__":
    main()
