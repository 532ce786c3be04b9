"""Studies (applications/tools/studies/study.py) whose runs come from the server of the programs, which saves their start."""

import os
import time

from scenes import Folder
from study import Result, Study


class ServedStudy(Study):
    """Its results tell no CPU time, and it leaves no file of the standard errors."""

    def _execute(self, case, resume):
        begin = time.monotonic()
        status, _, errors = Folder(os.getcwd()).end(case.program, *self._words(case, resume), ranks=case.ranks)
        lines = [line.strip() for line in errors.splitlines() if line.strip()]
        return Result(self.path(case.name), status, time.monotonic() - begin, 0.0, lines[-1] if lines and status else "")
