"""What is closed at the end of a `with` statement."""

import contextlib


class Closing(contextlib.AbstractContextManager):
    """Has close() called when a `with` statement ends."""

    def __exit__(self, *exception):
        self.close()
