"""A single .prm file that belongs to no chain: the program that it is for, and the folder of its results."""

import os

from chain.inputs import ChainError
from chain.step import Step, program_path
from program_choice import Refused, program_for, results_folder


class SingleFile(Step):
    """Runs whenever it is asked to: a map computes the points that it lacks."""

    def __init__(self, prm, arguments):
        """The path of the file is seen from the folder `arguments.origin`. Raises ChainError with the sentence of the program that refuses it."""
        words = [f"--output={arguments.output}"] if arguments.output else []
        try:
            self.program, self.said = program_for(prm, words, lambda name: program_path(name, arguments.programs), folder=arguments.origin)
        except Refused as refused:
            raise ChainError(str(refused)) from refused
        self.name = os.path.basename(prm)[:-len(".prm")]
        self.prm = os.path.join(arguments.origin, prm)
        self.output = os.path.join(arguments.origin, results_folder(self.said))
        self.needs = []

    def up_to_date(self):
        return False

    def mark_done(self):
        """Nothing asks whether it is up to date."""
