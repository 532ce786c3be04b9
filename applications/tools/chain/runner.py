"""Runs the steps of a chain in the order of their needs, several at a time."""

import concurrent.futures
import os
import signal
import subprocess
import threading
import time

from ranks import keep_ranks, ranks_begun_with, ranks_worth

INTERRUPTED = 130
STOPPING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class Runner:
    def __init__(self, steps, jobs, ranks, resume, preview=None, said=None):
        """`said`: what the programs say of the steps when they check them."""
        self.steps, self.jobs, self.ranks, self.preview, self.said = steps, jobs, ranks, preview, said or {}
        self.resume = resume
        self.lock = threading.Lock()
        self.stopping = False
        self.children = []  # processes, each with the function that stops it
        self.environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")

    def run(self):
        """The exit status: of the first run that failed, 130 when interrupted."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            try:
                return self._run_all(pool)
            except KeyboardInterrupt:
                # The runs save their state; leaving the pool waits for them.
                self._stop()
                return INTERRUPTED

    def _stop(self):
        for number in STOPPING:  # again: no more waiting
            signal.signal(number, lambda *_: self._each_child(lambda child, _: child.terminate()))
        with self.lock:
            self.stopping = True
        self._each_child(lambda _, stop: stop())

    def _each_child(self, action):
        for child, stop in list(self.children):
            if child.poll() is None:
                action(child, stop)

    def _say(self, line):
        with self.lock:
            print(line, flush=True)

    def _ranks_for(self, step, resume, last):
        """As asked for; else those that are worth it for a run beside which no other can start, `last`."""
        if self.ranks:
            return self.ranks
        if resume:
            return ranks_begun_with(step.output)
        return ranks_worth(self.said.get(step.name, ""), self.jobs) if last and self.jobs > 1 else 1

    def _start(self, step, alone, ranks):
        """The process; None when the chain is to stop."""
        resume = self.resume and step.begun()
        output = {} if alone else {"text": True, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        with self.lock:  # no run starts after the others were stopped
            if self.stopping:
                return None
            keep_ranks(step.output, ranks)
            # mpirun would end its ranks on Ctrl-C before they have saved their state.
            child = subprocess.Popen(step.command(ranks, resume), env=self.environment, start_new_session=ranks > 1, **output)
            self.children.append((child, step.ask_to_stop if ranks > 1 else child.terminate))
        return child

    def _attempt(self, step, alone, ranks):
        begin = time.monotonic()
        child = self._start(step, alone, ranks)
        if child is None:
            return INTERRUPTED
        for line in child.stdout or ():
            self._say(f"[{step.name}] {line.rstrip()}")
        status = child.wait()
        if status < 0:  # by a signal, as shells count
            status = 128 - status
        if status == 0:
            step.mark_done()
            self._say(f"{step.name}: done in {time.monotonic() - begin:.1f} s")
        else:
            self._say(f"{step.name}: stopped with exit status {status}")
        return status

    def _run_all(self, pool):
        waiting, done, running, worst, shown = list(self.steps), set(), {}, 0, None
        while waiting or running:
            ready = [s for s in waiting if all(n.name in done for n in s.needs)]
            alone = len(ready) == 1 and not running and not any(
                all(n.name in done for n in s.needs) for s in waiting if s is not ready[0])
            for step in ready if worst == 0 else []:
                if len(running) >= self.jobs:
                    break
                waiting.remove(step)
                if step.up_to_date():
                    self._say(f"{step.name}: up to date")
                    done.add(step.name)
                else:
                    ranks = self._ranks_for(step, self.resume and step.begun(), not running and all(s.hangs_on(step) for s in waiting))
                    if ranks > 1:
                        self._say(f"{step.name}: on {ranks} ranks")
                    running[pool.submit(self._attempt, step, alone or self.jobs == 1, ranks)] = (step, ranks)
            if not running:
                if worst or not any(all(n.name in done for n in s.needs) for s in waiting):
                    break
                continue
            busy = sum(ranks for _, ranks in running.values())
            if self.preview and done and waiting and worst == 0 and busy < self.jobs and (shown is None or shown.done()):
                shown = pool.submit(self.preview)
            finished, _ = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
            for future in finished:
                (step, _), status = running.pop(future), future.result()
                worst = worst or status
                if status == 0:
                    done.add(step.name)
        return worst
